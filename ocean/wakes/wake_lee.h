// What land leaves of a wake: nothing where it lies between the water and what disturbs it.
#pragma once

#include <cstddef>
#include <span>

#include "ocean/wakes/wake_sources.h"
#include "terrain/shore_map.h"

namespace swell::ocean {

inline constexpr std::size_t kLeeSpacing = 8;  // samples
inline constexpr std::size_t kLeePoints = kWakeSamples / kLeeSpacing + 1;

// Sizes window.lee if land is near enough to stand in the way, and empties it if not. Sources and
// their places must be set.
void size_lee(const terrain::ShoreMap* shore, const WakeWindow& window);

// Row j < kLeePoints of window.lee: 1 where a straight line from the nearest source, or place of
// the hull's way, meets no land, 0 where it meets more than kLeeSpacing samples of it. What was
// made on inland water, above the sea's level, has no lee. At most 0.2 ms a window.
void find_lee(const terrain::ShoreMap& shore, std::size_t j, const WakeWindow& window);

// Multiplies what belongs to the samples of row j by their lee, bilinear between points.
void put_in_lee(const WakeWindow& window, std::size_t j, std::span<float> row);

}  // namespace swell::ocean
