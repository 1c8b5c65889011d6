// The clouds of scenes: cover, parallax, flights, bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "math/elementary.h"
#include "math/simd_target.h"
#include "render/measures.h"
#include "render/shot.h"
#include "render/sky/cloud_kernels.h"
#include "render/sky/cloud_shadow.h"
#include "render/world/world_state.h"
#include "sky/sky_light.h"

namespace swell::render {
namespace {

constexpr float kPixelAngle = 0.001f;

scene::Scene cloudy_scene() {
  scene::Scene scene;
  scene.sea.spectrum = false;
  scene.sea.wind_speed_mps = 6.0;
  scene.sky.cloud_cover = 0.0;
  scene.sky.sun_elevation_rad = radians(45.0);
  scene.sky.sun_direction =
      sky::sun_direction(scene.sky.sun_azimuth_rad, scene.sky.sun_elevation_rad);
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
    const World world = world_of(scene);
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
  const World world = world_of(cloudy_scene());
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

// Rays that are followed with all lanes at work, in any company.
TEST(VolumeClouds, AreSeenTheSameByRaysInAQueue) {
  const World world = world_of(cloudy_scene());
  for (const glm::dvec3& eye : {glm::dvec3(0, 0, 2), {500, 900, 1500}, {0, 0, 4000}}) {
    const VolumeClouds clouds = clouds_at(world, eye);
    std::vector<glm::vec3> directions = sky_directions(61);
    if (eye.z > 3000.0)
      for (glm::vec3& d : directions) d.z = -d.z;
    const std::vector<RaySeen> alone = see(clouds, directions);
    std::vector<RaySeen> queued = alone;
    for (RaySeen& seen : queued)
      if (seen.opacity > 0.0f) seen = {};
    see_clouds_queued(clouds, directions, kFarthestCloud_m, queued);
    EXPECT_TRUE(queued == alone) << eye.z;
    // In other company.
    std::ranges::reverse(directions);
    directions.pop_back();
    std::vector<RaySeen> turned(directions.size());
    see_clouds_queued(clouds, directions, kFarthestCloud_m, turned);
    for (std::size_t i = 0; i < turned.size(); ++i)
      if (const RaySeen& seen = alone[alone.size() - 1 - i]; seen.opacity > 0.0f) {
        EXPECT_TRUE(turned[i] == seen) << i;
      }
  }
}

// CLD-07
TEST(VolumeClouds, HideAsMuchFromEitherSide) {
  scene::Scene scene = placed_scene({0.0, 0.0});
  scene.clouds.extinction_per_m = 0.002;
  const World world = world_of(scene);
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
  const World world = world_of(cloudy_scene());
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
  const World world = world_of(placed_scene(place));
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
  const World world = world_of(cloudy_scene());
  const double t_s = 500.0;
  const glm::dvec2 drift = volume_drift_m(world.scene(), 1.0, t_s);
  EXPECT_NEAR(glm::length(drift), 1.2 * 6.0 * t_s, 1e-6);
  scene::Scene still = cloudy_scene();
  still.clouds.change_mps = 0.0;
  const World unchanging = world_of(still);
  const auto directions = sky_directions(20);
  const auto before = see(clouds_at(unchanging, {0, 0, 2}), directions);
  const auto after = see(clouds_at(unchanging, {drift, 2.0}, t_s), directions);
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_NEAR(before[i].opacity, after[i].opacity, 0.02f);
}

// CLD-07, and the flight through a cloud.
TEST(VolumeClouds, AreEnteredAndLeftWithoutAJump) {
  const World world = world_of(placed_scene({0.0, 0.0}));
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

View northward(glm::dvec3 eye, double pitch_rad, int width_px = 150, int height_px = 90) {
  return scene::camera_view({.eye_m = eye, .pitch_rad = pitch_rad}, 0.0, width_px, height_px);
}

// At the edge of a cloud a picture changes much over a few metres, but never at once: the largest
// change of a flight falls as its frames come closer.
TEST(VolumeClouds, AreFlownThroughWithoutAJump) {
  const World world = world_of(placed_scene({0.0, 0.0}));
  Shot film;
  struct Change {
    double y_m = 0.0, value = 0.0;
  };
  const auto largest_change = [&](double from_m, double step_m, int frames) {
    Change largest;
    Target before;
    for (int n = 0; n <= frames; ++n) {
      const double y_m = from_m + step_m * n;
      film.draw(world, northward({30.0, y_m, 1250.0}, 0.0, 48, 28), 3.0,
                {.water_triangles = 200, .lookup_scale = 0.05});
      const double change = n == 0 ? 0.0 : mean_difference(before, film.target);
      if (change > largest.value) largest = {y_m - step_m, change};
      before = film.target;
    }
    return largest;
  };
  const Change flight = largest_change(-1500.0, 20.0, 120);
  EXPECT_GT(flight.value, 5.0);
  EXPECT_LT(largest_change(flight.y_m, 1.0, 20).value, 0.15 * flight.value);
}

// From the middle of a cloud, its rim 400 m away or more on all sides: neither sky nor sea is seen,
// nor any structure, and more light comes from where the sun is, and from above.
TEST(VolumeClouds, AroundAnEyeAreEvenLightThatIsBrightestTowardsTheSun) {
  scene::Scene scene = placed_scene({0.0, 0.0});
  scene.sky.sun_azimuth_rad = 0.0;
  scene.sky.sun_elevation_rad = radians(25.0);
  scene.sky.sun_direction =
      sky::sun_direction(scene.sky.sun_azimuth_rad, scene.sky.sun_elevation_rad);
  const World world = world_of(scene);
  const glm::dvec3 eye(0.0, 0.0, scene.clouds.base_m + 550.0);
  for (const RaySeen& seen : see(clouds_at(world, eye), sky_directions(20)))
    EXPECT_EQ(seen.opacity, 1.0f);

  const auto mean_code = [&](double heading_deg, double pitch_deg) {
    const scene::Camera camera{
        .eye_m = eye, .heading_rad = radians(heading_deg), .pitch_rad = radians(pitch_deg)};
    const Shot drawn(world, scene::camera_view(camera, 0.0, 96, 64), 0.0);
    int most_step = 0;
    double sum = 0.0;
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 96; ++x) {
        sum += drawn.codes(x, y).g;
        if (x > 0)
          most_step = std::max(most_step, std::abs(drawn.codes(x, y).g - drawn.codes(x - 1, y).g));
        if (y > 0)
          most_step = std::max(most_step, std::abs(drawn.codes(x, y).g - drawn.codes(x, y - 1).g));
      }
    EXPECT_LE(most_step, 2) << heading_deg << ' ' << pitch_deg;  // a step of light, and the dither
    return sum / (64 * 96);
  };
  const double to_sun = mean_code(0.0, 25.0), away = mean_code(180.0, 0.0);
  const double aside = mean_code(90.0, 0.0), down = mean_code(0.0, -80.0);
  for (const double code : {to_sun, away, aside, down}) {
    EXPECT_GT(code, 100.0);
    EXPECT_LT(code, 250.0);
  }
  EXPECT_GT(to_sun, away + 2.0);
  EXPECT_GT(to_sun, aside + 2.0);
  EXPECT_GT(to_sun, down + 2.0);
}

TEST(VolumeClouds, AreTheSameBitsOverThreadsTilesTargetsAndFramesBefore) {
  const World world = world_of(cloudy_scene());
  const FrameOptions options = {.water_triangles = 2000, .edge_samples = 4};
  const FrameOptions small = {.tile_size_px = 16, .water_triangles = 2000, .edge_samples = 4};
  Workers two(2), three(3);
  for (const glm::dvec3& eye : {glm::dvec3(0, 0, 2), {0, 0, 1400}, {0, 0, 4000}}) {
    const View view = northward(eye, eye.z > 3000.0 ? -0.3 : 0.2);
    const View other = northward({900.0, 100.0, 1700.0}, 0.0);
    Shot used(1);
    const auto reference = picture_hash(used.draw(world, view, 3.0, options));
    render_frame(world, other, 77.0, options, used.workspace, used.target, two);
    render_frame(world, view, 3.0, options, used.workspace, used.target, three);
    EXPECT_EQ(picture_hash(used.target), reference);
    select_simd_target(simd_targets().front());
    EXPECT_EQ(picture_hash(Shot(world, view, 3.0, small).target), reference);
    if (simd_target_available(SimdTarget::kAvx512)) select_simd_target(SimdTarget::kAvx512);
  }
}

// CLD-04: the nodes' lattice is not seen.
TEST(VolumeClouds, ShowNoPatternOfFourPixels) {
  const World world = world_of(cloudy_scene());
  constexpr int kWidth = 256, kHeight = 144;
  const Shot shot(world, northward({0.0, 0.0, 2.0}, 0.6, kWidth, kHeight), 3.0);
  // The Fourier coefficient of one period in four pixels, of the picture under a smooth window.
  const auto peak = [&](int across, int down) {
    double re = 0.0, im = 0.0, sum = 0.0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const double window = std::pow(std::sin(kPi * (x + 0.5) / kWidth), 2) *
                              std::pow(std::sin(kPi * (y + 0.5) / kHeight), 2);
        const double phase = 0.5 * kPi * (across * x + down * y);
        const double green = shot.codes(x, y).y;
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
  const World by_volume = world_of(scene);
  scene.clouds.rays = scene::CloudRays::kRays;
  const World by_rays(scene, by_volume, 2);
  const View view = northward({0, 0, 2}, 0.3, 160, 90);
  const Shot a(by_volume, view, 0.0), b(by_rays, view, 0.0);
  EXPECT_LT(mean_difference(a.target, b.target), 3.0);
  EXPECT_NE(a.target.rgba, b.target.rgba);
}

TEST(VolumeClouds, CanBeLeftOut) {
  scene::Scene scene = cloudy_scene();
  const World world = world_of(scene);
  scene.clouds.kind = scene::CloudKind::kNone;
  const World clear(scene, world, 2);
  const View view = northward({0, 0, 2}, 0.2);
  const Shot without(world, view, 3.0, {.without = {Part::kVolumeClouds, Part::kCloudShadows}});
  EXPECT_NE(Shot(world, view, 3.0).target.rgba, without.target.rgba);
  EXPECT_EQ(Shot(clear, view, 3.0).target.rgba, without.target.rgba);
}

// Under a cloud the sun's image in the water goes out; beside it, it stays.
TEST(CloudShadows, TakeTheGlitterFromTheWater) {
  scene::Scene scene = placed_scene({0.0, 0.0});
  scene.sea.spectrum = true;
  scene.sky.sun_azimuth_rad = 0.0;
  scene.sky.sun_elevation_rad = radians(50.0);
  scene.sky.sun_direction = sky::sun_direction(0.0, scene.sky.sun_elevation_rad);
  scene.clouds.cumulus[0].width_m = 3000.0;
  const World world = world_of(scene);
  // The shadow lies as far from under the cloud as the sun slants over the height of its base.
  const double under_y = -900.0 / std::tan(radians(50.0));
  const auto glitter = [&](double y_m, PartSet without) {
    const Shot shot(world, northward({0.0, y_m - 10.0, 8.0}, -0.6), 3.0,
                    {.water_triangles = 4000, .keep_linear = true, .without = without});
    return std::accumulate(shot.target.linear.begin(), shot.target.linear.end(), 0.0);
  };
  EXPECT_LT(glitter(under_y, {}), 0.6 * glitter(under_y, {Part::kCloudShadows}));
  const double lit = glitter(under_y - 6000.0, {Part::kCloudShadows});
  EXPECT_NEAR(glitter(under_y - 6000.0, {}), lit, 0.02 * lit);
}

// West of the lagoon's island the floor is too deep to be seen: there the image of what lies under
// water, which ends with the map, must show water in the same shade.
TEST(CloudShadows, GoOnWhereAMapEnds) {
  const World& world = shipped_world("lagoon");
  const View view =
      make_view({-15.0, -890.0, 1500.0}, 0.0, radians(-60.0), radians(50.0), 0.25f, 320, 180);
  const Shot with(world, view, 5.0);
  const Shot unseen(world, view, 5.0, {.without = {Part::kRefraction}});
  const Shot lit(world, view, 5.0, {.without = {Part::kCloudShadows}});
  const auto green = [](const Shot& shot, std::size_t i) {
    return static_cast<int>(shot.target.rgba[i] >> 8 & 255);
  };
  int off = 0, shade = 0;
  for (std::size_t y = 100; y < 160; ++y)
    for (std::size_t x = 76; x < 88; ++x) {
      const std::size_t i = y * 320 + x;
      off += green(with, i) - green(unseen, i);
      shade += green(lit, i) - green(with, i);
    }
  EXPECT_LE(std::abs(off), 0.5 * 60 * 12);
  EXPECT_GT(shade, 2 * 60 * 12);
}

// The texels of a level stand still in the world.
TEST(CloudShadows, DoNotCrawlWithTheCamera) {
  scene::Scene scene = cloudy_scene();
  scene.sky.cloud_cover = 0.4;
  const World world = world_of(scene);
  Workers workers(2);
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
  const World world = world_of(scene);
  const View view = northward({0, 0, 100}, -0.3);
  const Shot with(world, view, 3.0), without(world, view, 3.0, {.without = {Part::kCloudShadows}});
  EXPECT_NE(with.target.rgba, without.target.rgba);
}

}  // namespace
}  // namespace swell::render
