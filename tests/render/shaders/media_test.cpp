// What water and air do to light, and the views that look through water or into its mirror.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "constants.h"
#include "math/random.h"
#include "render/materials/list.h"
#include "render/shaders/shader_kernels.h"
#include "render/sky/sky_maps.h"
#include "render/view/render_view.h"
#include "texture/on_every_target.h"

namespace swell::render {
namespace {

class MediaOptics : public texture::OnEveryTarget {};
INSTANTIATE_TEST_SUITE_P(Targets, MediaOptics, texture::every_target(), texture::target_name);

constexpr double kN = 1.333;

// Apparent over true depth straight above a thing, tan(theta_water) / tan(theta_air), by Snell's
// law.
struct ApparentDepth {
  double degrees, k;
};
const std::vector<ApparentDepth> kApparent = {
    {0, .750188},  {10, .745140}, {20, .729362}, {30, .700853}, {40, .655983}, {45, .625761},
    {50, .589226}, {60, .493410}, {70, .361756}, {80, .193296}, {85, .098402}};

double exact_k(double cos_air, double n) {
  const double sin_water = std::sqrt(1.0 - cos_air * cos_air) / n;
  return cos_air / (n * std::sqrt(1.0 - sin_water * sin_water));
}

// ---- Water

struct Paths {
  std::vector<float> depth_m, length_m;
};
Paths paths(const std::vector<float>& cos_eye, const std::vector<float>& apparent_m, double n) {
  Media media;
  media.refraction_index = static_cast<float>(n);
  Paths result{std::vector<float>(cos_eye.size()), std::vector<float>(cos_eye.size())};
  path_through_water(media, cos_eye, apparent_m, result.depth_m, result.length_m);
  return result;
}

TEST_P(MediaOptics, ApparentDepthIsTheTables) {
  std::vector<float> cosines;
  for (const ApparentDepth& row : kApparent)
    cosines.push_back(static_cast<float>(std::cos(row.degrees * kDegree)));
  const Paths p = paths(cosines, std::vector<float>(cosines.size(), 1.0f), kN);
  for (std::size_t i = 0; i < cosines.size(); ++i)
    EXPECT_NEAR(1.0 / p.depth_m[i], kApparent[i].k, 1e-5) << kApparent[i].degrees;
}

// The way up follows Snell's law; the sun's way down is 1.2 depths.
TEST_P(MediaOptics, LightsWayIsASlantByTheRefractedAngle) {
  for (const double n : {1.01, 1.2, 1.333, 1.5, 2.0}) {
    std::vector<float> cosines, apparent_m;
    for (int i = 20; i <= 1000; ++i) {
      cosines.push_back(static_cast<float>(i) / 1000.0f);
      apparent_m.push_back(0.02f + 0.003f * static_cast<float>(i % 37));
    }
    const Paths p = paths(cosines, apparent_m, n);
    for (std::size_t i = 0; i < cosines.size(); ++i) {
      const double cos_air = cosines[i], sin_water = std::sqrt(1.0 - cos_air * cos_air) / n;
      const double depth = apparent_m[i] / exact_k(cos_air, n);
      const double length = depth / std::cos(std::asin(sin_water)) + 1.2 * depth;
      ASSERT_NEAR(p.depth_m[i], depth, 1e-5 * depth) << cos_air << " " << n;
      ASSERT_NEAR(p.length_m[i], length, 1e-5 * length) << cos_air << " " << n;
    }
  }
}

// Nearer to the horizon than 1.15 degrees the way counts as that at 1.15 degrees, and the part of
// it that goes up is 200 m at most.
TEST_P(MediaOptics, LightsWayIsBoundedWhereTheEyeSkimsTheWater) {
  const Paths p = paths({0.02f, 0.01f, 0.0f, -0.3f, 1.0f}, {1.0f, 1.0f, 1.0f, 1.0f, 300.0f}, kN);
  for (const std::size_t i : {1, 2, 3}) {
    EXPECT_EQ(p.depth_m[i], p.depth_m[0]);
    EXPECT_EQ(p.length_m[i], p.length_m[0]);
  }
  EXPECT_NEAR(p.length_m[4], 200.0 + 1.2 * 300.0 * kN, 1e-3);
}

Media murky_water() {
  Media media;
  media.absorption_per_m = {0.36f, 0.063f, 0.019f};  // Jerlov's type I
  return media;
}

std::vector<glm::vec3> absorbed(const Media& media, const std::vector<float>& length_m,
                                glm::vec3 light) {
  std::vector<glm::vec3> seen(length_m.size());
  absorb_in_water(media, length_m, light, seen);
  return seen;
}

// Source: Beer and Lambert's law.
TEST_P(MediaOptics, WaterAbsorbsExponentially) {
  const Media media = murky_water();
  std::vector<float> length_m;
  for (int i = 0; i < 500; ++i) length_m.push_back(0.3f * static_cast<float>(i));
  const auto seen = absorbed(media, length_m, {1.0f, 2.0f, 0.5f});
  const glm::dvec3 light(1.0, 2.0, 0.5);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const double x = static_cast<double>(media.absorption_per_m[c]) * length_m[i];
      ASSERT_NEAR(seen[i][c], light[c] * std::exp(-x), 2e-7 * (1.0 + x) * light[c]) << x;
    }
  }
}

