// Whole files as bytes, for image_io.cpp and write_file.cpp: read with limits, and words for what
// went wrong.
#pragma once

#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "texture/image/image_io.h"

namespace swell::texture {

// The text with control characters as spaces and none at its ends.
std::string one_line(std::string_view text);

// Throws FileError "PATH: TEXT".
template <class... T>
[[noreturn]] void fail(const std::filesystem::path& path, fmt::format_string<T...> text,
                       T&&... values) {
  throw FileError(one_line(path.string() + ": " + fmt::format(text, std::forward<T>(values)...)));
}

// The system's words for an errno.
std::string reason(int error);

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

// The content of a regular, non-empty file of at most max_bytes. Does not wait for pipes or
// devices; throws FileError.
std::vector<char> read_bytes(const std::filesystem::path& path, std::uint64_t max_bytes);

}  // namespace swell::texture
