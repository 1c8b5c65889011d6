#include "texture/file_bytes.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

namespace swell::texture {
namespace {

std::string reason(int error) { return std::generic_category().message(error); }

// A file descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return number_; }
  // Closes now; returns 0 or errno.
  int close() {
    const int result = ::close(number_);
    number_ = -1;
    return result == 0 ? 0 : errno;
  }

 private:
  int number_;
};

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

// Writes and syncs a new file; returns 0 or errno.
int write_new_file(Descriptor& file, std::span<const std::uint8_t> bytes) {
  if (const int error = write_all(file.get(), bytes)) return error;
  if (::fsync(file.get()) != 0) return errno;
  return file.close();
}

// The file that `path` stands for, through symbolic links. Refuses what is not a file: renaming
// over a device or a pipe would replace it.
std::filesystem::path checked_target(const std::filesystem::path& path) {
  struct stat status;
  if (::stat(path.c_str(), &status) != 0) {
    if (errno == ENOENT) return path;
    fail(path, "cannot write: {}", reason(errno));
  }
  if (S_ISDIR(status.st_mode)) fail(path, "cannot write: it is a directory");
  if (!S_ISREG(status.st_mode)) fail(path, "cannot write: it is not a regular file");
  std::error_code ignored;
  const std::filesystem::path target = std::filesystem::canonical(path, ignored);
  return ignored ? path : target;
}

// Opens a new file in `folder`; its name goes to `temporary`.
int create_temporary(const std::filesystem::path& folder, std::filesystem::path& temporary) {
  int file = -1;
  for (int attempt = 0; attempt < 1000 && file < 0; ++attempt) {
    temporary = folder / fmt::format(".swell-{}-{}.tmp", ::getpid(), attempt);
    file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file < 0 && errno != EEXIST) break;
  }
  return file;
}

}  // namespace

std::string one_line(std::string_view text) {
  std::string line(text);
  for (char& c : line) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  const std::size_t first = line.find_first_not_of(' ');
  if (first == std::string::npos) return {};
  return line.substr(first, line.find_last_not_of(' ') - first + 1);
}

std::vector<char> read_bytes(const std::filesystem::path& path, std::uint64_t max_bytes) {
  // O_NONBLOCK: opening a pipe must not wait for a writer.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  if (file.get() < 0) fail(path, "cannot open: {}", reason(errno));
  struct stat status;
  if (::fstat(file.get(), &status) != 0) fail(path, "cannot read: {}", reason(errno));
  if (S_ISDIR(status.st_mode)) fail(path, "cannot read: it is a directory");
  if (!S_ISREG(status.st_mode)) fail(path, "cannot read: it is not a regular file");
  const std::uint64_t size = static_cast<std::uint64_t>(status.st_size);
  if (size == 0) fail(path, "the file is empty");
  if (size > max_bytes) fail(path, "the file has {} bytes, allowed: {}", size, max_bytes);
  std::vector<char> bytes(size);
  std::size_t filled = 0;
  while (filled < bytes.size()) {
    const ssize_t got = ::read(file.get(), bytes.data() + filled, bytes.size() - filled);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail(path, "cannot read: {}", reason(errno));
    if (got == 0) fail(path, "the file shrank while it was read");
    filled += static_cast<std::size_t>(got);
  }
  return bytes;
}

void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes) {
  const std::filesystem::path target = checked_target(path);
  const std::filesystem::path folder = target.has_parent_path() ? target.parent_path() : ".";
  std::filesystem::path temporary;
  Descriptor file(create_temporary(folder, temporary));
  if (file.get() < 0) fail(path, "cannot write: {}", reason(errno));
  int error = write_new_file(file, bytes);
  if (error == 0 && ::rename(temporary.c_str(), target.c_str()) != 0) error = errno;
  if (error != 0) {
    ::unlink(temporary.c_str());
    fail(path, "cannot write: {}", reason(error));
  }
  // The name itself reaches the disk with its folder; the file is whole either way.
  const Descriptor folder_file(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (folder_file.get() >= 0) ::fsync(folder_file.get());
}

}  // namespace swell::texture
