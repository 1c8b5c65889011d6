// What waves mirror where the mirrored ray goes down: the sea, not the sky.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "constants.h"
#include "ocean/water_surface.h"
#include "render/drawn_water.h"
#include "render/shaders/plain_sea.h"
#include "render/shaders/shader_kernels.h"
#include "render/sky/sky_maps.h"
#include "sky/sky_light.h"
#include "texture/on_every_target.h"

namespace swell::render {
namespace {

class MirroredSea : public texture::OnEveryTarget {};
INSTANTIATE_TEST_SUITE_P(Targets, MirroredSea, texture::every_target(), texture::target_name);

constexpr float kSkyCode = 128.0f;
constexpr float kSky = kSoftSkyRange * (kSkyCode / 255.0f) * (kSkyCode / 255.0f);

// Water that mirrors everything, under a sky of radiance kSky, over a black sea.
PlainSea mirror(float variance) {
  PlainSea sea(kSkyCode, variance);
  sea.shading.media.refraction_index = 1e5f;
  return sea;
}

glm::vec3 to_eye(double elevation_rad) {
  return {0.0f, static_cast<float>(std::cos(elevation_rad)),
          static_cast<float>(std::sin(elevation_rad))};
}

// The part of the light that comes from the black sea, on a wave whose mean slope, uphill to the
// eye, is -slope: positive faces the eye.
double sea_part(PlainSea& sea, double elevation_rad, double slope) {
  auto& water = std::get<Water>(sea.shading.materials);
  water.sines[0] = {.slope_y = static_cast<float>(-slope), .wavelength_log2 = 100.0f};
  water.sine_count = 1;
  const std::vector<glm::vec3> eye = {to_eye(elevation_rad)};
  std::vector<glm::vec3> light(1);
  water_light(sea.shading, eye, light);
  return 1.0 - static_cast<double>(light[0].y) / kSky;
}

// Returns the part of the light that comes from the black sea by the facets themselves, one bounce
// of each: by quadrature over Gaussian slopes about the mean one, weighted by how much of a facet
// the eye sees.
double facets_part(double variance, double elevation_rad, double slope) {
  constexpr int kSteps = 160;
  const double sigma = std::sqrt(0.5 * variance), c = std::sin(elevation_rad),
               h = std::cos(elevation_rad);
  static const auto deviations = [] {
    std::array<double, kSteps> u;
    for (int i = 0; i < kSteps; ++i) u[i] = 10.0 * (i + 0.5) / kSteps - 5.0;
    return u;
  }();
  static const auto densities = [] {
    std::array<double, kSteps> p;
    for (int i = 0; i < kSteps; ++i) p[i] = std::exp(-0.5 * deviations[i] * deviations[i]);
    return p;
  }();
  double seen = 0.0, down = 0.0;
  for (int j = 0; j < kSteps; ++j) {
    const double y = slope + sigma * deviations[j];  // towards the eye
    const double projected = c + y * h;
    if (projected <= 0.0) continue;
    for (int i = 0; i < kSteps; ++i) {
      const double x = sigma * deviations[i];  // across
      const double weight = projected * densities[i] * densities[j];
      seen += weight;
      if (2.0 * projected / (1.0 + x * x + y * y) < c) down += weight;
    }
  }
  return down / seen;
}

constexpr double kVariances[] = {0.0012, 0.005, 0.02, 0.06};
constexpr double kElevations_deg[] = {2.0, 4.0, 7.0, 12.0, 20.0, 45.0, 80.0};

double radians(double degrees) { return degrees * kPiRef / 180.0; }

TEST_P(MirroredSea, IsSeenByAsManyFacetsAsThrowRaysDown) {
  double squares = 0.0;
  int count = 0;
  for (const double variance : kVariances) {
    PlainSea sea = mirror(static_cast<float>(variance));
    for (const double degrees : kElevations_deg) {
      const double elevation = radians(degrees);
      // Down to back sides 0.12 beyond the edge of sight.
      const double least = std::max(-std::tan(elevation) - 0.12, -0.4);
      for (double slope = least; slope < 0.4; slope += 0.03) {
        const double got = sea_part(sea, elevation, slope),
                     expected = facets_part(variance, elevation, slope);
        EXPECT_NEAR(got, expected, 0.3) << variance << " " << degrees << " " << slope;
        squares += (got - expected) * (got - expected);
        ++count;
      }
    }
  }
  EXPECT_LT(std::sqrt(squares / count), 0.06);
}

// Waves that are seen and facets that are not, together: the mean over the waves, as much as each
// is seen.
TEST_P(MirroredSea, IsSeenAsMuchAsByFacetsInTheMeanOverWaves) {
  constexpr int kWaves = 60;
  for (const double waves : {0.01, 0.03, 0.05}) {  // slope variance
    const double sigma = std::sqrt(0.5 * waves);
    for (const double variance : kVariances) {
      PlainSea sea = mirror(static_cast<float>(variance));
      for (const double degrees : kElevations_deg) {
        const double elevation = radians(degrees);
        double seen = 0.0, got = 0.0, expected = 0.0;
        for (int i = 0; i < kWaves; ++i) {
          const double u = 6.0 * (i + 0.5) / kWaves - 3.0, slope = sigma * u;
          const double projected = std::sin(elevation) + slope * std::cos(elevation);
          if (projected <= 0.0) continue;
          const double weight = projected * std::exp(-0.5 * u * u);
          seen += weight;
          got += weight * sea_part(sea, elevation, slope);
          expected += weight * facets_part(variance, elevation, slope);
        }
        const double error = (got - expected) / seen;
        EXPECT_GT(error, -0.02) << waves << " " << variance << " " << degrees;
        EXPECT_LT(error, 0.065) << waves << " " << variance << " " << degrees;
      }
    }
  }
}

// No line where the ray passes the horizon: a tenth of sigma turns little of the light.
TEST_P(MirroredSea, ComesInSmoothly) {
  for (const double variance : kVariances) {
    PlainSea sea = mirror(static_cast<float>(variance));
    const double sigma = std::sqrt(0.5 * variance);
    for (const double degrees : kElevations_deg) {
      double before = 1.0;
      const double elevation = radians(degrees), edge = -std::tan(elevation);
      if (edge < -0.5) continue;
      for (double slope = edge; slope < 0.3; slope += 0.1 * sigma) {
        const double part = sea_part(sea, elevation, slope);
        if (slope > edge) {
          EXPECT_LT(std::abs(part - before), 0.08) << variance << " " << degrees;
        }
        EXPECT_GE(part, -1e-4);
        EXPECT_LE(part, 1.0 + 1e-4);
        before = part;
      }
    }
  }
}

// ---- Of scenes

// Also under a zenith that is brighter than the horizon, and with water of any colour.
TEST(MirroredSeaOfScenes, IsNoBrighterThanTheHorizon) {
  scene::Scene scene;
  scene.sea.resolution = 16;
  for (const double wind : {0.0, 2.0, 8.0, 20.0}) {
    for (const double elevation : {-5.0, 5.0, 60.0}) {
      for (const float zenith : {0.05f, 0.3f, 2.0f}) {
        for (const float body : {0.0f, 0.05f, 1.0f}) {
          scene.sea.wind_speed_mps = wind;
          scene.sky.sun_elevation_rad = radians(elevation);
          scene.sky.sun_direction =
              sky::sun_direction(scene.sky.sun_azimuth_rad, scene.sky.sun_elevation_rad);
          scene.sky.zenith = glm::vec3(zenith);
          scene.water.body_colour = glm::vec3(body);
          const World world = world_of(scene);
          const DrawnWater drawn(world, 0.0);
          const glm::vec3 sea = drawn.water().optics.mirrored_sea;
          const glm::vec3 horizon = drawn.shading().light.horizon;
          for (int c = 0; c < 3; ++c) {
            EXPECT_GT(sea[c], 0.0f);
            EXPECT_LE(sea[c], horizon[c]) << wind << " " << elevation << " " << zenith;
          }
        }
      }
    }
  }
}

// One sine has half the square of its steepness as slope variance.
TEST(MirroredSeaOfScenes, HidesHalfOfTheRaysThatSmithsShadowingHides) {
  scene::Scene scene;
  scene.sea.spectrum = false;
  scene.water.bump_strength = 0.0;
  for (const double steepness : {0.1, 0.3, 0.6}) {
    scene.sea.sines = {{.amplitude_m = steepness * 30.0 / (2.0 * kPiRef), .wavelength_m = 30.0}};
    const World world = world_of(scene);
    const DrawnWater drawn(world, 0.0);
    const Water& water = drawn.water();
    const double variance = water.base_variance + 0.5 * steepness * steepness;
    const double nu = water.optics.wave_horizon / std::sqrt(variance);
    const double lambda = 0.5 * (std::exp(-nu * nu) / (nu * std::sqrt(kPiRef)) - std::erfc(nu));
    EXPECT_NEAR(1.0 / (1.0 + lambda), 0.5, 0.005) << steepness;
  }
}

// As seas are: dark.
TEST(MirroredSeaOfScenes, IsDarkUnderAnOrdinarySky) {
  const World world = world_of(scene::Scene());
  const DrawnWater drawn(world, 0.0);
  const glm::vec3 sea = drawn.water().optics.mirrored_sea;
  const glm::vec3 horizon = drawn.shading().light.horizon;
  for (int c = 0; c < 3; ++c) EXPECT_LT(sea[c], 0.5f * horizon[c]);
}

}  // namespace
}  // namespace swell::render
