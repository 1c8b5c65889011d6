// The sun's path on the sea as pictures show it: as wide as the slopes of the wind's sea make it.
// Source: Cox and Munk, Measurement of the Roughness of the Sea Surface, 1954.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "math/elementary.h"
#include "render/frame.h"
#include "scene/scene.h"
#include "scene/sky.h"

namespace swell::render {
namespace {

constexpr glm::ivec2 kSize_px(320, 96);

// Wind across the line of sight by half a right angle, so that slopes along and across it vary
// alike. The sun lies ahead; nothing else gives light.
scene::Scene sea_under_sun(double wind_mps, double elevation_deg) {
  scene::Scene scene;
  scene.sea.wind_speed_mps = wind_mps;
  scene.sea.wind_to_rad = 0.25 * kPi;
  scene.sky.sun_azimuth_rad = 0.0;
  scene.sky.sun_elevation_rad = scene::radians(elevation_deg);
  scene.sky.sun_direction = scene::sun_direction(0.0, scene.sky.sun_elevation_rad);
  scene.sky.zenith = scene.sky.horizon = glm::vec3(0.0f);
  scene.sky.sun_radiance = glm::vec3(2.0f);
  scene.sky.cloud_cover = 0.0;
  scene.sea.whitecaps = 0.0;
  return scene;
}

// The glitter's part of the light: that of the sun less that of a sun as bright beside it, which
// lights water, foam and haze as well.
struct Path {
  double width_rad = 0.0;  // standard deviation of the azimuth, of what lies near a depression
};

Path measure_path(const scene::Scene& scene, double depression_deg, double height_m) {
  FrameOptions options;
  options.keep_linear = true;
  options.edge_samples = 0;
  options.without = {Part::kHaze, Part::kEarth};
  Workers workers(2);
  Workspace workspace;
  Target target;
  const World world(scene);
  const double down_rad = scene::radians(depression_deg);
  double sum = 0.0, moment = 0.0;
  for (int n = 0; n < 4; ++n) {
    const View view = make_view({3000.0 * n, 0.0, height_m}, 0.0, -down_rad, 0.5, 0.25f, kSize_px.x, kSize_px.y);
    render_frame(world, view, 10.0 * n, options, workspace, target, workers);
    for (int y = 0; y < kSize_px.y; ++y)
      for (int x = 0; x < kSize_px.x; ++x) {
        const glm::dvec3 ray(view.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
        const double length = glm::length(ray), across = std::hypot(ray.x, ray.y);
        const double elevation = std::atan2(ray.z, across), azimuth = std::atan2(ray.x, ray.y);
        if (std::abs(elevation + down_rad) > scene::radians(0.5)) continue;
        const double weight = 1.0 / (length * length * length);
        const double light = weight * static_cast<double>(target.linear[3 * (static_cast<std::size_t>(y) * kSize_px.x + x) + 1]);
        sum += light;
        moment += light * azimuth * azimuth;
      }
  }
  return {std::sqrt(moment / sum)};
}

TEST(GlitterPicture, Probe) {
  const std::vector<std::pair<double, double>> widths = {{5.0, 1.65}, {10.0, 3.33}, {20.0, 6.88}, {30.0, 10.96}};
  for (const double height : {20.0, 100.0, 1000.0})
  for (const auto& [elevation, width] : widths)
    printf("h %g eps %g: %.2f of %.2f\n", height, elevation, measure_path(sea_under_sun(10.0, elevation), elevation, height).width_rad * 180 / kPi, width);
}

}  // namespace
}  // namespace swell::render
