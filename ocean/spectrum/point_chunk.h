// Points of a query go in pieces, whose fields are on the stack.
#pragma once

#include <cstddef>

namespace swell::ocean {

inline constexpr std::size_t kPointChunk = 256;

}  // namespace swell::ocean
