// Tiles that cover the sea with a patch: against a scalar reference, and what a blend has to keep.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "math/random.h"
#include "ocean/open_sea/sea.h"
#include "ocean/simd_targets.h"

namespace swell::ocean {
namespace {

constexpr int kSamples = 32;
constexpr double kTiledLength_m = 64.0;

SeaFrame tiled_frame(std::uint64_t seed) {
  SeaFrame frame;
  PatchFrame& patch = frame.patches.emplace_back();
  patch.length_m = glm::dvec2(kTiledLength_m);
  patch.resolution = kSamples;
  patch.tiling = {true, 12345};
  for (auto* field : {&patch.height_m, &patch.slope_x, &patch.slope_y})
    for (std::uint64_t i = 0; i < kSamples * kSamples; ++i)
      field->push_back(static_cast<float>(2.0 * random_uniform(seed, field->size() + i) - 1.0));
  return frame;
}

std::vector<glm::dvec2> random_places(int count, double range_m) {
  std::vector<glm::dvec2> places;
  for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(count); ++i)
    places.emplace_back(range_m * (2.0 * random_uniform(3, 2 * i) - 1.0),
                        range_m * (2.0 * random_uniform(3, 2 * i + 1) - 1.0));
  return places;
}

// ---- The reference: all weights of all tiles around a place, in double.

std::uint32_t hash(std::int64_t column, std::int64_t row, std::uint32_t seed) {
  std::uint32_t x = (static_cast<std::uint32_t>(row & 0xffff) << 16 |
                     static_cast<std::uint32_t>(column & 0xffff)) ^
                    seed;
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  return x ^ x >> 16;
}

// Rises from 0 to 1 across a border at 0, of width 1/8.
double half_weight(double x) {
  const double t = std::clamp(8.0 * x + 0.5, 0.0, 1.0);
  return std::sin(0.5 * std::numbers::pi * t * t * (3.0 - 2.0 * t));
}

// Returns the weight at x of a tile from 0 to 1.
double tile_weight(double x) { return half_weight(x) * half_weight(1.0 - x); }

double bilinear(const std::vector<float>& field, glm::dvec2 samples) {
  const glm::dvec2 cell = glm::floor(samples), f = samples - cell;
  const auto value = [&](int i, int j) {
    const auto wrap = [](double v) {
      return static_cast<int>(v - kSamples * std::floor(v / kSamples));
    };
    return static_cast<double>(field[wrap(cell.y + j) * kSamples + wrap(cell.x + i)]);
  };
  return (value(0, 0) * (1 - f.x) + value(1, 0) * f.x) * (1 - f.y) +
         (value(0, 1) * (1 - f.x) + value(1, 1) * f.x) * f.y;
}

double reference_height(const PatchFrame& patch, glm::dvec2 p) {
  const glm::dvec2 at = p / kTiledLength_m;
  double sum = 0.0;
  const auto row0 = static_cast<std::int64_t>(std::floor(at.y));
  for (std::int64_t row = row0 - 1; row <= row0 + 1; ++row) {
    const double x = at.x + ((row & 1) != 0 ? 0.5 : 0.0);
    const auto column0 = static_cast<std::int64_t>(std::floor(x));
    for (std::int64_t column = column0 - 1; column <= column0 + 1; ++column) {
      const double weight = tile_weight(x - static_cast<double>(column)) *
                            tile_weight(at.y - static_cast<double>(row));
      const std::uint32_t bits = hash(column, row, patch.tiling.seed);
      const glm::dvec2 offset(bits % kSamples, (bits >> 16) % kSamples);
      sum += weight * bilinear(patch.height_m, at * static_cast<double>(kSamples) + offset);
    }
  }
  return sum;
}

TEST(PatchTiles, GiveTheHeightsOfTheReference) {
  const SeaFrame frame = tiled_frame(1);
  for (const glm::dvec2& centre : {glm::dvec2(0.0), glm::dvec2(-5.2e6, 4.3e6)}) {
    std::vector<glm::dvec2> places = random_places(5000, 1000.0);
    for (glm::dvec2& p : places) p += centre;
    std::vector<float> first;
    for_each_simd_target([&] {
      std::vector<float> got(places.size());
      sample_heights(frame, places, got);
      for (std::size_t i = 0; i < places.size(); ++i)
        ASSERT_NEAR(got[i], reference_height(frame.patches[0], places[i]), 5e-3) << i;
      if (first.empty()) first = got;
      EXPECT_EQ(got, first);
    });
  }
}

TEST(PatchTiles, AroundAnOriginAreThoseOfTheWorld) {
  const SeaFrame frame = tiled_frame(2);
  const auto wide = random_places(2000, 1000.0);
  for (const glm::dvec2& origin : {glm::dvec2(0.0), glm::dvec2(-4.2e6 + 0.3, 12345.678)}) {
    const std::vector<glm::vec2> offsets(wide.begin(), wide.end());
    std::vector<glm::dvec2> world;
    for (const glm::vec2& offset : offsets) world.push_back(origin + glm::dvec2(offset));
    std::vector<float> got(offsets.size()), want(offsets.size());
    sample_heights(frame, origin, offsets, got);
    sample_heights(frame, world, want);
    for (std::size_t i = 0; i < got.size(); ++i) ASSERT_NEAR(got[i], want[i], 1e-3) << i;
  }
}

// A packet's other lanes change nothing: each place alone has the same bits.
TEST(PatchTiles, GiveEachPlaceItsBitsInAnyCompany) {
  const SeaFrame frame = tiled_frame(3);
  const auto places = random_places(500, 300.0);
  for_each_simd_target([&] {
    std::vector<float> all(places.size()), x(places.size()), y(places.size());
    sample_heights(frame, places, all);
    sample_slopes(frame, places, x, y);
    for (std::size_t i = 0; i < places.size(); ++i) {
      float z = 0.0f, dx = 0.0f, dy = 0.0f;
      sample_heights(frame, {&places[i], 1}, {&z, 1});
      sample_slopes(frame, {&places[i], 1}, {&dx, 1}, {&dy, 1});
      ASSERT_EQ(z, all[i]) << i;
      ASSERT_EQ(glm::vec2(dx, dy), glm::vec2(x[i], y[i])) << i;
    }
  });
}

// The patch is 1 everywhere: heights are the sum of the weights, and slopes are that sum's.
TEST(PatchTiles, HaveSlopesThatAreThoseOfTheirHeights) {
  SeaFrame frame = tiled_frame(4);
  std::ranges::fill(frame.patches[0].height_m, 1.0f);
  for (auto* slope : {&frame.patches[0].slope_x, &frame.patches[0].slope_y})
    std::ranges::fill(*slope, 0.0f);
  constexpr double kStep_m = 0.1;
  double steepest = 0.0;
  for (const glm::dvec2& p : random_places(3000, 500.0)) {
    const std::array<glm::dvec2, 4> around = {
        p + glm::dvec2(kStep_m, 0), p - glm::dvec2(kStep_m, 0), p + glm::dvec2(0, kStep_m),
        p - glm::dvec2(0, kStep_m)};
    std::array<float, 4> z{};
    sample_heights(frame, around, z);
    float x = 0.0f, y = 0.0f;
    sample_slopes(frame, {&p, 1}, {&x, 1}, {&y, 1});
    ASSERT_NEAR(x, (z[0] - z[1]) / (2 * kStep_m), 4e-3) << p.x << " " << p.y;
    ASSERT_NEAR(y, (z[2] - z[3]) / (2 * kStep_m), 4e-3) << p.x << " " << p.y;
    steepest = std::max(steepest, static_cast<double>(std::hypot(x, y)));
  }
  EXPECT_GT(steepest, 0.05);
}

// Half as long along y: the same heights at half of y, twice the slopes along y.
TEST(PatchTiles, AreAsLongAlongEachAxisAsThePatch) {
  const SeaFrame square = tiled_frame(5);
  SeaFrame flat = square;
  flat.patches[0].length_m.y = 0.5 * kTiledLength_m;
  for (float& slope : flat.patches[0].slope_y) slope *= 2.0f;
  const auto places = random_places(3000, 500.0);
  std::vector<glm::dvec2> nearer;
  for (const glm::dvec2& p : places) nearer.emplace_back(p.x, 0.5 * p.y);
  for_each_simd_target([&] {
    std::vector<float> z(places.size()), x = z, y = z, flat_z = z, flat_x = z, flat_y = z;
    sample_heights(square, places, z);
    sample_slopes(square, places, x, y);
    sample_heights(flat, nearer, flat_z);
    sample_slopes(flat, nearer, flat_x, flat_y);
    for (float& slope : y) slope *= 2.0f;
    EXPECT_EQ(flat_z, z);
    EXPECT_EQ(flat_x, x);
    EXPECT_EQ(flat_y, y);
  });
}

struct TileMoments {
  double mean, variance, kurtosis;
};
TileMoments moments_of(const std::vector<float>& values) {
  double sum = 0.0, squares = 0.0, fourths = 0.0;
  for (const float v : values) sum += v, squares += v * v;
  const double n = static_cast<double>(values.size()), mean = sum / n;
  for (const float v : values) fourths += std::pow(v - mean, 4);
  const double variance = squares / n - mean * mean;
  return {mean, variance, fourths / n / (variance * variance)};
}

SeaFrame wind_sea(bool tiling) {
  SeaDescription description;
  description.resolution = 64;
  description.patch_lengths_m = {640.0};
  description.tiling = tiling;
  Workers workers(1);
  SeaFrame frame;
  advance(Sea(description), 2.0, frame, workers);
  return frame;
}

// Heights along one line north to south through 4000 tiles' borders, and along their middles.
std::vector<float> heights_on(const SeaFrame& frame, double part_of_tile) {
  std::vector<glm::dvec2> places;
  for (int i = 0; i < 4000; ++i)
    places.emplace_back(101.0 * i, 640.0 * ((i * 7) % 4000 - 2000 + part_of_tile));
  std::vector<float> z(places.size());
  sample_heights(frame, places, z);
  return z;
}

TEST(PatchTiles, KeepTheDistributionOfHeightsAlsoWhereTheyAreBlended) {
  const SeaFrame frame = wind_sea(true);
  double variance = 0.0;
  for (const float z : frame.patches[0].height_m) variance += z * z;
  variance /= static_cast<double>(frame.patches[0].height_m.size());
  for (const double part : {0.0, 0.03, 0.5}) {
    const TileMoments m = moments_of(heights_on(frame, part));
    EXPECT_NEAR(m.mean, 0.0, 0.06 * std::sqrt(variance)) << part;
    EXPECT_NEAR(m.variance / variance, 1.0, 0.1) << part;
    EXPECT_NEAR(m.kurtosis, 3.0, 0.4) << part;
  }
}

TEST(PatchTiles, DoNotRepeatThemselves) {
  const auto correlation = [](const SeaFrame& frame, glm::dvec2 lag_m) {
    const auto places = random_places(20000, 50000.0);
    std::vector<glm::dvec2> moved;
    for (const glm::dvec2& p : places) moved.push_back(p + lag_m);
    std::vector<float> a(places.size()), b(places.size());
    sample_heights(frame, places, a);
    sample_heights(frame, moved, b);
    double ab = 0.0, aa = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) ab += a[i] * b[i], aa += a[i] * a[i];
    return ab / aa;
  };
  const SeaFrame tiled = wind_sea(true), periodic = wind_sea(false);
  for (const glm::dvec2& periods : {glm::dvec2(1, 0), glm::dvec2(0, 1), glm::dvec2(1, 1),
                                    glm::dvec2(0.5, 1), glm::dvec2(0, 2), glm::dvec2(7, 3)}) {
    EXPECT_LT(correlation(tiled, 640.0 * periods), 0.1) << periods.x << " " << periods.y;
    if (periods.x != 0.5) {
      EXPECT_GT(correlation(periodic, 640.0 * periods), 0.999);
    }
  }
}

}  // namespace
}  // namespace swell::ocean
