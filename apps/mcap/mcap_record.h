// The bytes of MCAP's records: numbers in little endian, texts and maps behind their lengths.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

namespace swell::apps {

static_assert(std::endian::native == std::endian::little, "numbers are written as they are held");

enum class McapOpcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0b,
  kSummaryOffset = 0x0e,
  kDataEnd = 0x0f,
};

// Bytes that are added to.
class McapBytes {
 public:
  template <class Number>
  McapBytes& number(std::type_identity_t<Number> value) {
    const std::size_t at = bytes_.size();
    bytes_.resize(at + sizeof value);
    std::memcpy(bytes_.data() + at, &value, sizeof value);
    return *this;
  }
  McapBytes& bytes(std::span<const std::uint8_t> more) {
    bytes_.insert(bytes_.end(), more.begin(), more.end());
    return *this;
  }
  McapBytes& text(std::string_view text) {
    number<std::uint32_t>(static_cast<std::uint32_t>(text.size()));
    bytes_.insert(bytes_.end(), text.begin(), text.end());
    return *this;
  }
  // An array or a map, whose length is that of its bytes.
  McapBytes& list(const McapBytes& elements) {
    return number<std::uint32_t>(static_cast<std::uint32_t>(elements.size())).bytes(elements.get());
  }
  McapBytes& record(McapOpcode opcode, const McapBytes& content) {
    return head(opcode, content.size()).bytes(content.get());
  }
  // What stands before a record's content.
  McapBytes& head(McapOpcode opcode, std::uint64_t size) {
    return number<std::uint8_t>(static_cast<std::uint8_t>(opcode)).number<std::uint64_t>(size);
  }
  void clear() { bytes_.clear(); }

  std::size_t size() const { return bytes_.size(); }
  std::span<const std::uint8_t> get() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

}  // namespace swell::apps
