// write_file(): whole files or none, whatever ends the process.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <optional>

#include "math/parallel.h"
#include "texture/image/file_bytes.h"
#include "texture/image/output_folder.h"
#include "texture/image/signal_lock.h"

namespace swell::texture {
namespace {

// Writes all bytes; returns 0 or errno.
int write_all(int descriptor, std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written > 0) bytes = bytes.subspan(static_cast<std::size_t>(written));
    if (written < 0 && errno != EINTR) return errno;
    if (written == 0) return ENOSPC;
  }
  return 0;
}

// What is to be written: a name in an open folder.
struct Target {
  const std::filesystem::path& path;  // for messages
  int folder;
  std::string name;
  std::optional<struct stat> replaced;  // the file that is there
  // Until the old file's access is known to be kept, nobody else may look into the new one.
  mode_t first_mode() const { return replaced ? 0600 : 0666; }
};

void check_kind(const std::filesystem::path& path, mode_t mode) {
  if (S_ISDIR(mode)) fail(path, "cannot write, got a directory, allowed a file");
  if (!S_ISREG(mode)) fail(path, "cannot write, got a device, a pipe or a socket, allowed a file");
}

// A link is replaced, and what it names stays as it is. One to a folder, a device or a pipe is
// refused all the same, and so is one to an open file (/dev/stdout): a system's, and no output's.
void check_link(const std::filesystem::path& path, int folder, const std::string& name) {
  struct stat behind;
  if (::fstatat(folder, name.c_str(), &behind, 0) != 0) {
    if (errno == ENOENT) return;
    fail(path, "cannot write: {}", reason(errno));
  }
  check_kind(path, behind.st_mode);
  constexpr std::string_view kProcesses = "/proc/";
  std::array<char, kProcesses.size()> text{};
  const ssize_t got = ::readlinkat(folder, name.c_str(), text.data(), text.size());
  if (got == std::ssize(kProcesses) && std::string_view(text.data(), text.size()) == kProcesses)
    fail(path, "cannot write, got what stands for an open file, allowed a file's own name");
}

// Refuses what is not a file: renaming over a device or a pipe would replace it.
Target checked_target(const std::filesystem::path& path, int folder, const std::string& name) {
  struct stat status;
  if (::fstatat(folder, name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0) {
    if (errno == ENOENT) return {path, folder, name, std::nullopt};
    fail(path, "cannot write: {}", reason(errno));
  }
  if (S_ISLNK(status.st_mode)) {
    check_link(path, folder, name);
    return {path, folder, name, std::nullopt};
  }
  check_kind(path, status.st_mode);
  return {path, folder, name, status};
}

// Owner, group and mode of the file that is replaced, as far as the system allows; never access
// for somebody who did not have it.
void keep_access(int file, const struct stat& old) {
  mode_t mode = old.st_mode & 07777;
  if (::fchown(file, old.st_uid, old.st_gid) != 0) {
    mode &= 0777;  // not as another user's
    if (::fchown(file, static_cast<uid_t>(-1), old.st_gid) != 0) mode &= 0707 | (mode & 07) << 3;
  }
  ::fchmod(file, mode);
}

// Fills, syncs and fits out the new file; returns 0 or errno.
int fill_file(int file, const Target& target, std::span<const std::uint8_t> bytes) {
  if (const int error = write_all(file, bytes)) return error;
  if (target.replaced) keep_access(file, *target.replaced);
  return ::fsync(file) == 0 ? 0 : errno;
}

// --- Files under temporary names, which nobody may leave behind

// The names that are in use now, for abandon_writes(). Each stands on its writer's stack.
struct NameInUse {
  int folder = -1;
  const char* name = nullptr;
  NameInUse* next = nullptr;
};
constinit NameInUse* names_in_use = nullptr;
constinit SignalLock names_lock;  // files and names_in_use change together

// FNV-1a.
std::uint64_t hash_text(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : text) hash = (hash ^ static_cast<std::uint8_t>(c)) * 0x100000001b3u;
  return hash;
}

std::string first_line(const char* path) {
  std::string line;
  std::getline(std::ifstream(path), line);
  return line;
}

// Where process ids mean the same: one machine, or one container on it, since one start.
struct Host {
  std::uint64_t id = 0, boot = 0;
  bool known = false;
};

Host this_host() {
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0) return {};
  std::error_code error;
  const auto processes = std::filesystem::read_symlink("/proc/self/ns/pid", error);
  const std::string boot = first_line("/proc/sys/kernel/random/boot_id");
  const std::string machine = first_line("/etc/machine-id");
  return {hash_text(name.data() + ('/' + machine) + processes.string()), hash_text(boot),
          !error && !boot.empty()};
}

std::string temporary_name(const Host& host, int attempt) {
  return fmt::format(".swell-{:016x}-{:016x}-{}-{}.tmp", host.id, host.boot, ::getpid(), attempt);
}

constexpr int kMostAttempts = 1000;