TEST_P(MediaOptics, TwoStretchesOfWaterLetThroughTheProductOfBoth) {
  const Media media = murky_water();
  for (const float a : {0.1f, 1.0f, 7.0f, 30.0f}) {
    for (const float b : {0.2f, 3.0f, 11.0f}) {
      const auto seen = absorbed(media, {a, b, a + b}, glm::vec3(1.0f));
      const glm::vec3 product = seen[0] * seen[1];
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[2][c], product[c], 1e-6) << a << " " << b;
    }
  }
}

// The water's own light comes in as the thing's goes: at once for none, wholly for ever.
TEST_P(MediaOptics, DeepWaterShowsItsOwnLight) {
  Media media = murky_water();
  media.body = {0.02f, 0.07f, 0.09f};
  const glm::vec3 thing(0.5f, 0.4f, 0.3f);
  const auto seen = absorbed(media, {0.0f, 1e4f, 1e30f}, thing);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[0][c], thing[c], 1e-7);
  EXPECT_EQ(seen[1], media.body);
  EXPECT_EQ(seen[2], media.body);
  for (const glm::vec3& same : absorbed(media, {0.0f, 0.7f, 19.0f, 400.0f}, media.body))
    EXPECT_EQ(same, media.body);
}

// ---- Air

constexpr double kMediaHaze_m = 15000.0;
constexpr double kMediaHazeCut = 1.0 / 512.0;  // half a step of the picture

struct HazyAir {
  HazyAir() {
    texture::RgbaImage image;
    texture::resize_image(16, 16, image);
    std::ranges::fill(image.texels, 0xff204080u);  // R 128, G 64, B 32
    sky = texture::pack_rgb(image);
    shading.light.sky_soft = shading.light.haze_sky = &sky;
    shading.light.horizon = glm::vec3(horizon());
    shading.media.inv_haze_m = static_cast<float>(1.0 / kMediaHaze_m);
  }
  std::vector<glm::vec3> seen(const std::vector<float>& distance_m, glm::vec3 light) const {
    std::vector<glm::vec3> result(distance_m.size());
    haze(shading, distance_m, {0.6f, -0.64f, 0.48f}, light, result);
    return result;
  }
  glm::dvec3 horizon() const {
    const glm::dvec3 code(128.0, 64.0, 32.0);
    return code * code * (static_cast<double>(kSoftSkyRange) / (255.0 * 255.0));
  }
  texture::RgbMap sky;
  ViewShading shading;
};

TEST_P(MediaOptics, HazeLeavesTheContrastThatKoschmiedersLawLeaves) {
  const HazyAir air;
  std::vector<float> distance_m;
  for (int i = 0; i < 4000; ++i) distance_m.push_back(2.5f * static_cast<float>(i * i) / 100.0f);
  const glm::vec3 light(0.9f, 0.02f, 0.4f);
  const auto seen = air.seen(distance_m, light);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    // The first half step of haze is left out, all along.
    const double amount =
        std::max(1.0 - std::exp(-distance_m[i] / kMediaHaze_m) - kMediaHazeCut, 0.0);
    for (int c = 0; c < 3; ++c) {
      const double expected = light[c] + (air.horizon()[c] - light[c]) * amount;
      ASSERT_NEAR(seen[i][c], expected, 2e-6) << distance_m[i];
    }
  }
}

