// A file that grows under the name PATH.partial and gets its own once it is whole.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

namespace swell::apps {

// What cannot be written throws texture::FileError. Nothing of what was written is lost then: the
// part of a write that failed is taken off again.
class PartialFile {
 public:
  explicit PartialFile(const std::filesystem::path& path);
  ~PartialFile();
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;

  void write(std::span<const std::uint8_t> bytes);
  std::uint64_t size() const { return size_; }
  std::uint32_t crc() const { return crc_; }  // CRC-32 of all that was written

  // Gives the file its name, in place of one that has it.
  void finish();

 private:
  [[noreturn]] void refuse(int error) const;

  std::filesystem::path path_, partial_;
  int file_ = -1;
  std::uint64_t size_ = 0;
  std::uint32_t crc_ = 0;
};

}  // namespace swell::apps
