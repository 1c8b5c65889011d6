// A hash of exact results: golden constants made with it notice one changed bit.
#pragma once

#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

namespace swell {

// FNV-1a over the object representations of the values added, eight bytes or four at a time.
class BitsHash {
 public:
  // Every NaN counts as the same one: its sign and payload are not promised.
  template <class T>
  requires std::is_arithmetic_v<T>
  void add(T value) {
    if (value != value) value = std::numeric_limits<T>::quiet_NaN();
    std::conditional_t<sizeof(T) == 8, std::uint64_t, std::uint32_t> bits;
    static_assert(sizeof(bits) == sizeof(value));
    std::memcpy(&bits, &value, sizeof(bits));
    hash_ = (hash_ ^ bits) * 0x100000001b3u;
    hash_ ^= hash_ >> 29;
  }

  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

}  // namespace swell
