#include "texture/image/file_bytes.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace swell::texture {

std::string reason(int error) { return std::generic_category().message(error); }

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

}  // namespace swell::texture
