// A look at TOML text before it is parsed: the parser and its tree recurse once per level, so a
// file of 'a.a.a.a...' or '[[[[...' would overflow the stack.
#pragma once

#include <cstdint>
#include <string_view>

namespace swell::scene {

inline constexpr int kMaxNesting = 16;  // dots of one key, brackets around one value

// The first line (from 1) with a key of more than kMaxNesting dots or with more than kMaxNesting
// open brackets; 0 if there is none. Strings and comments do not count.
std::uint32_t find_deep_nesting(std::string_view toml);

}  // namespace swell::scene
