// The clouds of scenes: cover, parallax, flights, bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/elementary.h"
#include "math/simd_target.h"
#include "render/cloud_kernels.h"
#include "render/frame.h"
#include "render/world/cloud_shadow.h"
#include "render/world/world_state.h"
#include "scene/sky.h"

namespace swell::render {
namespace {

constexpr float kPixelAngle = 0.001f;

scene::Scene cloudy_scene() {
  scene::Scene scene;
  scene.sea.spectrum = false;
  scene.sea.wind_speed_mps = 6.0;
  scene.sky.cloud_cover = 0.0;
  scene.sky.sun_elevation_rad = scene::radians(45.0);
  scene.sky.sun_direction =
      scene::sun_direction(scene.sky.sun_azimuth_rad, scene.sky.sun_elevation_rad);
  scene.clouds.kind = scene::CloudKind::kLayer;
  return scene;
}

scene::Scene placed_scene(glm::dvec2 position_m) {
  scene::Scene scene = cloudy_scene();
  scene.clouds.kind = scene::CloudKind::kPlaced;
  scene.clouds.cumulus = {{.position_m = position_m, .width_m = 1600.0, .height_m = 1200.0}};
  scene.clouds.wind_factor = 0.0;
  return scene;
}

VolumeClouds clouds_at(const World& world, glm::dvec3 eye, double t_s = 0.0) {
  return make_volume_clouds(world.state(), t_s, eye, kPixelAngle, {});
}

std::vector<RaySeen> see(const VolumeClouds& clouds, const std::vector<glm::vec3>& directions,
                         float farthest_m = kFarthestCloud_m) {
  std::vector<RaySeen> seen(directions.size());
  see_clouds(clouds, directions, farthest_m, seen);
  return seen;
}

std::vector<glm::vec3> sky_directions(int side) {
  std::vector<glm::vec3> directions;
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i)
      directions.push_back(glm::normalize(
          glm::vec3(2.0f * static_cast<float>(i) / static_cast<float>(side) - 1.0f,
                    2.0f * static_cast<float>(j) / static_cast<float>(side) - 1.0f, 0.25f)));
  return directions;
}

// CLD-01
TEST(VolumeClouds, CoverAsMuchOfThePlaneAsAsked) {
  for (const double cover : {0.1, 0.3, 0.5, 0.7}) {
    scene::Scene scene = cloudy_scene();
    scene.clouds.cover = cover;
    const World world(scene, 2);
    constexpr int kSide = 48;
    int covered = 0;
    for (int j = 0; j < kSide; ++j)
      for (int i = 0; i < kSide; ++i) {
        const double step_m = 8.0 * scene.clouds.size_m / kSide;
        const auto seen = see(clouds_at(world, {i * step_m, j * step_m, 0.0}), {{0, 0, 1}});
        covered += seen[0].opacity > 0.5f;
      }
    EXPECT_NEAR(covered / static_cast<double>(kSide * kSide), cover, 0.02) << cover;
  }
}

// CLD-08
TEST(VolumeClouds, SkipWhatIsEmptyAndNothingElse) {
  const World world(cloudy_scene(), 2);
  for (const glm::dvec3& eye : {glm::dvec3(0, 0, 2), {500, 900, 1500}, {0, 0, 4000}}) {
    VolumeClouds clouds = clouds_at(world, eye);
    std::vector<glm::vec3> directions = sky_directions(40);
    if (eye.z > 3000.0)
      for (glm::vec3& d : directions) d.z = -d.z;
    const std::vector<RaySeen> skipping = see(clouds, directions);
    clouds.skips_empty = false;
    EXPECT_TRUE(skipping == see(clouds, directions)) << eye.z;
  }
}

// CLD-07
TEST(VolumeClouds, HideAsMuchFromEitherSide) {
  scene::Scene scene = placed_scene({0.0, 0.0});
  scene.clouds.extinction_per_m = 0.002;
  const World world(scene, 2);
  const double z_m = 1300.0;
  for (const double y_m : {-300.0, 0.0, 555.0}) {
    VolumeClouds from_west = clouds_at(world, {-2500.0, y_m, z_m});
    VolumeClouds from_east = clouds_at(world, {2500.0, y_m, z_m});
    from_west.drop_per_m2 = from_east.drop_per_m2 = 0.0f;
    from_west.steps.step_m = from_east.steps.step_m = 1.0f;
    const float there = see(from_west, {{1, 0, 0}}, 5000.0f)[0].opacity;
    const float back = see(from_east, {{-1, 0, 0}}, 5000.0f)[0].opacity;
    EXPECT_GT(there, 0.1f);
    EXPECT_NEAR(there, back, 1e-3f);
  }
}

TEST(VolumeClouds, HalfTheStepShowsTheSame) {
  const World world(cloudy_scene(), 2);
  VolumeClouds clouds = clouds_at(world, {0, 0, 2});
  EXPECT_LE(clouds.steps.step_m * clouds.volume->extinction_per_m, 0.5f);
  const std::vector<glm::vec3> directions = sky_directions(80);
  const std::vector<RaySeen> whole = see(clouds, directions);
  clouds.steps.step_m *= 0.5f;
  const std::vector<RaySeen> half = see(clouds, directions);
  double square = 0.0, light_square = 0.0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    square += std::pow(double{whole[i].opacity} - double{half[i].opacity}, 2);
    light_square += std::pow(double{whole[i].sky} - double{half[i].sky}, 2);
  }
  EXPECT_LT(std::sqrt(square / static_cast<double>(whole.size())), 0.01);
  EXPECT_LT(std::sqrt(light_square / static_cast<double>(whole.size())), 0.01);
}

