#include "apps/messages/cdr.h"

#include <bit>
#include <cstring>
#include <type_traits>
#include <utility>

namespace swell::apps {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they are held");

// Numbers are aligned to their size, counted from behind the four bytes.
class CdrWriter {
 public:
  template <class Value>
  void add(const Value& value) {
    if constexpr (std::is_arithmetic_v<Value>)
      add_number(value);
    else
      std::apply([this](const auto&... field) { (this->add(field), ...); }, value.fields());
  }

  // With a zero at its end, which counts.
  void add(const std::string& text) {
    add_number(static_cast<std::uint32_t>(text.size() + 1));
    add_bytes(text.c_str(), text.size() + 1);
  }

  template <class Value>
  void add(const std::vector<Value>& values) {
    add_number(static_cast<std::uint32_t>(values.size()));
    if constexpr (std::is_same_v<Value, std::uint8_t>)
      add_bytes(values.data(), values.size());
    else
      for (const Value& value : values) add(value);
  }

  template <class Value, std::size_t kSize>
  void add(const std::array<Value, kSize>& values) {
    for (const Value& value : values) add(value);
  }

  std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  static constexpr std::size_t kHead = 4;

  template <class Number>
  void add_number(Number number) {
    const std::size_t off = (bytes_.size() - kHead) % sizeof number;
    bytes_.resize(bytes_.size() + (off == 0 ? 0 : sizeof number - off));
    add_bytes(&number, sizeof number);
  }

  void add_bytes(const void* from, std::size_t count) {
    const auto* bytes = static_cast<const std::uint8_t*>(from);
    bytes_.insert(bytes_.end(), bytes, bytes + count);
  }

  std::vector<std::uint8_t> bytes_{0, 1, 0, 0};
};

}  // namespace

std::vector<std::uint8_t> cdr_bytes(const msg::Message& message) {
  CdrWriter writer;
  std::visit([&](const auto& of_a_kind) { writer.add(of_a_kind); }, message);
  return writer.take();
}

}  // namespace swell::apps
