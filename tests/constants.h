// Numbers that oracles use, apart from the library's own.
#pragma once

#include <limits>
#include <numbers>

namespace swell {

inline constexpr double kPiRef = std::numbers::pi;
inline constexpr double kTurn = 2.0 * kPiRef;
inline constexpr double kDegree = kPiRef / 180.0;
inline constexpr double kG = 9.81;
inline constexpr double kInf = std::numeric_limits<double>::infinity();

}  // namespace swell
