// Numbers from text, the same in every locale.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>

namespace swell::apps {

// The whole of `text` as a number, or nothing. `base` is 10 if it is left out; whole numbers only
// can have another.
template <class Number, class... Base>
std::optional<Number> parse_number(std::string_view text, Base... base) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base...);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace swell::apps
