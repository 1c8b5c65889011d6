// The shadows of floating objects and of land in pictures, against rays to the sun.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/edges/edge_scenes.h"
#include "render/measures.h"
#include "render/shot.h"
#include "shapes/object_ray.h"
#include "sky/sky_light.h"
#include "terrain/height_grid.h"

namespace swell::render {
namespace {

constexpr int kSize_px = 96;

void set_sun(double azimuth_deg, double elevation_deg, scene::Scene& scene) {
  scene.sky.sun_azimuth_rad = azimuth_deg * kPi / 180.0;
  scene.sky.sun_elevation_rad = elevation_deg * kPi / 180.0;
  scene.sky.sun_direction =
      sky::sun_direction(scene.sky.sun_azimuth_rad, scene.sky.sun_elevation_rad);
}

// Linear light of pixels' middles alone.
FrameOptions without(PartSet parts) {
  return {.keep_linear = true, .edge_samples = 0, .without = parts};
}

// The place on the water that the middle of a pixel of a picture without waves shows.
glm::dvec2 place_at(const View& view, int x, int y) {
  const glm::dvec3 ray(view.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
  return glm::dvec2(view.eye_world - ray * (view.eye_world.z / ray.z));
}

// How much less green light a pixel has in the shade.
float taken(const Shot& lit, const Shot& shaded, int x, int y) {
  return lit.linear(x, y).y - shaded.linear(x, y).y;
}

// A flat sea under an object of a kind, where all of a picture's points can be worked out.
struct OneObject {
  OneObject(scene::ObjectKind kind, double elevation_deg) : scene(plain_scene()) {
    set_sun(235.0, elevation_deg, scene);
    scene::FloatingObject object = white_box({0.0, 0.0}, {5.0, 3.0, 4.0});
    object.kind = kind;
    object.heading_rad = 0.5;
    scene.objects = {object};
    mesh = shapes::make_object_mesh(kind, object.top_mark, shapes::kLevelSegments[0]);
  }

  // The part of nine rays that meet the object: from `p` to points of the sun's rim, and to its
  // middle from p and from places around it across the ray, as far as half a pixel softens shadows.
  double hidden(glm::dvec3 p) const {
    const scene::FloatingObject& object = scene.objects[0];
    const scene::ObjectPose pose = {glm::dvec3(0.0), {glm::cross(ahead, up), ahead, up}};
    const glm::dvec3 sun(scene.sky.sun_direction);
    const glm::dvec3 right = glm::normalize(glm::cross(sun, up)), above = glm::cross(right, sun);
    int met = shapes::intersect_ray(object, pose, mesh, p, sun).has_value();
    for (const glm::dvec2& side : {glm::dvec2(1.0, 0.0), {-1.0, 0.0}, {0.0, 1.0}, {0.0, -1.0}}) {
      const glm::dvec3 aside = side.x * right + side.y * above;
      const glm::dvec3 rim = sun + 0.0046 * aside, beside = p + 0.22 * aside;
      met += shapes::intersect_ray(object, pose, mesh, p, rim).has_value();
      met += shapes::intersect_ray(object, pose, mesh, beside, sun).has_value();
    }
    return met / 9.0;
  }

  glm::dvec3 ahead{std::sin(0.5), std::cos(0.5), 0.0}, up{0.0, 0.0, 1.0};
  shapes::ObjectMesh mesh;
  scene::Scene scene;
};

// Straight down from 200 m, with `side_m` of sea from edge to edge.
View from_above(glm::dvec2 middle, double side_m) {
  return make_view({middle, 200.0}, 0.0, -0.5 * kPi, 2.0 * std::atan(side_m / 400.0), 0.25f,
                   kSize_px, kSize_px);
}

class ObjectShadow : public testing::TestWithParam<scene::ObjectKind> {};
INSTANTIATE_TEST_SUITE_P(Kinds, ObjectShadow,
                         testing::Values(scene::ObjectKind::kBuoy, scene::ObjectKind::kSphere,
                                         scene::ObjectKind::kBox),
                         [](const auto& kind) {
                           return std::string(scene::kObjectKindNames[kind.param]);
                         });

TEST_P(ObjectShadow, LiesWhereRaysToTheSunMeetTheObject) {
  for (const double elevation_deg : {12.0, 40.0}) {
    const OneObject one(GetParam(), elevation_deg);
    const World world = world_of(one.scene);
    const View view = from_above({6.0, 4.5}, 26.0);
    const Shot shaded(world, view, 1.0, without({Part::kHulls}));
    const Shot lit(world, view, 1.0, without({Part::kHulls, Part::kShadows}));
    // What the whole shadow takes away.
    float most = 0.0f;
    for (int y = 0; y < kSize_px; ++y)
      for (int x = 0; x < kSize_px; ++x) most = std::max(most, taken(lit, shaded, x, y));
    ASSERT_GT(most, 1e-4f);
    int in_shadow = 0, in_sun = 0, wrong = 0;
    for (int y = 0; y < kSize_px; y += 2) {
      for (int x = 0; x < kSize_px; x += 2) {
        const glm::dvec2 p = place_at(view, x, y);
        // The object itself, and what is seen through it, is not the water's.
        if (glm::length(p) < 3.4) continue;
        const double hidden = one.hidden({p, 0.0});
        const double got = static_cast<double>(taken(lit, shaded, x, y) / most);
        in_shadow += hidden == 1.0;
        in_sun += hidden == 0.0;
        wrong += (hidden == 0.0 && got > 0.02) || (hidden == 1.0 && got < 0.9);
      }
    }
    EXPECT_GT(in_shadow, 0) << elevation_deg;
    EXPECT_GT(in_sun, 1000);
    EXPECT_LE(wrong, 3) << elevation_deg << ": of " << in_shadow;
  }
}

// As the camera moves by parts of a pixel, the middle of what a shadow takes, and how much that is,
// stay where they are.
TEST_P(ObjectShadow, DoesNotCrawlWithTheCamera) {
  constexpr double kSide_m = 26.0, kPixel_m = kSide_m / kSize_px;
  const OneObject one(GetParam(), 25.0);
  const World world = world_of(one.scene);
  const auto shadow_from = [&](glm::dvec2 middle) {
    const View view = from_above(middle, kSide_m);
    const Shot shaded(world, view, 1.0, without({Part::kHulls}));
    const Shot lit(world, view, 1.0, without({Part::kHulls, Part::kShadows}));
    glm::dvec3 sum(0.0);  // middle times weight, weight
    for (int y = 0; y < kSize_px; ++y)
      for (int x = 0; x < kSize_px; ++x) {
        const glm::dvec2 p = place_at(view, x, y);
        // Not the object itself, nor what is seen through it; without an edge.
        const double beside = std::clamp(glm::length(p) - 3.4, 0.0, 1.0);
        sum += beside * static_cast<double>(taken(lit, shaded, x, y)) * glm::dvec3(p, 1.0);
      }
    return glm::dvec3(glm::dvec2(sum) / sum.z, sum.z);
  };
  const glm::dvec3 first = shadow_from({6.0, 4.5});
  EXPECT_GT(first.z, 0.0);
  for (int step = 1; step <= 5; ++step) {
    const glm::dvec3 now =
        shadow_from(glm::dvec2(6.0, 4.5) + double(step) * glm::dvec2(0.041, 0.027));
    EXPECT_LT(glm::length(glm::dvec2(now - first)), 0.1 * kPixel_m) << step;
    EXPECT_NEAR(now.z / first.z, 1.0, 0.02) << step;
  }
}

// A box south of the picture, which looks north over its shadow.
TEST(SunShadow, FallsIntoThePictureFromOutside) {
  scene::Scene scene = plain_scene();
  set_sun(180.0, 20.0, scene);
  scene.objects = {white_box({0.0, -8.0}, {6.0, 2.0, 8.0})};
  const World world = world_of(scene);
  // 6.4 m above the water: 17.6 m of shadow, as far as y = 9.6.
  const View view = make_view({0.0, 0.0, 6.0}, 0.0, -0.6, 0.7, 0.25f, kSize_px, kSize_px);
  const Shot shaded(world, view, 1.0, without({Part::kHulls}));
  const Shot lit(world, view, 1.0, without({Part::kHulls, Part::kShadows}));
  const auto taken_at = [&](double x_m, double y_m) {
    const glm::vec4 clip = view.clip_from_rel * glm::vec4(x_m, y_m, -6.0, 1.0);
    const int x = static_cast<int>((0.5f + 0.5f * clip.x / clip.w) * kSize_px);
    const int y = static_cast<int>((0.5f - 0.5f * clip.y / clip.w) * kSize_px);
    return taken(lit, shaded, x, y);
  };
  EXPECT_GT(taken_at(0.0, 7.0), 1e-3f);
  EXPECT_GT(taken_at(2.0, 8.5), 1e-3f);
  EXPECT_EQ(taken_at(0.0, 11.0), 0.0f);
  EXPECT_EQ(taken_at(3.6, 8.0), 0.0f);
}

// Glitter of a rough sea, with a hill to the north that stands over the sun.
scene::Scene sea_behind_island(double elevation_deg) {
  scene::Scene scene = plain_scene();
  scene.sea.wind_speed_mps = 5.0;
  scene.water.bump_strength = 1.0;
  scene.terrain.emplace();
  scene.terrain->island_radius_m = 100.0;
  scene.terrain->island_height_m = 50.0;
  set_sun(0.0, elevation_deg, scene);
  return scene;
}

float brightest(const World& world, const View& view, PartSet parts) {
  return std::ranges::max(green_light(Shot(world, view, 1.0, without(parts)).target));
}

// The picture shows water alone, looking down: the island is above its upper edge.
TEST(SunShadow, OfAnIslandOutsideThePictureTakesTheGlintAway) {
  const View view = make_view({0.0, -210.0, 12.0}, 0.0, -0.3, 0.24, 0.25f, kSize_px, kSize_px);
  const World low = world_of(sea_behind_island(10.0)), high = world_of(sea_behind_island(35.0));
  EXPECT_GT(brightest(low, view, {Part::kShadows}), 1.0f);
  EXPECT_LT(brightest(low, view, {}), 0.3f);
  // A sun that stands over the island is as bright as without it.
  const View down = make_view({0.0, -210.0, 12.0}, 0.0, -0.6, 0.24, 0.25f, kSize_px, kSize_px);
  EXPECT_EQ(Shot(high, down, 1.0, without({})).target.linear,
            Shot(high, down, 1.0, without({Part::kShadows})).target.linear);
}

TEST(SunShadow, IsTheSamePictureOnTilesOfAnySize) {
  scene::Scene scene = sea_behind_island(9.0);
  scene.detail.triangulation = scene::Triangulation::kRoam;
  scene.detail.water_triangles = scene.detail.terrain_triangles = 3000;
  for (const double x : {-30.0, -5.0, 4.0, 20.0})
    scene.objects.push_back(white_box({x, -150.0 + x}, {3.0, 2.0, 5.0}));
  scene.objects[1].kind = scene::ObjectKind::kBuoy;
  scene.objects[2].kind = scene::ObjectKind::kSphere;
  // Far away, where a round earth sinks it by 5 m: 10 pixels.
  scene.objects.push_back(white_box({900.0, 8800.0}, {90.0, 60.0, 80.0}));
  const World world = world_of(scene);
  const View near = make_view({0.0, -190.0, 9.0}, 0.1, -0.15, 0.9, 0.25f, 160, 90);
  const View far = make_view({0.0, -190.0, 90.0}, 0.1, -0.01, 0.02, 0.25f, 160, 90);
  for (const View& view : {near, far}) {
    const Shot expected(world, view, 1.0, without({}));
    for (const int tile_size_px : {16, 32}) {
      FrameOptions options = without({});
      options.tile_size_px = tile_size_px;
      EXPECT_EQ(Shot(world, view, 1.0, options).target.linear, expected.target.linear)
          << tile_size_px;
    }
  }
}

// ---- Hulls

TEST(Hull, DarkensAndFoamsTheWaterAtItsWaterline) {
  scene::Scene scene = plain_scene();
  scene.sea.wind_speed_mps = 9.0;
  scene.detail.triangulation = scene::Triangulation::kRoam;
  scene.objects = {white_box({0.0, 0.0}, {5.0, 5.0, 3.0})};
  // What of it waves show under water is as dark as the water.
  scene.objects[0].colour = glm::vec3(0.0f);
  const View view = from_above({0.0, 0.0}, 40.0);
  const auto mean_at = [&](const World& world, double low_m, double high_m) {
    const Shot with(world, view, 1.0, without({}));
    const Shot bare(world, view, 1.0, without({Part::kHulls}));
    double sum = 0.0, n = 0.0;
    for (int y = 0; y < kSize_px; ++y)
      for (int x = 0; x < kSize_px; ++x) {
        const double px_m = 40.0 / kSize_px, mid = 0.5 * (kSize_px - 1);
        const double away = std::max(std::abs(x - mid), std::abs(y - mid)) * px_m - 2.5;
        if (away < low_m || away > high_m) continue;
        sum += static_cast<double>((with.linear(x, y) - bare.linear(x, y)).y);
        ++n;
      }
    return sum / n;
  };
  const World windy = world_of(scene);
  EXPECT_GT(mean_at(windy, 0.0, 0.5), 0.02);
  EXPECT_EQ(mean_at(windy, 3.5, 12.0), 0.0);
  // A calm has no foam, and darker water.
  scene.sea.wind_speed_mps = 0.0;
  const World calm = world_of(scene);
  EXPECT_LT(mean_at(calm, 0.0, 0.6), 0.0);
}

// What a ball mirrors passes from the sky to the sea without a line.
TEST(Gloss, HasNoEdge) {
  scene::Scene scene = plain_scene();
  scene.sky.zenith = scene.sky.horizon = glm::vec3(0.8f);
  scene.sky.sun_radiance = glm::vec3(0.0f);
  scene.objects = {white_box({0.0, 6.0}, {4.0, 4.0, 4.0})};
  scene.objects[0].kind = scene::ObjectKind::kSphere;
  scene.objects[0].colour = glm::vec3(0.0f);
  const World world = world_of(scene);
  const View view = make_view({0.0, 0.0, 4.5}, 0.0, -0.45, 0.5, 0.25f, kSize_px, kSize_px);
  const Shot shot(world, view, 1.0, without({}));
  const auto green = [&](int x, int y) { return shot.linear(x, y).y; };
  // The rim is brighter than the middle, by Fresnel: in steps that are small against the whole.
  float widest = 0.0f, step = 0.0f;
  for (int y = 30; y < 66; ++y)
    for (int x = 30; x < 65; ++x) {
      step = std::max(step, std::abs(green(x + 1, y) - green(x, y)));
      step = std::max(step, std::abs(green(x, y + 1) - green(x, y)));
      widest = std::max(widest, green(x, y));
    }
  EXPECT_GT(widest, 0.01f);
  EXPECT_LT(step, 0.1f * widest);
}

}  // namespace
}  // namespace swell::render
