// Maps that are longer along one axis than along the other, of one wave whose heights, slopes and
// velocities are known.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "constants.h"
#include "ocean/frame_at.h"
#include "ocean/open_sea/map_waves.h"
#include "ocean/open_sea/sea.h"
#include "ocean/open_sea/sea_state.h"
#include "ocean/simd_targets.h"
#include "ocean/velocity.h"
#include "scratch_folder.h"

namespace swell::ocean {
namespace {

constexpr double kAlongX_m = 48.0, kAlongY_m = 20.0, kAmplitude_m = 0.4, kMapPeriod_s = 9.0;
constexpr int kMapSize = 64, kMapFrames = 32;

// sin(2 pi (x + y - t)), x and y in sides, t in loops.
PeriodicMap sine_map() {
  constexpr double kMost = 32767.0;
  PeriodicMap map;
  map.size = kMapSize, map.frames = kMapFrames;
  map.travel = std::sqrt(0.5);
  map.height_scale = static_cast<float>(1.0 / kMost);
  map.slope_scale = static_cast<float>(kTurn / kMost);
  for (int f = 0; f < kMapFrames; ++f)
    for (int j = 0; j < kMapSize; ++j)
      for (int i = 0; i < kMapSize; ++i) {
        const double phase =
            kTurn * (static_cast<double>(i + j) / kMapSize - static_cast<double>(f) / kMapFrames);
        map.height.push_back(static_cast<std::int16_t>(std::lround(kMost * std::sin(phase))));
        map.slope_x.push_back(static_cast<std::int16_t>(std::lround(kMost * std::cos(phase))));
      }
  map.slope_y = map.slope_x;
  return map;
}

SeaDescription sea_of_sine(const ScratchFolder& folder, glm::dvec2 length_m, double period_s) {
  const std::string file = folder.write("sine.map", encode_map(sine_map())).string();
  SeaDescription description;
  description.spectrum = false;
  description.tiling = false;
  description.maps = {{file, length_m, period_s, 4.0 * kAmplitude_m * std::sqrt(0.5)}};
  return description;
}

double phase_at(glm::dvec2 p, double t_s) {
  return kTurn * (p.x / kAlongX_m + p.y / kAlongY_m - t_s / kMapPeriod_s);
}

struct StretchedSea {
  ScratchFolder folder;
  Sea sea{sea_of_sine(folder, {kAlongX_m, kAlongY_m}, kMapPeriod_s)};
};

// On the samples; between them heights and slopes are bilinear.
std::vector<glm::dvec2> samples_of_map() {
  std::vector<glm::dvec2> places;
  for (int n = 0; n < 500; ++n)
    places.emplace_back(kAlongX_m * (37 * n - 4000) / kMapSize,
                        kAlongY_m * (11 * n - 900) / kMapSize);
  return places;
}

TEST(StretchedMap, HasTheHeightsAndSlopesOfItsSine) {
  const StretchedSea stretched;
  Workers workers(1);
  SeaFrame frame;
  for (const double t_s : {0.0, 5.0, -77.3}) {
    advance(stretched.sea, t_s, frame, workers);
    for_each_simd_target([&] {
      const std::vector<glm::dvec2> places = samples_of_map();
      std::vector<float> z(places.size()), x(places.size()), y(places.size());
      sample_heights(frame, places, z);
      sample_slopes(frame, places, x, y);
      for (std::size_t i = 0; i < places.size(); ++i) {
        const double phase = phase_at(places[i], t_s);
        ASSERT_NEAR(z[i], kAmplitude_m * std::sin(phase), 2e-4) << i;
        ASSERT_NEAR(x[i], kAmplitude_m * kTurn / kAlongX_m * std::cos(phase), 1e-4) << i;
        ASSERT_NEAR(y[i], kAmplitude_m * kTurn / kAlongY_m * std::cos(phase), 1e-4) << i;
      }
    });
  }
}

// The drawn vertices' heights are asked for around an origin.
TEST(StretchedMap, HasTheSameHeightsAroundAnOrigin) {
  const StretchedSea stretched;
  const SeaFrame frame = frame_at(stretched.sea, 3.0);
  const glm::dvec2 origin(-4100.0, 12345.0);
  std::vector<glm::vec2> offsets;
  std::vector<glm::dvec2> places;
  for (int n = 0; n < 500; ++n) {
    offsets.emplace_back(3.1f * static_cast<float>(n), 700.0f - 2.3f * static_cast<float>(n));
    places.push_back(origin + glm::dvec2(offsets.back()));
  }
  for_each_simd_target([&] {
    std::vector<float> near(places.size()), world(places.size());
    sample_heights(frame, origin, offsets, near);
    sample_heights(frame, places, world);
    for (std::size_t i = 0; i < places.size(); ++i) {
      ASSERT_NEAR(near[i], world[i], 1e-4) << i;
      ASSERT_NEAR(world[i], kAmplitude_m * std::sin(phase_at(places[i], 3.0)), 2e-3) << i;
    }
  });
}

TEST(StretchedMap, HasTheVarianceOfSlopesAlongEachAxis) {
  const StretchedSea stretched;
  const PatchFrame patch = frame_at(stretched.sea, 3.0).patches[0];
  double x2 = 0.0, y2 = 0.0;
  for (std::size_t i = 0; i < patch.slope_x.size(); ++i) {
    x2 += static_cast<double>(patch.slope_x[i]) * patch.slope_x[i];
    y2 += static_cast<double>(patch.slope_y[i]) * patch.slope_y[i];
  }
  const auto count = static_cast<double>(patch.slope_x.size());
  const auto variance_along = [](double length_m) {
    return 0.5 * std::pow(kAmplitude_m * kTurn / length_m, 2.0);
  };
  const double along_x = variance_along(kAlongX_m), along_y = variance_along(kAlongY_m);
  EXPECT_NEAR(x2 / count / along_x, 1.0, 1e-3);
  EXPECT_NEAR(y2 / count / along_y, 1.0, 1e-3);
  EXPECT_NEAR(static_cast<double>(patch.slope_variance) / (along_x + along_y), 1.0, 1e-4);
  EXPECT_GE(stretched.sea.slope_bound(), kAmplitude_m * kTurn / kAlongY_m);
  EXPECT_NEAR(stretched.sea.height_bound_m(), kAmplitude_m, 1e-3);
}

TEST(StretchedMap, HasTheLengthOfItsWave) {
  const StretchedSea stretched;
  const double wavelength_m = 1.0 / std::hypot(1.0 / kAlongX_m, 1.0 / kAlongY_m);
  EXPECT_NEAR(stretched.sea.mean_wavelength_m(), wavelength_m, 1e-3);
}

TEST(StretchedMap, RunsAsFastAsInDeepWaterByDefault) {
  const ScratchFolder folder;
  for (const glm::dvec2& length_m :
       {glm::dvec2(kAlongX_m, kAlongY_m), {3.0, 700.0}, {700.0, 3.0}}) {
    const Sea sea(sea_of_sine(folder, length_m, 0.0));
    const double k = kTurn * glm::length(1.0 / length_m);
    // The wave passes a place once a loop.
    EXPECT_NEAR(sea.state().maps[0].loops_per_s, std::sqrt(9.81 * k) / kTurn, 1e-3 * std::sqrt(k));
  }
}

// Circles of deep water in the plane of the wave: along k = 2 pi (1 / 48, 1 / 20), omega z along
// and the rate of z upwards.
TEST(StretchedMap, MovesItsWaterAlongItsWave) {
  const StretchedSea stretched;
  Workers workers(1);
  const SeaFrame frame = frame_at(stretched.sea, 2.0);
  VelocityFrame velocity;
  advance_velocity(stretched.sea, frame, velocity, workers);
  const glm::dvec2 along = glm::normalize(glm::dvec2(1.0 / kAlongX_m, 1.0 / kAlongY_m));
  const double omega = kTurn / kMapPeriod_s;
  for (const glm::dvec2& p : samples_of_map()) {
    glm::vec3 v;
    sample_velocities(velocity, {&p, 1}, {&v, 1});
    const double phase = phase_at(p, 2.0), speed = kAmplitude_m * omega;
    ASSERT_NEAR(v.x, along.x * speed * std::sin(phase), 0.02 * speed);
    ASSERT_NEAR(v.y, along.y * speed * std::sin(phase), 0.02 * speed);
    ASSERT_NEAR(v.z, -speed * std::cos(phase), 0.02 * speed);
  }
}

// The map begins at whole samples, of 0.75 m along x and 0.3125 m along y.
TEST(StretchedMap, IsOffsetAlongEachAxis) {
  const ScratchFolder folder;
  SeaDescription description = sea_of_sine(folder, {kAlongX_m, kAlongY_m}, kMapPeriod_s);
  description.maps[0].offset_m = {9.0, -2.5};
  const SeaFrame frame = frame_at(Sea(description), 0.0);
  for (const glm::dvec2& p : samples_of_map()) {
    float z = 0.0f;
    sample_heights(frame, {&p, 1}, {&z, 1});
    ASSERT_NEAR(z, kAmplitude_m * std::sin(phase_at(p + glm::dvec2(9.0, -2.5), 0.0)), 2e-4);
  }
}

}  // namespace
}  // namespace swell::ocean