// The middle of a cloud lies where the lines of sight from two places cross.
TEST(VolumeClouds, StandInSpace) {
  const glm::dvec2 place(400.0, 3000.0);
  const World world(placed_scene(place), 2);
  const auto bearing = [&](double x_m) {
    double sum = 0.0, weight = 0.0;
    std::vector<glm::vec3> directions;
    for (int j = 0; j < 60; ++j)
      for (int i = -120; i <= 120; ++i)
        directions.push_back(glm::normalize(
            glm::vec3(0.01f * static_cast<float>(i), 1.0f, 0.25f + 0.01f * static_cast<float>(j))));
    const auto seen = see(clouds_at(world, {x_m, 0.0, 2.0}), directions);
    for (std::size_t i = 0; i < seen.size(); ++i) {
      sum += double{seen[i].opacity} * double{directions[i].x / directions[i].y};
      weight += double{seen[i].opacity};
    }
    EXPECT_GT(weight, 100.0);
    return sum / weight;
  };
  // x = x0 + y tan(bearing), from both.
  const double left = bearing(-500.0), right = bearing(1300.0);
  const double y_m = 1800.0 / (left - right), x_m = -500.0 + y_m * left;
  EXPECT_NEAR(y_m, place.y, 250.0);
  EXPECT_NEAR(x_m, place.x, 150.0);
}

TEST(VolumeClouds, DriftWithTheWindAndNothingElse) {
  const World world(cloudy_scene(), 2);
  const double t_s = 500.0;
  const glm::dvec2 drift = volume_drift_m(world.scene(), 1.0, t_s);
  EXPECT_NEAR(glm::length(drift), 1.2 * 6.0 * t_s, 1e-6);
  scene::Scene still = cloudy_scene();
  still.clouds.change_mps = 0.0;
  const World unchanging(still, 2);
  const auto directions = sky_directions(20);
  const auto before = see(clouds_at(unchanging, {0, 0, 2}), directions);
  const auto after = see(clouds_at(unchanging, {drift, 2.0}, t_s), directions);
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_NEAR(before[i].opacity, after[i].opacity, 0.02f);
}

