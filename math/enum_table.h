// Tables beside an enumeration, or beside false and true. Each row names its enumerator: a table
// that lacks one or has one twice does not compile.
//
//   enum class Light : std::uint8_t { kSun, kMoon };
//   constexpr auto kNames = enum_words<Light>({{Light::kSun, "sun"}, {Light::kMoon, "moon"}});
//   kNames[Light::kMoon]
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <type_traits>

namespace swell {

// Whether the value has a name. Compilers write "Light::kMoon" for an enumerator and "(Light)2" for
// a value that is none, as the last word of this function's text.
template <auto kValue>
consteval bool is_enumerator() {
  const std::string_view text = __PRETTY_FUNCTION__;
  const char first = text[text.find_last_of(":)= ") + 1];
  return first != '-' && !(first >= '0' && first <= '9');
}

template <class Enum, std::size_t kFirst = 0>
consteval std::size_t count_enumerators() {
  if constexpr (std::is_same_v<Enum, bool>)
    return 2;
  else if constexpr (is_enumerator<static_cast<Enum>(kFirst)>())
    return count_enumerators<Enum, kFirst + 1>();
  else
    return kFirst;
}

// kEnumerators counts the enumerators of an enumeration whose values are 0, 1, 2 and so on.
template <class Enum>
inline constexpr std::size_t kEnumerators = count_enumerators<Enum>();

template <class Enum>
consteval std::array<Enum, kEnumerators<Enum>> all_enumerators() {
  std::array<Enum, kEnumerators<Enum>> all{};
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<Enum>(i);
  return all;
}

// A value for each enumerator, in their order.
template <class Enum, class Value>
struct EnumTable : std::array<Value, kEnumerators<Enum>> {
  using Of = Enum;
  using std::array<Value, kEnumerators<Enum>>::operator[];
  constexpr const Value& operator[](Enum of) const { return (*this)[static_cast<std::size_t>(of)]; }
  constexpr Value& operator[](Enum of) { return (*this)[static_cast<std::size_t>(of)]; }
};

template <class Enum, class Value>
struct EnumRow {
  Enum of;
  Value value;
};

template <class Enum, class Value, std::size_t kRows>
requires(kRows == kEnumerators<Enum>) consteval EnumTable<Enum, Value> enum_table(
    const EnumRow<Enum, Value> (&rows)[kRows]) {
  EnumTable<Enum, Value> table{};
  std::array<bool, kRows> is_there{};
  for (const EnumRow<Enum, Value>& row : rows) {
    const auto at = static_cast<std::size_t>(row.of);
    if (is_there.at(at)) throw "an enumerator twice";  // does not compile
    is_there[at] = true;
    table[at] = row.value;
  }
  return table;
}

template <class Enum, std::size_t kRows>
consteval EnumTable<Enum, std::string_view> enum_words(
    const EnumRow<Enum, std::string_view> (&rows)[kRows]) {
  return enum_table(rows);
}

// Whether a list has a row for each enumerator, in their order, which `of` says.
template <class Rows, class Row, class Enum>
consteval bool lists_all(const Rows& rows, Enum Row::*of) {
  if (std::size(rows) != kEnumerators<Enum>) return false;
  for (std::size_t i = 0; i < std::size(rows); ++i)
    if (rows[i].*of != static_cast<Enum>(i)) return false;
  return true;
}

}  // namespace swell
