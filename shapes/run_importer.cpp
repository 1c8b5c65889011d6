#include "shapes/run_importer.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "math/enum_table.h"
#include "math/stop.h"
#include "shapes/flat_mesh.h"
#include "texture/image/file_bytes.h"
#include "texture/image/program_folder.h"

namespace swell::shapes {
namespace {

using Clock = std::chrono::steady_clock;

constexpr char kImporterFile[] = "swell_mesh_import";
constexpr std::size_t kMostStreamBytes = 1700u << 20;  // of what limits allow, at the utmost
constexpr std::size_t kMostMessageBytes = 4096;

void check(int error, const char* what) {
  if (error != 0) throw std::system_error(error, std::generic_category(), what);
}

std::string importer_path() {
  const auto is_there = [](const std::filesystem::path& place) {
    return access(place.c_str(), X_OK) == 0;
  };
  const auto places = texture::places_beside_program(kImporterFile);
  for (const std::filesystem::path& place : places)
    if (is_there(place)) return place.string();
  try {
    const std::filesystem::path last = texture::folder_of_image_codec() / kImporterFile;
    if (is_there(last)) return last.string();
  } catch (const texture::FileError&) {
    // No module for images either: the importer is what is asked for.
  }
  throw std::runtime_error(
      fmt::format("the importer of meshes is not there: {}; the Debian package swell-meshes has it",
                  places.front().string()));
}

// What the child writes at one end, we read at the other.
class Pipe {
 public:
  Pipe() { check(pipe2(ends_.data(), O_CLOEXEC) == 0 ? 0 : errno, "pipe"); }
  ~Pipe() {
    close_end(0);
    close_end(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  int to_read() const { return ends_[0]; }
  int to_write() const { return ends_[1]; }
  void close_writing() { close_end(1); }

 private:
  void close_end(std::size_t end) {
    if (ends_[end] >= 0) close(ends_[end]);
    ends_[end] = -1;
  }
  std::array<int, 2> ends_{-1, -1};
};

// A child that does not outlive this.
class Child {
 public:
  Child(const std::string& program, std::vector<std::string> arguments, const Pipe& out,
        const Pipe& err) {
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&files, out.to_write(), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&files, err.to_write(), STDERR_FILENO);
    std::vector<char*> argv = {const_cast<char*>(program.c_str())};
    for (std::string& text : arguments) argv.push_back(text.data());
    argv.push_back(nullptr);
    const int error = posix_spawn(&pid_, program.c_str(), &files, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    check(error, program.c_str());
  }
  ~Child() {
    if (pid_ <= 0) return;
    kill(pid_, SIGKILL);
    while (waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  int wait() {
    int status = 0;
    while (waitpid(pid_, &status, 0) < 0)
      if (errno != EINTR) check(errno, "waitpid");
    pid_ = 0;
    return status;
  }

 private:
  pid_t pid_ = 0;
};

// Reads what is there; false at the end.
bool read_some(int from, std::size_t most, std::vector<char>& bytes) {
  std::array<char, 1 << 16> buffer;
  const ssize_t size = read(from, buffer.data(), buffer.size());
  if (size < 0) return errno == EINTR;
  if (bytes.size() + static_cast<std::size_t>(size) > most)
    throw std::runtime_error("more than a mesh may hold");
  bytes.insert(bytes.end(), buffer.begin(), buffer.begin() + size);
  return size > 0;
}

// Both until they end, by turns.
void read_both(const Pipe& out, const Pipe& err, Clock::time_point deadline,
               std::vector<char>& stream, std::vector<char>& message) {
  std::array<pollfd, 2> open = {{{out.to_read(), POLLIN, 0}, {err.to_read(), POLLIN, 0}}};
  while (open[0].fd >= 0 || open[1].fd >= 0) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now());
    if (left.count() <= 0)
      throw std::runtime_error(fmt::format("a file that takes over {} s to read", kMostImport_s));
    check_stop();
    const int turn_ms = static_cast<int>(std::min<long>(left.count(), 10));
    if (poll(open.data(), open.size(), turn_ms) < 0 && errno != EINTR) check(errno, "poll");
    if (open[0].revents != 0 && !read_some(open[0].fd, kMostStreamBytes, stream)) open[0].fd = -1;
    if (open[1].revents != 0) {
      // What does not fit is not said.
      std::vector<char> more;
      if (!read_some(open[1].fd, 1 << 16, more)) open[1].fd = -1;
      if (message.size() < kMostMessageBytes)
        message.insert(message.end(), more.begin(), more.end());
    }
    open[0].revents = open[1].revents = 0;
  }
}

}  // namespace

std::vector<char> run_importer(const std::string& file, scene::UpAxis up) {
  constexpr auto kUp = enum_words<scene::UpAxis>(
      {{scene::UpAxis::kByFormat, "auto"}, {scene::UpAxis::kY, "y"}, {scene::UpAxis::kZ, "z"}});
  Pipe out, err;
  fcntl(out.to_read(), F_SETPIPE_SZ, 1 << 20);  // fewer turns; what it is else is good too
  // It ends when this thread does, which waits for it.
  Child child(importer_path(), {file, std::string(kUp[up]), std::to_string(getpid())}, out, err);
  out.close_writing();
  err.close_writing();
  std::vector<char> stream, message;
  read_both(out, err, Clock::now() + std::chrono::seconds(kMostImport_s), stream, message);
  const int status = child.wait();
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return stream;
  std::string text = texture::one_line(std::string_view(message.data(), message.size()));
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
    text = fmt::format("a file that takes over {} s to read", kMostImport_s);
  else if (WIFSIGNALED(status))
    text = fmt::format("a file that the importer fails at ({})", strsignal(WTERMSIG(status)));
  else if (text.empty())
    text = fmt::format("a file that the importer fails at (exit code {})", WEXITSTATUS(status));
  throw std::runtime_error(text);
}

}  // namespace swell::shapes