// CLD-07, and the flight through a cloud.
TEST(VolumeClouds, AreEnteredAndLeftWithoutAJump) {
  const World world(placed_scene({0.0, 0.0}), 2);
  const std::vector<glm::vec3> directions = {glm::normalize(glm::vec3(1.0f, 0.1f, 0.05f)),
                                             glm::normalize(glm::vec3(1.0f, -0.4f, -0.2f)),
                                             glm::normalize(glm::vec3(0.2f, 1.0f, 0.3f))};
  std::vector<RaySeen> before;
  float most = 0.0f, opaque = 0.0f;
  for (int n = 0; n < 300; ++n) {
    const double x_m = -1500.0 + 10.0 * n;
    const auto seen = see(clouds_at(world, {x_m, 30.0, 1200.0}), directions);
    const auto nudged = see(clouds_at(world, {x_m + 0.001, 30.0, 1200.0}), directions);
    for (std::size_t i = 0; i < seen.size(); ++i) {
      EXPECT_LT(std::abs(seen[i].opacity - nudged[i].opacity), 1.0f / 255.0f) << x_m;
      EXPECT_LT(std::abs(seen[i].sky - nudged[i].sky), 1.0f / 255.0f) << x_m;
      if (!before.empty()) most = std::max(most, std::abs(seen[i].sky - before[i].sky));
      opaque = std::max(opaque, seen[i].opacity);
    }
    before = seen;
  }
  EXPECT_EQ(opaque, 1.0f);
  EXPECT_LT(most, 0.25f);
}

struct DrawnClouds {
  std::uint64_t hash;
  std::vector<float> linear;
};

DrawnClouds draw(const World& world, glm::dvec3 eye, double pitch_rad, const FrameOptions& options,
                 int threads, Workspace& workspace, double t_s = 3.0) {
  Workers workers(threads);
  scene::Camera camera;
  camera.eye_m = eye;
  camera.pitch_rad = pitch_rad;
  Target target;
  render_frame(world, scene::camera_view(camera, 0.0, 150, 90), t_s, options, workspace, target,
               workers);
  return {picture_hash(target), target.linear};
}

// At the edge of a cloud a picture changes much over a few metres, but never at once: the largest
// change of a flight falls as its frames come closer.
TEST(VolumeClouds, AreFlownThroughWithoutAJump) {
  const World world(placed_scene({0.0, 0.0}), 2);
  Workers workers(2);
  Workspace workspace;
  FrameOptions options;
  options.water_triangles = 200;
  options.lookup_scale = 0.05;
  struct Change {
    double y_m = 0.0, value = 0.0;
  };
  const auto largest_change = [&](double from_m, double step_m, int frames) {
    Change largest;
    Target target;
    std::vector<std::uint32_t> before;
    for (int n = 0; n <= frames; ++n) {
      scene::Camera camera;
      camera.eye_m = {30.0, from_m + step_m * n, 1250.0};
      render_frame(world, scene::camera_view(camera, 0.0, 48, 28), 3.0, options, workspace, target,
                   workers);
      double sum = 0.0;
      for (std::size_t i = 0; i < before.size(); ++i)
        for (int c = 0; c < 3; ++c)
          sum += std::abs(static_cast<double>(target.rgba[i] >> (8 * c) & 255) -
                          static_cast<double>(before[i] >> (8 * c) & 255));
      const double change = sum / (3.0 * static_cast<double>(target.rgba.size()));
      if (change > largest.value) largest = {camera.eye_m.y - step_m, change};
      before = target.rgba;
    }
    return largest;
  };
  const Change flight = largest_change(-1500.0, 20.0, 120);
  EXPECT_GT(flight.value, 5.0);
  EXPECT_LT(largest_change(flight.y_m, 1.0, 20).value, 0.15 * flight.value);
}

