#include "ocean/open_sea/patch_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/elementary.h"

namespace swell::ocean {
namespace {

constexpr int kMostSamples = 512, kLanes = 16;

// A row of samples and the first one again.
using Row = std::array<float, kMostSamples + 1>;

void read_row(const PatchFrame& patch, int j, Row& row) {
  const int n = patch.resolution;
  const auto first = patch.height_m.begin() + static_cast<std::ptrdiff_t>(j % n) * n;
  std::copy_n(first, n, row.begin());
  row[static_cast<std::size_t>(n)] = row[0];
}

// The largest of each lane, so that a compiler takes them side by side.
struct Largest {
  std::array<float, kLanes> height_m{}, slope2{};

  void include(std::size_t lane, float z, float slope_squared) {
    height_m[lane] = height_m[lane] < z ? z : height_m[lane];
    slope2[lane] = slope2[lane] < slope_squared ? slope_squared : slope2[lane];
  }
};

// Between samples heights are bilinear: a cell's slope along an axis is between those of its edges.
void include_row(const Row& south, const Row& north, std::size_t samples, glm::vec2 per_m,
                 Largest& largest) {
  for (std::size_t first = 0; first < samples; first += kLanes)
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::size_t i = first + lane;
      const float x0 = std::abs(south[i + 1] - south[i]), x1 = std::abs(north[i + 1] - north[i]);
      const float y0 = std::abs(north[i] - south[i]), y1 = std::abs(north[i + 1] - south[i + 1]);
      const float x = (x0 < x1 ? x1 : x0) * per_m.x, y = (y0 < y1 ? y1 : y0) * per_m.y;
      largest.include(lane, std::abs(south[i]), x * x + y * y);
    }
}

}  // namespace

HeightBounds bounds_of_patch(const PatchFrame& patch) {
  constexpr double kRounding = 1.0 + 1e-5;
  const glm::dvec2 per_m = static_cast<double>(patch.resolution) / patch.length_m;
  Largest largest;
  Row south, north;
  read_row(patch, 0, south);
  for (int j = 1; j <= patch.resolution; ++j) {
    read_row(patch, j, north);
    include_row(south, north, static_cast<std::size_t>(patch.resolution), glm::vec2(per_m),
                largest);
    std::swap(south, north);
  }
  HeightBounds bounds = {
      static_cast<double>(std::ranges::max(largest.height_m)) * kRounding,
      std::sqrt(static_cast<double>(std::ranges::max(largest.slope2))) * kRounding};
  if (!patch.height_quads.empty()) {  // each is off by half a step
    const auto step_m = static_cast<double>(patch.height_step_m);
    bounds.height_m += step_m;
    bounds.slope += step_m * glm::length(per_m);
  }
  if (!patch.tiling.on) return bounds;
  // Of weights whose squares add up to 1.004 at most.
  const double two_tiles = 1.01 * std::sqrt(2.0);
  const double blend_per_m = kTileBlendSlope / std::min(patch.length_m.x, patch.length_m.y);
  return {two_tiles * bounds.height_m, two_tiles * (bounds.slope + blend_per_m * bounds.height_m)};
}

HeightBounds bounds_of_sines(const SeaFrame& frame) {
  HeightBounds bounds;
  for (const SineFrame& sine : frame.sines) {
    bounds.height_m += std::abs(sine.amplitude_m);
    bounds.slope += std::abs(sine.amplitude_m) * 2.0 * kPi * glm::length(sine.cycles_per_m);
  }
  return bounds;
}

}  // namespace swell::ocean
