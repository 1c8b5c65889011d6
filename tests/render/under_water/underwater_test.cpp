// What an eye below the surface sees, and one that the surface cuts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "constants.h"
#include "math/random.h"
#include "ocean/water_surface.h"
#include "render/shot.h"
#include "render/world/world_state.h"
#include "scene/scene.h"
#include "terrain/height_grid.h"

namespace swell::render {
namespace {

// A sea of glass under a sky of radiance 1, as clear as a scene may be and black below.
scene::Scene glass_scene() {
  scene::Scene scene;
  scene.sea.wind_speed_mps = 0.0;
  scene.sky.zenith = scene.sky.horizon = glm::vec3(1.0f);
  scene.sky.sun_radiance = glm::vec3(0.0f);
  scene.sky.cloud_cover = 0.0;
  scene.water.body_colour = glm::vec3(0.0f);
  scene.water.absorption_per_m = glm::vec3(0.001f);
  scene.detail.triangulation = scene::Triangulation::kPlane;
  return scene;
}

View view_from(glm::dvec3 eye_m, double pitch_rad, double fov_y_rad, int width_px, int height_px) {
  const scene::Camera camera = {.eye_m = eye_m, .pitch_rad = pitch_rad, .fov_y_rad = fov_y_rad};
  return scene::camera_view(camera, 0.0, width_px, height_px);
}

struct Drawing : Shot {
  explicit Drawing(int threads = 2) : Shot(threads) {}
  Drawing(const World& world, const View& seen, const FrameOptions& options = {}) {
    draw(world, seen, options);
  }

  void draw(const World& world, const View& seen, FrameOptions options = {}, double t_s = 3.0) {
    options.keep_linear = true;
    if (options.water_triangles == 0) options.water_triangles = options.terrain_triangles = 1500;
    Shot::draw(world, seen, t_s, options);
  }

