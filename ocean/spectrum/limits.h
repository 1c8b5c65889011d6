// What a sea is made of at most; everything that is drawn or asked has all of it.
#pragma once

#include <cstddef>

namespace swell::ocean {

inline constexpr std::size_t kMaxPatches = 8, kMaxSines = 64, kMaxSwells = 4;
inline constexpr std::size_t kMaxSineTrains = 2 * kMaxSines;  // with what sharpens their crests
// The longest patches have foam, but not the last of several: its waves break unseen.
inline constexpr std::size_t kMostFoamPatches = 2;
// Squares of water that hold wakes at a time, and the samples along a side of one.
inline constexpr std::size_t kMostWakeWindows = 8;
inline constexpr int kWakeSamples = 256;

}  // namespace swell::ocean