// A new file beside the target, under a temporary name.
class NamedFile {
 public:
  explicit NamedFile(const Target& target) : folder_(target.folder) {
    const Host host = this_host();
    const SignalLockGuard change(names_lock);
    int number = -1;
    for (int attempt = 0; attempt < kMostAttempts && number < 0; ++attempt) {
      temporary_ = temporary_name(host, attempt);
      number = ::openat(folder_, temporary_.c_str(),
                        O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, target.first_mode());
      if (number < 0 && errno != EEXIST) break;
    }
    error_ = number < 0 ? errno : 0;
    file_.emplace(number);
    if (error_ != 0) return;
    has_name_ = true;
    name_ = {folder_, temporary_.c_str(), names_in_use};
    names_in_use = &name_;
  }
  ~NamedFile() {
    if (has_name_) give_up_name([&] { ::unlinkat(folder_, temporary_.c_str(), 0); });
  }
  NamedFile(const NamedFile&) = delete;
  NamedFile& operator=(const NamedFile&) = delete;

  // Writes the bytes and takes the target's name; returns 0 or errno.
  int become(const Target& target, std::span<const std::uint8_t> bytes) {
    if (error_ != 0) return error_;
    if (const int error = fill_file(file_->get(), target, bytes)) return error;
    if (const int error = file_->close()) return error;
    int error = 0;
    give_up_name([&] {
      if (::renameat(folder_, temporary_.c_str(), folder_, target.name.c_str()) == 0) return;
      error = errno;
      ::unlinkat(folder_, temporary_.c_str(), 0);
    });
    return error;
  }

 private:
  // Calls `lose`, after which there is no file under the name.
  void give_up_name(FunctionRef<void()> lose) {
    const SignalLockGuard change(names_lock);
    lose();
    has_name_ = false;
    NameInUse** link = &names_in_use;
    while (*link != &name_) link = &(*link)->next;
    *link = name_.next;
  }

  int folder_;
  std::string temporary_;
  std::optional<Descriptor> file_;
  NameInUse name_;
  bool has_name_ = false;
  int error_ = 0;  // of opening
};

// --- Files without a name, which the system removes by itself

constexpr int kNoUnnamedFiles = -1;

// Gives an unnamed file the target's name; returns 0, errno, or kNoUnnamedFiles if no name can be
// given to it here.
int name_file(int file, const Target& target) {
  const std::string self = fmt::format("/proc/self/fd/{}", file);
  const auto link = [&](const std::string& name) {
    return ::linkat(AT_FDCWD, self.c_str(), target.folder, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
  };
  if (!target.replaced && link(target.name)) return 0;
  // A link does not replace a file; a rename does.
  const Host host = this_host();
  const SignalLockGuard change(names_lock);
  for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
    const std::string temporary = temporary_name(host, attempt);
    if (link(temporary)) {
      if (::renameat(target.folder, temporary.c_str(), target.folder, target.name.c_str()) == 0)
        return 0;
      const int error = errno;
      ::unlinkat(target.folder, temporary.c_str(), 0);
      return error;
    }
    if (errno != EEXIST) break;
  }
  return kNoUnnamedFiles;
}

int write_unnamed(const Target& target, std::span<const std::uint8_t> bytes) {
  const Descriptor file(
      ::openat(target.folder, ".", O_WRONLY | O_TMPFILE | O_CLOEXEC, target.first_mode()));
  if (file.get() < 0) return kNoUnnamedFiles;
  if (const int error = fill_file(file.get(), target, bytes)) return error;
  return name_file(file.get(), target);
}

// --- What killed writers left

// Whether the name is a temporary one of this host, and its process is dead for sure: not known
// any more, or from before the machine's last start. A copy of this machine under its name could
// be the other one that runs; but it would not leave its file alone for an hour.
bool is_abandoned(const std::filesystem::directory_entry& entry, const Host& host) {
  unsigned long host_id = 0, boot = 0;
  int pid = 0, attempt = 0, length = 0;
  const std::string name = entry.path().filename().string();
  if (std::sscanf(name.c_str(), ".swell-%16lx-%16lx-%9d-%4d.tmp%n", &host_id, &boot, &pid, &attempt,
                  &length) != 4 ||
      length != std::ssize(name) || host_id != host.id || pid < 1)
    return false;
  struct stat status;
  if (::lstat(entry.path().c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return false;
  if (boot == host.boot) return ::kill(pid, 0) != 0 && errno == ESRCH;
  constexpr std::time_t kHour_s = 3600;
  return std::time(nullptr) - status.st_mtime > kHour_s;
}

}  // namespace

void write_file_in(int folder, const std::string& name, const std::filesystem::path& path,
                   std::span<const std::uint8_t> bytes) {
  const Target target = checked_target(path, folder, name);
  int error = write_unnamed(target, bytes);
  if (error == kNoUnnamedFiles) error = NamedFile(target).become(target, bytes);
  if (error != 0) fail(path, "cannot write: {}", reason(error));
  // The name itself reaches the disk with its folder; the file is whole either way.
  const Descriptor readable(::openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (readable.get() >= 0) ::fsync(readable.get());
}

void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes) {
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  const Descriptor open(::open(folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
  if (open.get() < 0) fail(path, "cannot write: {}", reason(errno));
  const std::string name = path.has_filename() ? path.filename().string() : ".";
  write_file_in(open.get(), name, path, bytes);
}

void abandon_writes() noexcept {
  names_lock.take();
  for (const NameInUse* name = names_in_use; name != nullptr; name = name->next)
    ::unlinkat(name->folder, name->name, 0);
}

void remove_abandoned_files(const std::filesystem::path& folder) {
  const Host host = this_host();
  if (!host.known) return;
  std::error_code error;
  std::filesystem::directory_iterator entry(folder, error);
  for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
    if (is_abandoned(*entry, host)) ::unlink(entry->path().c_str());
  }
}

}  // namespace swell::texture
