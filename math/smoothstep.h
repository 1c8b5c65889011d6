// The S-shaped blend from 0 to 1, written once.
#pragma once

#include <algorithm>

namespace swell {

// 3 t^2 - 2 t^3 for t in [0, 1]: its slope is 0 at both ends.
template <class T>
constexpr T smooth_blend(T t) {
  return t * t * (T(3) - T(2) * t);
}

// 0 up to x = low, 1 from x = high on, smooth_blend() between them. low != high; with low > high it
// falls as x grows. NaN gives NaN.
template <class T>
constexpr T smoothstep(T low, T high, T x) {
  return smooth_blend(std::clamp((x - low) / (high - low), T(0), T(1)));
}

}  // namespace swell
