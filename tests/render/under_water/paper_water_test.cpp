// Water as the base paper draws it: ripples from a looping sequence, distorted lookups, projected
// glitter. Source: Ma, Zhu, Gong, 2006.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <vector>

#include "math/simd_target.h"
#include "ocean/water_surface.h"
#include "render/drawn_water.h"
#include "render/measures.h"
#include "sky/sky_light.h"
#include "terrain/height_grid.h"
#include "texture/image/image_io.h"

namespace swell::render {
namespace {

constexpr double kPaperEye_m = 4.0;

// ---- The sequence

// Nothing moves but ripples.
scene::Scene sea_of_ripples(double loop_s) {
  scene::Scene scene = shading_scene(kPaperEye_m);
  scene.sea.spectrum = false;
  scene.sky.cloud_cover = 0.0;
  scene.ripples.kind = scene::RippleKind::kSequence;
  scene.ripples.loop_s = loop_s;
  scene.ripples.frames = 12;
  return scene;
}

TEST(RippleSequence, LoopsBitForBit) {
  for (const double loop_s : {3.7, 4.0}) {
    const World world = world_of(sea_of_ripples(loop_s));
    const DrawnWater first(world, 0.3);
    DrawnWater again;
    for (const double loops : {1.0, 2.0, -1.0, 1000.0}) {
      again.draw_small(world, 0.3 + loops * loop_s);
      EXPECT_EQ(again.target.rgba, first.target.rgba) << loop_s << " " << loops;
    }
    again.draw_small(world, 0.3 + 0.4 * loop_s);
    EXPECT_NE(again.target.rgba, first.target.rgba) << loop_s;
  }
}

// Ten loops of 4 s or so fit into 41 s.
TEST(RippleSequence, FitsIntoTheLoopOfTheSea) {
  scene::Scene scene = sea_of_ripples(4.0);
  scene.sea.loop_s = 41.0;
  EXPECT_EQ(ripple_loop_part(scene, 0.0), 0.0);
  EXPECT_NEAR(ripple_loop_part(scene, 4.1 + 1.0), 1.0 / 4.1, 1e-5);
  EXPECT_EQ(ripple_loop_part(scene, 12.5 + 41.0), ripple_loop_part(scene, 12.5));
  scene.sea.loop_s = 1.0;
  EXPECT_NEAR(ripple_loop_part(scene, 0.25), 0.25, 1e-5);
}

// Slope variance of the ripples, both axes together.
double ripple_variance(const scene::Scene& scene) {
  const World world = world_of(scene);
  const DrawnWater drawn(world, 1.02);  // between two frames
  const Water& water = drawn.water();
  double variance = 0.0;
  for (int i = water.first_ripples; i < water.layer_count; ++i) {
    const SlopeLayer& layer = water.layers[static_cast<std::size_t>(i)];
    variance += static_cast<double>(layer.map->lost_variance.back()) * layer.gain * layer.gain;
  }
  return variance;
}

TEST(RippleSequence, IsAsRoughAsTheLayers) {
  scene::Scene scene = shading_scene(kPaperEye_m);
  const double layers = ripple_variance(scene);
  scene.ripples.kind = scene::RippleKind::kSequence;
  EXPECT_NEAR(ripple_variance(scene), layers, 0.06 * layers);
}

// ---- Pictures

constexpr double kGlitterEye_m = 20.0;

// Black water under a sky of one colour. A wall behind the sun's path throws its shadow on all that
// is seen before it.
scene::Scene glitter_scene(double wind_mps, double elevation_deg, double azimuth_deg) {
  scene::Scene scene;
  scene.round_earth = false;
  scene.detail.triangulation = scene::Triangulation::kPlane;
  scene.sea.wind_speed_mps = wind_mps;
  scene.sea.wind_from_rad = radians(azimuth_deg + 45.0);
  scene.sea.whitecaps = 0.0;
  scene.sky.sun_azimuth_rad = radians(azimuth_deg);
  scene.sky.sun_elevation_rad = radians(elevation_deg);
  scene.sky.sun_direction =
      sky::sun_direction(scene.sky.sun_azimuth_rad, scene.sky.sun_elevation_rad);
  scene.sky.zenith = scene.sky.horizon = glm::vec3(0.1f);
  scene.sky.sun_radiance = glm::vec3(1.0f);
  scene.sky.cloud_cover = 0.0;
  scene.water.body_colour = glm::vec3(0.0f);
  const double far_m = 10.0 + 3.0 * kGlitterEye_m / std::tan(scene.sky.sun_elevation_rad);
  scene.objects = {{.kind = scene::ObjectKind::kBox,
                    .position_m = far_m * glm::dvec2(std::sin(scene.sky.sun_azimuth_rad),
                                                     std::cos(scene.sky.sun_azimuth_rad)),
                    .size_m = {500.0, 10.0, 500.0},
                    .heading_rad = scene.sky.sun_azimuth_rad,
                    .draught = 0.5}};
  return scene;
}

constexpr glm::ivec2 kSize_px(200, 160);

std::vector<float> green_without_air(const World& world, const View& view, double t_s,
                                     PartSet without) {
  without.add({Part::kHaze, Part::kHulls, Part::kReflection});
  return green_light(Shot(world, view, t_s, {.keep_linear = true, .without = without}).target);
}

// What the wall takes away: its sum and its middle, in pixels from the left and the top.
struct DrawnGlitter {
  double light = 0.0;
  glm::dvec2 middle_px{0.0};
};
DrawnGlitter draw_glitter(const scene::Scene& scene, const View& view, int times) {
  const World world = world_of(scene);
  DrawnGlitter glitter;
  for (int n = 0; n < times; ++n) {
    const std::vector<float> lit = green_without_air(world, view, 3.0 * n, {Part::kShadows});
    const std::vector<float> dark = green_without_air(world, view, 3.0 * n, {});
    for (int y = 0; y < kSize_px.y; ++y)
      for (int x = 0; x < kSize_px.x; ++x) {
        const auto i = static_cast<std::size_t>(y * kSize_px.x + x);
        const auto light = static_cast<double>(lit[i] - dark[i]);
        glitter.light += light;
        glitter.middle_px += light * glm::dvec2(x + 0.5, y + 0.5);
      }
  }
  glitter.middle_px /= glitter.light;
  return glitter;
}

// Where a pinhole camera of this heading and pitch shows the sun's mirror direction.
glm::dvec2 mirrored_sun_px(glm::dvec2 heading_pitch_deg, glm::dvec2 sun_deg, double fov_deg) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  const double turn = (sun_deg.x - heading_pitch_deg.x) * kDegree;
  const double down = sun_deg.y * kDegree, pitch = heading_pitch_deg.y * kDegree;
  const double right = std::cos(down) * std::sin(turn), level = std::cos(down) * std::cos(turn);
  const double ahead = level * std::cos(pitch) - std::sin(down) * std::sin(pitch);
  const double up = -std::sin(down) * std::cos(pitch) - level * std::sin(pitch);
  const double per_tan = 0.5 * kSize_px.y / std::tan(0.5 * fov_deg * kDegree);
  return {0.5 * kSize_px.x + per_tan * right / ahead, 0.5 * kSize_px.y - per_tan * up / ahead};
}

View view_to(glm::dvec2 heading_pitch_deg, double fov_deg) {
  return make_view({0.0, 0.0, kGlitterEye_m}, radians(heading_pitch_deg.x),
                   radians(heading_pitch_deg.y), radians(fov_deg), 0.25f, kSize_px.x, kSize_px.y);
}

TEST(ProjectedGlitter, StandsWhereFlatWaterMirrorsTheSun) {
  for (const glm::dvec2& sun_deg :
       std::vector<glm::dvec2>{{10.0, 12.0}, {130.0, 35.0}, {250.0, 60.0}, {0.0, 80.0}})
    for (const double off_deg : {0.0, 9.0}) {
      scene::Scene scene = glitter_scene(0.0, sun_deg.y, sun_deg.x);
      scene.water.glitter = scene::Glitter::kProjective;
      const glm::dvec2 to(sun_deg.x + off_deg, -sun_deg.y + 0.5 * off_deg);
      const glm::dvec2 middle = draw_glitter(scene, view_to(to, 40.0), 1).middle_px;
      const glm::dvec2 mirrored = mirrored_sun_px(to, sun_deg, 40.0);
      EXPECT_LT(glm::distance(middle, mirrored), 0.5)
          << sun_deg.x << " " << sun_deg.y << " " << off_deg << ": " << middle.x << " " << middle.y
          << ", " << mirrored.x << " " << mirrored.y;
    }
}

TEST(ProjectedGlitter, HasItsMiddleWhereThatOfSlopesHasIt) {
  for (const double elevation_deg : {35.0, 50.0, 65.0}) {
    scene::Scene scene = glitter_scene(1.0, elevation_deg, 40.0);
    const View view = view_to({40.0, -elevation_deg}, 60.0);
    const glm::dvec2 slopes = draw_glitter(scene, view, 3).middle_px;
    scene.water.glitter = scene::Glitter::kProjective;
    const glm::dvec2 projected = draw_glitter(scene, view, 3).middle_px;
    EXPECT_LT(glm::distance(slopes, projected), 0.02 * kSize_px.y)
        << elevation_deg << ": " << slopes.x << " " << slopes.y << ", " << projected.x << " "
        << projected.y;
  }
}

// The texture takes as much light to the eye as the statistics of slopes, on glass.
TEST(ProjectedGlitter, OfGlassIsAsBrightAsThatOfSlopes) {
  const View view = view_to({40.0, -50.0}, 10.0);
  scene::Scene scene = glitter_scene(0.0, 50.0, 40.0);
  const double slopes = draw_glitter(scene, view, 1).light;
  scene.water.glitter = scene::Glitter::kProjective;
  EXPECT_NEAR(draw_glitter(scene, view, 1).light, slopes, 0.05 * slopes);
}

// ---- Switches

scene::Scene with_all() {
  scene::Scene scene = glitter_scene(4.0, 30.0, 10.0);
  scene.objects.clear();
  scene.terrain.emplace();
  scene.terrain->island_radius_m = 180.0;
  scene.terrain->floor_depth_m = 14.0;
  scene.terrain->seed = 3;
  scene.water.body_colour = {0.01f, 0.05f, 0.06f};
  scene.water.glitter = scene::Glitter::kProjective;
  scene.water.caustic_distortion = 1.0;
  scene.water.distortion_factor = scene::DistortionFactor::kPaper;
  scene.ripples.kind = scene::RippleKind::kSequence;
  scene.ripples.lighting = scene::RippleLighting::kPaper;
  scene.ripples.frames = 8;
  return scene;
}

View small_view() { return make_view({-15.0, -225.0, 2.2}, 0.05, -0.66, 0.96, 0.25f, 96, 64); }

std::uint64_t hash_of(const World& world, const FrameOptions& options, int threads = 2) {
  return picture_hash(Shot(world, small_view(), 2.3, options, threads).target);
}

TEST(PaperWater, IsTheSamePictureHoweverItIsDrawn) {
  const World world = world_of(with_all());
  const std::uint64_t expected = hash_of(world, {}, 1);
  for (const int tile : {16, 32})
    EXPECT_EQ(hash_of(world, {.tile_size_px = tile}, 3), expected) << tile;
  if (!simd_target_available(SimdTarget::kAvx512)) return;
  select_simd_target(simd_targets().front());
  EXPECT_EQ(hash_of(world, {}), expected);
  select_simd_target(SimdTarget::kAvx512);
}

TEST(PaperWater, PartsCanBeLeftOut) {
  const World world = world_of(with_all());
  const std::uint64_t whole = hash_of(world, {});
  for (const Part part : {Part::kSequence, Part::kSunTexture, Part::kCausticBend})
    EXPECT_NE(hash_of(world, {.without = {part}}), whole) << part_name(part);
  scene::Scene plain = with_all();
  plain.ripples = {};
  plain.water.glitter = scene::Glitter::kSlopes;
  plain.water.caustic_distortion = 0.0;
  EXPECT_EQ(hash_of(world, {.without = {Part::kSequence, Part::kSunTexture, Part::kCausticBend}}),
            hash_of(World(plain, world, 1), {}));
}

}  // namespace
}  // namespace swell::render
