// What write_file() replaces, keeps and leaves behind.
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <functional>

#include "refused_calls.h"
#include "scratch_folder.h"
#include "texture/image_files.h"

namespace swell::texture {
namespace {

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

struct stat status_of(const fs::path& path) {
  struct stat status {};
  EXPECT_EQ(stat(path.c_str(), &status), 0) << path;
  return status;
}

// Runs `work` in a child; its exit code, or -signal.
int in_child(const std::function<void()>& work) {
  const pid_t child = fork();
  if (child == 0) {
    try {
      work();
    } catch (const FileError&) {
      _exit(7);
    }
    _exit(0);
  }
  int status = 0;
  EXPECT_EQ(waitpid(child, &status, 0), child);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

// ---- In one way

using WriteFile = Files;

TEST_F(WriteFile, WritesAndReplaces) {
  const fs::path path = folder / "a.bin";
  write_file(path, bytes_of("first"));
  EXPECT_EQ(content(path), "first");
  write_file(path, bytes_of("second, longer"));
  EXPECT_EQ(content(path), "second, longer");
  write_file(path, {});
  EXPECT_EQ(content(path), "");
  EXPECT_EQ(file_count(), 1u);
  write_file(folder / std::string(250, 'n'), bytes_of("a long name"));
  EXPECT_EQ(file_count(), 2u);
}

TEST_F(WriteFile, ReplacesALinkAndLeavesWhatItNames) {
  const fs::path file = put("file", bytes_of("old"));
  fs::create_symlink(file, folder / "link");
  fs::create_symlink("nothing", folder / "dangling");
  for (const char* name : {"link", "dangling"}) {
    write_file(folder / name, bytes_of("new"));
    EXPECT_FALSE(fs::is_symlink(folder / name)) << name;
    EXPECT_EQ(content(folder / name), "new") << name;
  }
  EXPECT_EQ(content(file), "old");
  EXPECT_FALSE(fs::exists(folder / "nothing"));
}

TEST_F(WriteFile, FollowsLinksOnTheWay) {
  fs::create_directory(folder / "inner");
  fs::create_symlink("inner", folder / "way");
  write_file(folder / "way" / "file", bytes_of("new"));
  EXPECT_TRUE(fs::is_symlink(folder / "way"));
  EXPECT_EQ(content(folder / "inner" / "file"), "new");
}

void expect_write_fails(const fs::path& path) {
  try {
    write_file(path, bytes_of("content"));
    ADD_FAILURE() << path << " was written";
  } catch (const FileError& error) {
    EXPECT_EQ(std::string(error.what()).rfind(path.string(), 0), 0u) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
}

TEST_F(WriteFile, PlacesThatCannotBeWrittenAreRefused) {
  put("file", bytes_of("old"));
  fs::create_directory(folder / "folder");
  fs::create_symlink(folder / "loop", folder / "loop");
  const std::size_t before = file_count();
  expect_write_fails(folder / "missing" / "a.png");
  expect_write_fails(folder / "file" / "a.png");  // below a file
  expect_write_fails(folder / "folder");
  expect_write_fails(folder / std::string(300, 'x'));
  expect_write_fails(folder / "loop");
  expect_write_fails("/proc/swell.png");
  expect_write_fails("/dev/null");
  fs::create_symlink("/dev/null", folder / "device");
  fs::create_symlink("/proc/self/exe", folder / "open_file");
  fs::create_symlink("folder", folder / "link_to_folder");
  for (const char* name : {"device", "open_file", "link_to_folder"}) {
    expect_write_fails(folder / name);
    EXPECT_TRUE(fs::remove(folder / name));
  }
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_EQ(file_count(), before);
  EXPECT_TRUE(fs::is_empty(folder / "folder"));
  EXPECT_EQ(content(folder / "file"), "old");
}

TEST_F(WriteFile, FullDiskLeavesTheOldFileAndNoOther) {
  const fs::path path = put("a.bin", bytes_of("old"));
  const pid_t child = fork();
  if (child == 0) {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{1000, 1000};
    if (setrlimit(RLIMIT_FSIZE, &limit) != 0) _exit(3);
    try {
      write_file(path, Bytes(5000, 'x'));
    } catch (const FileError&) {
      _exit(7);
    }
    _exit(0);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 7);
  EXPECT_EQ(content(path), "old");
  EXPECT_EQ(file_count(), 1u);
}

// ---- In all ways

// The ways to a whole file: without a name until it is done, as far as the system lets us.
struct Way {
  const char* name;
  bool (*prepare)();
};
void PrintTo(const Way& way, std::ostream* out) { *out << way.name; }
constexpr Way kWays[] = {{"UnnamedFiles", [] { return true; }},
                         {"NoUnnamedFiles", refuse_unnamed_files},
                         {"NoLinks", refuse_links}};

class ReplacedFile : public testing::TestWithParam<Way> {
 protected:
  // Writes with the parameter's way, in a child.
  void write(
      const fs::path& path, const std::string& text, const std::function<void()>& first = [] {}) {
    EXPECT_EQ(in_child([&] {
                first();
                if (!GetParam().prepare()) _exit(9);
                write_file(path, bytes_of(text));
              }),
              0);
  }
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder))
      names.push_back(entry.path().filename().string());
    return names;
  }
  // A child that is killed in the middle of writing, when it may have a temporary file.
  void write_and_die(const fs::path& path) {
    EXPECT_EQ(in_child([&] {
                if (!GetParam().prepare()) _exit(9);
                signal(SIGXFSZ, SIG_DFL);
                const rlimit limit{1000, 1000}, no_core{0, 0};
                setrlimit(RLIMIT_CORE, &no_core);
                setrlimit(RLIMIT_FSIZE, &limit);
                write_file(path, Bytes(5000, 'x'));
              }),
              -SIGXFSZ);
  }

