// Takes values off the front of a target's input.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <string>

namespace swell::fuzz {

// What is taken behind the end is 0.
class Bytes {
 public:
  explicit Bytes(std::span<const std::uint8_t> bytes) : left_(bytes) {}

  bool empty() const { return left_.empty(); }

  template <class Value>
  Value take() {
    Value value{};
    const std::size_t size = std::min(sizeof value, left_.size());
    std::memcpy(&value, left_.data(), size);
    left_ = left_.subspan(size);
    return value;
  }

  // In [0, count).
  std::size_t index(std::size_t count) { return take<std::uint8_t>() % count; }

  bool coin() { return index(2) == 1; }

  // Mostly a small one; seldom an extreme, or any at all.
  double number() {
    constexpr std::array kExtremes = {0.0,  -0.0,   1e-320, 5e-324, 1e6,     -1e6,   1e7,
                                      1e9,  1e12,   -1e12,  1e13,   1.7e308, -1e300, 1e-300,
                                      1e39, 8192.0, 1e100,  0.001,  100.0,   180.0,  360.0};
    const auto kind = take<std::uint8_t>();
    if (kind < 200) return take<std::int16_t>() / 64.0;
    if (kind < 240) return kExtremes[index(kExtremes.size())];
    if (kind < 250) return take<double>();
    return kind < 253 ? std::numeric_limits<double>::infinity()
                      : std::numeric_limits<double>::quiet_NaN();
  }

  std::string text(std::size_t most) {
    std::string result;
    for (std::size_t n = index(most + 1); n > 0 && !empty(); --n)
      result += static_cast<char>(take<std::uint8_t>());
    return result;
  }

 private:
  std::span<const std::uint8_t> left_;
};

}  // namespace swell::fuzz