// 1/e of the contrast at the haze distance, and a black target at the range of sight (3.912 of
// them) has lost all but a fiftieth against the horizon.
TEST_P(MediaOptics, HazeHidesWhatIsBeyondTheRangeOfSight) {
  const HazyAir air;
  const auto seen = air.seen(
      {static_cast<float>(kMediaHaze_m), static_cast<float>(3.912 * kMediaHaze_m), 1e9f}, {});
  const auto contrast = [&](std::size_t i) { return 1.0 - seen[i].y / air.horizon().y; };
  EXPECT_NEAR(contrast(0), std::exp(-1.0) + kMediaHazeCut, 1e-5);
  EXPECT_NEAR(contrast(1), 0.02 + kMediaHazeCut, 1e-4);
  EXPECT_NEAR(contrast(2), kMediaHazeCut, 1e-5);
}

TEST_P(MediaOptics, HazeOfLessThanHalfAStepIsLeftOut) {
  const HazyAir air;
  const double first_m = -kMediaHaze_m * std::log1p(-kMediaHazeCut);  // 29.3 m
  const glm::vec3 light(0.123f, 0.456f, 0.789f);
  const auto seen = air.seen(
      {0.0f, 10.0f, static_cast<float>(0.99 * first_m), static_cast<float>(1.1 * first_m)}, light);
  for (const std::size_t i : {0, 1, 2}) EXPECT_EQ(seen[i], light) << i;
  EXPECT_NE(seen[3], light);
}

// The steeper the view, the more the mean of the horizon takes the place of what is seen at the
// azimuth: wholly straight down, not at all level, with no seam between.
TEST_P(MediaOptics, HazeStraightDownIsTheHorizonsMean) {
  HazyAir air;
  air.shading.light.horizon = {0.9f, 0.5f, 0.1f};
  for (const double degrees : {0.0, 0.1, 10.0, 30.0, 45.0, 70.0, 90.0}) {
    const double horizontal = std::sin(degrees * kDegree);
    const glm::vec3 to_eye(0.8 * horizontal, -0.6 * horizontal, std::cos(degrees * kDegree));
    std::vector<glm::vec3> seen(1);
    haze(air.shading, std::vector<float>{1e9f}, to_eye, {}, seen);
    const double steep = 1.0 - std::pow(horizontal, 16.0);
    for (int c = 0; c < 3; ++c) {
      const double mean = air.shading.light.horizon[c];
      const double expected = air.horizon()[c] + (mean - air.horizon()[c]) * steep;
      EXPECT_NEAR(seen[0][c], (1.0 - kMediaHazeCut) * expected, 2e-6) << degrees;
    }
  }
}

// ---- Views

// Points beside and below an eye 12 m over the water.
constexpr float kLevel_m = -12.0f;
std::vector<WorldPoint> random_points(float lowest_m, float highest_m, float farthest_m) {
  std::vector<WorldPoint> points;
  const auto uniform = [](std::uint64_t i, double low, double high) {
    return static_cast<float>(low + (high - low) * random_uniform(5, i));
  };
  for (std::uint64_t i = 0; i < 3000; i += 3) {
    const float above_m = uniform(i, lowest_m, highest_m);
    points.push_back({{uniform(i + 1, -farthest_m, farthest_m),
                       uniform(i + 2, -farthest_m, farthest_m), kLevel_m + above_m},
                      above_m,
                      kLevel_m});
  }
  return points;
}

PointMap map_of(ViewKind kind) {
  return {kind, {.submerged = false, .to_surface_m = -kLevel_m}, static_cast<float>(kN)};
}

// What find_seen makes of what map_point made of the points.
std::vector<glm::vec3> there_and_back(ViewKind kind, const std::vector<WorldPoint>& points) {
  std::vector<glm::vec3> shown, seen(points.size());
  for (const WorldPoint& p : points) shown.push_back(map_point(map_of(kind), p));
  Media media;
  media.refraction_index = static_cast<float>(kN);
  find_seen(kind, media, kLevel_m, shown, seen);
  return seen;
}

TEST_P(MediaOptics, ReflectionShowsPointsThatAreFoundAgain) {
  const auto points = random_points(-5.0f, 60.0f, 300.0f);
  const auto seen = there_and_back(ViewKind::kReflection, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::vec3 shown = map_point(map_of(ViewKind::kReflection), points[i]);
    ASSERT_NEAR(shown.z - kLevel_m, -points[i].above_m, 1e-5);  // as deep as it is high
    ASSERT_LE(glm::distance(seen[i], points[i].p_rel), 1e-6f * glm::length(points[i].p_rel)) << i;
  }
}