  const ScratchFolder scratch;
  const fs::path folder = scratch.path();
};
INSTANTIATE_TEST_SUITE_P(Ways, ReplacedFile, testing::ValuesIn(kWays),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_P(ReplacedFile, KeepsItsMode) {
  for (const mode_t mode : {0600u, 0644u, 0640u, 0755u, 0444u, 0664u, 0666u, 0700u, 02750u}) {
    const fs::path path = folder / "a.png";
    std::ofstream(path) << "old";
    ASSERT_EQ(chmod(path.c_str(), mode), 0);
    write(path, "new");
    EXPECT_EQ(content(path), "new");
    EXPECT_EQ(status_of(path).st_mode & 07777, mode);
    fs::remove(path);
  }
  EXPECT_TRUE(names().empty());
}

TEST_P(ReplacedFile, KeepsItsOwnerWhereTheSystemAllowsIt) {
  if (geteuid() != 0) GTEST_SKIP() << "only root gives files away";
  const fs::path path = folder / "a.png";
  std::ofstream(path) << "old";
  ASSERT_EQ(chown(path.c_str(), 1234, 5678), 0);
  ASSERT_EQ(chmod(path.c_str(), 0640), 0);
  write(path, "new");
  EXPECT_EQ(status_of(path).st_uid, 1234u);
  EXPECT_EQ(status_of(path).st_gid, 5678u);
  EXPECT_EQ(status_of(path).st_mode & 07777, 0640u);
  // Another user who may write into the folder makes it his own; his group gains no access.
  ASSERT_EQ(chmod(folder.c_str(), 0777), 0);
  write(path, "newer", [] {
    if (setgid(2345) != 0 || setuid(2345) != 0) _exit(9);
  });
  EXPECT_EQ(content(path), "newer");
  EXPECT_EQ(status_of(path).st_uid, 2345u);
  EXPECT_EQ(status_of(path).st_gid, 2345u);
  EXPECT_EQ(status_of(path).st_mode & 07777, 0600u);
}

TEST_P(ReplacedFile, ANewFileHasTheModeThatTheUmaskLeaves) {
  for (const mode_t mask : {022u, 077u, 002u, 0u}) {
    const fs::path path = folder / "a.png";
    write(path, "new", [&] { umask(mask); });
    EXPECT_EQ(status_of(path).st_mode & 07777, 0666 & ~mask);
    fs::remove(path);
  }
}

TEST_P(ReplacedFile, ItsOtherHardLinksKeepTheOldContent) {
  std::ofstream(folder / "first") << "old";
  fs::create_hard_link(folder / "first", folder / "second");
  write(folder / "first", "new");
  EXPECT_EQ(content(folder / "first"), "new");
  EXPECT_EQ(content(folder / "second"), "old");
  EXPECT_EQ(status_of(folder / "first").st_nlink, 1u);
  EXPECT_EQ(names().size(), 2u);
}

TEST_P(ReplacedFile, ALinkOfItsNameIsReplaced) {
  fs::create_directory(folder / "inner");
  std::ofstream(folder / "inner" / "file") << "old";
  ASSERT_EQ(chmod((folder / "inner" / "file").c_str(), 0606), 0);
  fs::create_symlink("inner/file", folder / "link");
  write(folder / "link", "new");
  EXPECT_FALSE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(content(folder / "link"), "new");
  EXPECT_EQ(status_of(folder / "link").st_mode & 07777, 0644u);  // not that of the link's file
  EXPECT_EQ(content(folder / "inner" / "file"), "old");
}

TEST_P(ReplacedFile, ALinkInAFolderOfEverybodysIsNotFollowed) {
  std::ofstream(folder / "victim") << "old";
  fs::create_directory(folder / "sticky");
  ASSERT_EQ(chmod((folder / "sticky").c_str(), 01777), 0);
  fs::create_symlink("../victim", folder / "sticky" / "a.png");
  if (geteuid() == 0) {
    ASSERT_EQ(lchown((folder / "sticky" / "a.png").c_str(), 1234, 1234), 0);
  }
  write(folder / "sticky" / "a.png", "new");
  EXPECT_EQ(content(folder / "victim"), "old");
  EXPECT_FALSE(fs::is_symlink(folder / "sticky" / "a.png"));
  EXPECT_EQ(content(folder / "sticky" / "a.png"), "new");
}

TEST_P(ReplacedFile, IsWholeOrOldWhenTheDiskFillsUp) {
  const fs::path path = folder / "a.png";
  std::ofstream(path) << "old";
  EXPECT_EQ(in_child([&] {
              if (!GetParam().prepare()) _exit(9);
              signal(SIGXFSZ, SIG_IGN);
              const rlimit limit{1000, 1000};
              setrlimit(RLIMIT_FSIZE, &limit);
              write_file(path, Bytes(5000, 'x'));
            }),
            7);
  EXPECT_EQ(content(path), "old");
  EXPECT_EQ(names().size(), 1u);
}

TEST_P(ReplacedFile, StaysOldWhenTheWriterIsKilledAndALaterOneCleansUp) {
  const fs::path path = folder / "a.png";
  std::ofstream(path) << "old";
  write_and_die(path);
  EXPECT_EQ(content(path), "old");
  const std::size_t left = std::string_view(GetParam().name) == "NoUnnamedFiles" ? 2 : 1;
  EXPECT_EQ(names().size(), left);
  remove_abandoned_files(folder);
  EXPECT_EQ(names(), std::vector<std::string>{"a.png"});
}

// --- What a later run may remove

class AbandonedFile : public ReplacedFile {
 protected:
  // Its name is .swell-HOST-BOOT-PID-N.tmp.
  std::vector<std::string> parts_of_abandoned_name() {
    write_and_die(folder / "a.png");
    const std::string name = names().at(0);
    std::vector<std::string> parts(1);
    for (const char c : name) {
      if (c == '-' || c == '.')
        parts.emplace_back();
      else
        parts.back() += c;
    }
    fs::remove(folder / name);
    return parts;  // "", "swell", host, boot, pid, "0", "tmp"
  }
  fs::path put(const std::string& host, const std::string& boot, const std::string& pid,
               std::chrono::minutes age = std::chrono::minutes(0)) {
    const fs::path path = folder / (".swell-" + host + "-" + boot + "-" + pid + "-0.tmp");
    std::ofstream(path) << "half";
    fs::last_write_time(path, fs::file_time_type::clock::now() - age);
    return path;
  }
};
INSTANTIATE_TEST_SUITE_P(Ways, AbandonedFile, testing::Values(kWays[1]));

TEST_P(AbandonedFile, IsRemovedOnlyWhereItsProcessIsSurelyDead) {
  const std::vector<std::string> parts = parts_of_abandoned_name();
  ASSERT_EQ(parts.size(), 7u);
  const std::string host = parts[2], boot = parts[3], dead = parts[4];
  const std::string other = "0123456789abcdef";
  const std::chrono::hours day(24);
  const fs::path kept[] = {
      put(host, boot, std::to_string(getpid()), day),  // alive
      put(host, boot, "1", day),                       // alive, and perhaps another user's
      put(other, boot, dead, day),
      put(other, other, dead, day),
      put(host, other, dead),  // may be a copy of this machine, at work
      put(host, other, dead, std::chrono::minutes(55)),
      put(host, boot, "-1", day),
      put(host, boot, "0", day),
      put(host, boot, dead + "x", day),
  };
  const fs::path gone[] = {put(host, boot, dead), put(host, other, dead + "9", day),
                           put(host, other, std::to_string(getpid()), day)};
  fs::create_directory(folder / (".swell-" + host + "-" + boot + "-" + dead + "-1.tmp"));
  std::ofstream(folder / ".swell-12345-0.tmp") << "an unknown name";
  remove_abandoned_files(folder);
  for (const fs::path& path : kept) EXPECT_TRUE(fs::exists(path)) << path;
  for (const fs::path& path : gone) EXPECT_FALSE(fs::exists(path)) << path;
  EXPECT_TRUE(fs::exists(folder / ".swell-12345-0.tmp"));
  EXPECT_TRUE(fs::exists(folder / (".swell-" + host + "-" + boot + "-" + dead + "-1.tmp")));
}

TEST_P(AbandonedFile, InAFolderThatIsNoneIsNoFault) {
  EXPECT_NO_THROW(remove_abandoned_files(folder / "missing"));
  EXPECT_NO_THROW(remove_abandoned_files("/dev/null"));
}

}  // namespace
}  // namespace swell::texture