TEST(VolumeClouds, AreTheSameBitsOverThreadsTilesTargetsAndFramesBefore) {
  const World world(cloudy_scene(), 2);
  FrameOptions options;
  options.water_triangles = 2000;
  options.edge_samples = 4;
  for (const glm::dvec3& eye : {glm::dvec3(0, 0, 2), {0, 0, 1400}, {0, 0, 4000}}) {
    const double pitch = eye.z > 3000.0 ? -0.3 : 0.2;
    Workspace used;
    const auto reference = draw(world, eye, pitch, options, 1, used).hash;
    draw(world, {900.0, 100.0, 1700.0}, 0.0, options, 2, used, 77.0);
    EXPECT_EQ(draw(world, eye, pitch, options, 3, used).hash, reference);
    FrameOptions small = options;
    small.tile_size_px = 16;
    select_simd_target(SimdTarget::kAvx2);
    Workspace fresh;
    EXPECT_EQ(draw(world, eye, pitch, small, 2, fresh).hash, reference);
    if (simd_target_available(SimdTarget::kAvx512)) select_simd_target(SimdTarget::kAvx512);
  }
}

// CLD-04: the nodes' lattice is not seen.
TEST(VolumeClouds, ShowNoPatternOfFourPixels) {
  const World world(cloudy_scene(), 2);
  Workers workers(2);
  Workspace workspace;
  Target target;
  scene::Camera camera;
  camera.eye_m = {0.0, 0.0, 2.0};
  camera.pitch_rad = 0.6;
  constexpr int kWidth = 256, kHeight = 144;
  render_frame(world, scene::camera_view(camera, 0.0, kWidth, kHeight), 3.0, {}, workspace, target,
               workers);
  // The Fourier coefficient of one period in four pixels, of the picture under a smooth window.
  const auto peak = [&](int across, int down) {
    double re = 0.0, im = 0.0, sum = 0.0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const double window = std::pow(std::sin(kPi * (x + 0.5) / kWidth), 2) *
                              std::pow(std::sin(kPi * (y + 0.5) / kHeight), 2);
        const double phase = 0.5 * kPi * (across * x + down * y);
        const double green =
            static_cast<double>(target.rgba[static_cast<std::size_t>(y * kWidth + x)] >> 8 & 255);
        re += window * green * std::cos(phase), im += window * green * std::sin(phase);
        sum += window;
      }
    return 2.0 * std::hypot(re, im) / sum;
  };
  EXPECT_LT(peak(1, 0), 1.0);
  EXPECT_LT(peak(0, 1), 1.0);
  EXPECT_LT(peak(1, 1), 1.0);
}

// CLD-03
TEST(VolumeClouds, AreLitByTheVolumeAsBySecondRays) {
  scene::Scene scene = cloudy_scene();
  const World by_volume(scene, 2);
  scene.clouds.rays = scene::CloudRays::kRays;
  const World by_rays(scene, by_volume, 2);
  const auto picture = [&](const World& world) {
    Workers workers(2);
    Workspace workspace;
    Target target;
    scene::Camera camera;
    camera.eye_m = {0, 0, 2};
    camera.pitch_rad = 0.3;
    render_frame(world, scene::camera_view(camera, 0.0, 160, 90), 0.0, {}, workspace, target,
                 workers);
    return target.rgba;
  };
  const auto a = picture(by_volume), b = picture(by_rays);
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int c = 0; c < 3; ++c)
      sum += std::abs(static_cast<double>(a[i] >> (8 * c) & 255) -
                      static_cast<double>(b[i] >> (8 * c) & 255));
  EXPECT_LT(sum / (3.0 * static_cast<double>(a.size())), 3.0);
  EXPECT_NE(a, b);
}

TEST(VolumeClouds, CanBeLeftOut) {
  scene::Scene scene = cloudy_scene();
  const World world(scene, 2);
  scene.clouds.kind = scene::CloudKind::kNone;
  const World clear(scene, world, 2);
  FrameOptions options;
  options.without = {Part::kVolumeClouds, Part::kCloudShadows};
  Workspace workspace;
  const auto with = draw(world, {0, 0, 2}, 0.2, {}, 2, workspace).hash;
  const auto without = draw(world, {0, 0, 2}, 0.2, options, 2, workspace).hash;
  EXPECT_NE(with, without);
  EXPECT_EQ(draw(clear, {0, 0, 2}, 0.2, {}, 2, workspace).hash, without);
}

