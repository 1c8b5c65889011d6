// A round sea without end: where its horizon lies, what sinks behind it, and that it looks the same
// wherever the square of its lattice lies.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "math/elementary.h"
#include "render/shot.h"

namespace swell::render {
namespace {

constexpr double kRadius_m = 6371e3 / 0.87;  // HOR: k = 0.13
const std::vector<double> kHeights_m = {0.3, 2.0, 10.0, 60.0, 300.0, 1500.0, 10000.0, 40000.0};

double dip(double eye_m) { return std::sqrt(2.0 * eye_m / kRadius_m); }  // its tangent

scene::Scene calm_sea() {
  scene::Scene scene;
  scene.sea.spectrum = false;
  scene.sky.haze_distance_m = 1e7;
  return scene;
}

Shot draw(const World& world, const View& view) {
  // Not adaptively: a pixel may be filled in on one side of a step and shaded on the other.
  return Shot(world, view, 5.0,
              {.water_triangles = 20000, .edge_samples = 0, .shading = scene::ShadingRate::kFull});
}

// Rolled, so that the horizon crosses pixels' centres at all heights.
View towards_horizon(glm::dvec3 eye, double tan_dip, double fov_y_rad, int width_px,
                     int height_px) {
  const glm::dmat3 axes = camera_axes(0.4, -std::atan(tan_dip), 0.07);
  return make_view(eye, axes, lens_of_fov(fov_y_rad, width_px, height_px), 0.25f, width_px,
                   height_px);
}

// How far below the horizon of that dip the drawn one lies, in pixels: the mean and the most of a
// column. No column has sky below water.
struct HorizonError {
  double mean_px = 0.0;
  int most_px = 0;
};
HorizonError horizon_error(const World& world, const View& view, double tan_dip) {
  const Shot shot = draw(world, view);
  HorizonError error;
  for (int x = 0; x < view.width_px; ++x) {
    int missing = 0, first_water = view.height_px;
    for (int y = 0; y < view.height_px; ++y) {
      const glm::vec3 ray = view.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      const double across = std::hypot(static_cast<double>(ray.x), static_cast<double>(ray.y));
      const bool is_water = shot.shows(SurfaceKind::kWater, x, y);
      missing += (static_cast<double>(ray.z) < -tan_dip * across) - is_water;
      if (is_water) first_water = std::min(first_water, y);
      EXPECT_TRUE(is_water || first_water == view.height_px) << "sky at " << x << ", " << y;
    }
    error.mean_px += static_cast<double>(missing) / view.width_px;
    error.most_px = std::max(error.most_px, std::abs(missing));
  }
  return error;
}

// HOR-01, of a picture 720 pixels high (935 pixels to the radian, of which this is the middle).
TEST(Horizon, LiesAsFarDownAsTheEyesHeightSays) {
  const World world = world_of(calm_sea());
  for (const double height_m : kHeights_m) {
    const double fov_y_rad = 2.0 * std::atan(50.0 / 935.0);
    const View view =
        towards_horizon({800.0, -3000.0, height_m}, dip(height_m), fov_y_rad, 320, 100);
    const HorizonError error = horizon_error(world, view, dip(height_m));
    EXPECT_LT(std::abs(error.mean_px), 0.1) << height_m << " m";
    EXPECT_LE(error.most_px, 1) << height_m << " m";
  }
}

TEST(Horizon, IsRoundInWideViewsToo) {
  const World world = world_of(calm_sea());
  for (const double height_m : kHeights_m) {
    const View view = towards_horizon({0.0, 0.0, height_m}, dip(height_m), radians(60.0), 320, 180);
    const HorizonError error = horizon_error(world, view, dip(height_m));
    EXPECT_LT(std::abs(error.mean_px), 0.1) << height_m << " m";
    EXPECT_LE(error.most_px, 1) << height_m << " m";
  }
}

TEST(Horizon, OfAFlatSeaLiesAtEyeHeight) {
  scene::Scene scene = calm_sea();
  scene.round_earth = false;
  const World world = world_of(scene);
  const View view = towards_horizon({0.0, 0.0, 60.0}, 0.0, radians(40.0), 320, 180);
  const HorizonError error = horizon_error(world, view, 0.0);
  EXPECT_LT(std::abs(error.mean_px), 0.1);
}

// HOR-02: from 10 m, of what stands 20 km off the lowest 4.259 m lie behind the horizon.
TEST(Horizon, HidesTheHullAndShowsTheMast) {
  constexpr double kFocal_px = 200000.0, kHidden_m = 4.259;
  for (const double tall_m : {4.0, 4.6, 6.0, 10.0}) {
    scene::Scene scene = calm_sea();
    scene::FloatingObject mast;
    mast.kind = scene::ObjectKind::kBox;
    mast.position_m = {0.0, 20000.0};
    mast.size_m = {4.0, 4.0, tall_m};
    mast.draught = 0.0;
    scene.objects = {mast};
    const World world = world_of(scene);
    const double fov_y_rad = 2.0 * std::atan(100.0 / kFocal_px);
    const View view =
        make_view({0.0, 0.0, 10.0}, 0.0, -std::atan(dip(10.0)), fov_y_rad, 0.25f, 16, 200);
    const Shot shot = draw(world, view);
    int rows = 0;
    for (int y = 0; y < view.height_px; ++y) rows += shot.shows(SurfaceKind::kObjects, 8, y);
    const double expected_px = std::max(tall_m - kHidden_m, 0.0) * kFocal_px / 20000.0;
    EXPECT_NEAR(rows, expected_px, 1.5) << tall_m << " m: 0.15 px at f = 20000";
  }
}

// Waves that triangles are too wide for would stand up from the horizon here and there.
TEST(Horizon, OfAStormHasNoHeadlands) {
  scene::Scene scene;
  scene.sea.wind_speed_mps = 22.0;
  scene.sea.patch_lengths_m = {1400.0, 210.0, 31.0};
  const World world = world_of(scene);
  for (const double height_m : {60.0, 300.0, 1500.0}) {
    const View view = towards_horizon({0.0, 0.0, height_m}, dip(height_m), radians(10.0), 320, 180);
    const HorizonError error = horizon_error(world, view, dip(height_m));
    EXPECT_LT(std::abs(error.mean_px), 0.25) << height_m << " m";
    EXPECT_LE(error.most_px, 1) << height_m << " m";
  }
}

// Pixels of which a channel differs by more than `steps`.
int changed_pixels(const Shot& a, const Shot& b, int steps) {
  int changed = 0;
  for (int y = 0; y < a.view.height_px; ++y) {
    for (int x = 0; x < a.view.width_px; ++x) {
      const glm::ivec3 d = glm::abs(a.codes(x, y) - b.codes(x, y));
      changed += std::max({d.r, d.g, d.b}) > steps;
    }
  }
  return changed;
}

// The lattice's square jumps when the eye crosses a multiple of 4096 m or more. A micrometre to
// either side of it nothing else moves; 2 mm are seen in near ripples.
TEST(Horizon, AStepOfTheLatticeMovesNoPixel) {
  const World& world = shipped_world("open_ocean");
  for (const double height_m : kHeights_m) {
    for (const double fov_deg : {10.0, 60.0}) {
      const auto draw_at = [&](double east_m) {
        return draw(world, towards_horizon({65536.0 + east_m, -900.0, height_m + 3.0},
                                           dip(height_m), radians(fov_deg), 160, 90));
      };
      const Shot before = draw_at(-1e-6), after = draw_at(1e-6);
      ASSERT_NE(before.state().meshes.water.domain.min_world,
                after.state().meshes.water.domain.min_world);
      EXPECT_EQ(changed_pixels(before, after, 8), 0) << height_m << " m, " << fov_deg << " degrees";
    }
  }
}

// An endless sea has waves wherever the eye goes.
TEST(Horizon, WavesGoOnEverywhere) {
  const World& world = shipped_world("open_ocean");
  for (const glm::dvec2& at : {glm::dvec2(0.0), glm::dvec2(5e4, -3e4), glm::dvec2(-8e5, 9e5)}) {
    const Shot shot = draw(world, make_view({at, 10.0}, 0.0, -0.2, 0.9, 0.25f, 96, 54));
    const Surface& water = shot.state().meshes.water;
    double square = 0.0;
    int near = 0;
    for (std::size_t i = 0; i < water.height_m.size(); ++i) {
      if (glm::length(water.offset[i]) > 300.0f) continue;
      square += static_cast<double>(water.height_m[i]) * water.height_m[i];
      ++near;
    }
    ASSERT_GT(near, 1000);
    EXPECT_GT(4.0 * std::sqrt(square / near), 2.0) << "significant height of a gale";
  }
}

}  // namespace
}  // namespace swell::render