  float green(int x, int y) const { return linear(x, y).y; }
  bool in_water(int x, int y) const { return (target.labels.flags[at(x, y)] & kSeenInWater) != 0; }
};

// Radius of Snell's window on a flat surface, over the depth: 1 / sqrt(n^2 - 1).
TEST(UnderWater, SnellsWindowIsACircleOfItsRadius) {
  constexpr int kSize = 256;
  const World world = world_of(glass_scene());
  Drawing drawing;
  for (const double depth_m : {0.7, 5.0, 40.0}) {
    drawing.draw(world, view_from({3.0, 4.0, -depth_m}, 0.5 * kPiRef, 2.0, kSize, kSize));
    const double radius_px = 1.134542 * 0.5 * kSize / std::tan(1.0);
    int lit = 0;
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        const double r = std::hypot(x + 0.5 - 0.5 * kSize, y + 0.5 - 0.5 * kSize);
        const float light = drawing.green(x, y);
        lit += light > 0.2f;
        if (r < radius_px - 1.5) {
          ASSERT_GT(light, 0.3f) << x << ' ' << y;
        } else if (r > radius_px + 1.5) {
          ASSERT_LT(light, 0.004f) << x << ' ' << y;
        }
      }
    EXPECT_NEAR(std::sqrt(lit / kPiRef), radius_px, 1.0) << depth_m;
  }
}

// At each pixel the light of the sky that Fresnel lets through, which is that of the ray in air.
TEST(UnderWater, TheWindowIsAsBrightAsFresnelSays) {
  constexpr int kSize = 128;
  const World world = world_of(glass_scene());
  const Drawing drawing(world, view_from({0.0, 0.0, -2.0}, 0.5 * kPiRef, 1.8, kSize, kSize));
  constexpr double kN = 1.333;
  for (const int x : {64, 70, 80, 95, 105, 110}) {
    const double tan_water = (x + 0.5 - 64.0) / 64.0 * std::tan(0.9);
    const double water = std::atan(std::hypot(tan_water, 0.5 / 64.0 * std::tan(0.9)));
    if (kN * std::sin(water) >= 0.995) continue;
    const double air = std::asin(kN * std::sin(water));
    const double s = std::sin(air - water) / std::sin(air + water);
    const double p = std::tan(air - water) / std::tan(air + water);
    const double passes = 1.0 - 0.5 * (s * s + p * p);
    const double clear = std::exp(-0.001 * 2.0 / std::cos(water));
    EXPECT_NEAR(drawing.green(x, 64), passes * clear, 0.012) << x;
  }
}

// Around the window the surface is a whole mirror: of the water's light, here the only one.
TEST(UnderWater, NoSeamLiesBetweenFarWaterAndNone) {
  scene::Scene scene = glass_scene();
  scene.water.body_colour = glm::vec3(0.05f);
  scene.water.absorption_per_m = glm::vec3(0.1f);
  scene.detail.triangulation = scene::Triangulation::kRoam;
  const World world = world_of(scene);
  const Drawing drawing(world, view_from({0.0, 0.0, -5.0}, 0.0, 0.6, 64, 128));
  for (int y = 1; y < 128; ++y) {
    ASSERT_GT(drawing.green(32, y), 0.0f);
    EXPECT_NEAR(drawing.green(32, y) / drawing.green(32, y - 1), 1.0f, 0.03f) << y;
  }
}

scene::Scene wavy_scene(double amplitude_m) {
  scene::Scene scene;
  scene.sea.resolution = 32;
  scene.sea.wind_speed_mps = 6.0;
  scene.sea.amplitude_scale = amplitude_m;
  scene.detail.water_triangles = 3000;
  scene.terrain.emplace();
  scene.terrain->floor_depth_m = 12.0;
  scene.terrain->island_height_m = 0.0;
  return scene;
}

// From 2 m above to 4 m below.
TEST(UnderWater, AnEyeThatDivesSeesSomethingAllTheWay) {
  for (const double waves : {0.05, 0.5, 2.0}) {
    const World world = world_of(wavy_scene(waves));
    Drawing drawing;
    double before = 0.0;
    for (int i = 0; i < 60; ++i) {
      const double z = 2.0 - 6.0 * i / 59.0;
      drawing.draw(world, view_from({0.0, -600.0, z}, 0.1, 1.0, 48, 27), {}, 10.0 + 0.02 * i);
      const std::vector<float>& linear = drawing.target.linear;
      double sum = 0.0;
      float least = 1e9f;
      for (const float light : linear) {
        ASSERT_TRUE(std::isfinite(light) && light >= 0.0f) << z;
        sum += std::min(static_cast<double>(light), 1.0);
      }
      for (std::size_t k = 2; k < linear.size(); k += 3) least = std::min(least, linear[k]);
      EXPECT_GT(least, 1e-4f) << waves << ' ' << z;
      const double mean = sum / static_cast<double>(linear.size());
      EXPECT_GT(mean, 0.01) << waves << ' ' << z;
      if (i == 0) before = mean;
      // The near plane is as high as less than three steps of the eye.
      EXPECT_LT(std::abs(mean - before), 0.4) << waves << ' ' << z;
      before = mean;
    }
  }
}

TEST(UnderWater, IsDrawnWithoutPlanarMaps) {
  const World world = world_of(wavy_scene(0.5));
  Drawing drawing;
  for (const PartSet without : {PartSet{Part::kReflection}, PartSet{Part::kRefraction},
                                PartSet{Part::kReflection, Part::kRefraction}}) {
    drawing.draw(world, view_from({0.0, -600.0, -3.0}, 0.4, 1.0, 64, 36), {.without = without});
    for (const float light : drawing.target.linear)
      ASSERT_TRUE(std::isfinite(light) && light >= 0.0f);
  }
}

// ---- The eye that the surface cuts

FrameOptions with_flags() {
  FrameOptions options;
  options.labels.add(Label::kFlags);
  return options;
}

// The near plane's lower half is under a flat surface at the eye's height.
TEST(UnderWater, AFlatSurfaceCutsThePictureInHalves) {
  const World world = world_of(glass_scene());
  const Drawing drawing(world, view_from({0.0, 0.0, 0.0}, 0.0, 1.0, 100, 60), with_flags());
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 100; ++x) ASSERT_EQ(drawing.in_water(x, y), y >= 30) << x << ' ' << y;
}