// Under a cloud the sun's image in the water goes out; beside it, it stays.
TEST(CloudShadows, TakeTheGlitterFromTheWater) {
  scene::Scene scene = placed_scene({0.0, 0.0});
  scene.sea.spectrum = true;
  scene.sky.sun_azimuth_rad = 0.0;
  scene.sky.sun_elevation_rad = scene::radians(50.0);
  scene.sky.sun_direction = scene::sun_direction(0.0, scene.sky.sun_elevation_rad);
  scene.clouds.cumulus[0].width_m = 3000.0;
  const World world(scene, 2);
  FrameOptions options;
  options.keep_linear = true;
  options.water_triangles = 4000;
  FrameOptions lit = options;
  lit.without.add(Part::kCloudShadows);
  // The shadow lies as far from under the cloud as the sun slants over the height of its base.
  const double under_y = -900.0 / std::tan(scene::radians(50.0));
  const auto glitter = [&](double y_m, const FrameOptions& o) {
    Workspace workspace;
    const auto picture = draw(world, {0.0, y_m - 10.0, 8.0}, -0.6, o, 2, workspace);
    double sum = 0.0;
    for (const float v : picture.linear) sum += double{v};
    return sum;
  };
  EXPECT_LT(glitter(under_y, options), 0.6 * glitter(under_y, lit));
  EXPECT_NEAR(glitter(under_y - 6000.0, options), glitter(under_y - 6000.0, lit),
              0.02 * glitter(under_y - 6000.0, lit));
}

// The texels of a level stand still in the world.
TEST(CloudShadows, DoNotCrawlWithTheCamera) {
  scene::Scene scene = cloudy_scene();
  scene.sky.cloud_cover = 0.4;
  const World world(scene, 2);
  Workers workers(2);
  Workspace workspace;
  const auto shadow_at = [&](glm::dvec3 eye) {
    CloudShadow shadow;
    Profile profile;
    profile.begin_frame(false);
    const StageRun run{workers, profile, Stage::kSea};
    const Clouds deck = make_clouds(world.state(), 0.0, eye, {});
    advance_cloud_shadow(world.state(), deck, clouds_at(world, eye), eye, {}, shadow, run);
    return shadow;
  };
  const CloudShadow a = shadow_at({10.0, 10.0, 0.0});
  const double moved_m = 3.0 * 48.0;
  const CloudShadow b = shadow_at({10.0 + moved_m, 10.0, 0.0});
  int most = 0, darkest = 255, lightest = 0;
  for (int y = 0; y < CloudShadow::kSide; ++y)
    for (int x = 3; x < CloudShadow::kSide; ++x) {
      const int here = static_cast<int>(a.words[0][static_cast<std::size_t>(y * 128 + x)] & 255);
      const int there =
          static_cast<int>(b.words[0][static_cast<std::size_t>(y * 128 + x - 3)] & 255);
      most = std::max(most, std::abs(here - there));
      darkest = std::min(darkest, here), lightest = std::max(lightest, here);
    }
  EXPECT_LE(most, 1);
  EXPECT_LT(darkest, 60);
  EXPECT_GT(lightest, 150);
}

TEST(CloudShadows, AreThoseOfTheOldLayerToo) {
  scene::Scene scene = cloudy_scene();
  scene.clouds.kind = scene::CloudKind::kNone;
  scene.sky.cloud_cover = 0.5;
  const World world(scene, 2);
  FrameOptions options;
  Workspace workspace;
  const auto with = draw(world, {0, 0, 100}, -0.3, options, 2, workspace).hash;
  options.without.add(Part::kCloudShadows);
  EXPECT_NE(draw(world, {0, 0, 100}, -0.3, options, 2, workspace).hash, with);
}

}  // namespace
}  // namespace swell::render
