// Values as bytes that the same program reads again: no format for others. A struct that can be
// written says what it consists of, in any fixed order,
//
//   auto fields() { return std::tie(size, levels, words); }
//
// or that it is kept byte by byte, for what lies in large arrays:
//
//   static constexpr bool kPlainBytes = true;
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <iosfwd>
#include <memory>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <type_traits>
#include <vector>

#include "math/large_array.h"
#include "math/value_hash.h"

namespace swell {

// Bytes are not what was written: too few, changed, or those of something else.
class ArchiveError : public std::runtime_error {
  using runtime_error::runtime_error;
};

template <class T>
inline constexpr bool kIsPlainBytes = std::is_arithmetic_v<T> || std::is_enum_v<T>;
template <class T>
requires T::kPlainBytes inline constexpr bool kIsPlainBytes<T> = std::is_standard_layout_v<T>;
template <glm::length_t L, class T>
inline constexpr bool kIsPlainBytes<glm::vec<L, T>> = true;
template <class T, std::size_t N>
inline constexpr bool kIsPlainBytes<std::array<T, N>> = kIsPlainBytes<T>;

// Whether a type, or what it may hold, says what it consists of.
template <class T>
inline constexpr bool kHasFields = requires(T& value) {
  value.fields();
};
template <class T>
inline constexpr bool kHasFields<std::optional<T>> = kHasFields<T>;

// Writes or reads what a value consists of, as `Bytes` does with bytes and with the number of an
// array's elements. Writing only reads the value, so that others may at the same time. Asks
// check_stop() every megabyte.
template <class Bytes>
class Archive {
 public:
  template <class... Args>
  explicit Archive(Args&&... args) : bytes_(std::forward<Args>(args)...) {}

  template <class T>
  void add(T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      std::uint8_t byte = value ? 1 : 0;  // changed bytes may be no bool
      bytes_.add(&byte, 1);
      if (value != (byte != 0)) value = !value;  // who writes changes nothing
    } else if constexpr (kIsPlainBytes<T>) {
      bytes_.add(&value, sizeof value);
    } else {
      std::apply([&](auto&... field) { (add(field), ...); }, value.fields());
    }
  }

  template <class T, class Memory>
  void add(std::vector<T, Memory>& values) {
    std::uint64_t count = values.size();
    bytes_.add_count(count, sizeof(T));
    if (count != values.size()) resize_large(values, count);
    if constexpr (kIsPlainBytes<T>)
      bytes_.add(values.data(), count * sizeof(T));
    else
      for (T& value : values) add(value);
  }

  template <class T, std::size_t N>
  requires(!kIsPlainBytes<T>) void add(std::array<T, N>& values) {
    for (T& value : values) add(value);
  }

  template <class T>
  void add(std::optional<T>& value) {
    bool is_there = value.has_value();
    add(is_there);
    if (is_there) add(value ? *value : value.emplace());
  }

  Bytes& bytes() { return bytes_; }

 private:
  Bytes bytes_;
};

// XXH3 of bytes that come one after the other.
class StreamHash {
 public:
  StreamHash();
  ~StreamHash();
  void add(const void* bytes, std::size_t size);
  ValueHash hash() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

class WrittenBytes {
 public:
  explicit WrittenBytes(std::ostream& to) : to_(to) {}
  void add(const void* bytes, std::size_t size);
  void add_count(std::uint64_t count, std::size_t /*element_size*/) { add(&count, sizeof count); }
  // Ends what was added by its hash. `to` tells of errors.
  void finish();

 private:
  std::ostream& to_;
  StreamHash hash_;
};

// Throws ArchiveError where there are fewer bytes than are asked for.
class ReadBytes {
 public:
  ReadBytes(std::istream& from, std::uint64_t size) : from_(from), left_(size) {}
  void add(void* bytes, std::size_t size);
  void add_count(std::uint64_t& count, std::size_t element_size);
  // Throws ArchiveError unless finish() ended just these bytes.
  void finish();

 private:
  std::istream& from_;
  std::uint64_t left_;
  StreamHash hash_;
};

using ArchiveWriter = Archive<WrittenBytes>;
using ArchiveReader = Archive<ReadBytes>;

}  // namespace swell