// What begins in water is told by the drawn surface, which is a little off the water where that is
// bent: at most as much as that.
TEST(UnderWater, PixelsBeginInWaterWhereAQuerySaysSo) {
  constexpr int kWidth = 128, kHeight = 72;
  scene::Scene scene;
  scene.sea.wind_speed_mps = 8.0;
  const World world = world_of(scene);
  Drawing drawing;
  int checked = 0, crossed = 0;
  for (std::uint64_t i = 0; i < 12; ++i) {
    const glm::dvec2 p(400.0 * random_uniform(3, 3 * i), 400.0 * random_uniform(3, 3 * i + 1));
    // As high as the water is there.
    drawing.draw(world, view_from({p, 3.0}, 0.0, 1.2, 16, 9));
    const ocean::WaterSurface at_first = water_surface(world.state(), *drawing.state().sea);
    const double z = static_cast<double>(at_first.height(p)) + 0.1 * random_uniform(3, 3 * i + 2);
    FrameOptions options = with_flags();
    options.water_triangles = 30000;
    const View view = view_from({p, z}, 0.0, 1.2, kWidth, kHeight);
    drawing.draw(world, view, options);
    const ocean::WaterSurface water = water_surface(world.state(), *drawing.state().sea);
    bool wet = false, dry = false;
    for (int y = 0; y < kHeight; y += 3)
      for (int x = 0; x < kWidth; x += 5) {
        const glm::dvec3 at =
            view.eye_world + glm::dvec3(view.near_m * view.ray(static_cast<float>(x) + 0.5f,
                                                               static_cast<float>(y) + 0.5f));
        const double above_m = at.z - static_cast<double>(water.height(glm::dvec2(at)));
        (drawing.in_water(x, y) ? wet : dry) = true;
        if (std::abs(above_m) < 0.02) continue;
        ++checked;
        EXPECT_EQ(drawing.in_water(x, y), above_m < 0.0) << i << ' ' << above_m;
      }
    crossed += wet && dry;
  }
  EXPECT_GT(checked, 3000);
  EXPECT_GE(crossed, 6);
}

// The contract of all pictures holds for those that are shaded from both sides.
TEST(UnderWater, ACutPictureHasTheSameBitsHoweverItIsDrawn) {
  const World world = world_of(wavy_scene(0.5));
  Drawing drawing(world, view_from({0.0, -600.0, 4.0}, 0.0, 1.0, 16, 9));
  const double z =
      static_cast<double>(water_surface(world.state(), *drawing.state().sea).height({0.0, -600.0}));
  const View view = view_from({0.0, -600.0, z}, 0.05, 1.0, 150, 90);
  FrameOptions options = with_flags();
  options.edge_samples = 4;
  drawing.draw(world, view, options);
  int wet = 0;
  for (int x = 0; x < 150; ++x) wet += drawing.in_water(x, 89);
  EXPECT_GT(wet, 0);
  for (const int tile : {16, 32})
    for (const int threads : {1, 3}) {
      Drawing other(threads);
      options.tile_size_px = tile;
      other.draw(world, view, options);
      EXPECT_EQ(other.target.rgba, drawing.target.rgba) << tile << ' ' << threads;
      EXPECT_EQ(other.target.labels.flags, drawing.target.labels.flags) << tile << ' ' << threads;
    }
}

// A line darker than what is above and below, and only with its part.
TEST(UnderWater, TheMeniscusIsALineThatCanBeLeftOut) {
  const World world = world_of(glass_scene());
  const View view = view_from({0.0, 0.0, 0.0}, 0.0, 1.0, 100, 60);
  const Drawing with(world, view), without(world, view, {.without = {Part::kMeniscus}});
  for (int y = 0; y < 60; ++y) {
    const bool near = y >= 28 && y < 32;
    if (y == 29) {
      EXPECT_LT(with.green(50, y), 0.8f * without.green(50, y));
    } else if (!near) {
      EXPECT_EQ(with.green(50, y), without.green(50, y)) << y;
    }
  }
}

}  // namespace
}  // namespace swell::render
