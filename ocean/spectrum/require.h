// Values that callers give.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string_view>

namespace swell::ocean {

// Throws std::invalid_argument, which names the value, unless it lies in [low, high].
inline void require(double value, double low, double high, std::string_view name) {
  if (value >= low && value <= high) return;  // NaN fails
  throw std::invalid_argument(fmt::format("{}: got {}, allowed [{}, {}]", name, value, low, high));
}

}  // namespace swell::ocean
