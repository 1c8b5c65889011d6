// What things are made of, as a hash to find them by.
//
//   const ValueHash key = ValueBytes().add("sky").add(turbidity).add(seed).hash();
#pragma once

#include <compare>
#include <concepts>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace swell {

// Equal for equal bytes, in any process; others share one with a chance of 2^-128 a pair.
struct ValueHash {
  std::uint64_t high = 0, low = 0;
  auto operator<=>(const ValueHash&) const = default;
};

// Values one after the other, bit by bit: -0 is not 0. What has no fixed size says how long it is.
class ValueBytes {
 public:
  ValueBytes& add(std::string_view text) {
    add(text.size());
    bytes_.append(text);
    return *this;
  }
  ValueBytes& add(const char* text) { return add(std::string_view(text)); }
  ValueBytes& add(const std::string& text) { return add(std::string_view(text)); }
  ValueBytes& add(const std::filesystem::path& path) { return add(path.native()); }

  template <class T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T> ValueBytes& add(T value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
  }

  template <glm::length_t L, class T>
  ValueBytes& add(const glm::vec<L, T>& v) {
    for (glm::length_t i = 0; i < L; ++i) add(v[i]);
    return *this;
  }

  template <class T>
  ValueBytes& add(const std::optional<T>& value) {
    add(value.has_value());
    return value ? add(*value) : *this;
  }

  template <class T>
  ValueBytes& add(const std::vector<T>& values) {
    add(values.size());
    for (const T& value : values) add(value);
    return *this;
  }

  ValueBytes& add(const ValueHash& hash) { return add(hash.high).add(hash.low); }

  ValueHash hash() const;

 private:
  std::string bytes_;
};

}  // namespace swell
