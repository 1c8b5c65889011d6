// Heights of maps in 16 bits, the four of a bilinear sample in one word, against exact ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "math/random.h"
#include "ocean/frame_at.h"
#include "ocean/open_sea/map_waves.h"
#include "ocean/open_sea/sea.h"
#include "ocean/open_sea/sea_state.h"
#include "ocean/simd_targets.h"

namespace swell::ocean {
namespace {

SeaDescription sea_of_set(MapSet set, MapHeights heights) {
  SeaDescription description;
  description.spectrum = false;
  description.map_set = set;
  description.map_heights = heights;
  return description;
}

// Signed codes of (i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1).
int code_of(std::uint64_t quad, int corner) {
  return static_cast<std::int16_t>(quad >> (16 * corner) & 0xffff);
}

// Rounded to a code each height is off by half a step, 1.25 / 65534 of its layer's peak. Where
// tiles are blended four of them count, by weights that add up to 2 at most.
double bound_m(const Sea& sea, bool tiling) {
  double bound = 1e-6;  // of sums of floats
  bool is_tiled = tiling;
  for (const MapWaves& waves : sea.state().maps) {
    bound += (is_tiled ? 2.0 : 1.0) * 1.25 * waves.peak_m() / 65534.0;
    is_tiled = false;  // only the first
  }
  return bound;
}

TEST(PackedHeights, AreWithinTheirBoundOfExactOnes) {
  std::vector<glm::dvec2> places;
  std::vector<glm::vec2> offsets;
  for (std::uint64_t n = 0; n < 5000; ++n) {
    places.emplace_back(6000.0 * random_uniform(1, n) - 3000.0, 6000.0 * random_uniform(2, n));
    offsets.emplace_back(places.back() - glm::dvec2(100.0, -70.0));
  }
  std::vector<float> exact_m(places.size()), packed_m(places.size());
  for (const MapSet set : {MapSet::kRiver, MapSet::kOcean})
    for (const bool tiling : {false, true}) {
      SeaDescription description = sea_of_set(set, MapHeights::kExact);
      description.tiling = tiling;
      const Sea exact(description);
      description.map_heights = MapHeights::kPacked;
      const Sea packed(description);
      const double bound = bound_m(packed, tiling);
      for (const double t_s : {0.0, 3.21, -400.7}) {
        const SeaFrame exact_frame = frame_at(exact, t_s), packed_frame = frame_at(packed, t_s);
        for_each_simd_target([&] {
          double most = 0.0;
          const auto compare = [&] {
            for (std::size_t i = 0; i < places.size(); ++i) {
              most = std::max(most, static_cast<double>(std::abs(exact_m[i] - packed_m[i])));
              ASSERT_LE(most, bound) << i;
            }
          };
          sample_heights(exact_frame, places, exact_m);
          sample_heights(packed_frame, places, packed_m);
          compare();
          sample_heights(exact_frame, {100.0, -70.0}, offsets, exact_m);
          sample_heights(packed_frame, {100.0, -70.0}, offsets, packed_m);
          compare();
          EXPECT_GT(most, 0.05 * bound);
        });
      }
    }
}

TEST(PackedHeights, AreTheNearestCodesOfASampleAndItsNeighbours) {
  const SeaFrame frame = frame_at(Sea(sea_of_set(MapSet::kLake, MapHeights::kPacked)), 7.7);
  ASSERT_EQ(frame.patches.size(), 7u);
  for (const PatchFrame& patch : frame.patches) {
    const int n = patch.resolution;
    const auto at = [&](int i, int j) { return static_cast<std::size_t>(j % n * n + i % n); };
    const auto step_m = static_cast<double>(patch.height_step_m);
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        for (int corner = 0; corner < 4; ++corner) {
          const std::size_t whose = at(i + corner % 2, j + corner / 2);
          const double steps = static_cast<double>(patch.height_m[whose]) / step_m;
          ASSERT_NEAR(code_of(patch.height_quads[at(i, j)], corner), steps, 0.503)
              << i << " " << j << " " << corner;
        }
  }
}

TEST(PackedHeights, AreTheCodesOnTheSamples) {
  SeaFrame frame = frame_at(Sea(sea_of_set(MapSet::kLake, MapHeights::kPacked)), 7.7);
  frame.patches.resize(1);
  PatchFrame& patch = frame.patches[0];
  patch.tiling = {};
  patch.length_m = {128.0, 64.0};  // places of samples are exact
  ASSERT_EQ(patch.resolution, 128);
  for_each_simd_target([&] {
    for (int n = 0; n < 2000; ++n) {
      const int i = 37 * n % 128, j = 11 * n % 128;
      const glm::dvec2 p(i - 1280.0, 0.5 * j + 640.0);
      float z = 0.0f;
      sample_heights(frame, {&p, 1}, {&z, 1});
      const int code = code_of(patch.height_quads[static_cast<std::size_t>(128 * j + i)], 0);
      ASSERT_EQ(z, static_cast<float>(code) * patch.height_step_m) << i << " " << j;
    }
  });
}

TEST(PackedHeights, AreTheSameBitsOnAnyThreadsAndTargets) {
  const Sea sea(sea_of_set(MapSet::kCoast, MapHeights::kPacked));
  const SeaFrame alone = frame_at(sea, 3.0), together = frame_at(sea, 3.0, 4);
  for (std::size_t p = 0; p < alone.patches.size(); ++p)
    EXPECT_EQ(alone.patches[p].height_quads, together.patches[p].height_quads);
  std::vector<glm::dvec2> places;
  for (int n = 0; n < 3001; ++n) places.emplace_back(1.7 * n, 900.0 - 0.9 * n);
  std::vector<float> first;
  for_each_simd_target([&] {
    std::vector<float> z(places.size());
    sample_heights(alone, places, z);
    if (first.empty()) first = z;
    EXPECT_EQ(z, first);
  });
}

TEST(PackedHeights, OfALayerWithoutHeightAreZero) {
  SeaDescription description = sea_of_set(MapSet::kLake, MapHeights::kPacked);
  description.amplitude_scale = 0.0;
  const SeaFrame frame = frame_at(Sea(description), 1.0);
  const glm::dvec2 p(12.3, 4.5);
  float z = 1.0f;
  sample_heights(frame, {&p, 1}, {&z, 1});
  EXPECT_EQ(z, 0.0f);
}

TEST(PackedHeights, AreNotMadeUnasked) {
  SeaDescription description = sea_of_set(MapSet::kLake, MapHeights::kExact);
  for (const PatchFrame& patch : frame_at(Sea(description), 1.0).patches)
    EXPECT_TRUE(patch.height_quads.empty());
  description.map_set = MapSet::kNone;
  description.map_heights = MapHeights::kPacked;
  description.spectrum = true;
  for (const PatchFrame& patch : frame_at(Sea(description), 1.0).patches)
    EXPECT_TRUE(patch.height_quads.empty());
}

}  // namespace
}  // namespace swell::ocean
