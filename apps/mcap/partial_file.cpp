#include "apps/mcap/partial_file.h"

#include <fcntl.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "apps/shared/output_file.h"

namespace swell::apps {

PartialFile::PartialFile(const std::filesystem::path& path) : path_(path), partial_(path) {
  check_output_place(path);
  partial_ += ".partial";
  file_ = ::open(partial_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file_ < 0) refuse(errno);
}

PartialFile::~PartialFile() {
  if (file_ >= 0) ::close(file_);
}

void PartialFile::refuse(int error) const {
  refuse_output(partial_, std::generic_category().message(error));
}

void PartialFile::write(std::span<const std::uint8_t> bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t count = ::write(file_, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      const int error = errno;
      if (::ftruncate(file_, static_cast<off_t>(size_)) != 0) refuse(errno);
      refuse(error);
    }
    done += static_cast<std::size_t>(count);
  }
  size_ += bytes.size();
  crc_ = static_cast<std::uint32_t>(::crc32_z(crc_, bytes.data(), bytes.size()));
}

void PartialFile::finish() {
  const int file = std::exchange(file_, -1);
  if (::fsync(file) != 0) {
    const int error = errno;
    ::close(file);
    refuse(error);
  }
  if (::close(file) != 0) refuse(errno);
  if (::rename(partial_.c_str(), path_.c_str()) != 0) refuse(errno);
}

}  // namespace swell::apps