TEST_P(MediaOptics, RefractionShowsPointsThatAreFoundAgain) {
  const auto points = random_points(-12.0f, -0.01f, 60.0f);
  const auto seen = there_and_back(ViewKind::kRefraction, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float depth = -points[i].above_m;
    ASSERT_NEAR(seen[i].z, points[i].p_rel.z, 1e-3f * depth + 1e-4f) << i;
    ASSERT_EQ(glm::vec2(seen[i]), glm::vec2(points[i].p_rel)) << i;
  }
}

// Standing out of the water and seen through a wave.
TEST_P(MediaOptics, RefractionShowsPointsAboveTheWaterThatAreFoundAgain) {
  const auto points = random_points(0.0f, 0.3f, 60.0f);
  const auto seen = there_and_back(ViewKind::kRefraction, points);
  for (std::size_t i = 0; i < points.size(); ++i)
    ASSERT_NEAR(seen[i].z, points[i].p_rel.z, 0.1f * points[i].above_m + 1e-4f) << i;
}

// A straight line through the level is bent there, on both sides alike.
TEST_P(MediaOptics, RefractionMovesPointsOnBothSidesOfTheLevelAlike) {
  for (const WorldPoint& p : random_points(0.01f, 8.0f, 60.0f)) {
    WorldPoint below = p;
    below.above_m = -p.above_m, below.p_rel.z = p.level_rel_m - p.above_m;
    const PointMap map = map_of(ViewKind::kRefraction);
    EXPECT_NEAR(map_point(map, p).z + map_point(map, below).z, 2.0f * p.level_rel_m, 1e-4f);
  }
}

// ---- Under water

// An eye 12 m down.
constexpr float kDeep_m = 12.0f;

Media deep_water() {
  Media media = murky_water();
  media.body = {0.01f, 0.05f, 0.08f};
  media.refraction_index = static_cast<float>(kN);
  return submerge(media, -kDeep_m);
}

std::vector<glm::vec3> there_and_back_below(ViewKind kind, const std::vector<WorldPoint>& points) {
  const PointMap map{kind, {.submerged = true, .to_surface_m = kDeep_m}, static_cast<float>(kN)};
  std::vector<glm::vec3> shown, seen(points.size());
  for (const WorldPoint& p : points) shown.push_back(map_point(map, p));
  find_seen(kind, deep_water(), kDeep_m, shown, seen);
  return seen;
}

std::vector<WorldPoint> points_over(float level_m, std::vector<WorldPoint> points) {
  for (WorldPoint& p : points) {
    p.level_rel_m = level_m;
    p.p_rel.z = level_m + p.above_m;
  }
  return points;
}

TEST_P(MediaOptics, FromBelowWhatIsMirroredIsFoundAgain) {
  const auto points = points_over(kDeep_m, random_points(-30.0f, 0.0f, 300.0f));
  const auto seen = there_and_back_below(ViewKind::kReflection, points);
  for (std::size_t i = 0; i < points.size(); ++i)
    ASSERT_LE(glm::distance(seen[i], points[i].p_rel), 1e-5f * glm::length(points[i].p_rel)) << i;
}

// Near the rim of the window a step of the direction is a long way up.
TEST_P(MediaOptics, FromBelowWhatStandsInAirIsFoundAgain) {
  const auto points = points_over(kDeep_m, random_points(0.5f, 60.0f, 60.0f));
  const auto seen = there_and_back_below(ViewKind::kRefraction, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    ASSERT_EQ(glm::vec2(seen[i]), glm::vec2(points[i].p_rel)) << i;
    ASSERT_NEAR(seen[i].z, points[i].p_rel.z, 0.01f * points[i].above_m) << i;
  }
}

// A straight way under water, with what it shows lit by what light comes down there: by quadrature
// in double, and the limits.
glm::dvec3 integrated(const Media& media, double z0, double length_m, double deeper_m,
                      glm::dvec3 light) {
  constexpr int kSteps = 20000;
  glm::dvec3 sum(0.0);
  for (int c = 0; c < 3; ++c) {
    const double lost = media.absorption_per_m[c], daylight = media.daylight_lost_per_m[c];
    for (int i = 0; i < kSteps; ++i) {
      const double part = (i + 0.5) / kSteps, s = part * length_m;
      sum[c] += media.scattered[c] * lost * length_m / kSteps *
                std::exp(-lost * s - daylight * (z0 + part * deeper_m));
    }
    sum[c] += light[c] * std::exp(-lost * length_m - daylight * (z0 + deeper_m));
  }
  return sum;
}

