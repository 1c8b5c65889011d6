// The sun's path on the sea as pictures show it: as wide as the slopes of the wind's sea make it.
// Source: Cox and Munk, Measurement of the Roughness of the Sea Surface, 1954.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "math/elementary.h"
#include "render/measures.h"
#include "render/shot.h"
#include "sky/sky_light.h"

namespace swell::render {
namespace {

constexpr glm::ivec2 kGlitterSize_px(320, 48);
constexpr double kEye_m = 20.0;

// The sun stands ahead, the wind blows across the line of sight by half a right angle, so that
// slopes along and across it vary alike. A wall as wide as what is seen stands before the sun and
// throws its shadow on all of it.
scene::Scene sea_behind_wall(double wind_mps, double elevation_deg) {
  scene::Scene scene;
  scene.sea.wind_speed_mps = wind_mps;
  scene.sea.wind_from_rad = 0.25 * kPi;
  scene.sea.whitecaps = 0.0;
  scene.water.body_colour = glm::vec3(0.0f);
  scene.sky.sun_azimuth_rad = 0.0;
  scene.sky.sun_elevation_rad = radians(elevation_deg);
  scene.sky.sun_direction = sky::sun_direction(0.0, scene.sky.sun_elevation_rad);
  scene.sky.zenith = scene.sky.horizon = glm::vec3(0.1f);
  scene.sky.sun_radiance = glm::vec3(2.0f);
  scene.sky.cloud_cover = 0.0;
  scene::FloatingObject wall;
  wall.kind = scene::ObjectKind::kBox;
  wall.position_m = {0.0, 300.0};
  wall.size_m = {500.0, 10.0, 500.0};
  wall.draught = 0.5;
  scene.objects = {wall};
  return scene;
}

// Green light of a strip of the sea.
std::vector<float> strip(const World& world, const View& view, double t_s, PartSet without) {
  without.add({Part::kHaze, Part::kEarth, Part::kHulls, Part::kReflection});
  const Shot shot(world, view, t_s, {.keep_linear = true, .edge_samples = 0, .without = without});
  return green_light(shot.target);
}

// Standard deviation of the azimuth of the sun's path, which is what the wall takes away, where it
// is seen within half a degree of the sun's elevation below the level.
double path_width_rad(const scene::Scene& scene) {
  const double down_rad = scene.sky.sun_elevation_rad;
  const World world = world_of(scene);
  double sum = 0.0, moment = 0.0;
  for (int n = 0; n < 6; ++n) {
    const View view = make_view({0.0, 0.0, kEye_m}, 0.0, -down_rad, radians(8.0), 0.25f,
                                kGlitterSize_px.x, kGlitterSize_px.y);
    const std::vector<float> lit = strip(world, view, 7.0 * n, {Part::kShadows});
    const std::vector<float> shaded = strip(world, view, 7.0 * n, {});
    for (int y = 0; y < kGlitterSize_px.y; ++y)
      for (int x = 0; x < kGlitterSize_px.x; ++x) {
        const glm::dvec3 ray(view.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
        const auto i = static_cast<std::size_t>(y * kGlitterSize_px.x + x);
        const double azimuth = std::atan2(ray.x, ray.y), length = glm::length(ray);
        if (std::abs(std::asin(-ray.z / length) - down_rad) > radians(0.5)) continue;
        const double solid_angle = 1.0 / (length * length * length);  // in proportion to it
        const double glint = solid_angle * static_cast<double>(lit[i] - shaded[i]);
        sum += glint;
        moment += glint * azimuth * azimuth;
      }
  }
  return std::sqrt(moment / sum);
}

// OPT-14, at the depression that is the sun's own elevation: the standard deviation of the azimuth
// is asin(2 s tan elevation), for a deviation s of the slopes along each axis; within 10 %.
TEST(GlitterPicture, OfTheSunsPathIsAsWideAsTheSlopesSay) {
  const std::vector<std::pair<double, double>> widths_deg = {
      {5.0, 1.65}, {10.0, 3.33}, {20.0, 6.88}, {30.0, 10.96}};
  for (const auto& [elevation_deg, width_deg] : widths_deg) {
    const double drawn_deg = path_width_rad(sea_behind_wall(10.0, elevation_deg)) * 180.0 / kPi;
    EXPECT_NEAR(drawn_deg, width_deg, 0.1 * width_deg) << elevation_deg;
  }
}

// OPT-14 at 20 degrees: the width follows from Cox and Munk's mean square slope, which scatters by
// 0.004.
TEST(GlitterPicture, OfTheSunsPathIsAsWideAsTheWindSays) {
  constexpr double kElevation_deg = 20.0;
  const auto width_rad = [&](double slope_variance) {
    const double deviation = std::sqrt(0.5 * slope_variance);
    return std::asin(2.0 * deviation * std::tan(radians(kElevation_deg)));
  };
  for (const double wind_mps : {3.0, 6.0, 14.0}) {
    const double variance = 0.003 + 0.00512 * wind_mps;
    const double drawn_rad = path_width_rad(sea_behind_wall(wind_mps, kElevation_deg));
    EXPECT_GE(drawn_rad, width_rad(variance - 0.004)) << wind_mps;
    EXPECT_LE(drawn_rad, width_rad(variance + 0.004)) << wind_mps;
  }
}

}  // namespace
}  // namespace swell::render