TEST_P(MediaOptics, WaterScattersWhatQuadratureSays) {
  const Media media = deep_water();
  const glm::vec3 light(0.3f, 0.2f, 0.1f);
  std::vector<float> length_m, deeper_m;
  for (const float length : {0.01f, 0.5f, 3.0f, 14.4f, 60.0f, 200.0f})
    // With -1 / 1.2 of the length upward no exponent is left: the series.
    for (const float slant : {-0.8334f, -0.8f, -0.5f, 0.0f, 0.3f, 1.0f})
      if (slant * length >= -kDeep_m) {
        length_m.push_back(length);
        deeper_m.push_back(slant * length);
      }
  std::vector<glm::vec3> seen(length_m.size());
  through_water(media, media.daylight_at_eye, length_m, deeper_m, light, seen);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const glm::dvec3 exact = integrated(media, kDeep_m, length_m[i], deeper_m[i], light);
    for (int c = 0; c < 3; ++c)
      ASSERT_NEAR(seen[i][c], exact[c], 2e-5 * exact[c] + 1e-8)
          << length_m[i] << ' ' << deeper_m[i] << ' ' << c;
  }
}

// A way of 20 m that goes 8 m down, cut after 7 m.
TEST_P(MediaOptics, WaysAfterEachOtherAreOneWay) {
  const Media media = deep_water();
  const glm::vec3 light(0.3f, 0.2f, 0.1f);
  std::vector<glm::vec3> whole(1), far(1), near(1);
  through_water(media, media.daylight_at_eye, std::vector{20.0f}, std::vector{8.0f}, light, whole);
  glm::vec3 daylight_there;
  for (int c = 0; c < 3; ++c)
    daylight_there[c] =
        media.daylight_at_eye[c] * std::exp(-media.daylight_lost_per_m[c] * 0.35f * 8.0f);
  through_water(media, daylight_there, std::vector{13.0f}, std::vector{0.65f * 8.0f}, light, far);
  // What comes out of the far part is not dimmed again by depth.
  glm::vec3 arriving = far[0];
  for (int c = 0; c < 3; ++c) arriving[c] /= daylight_there[c];
  through_water(media, media.daylight_at_eye, std::vector{7.0f}, std::vector{0.35f * 8.0f},
                arriving, near);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(near[0][c], whole[0][c], 1e-5f * whole[0][c]) << c;
}

// No seam between far things and none.
TEST_P(MediaOptics, WaterWithoutEndIsTheLimit) {
  const Media media = deep_water();
  for (const float w : {0.0f, 0.2f, 1.0f}) {
    std::vector<glm::vec3> seen(1), endless(1);
    through_water(media, media.daylight_at_eye, std::vector{4e4f}, std::vector{w * 4e4f},
                  glm::vec3(5.0f), seen);
    endless_water(media, media.daylight_at_eye, std::vector{w}, endless);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[0][c], endless[0][c], 1e-5f * seen[0][c]);
  }
}

// The radiance of deep water is one number, from above and from just below.
TEST_P(MediaOptics, DeepWaterIsAsBrightFromBelowAsFromAbove) {
  const Media media = deep_water();
  std::vector<glm::vec3> seen(1);
  endless_water(media, glm::vec3(1.0f), std::vector{1.0f}, seen);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[0][c], media.body[c], 1e-6f);
}

// ... and so is a floor in it, straight down.
TEST_P(MediaOptics, AFloorIsAsBrightFromBelowAsFromAbove) {
  const Media media = deep_water();
  const glm::vec3 light(0.3f, 0.2f, 0.1f);
  std::vector<glm::vec3> seen(1);
  through_water(media, glm::vec3(1.0f), std::vector{6.0f}, std::vector{6.0f}, light, seen);
  const auto above = absorbed(media, {(1.0f + kDaylightSlant) * 6.0f}, light);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[0][c], above[0][c], 1e-6f);
}

}  // namespace
}  // namespace swell::render
