// The images that water looks into, on the test picture: a pool of still water with a checkered
// floor, a checkered tower and a pole in it. What a pixel shows is told by a ray in double that
// Snell's law bends and the level mirrors, through boxes and a plane.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>

#include "render/shot.h"
#include "terrain/height_grid.h"

namespace swell::render {
namespace {

constexpr double kPi = std::numbers::pi, kPoolIndex = 1.333, kFloor_m = -2.0;
constexpr int kTower = 0, kPole = 1, kFloor = -1;

// In even light, through water and air as clear as can be.
scene::Scene pool_scene(std::optional<double> reflection_weight) {
  scene::Scene scene = load_shipped("pool");
  scene.sky = {};
  scene.sky.zenith = scene.sky.horizon = glm::vec3(1.0f);
  scene.sky.sun_radiance = glm::vec3(0.0f);
  scene.sky.cloud_cover = 0.0;
  scene.sky.haze_distance_m = 1e7;
  scene.round_earth = false;
  scene.water.body_colour = glm::vec3(0.0f);
  scene.water.absorption_per_m = glm::vec3(1e-4f);
  scene.water.reflection_weight = reflection_weight;
  scene.picture.edge_samples = 0;
  for (scene::FloatingObject& object : scene.objects) object.roughness = 1.0;  // without gloss
  return scene;
}

struct Ray {
  glm::dvec3 from, along;
};

struct Hit {
  double distance = std::numeric_limits<double>::infinity();
  int what = -2;      // an object, the floor, or nothing
  bool light = true;  // its square
  bool operator==(const Hit& b) const { return what == b.what && light == b.light; }
};

bool is_light(double a, double b) {
  return std::fmod(std::floor(a) + std::floor(b) + 1e6, 2.0) == 0.0;
}

// A box and its squares.
void meet_box(const scene::Scene& scene, std::size_t n, const scene::ObjectPose& pose,
              const Ray& ray, Hit& hit) {
  const scene::FloatingObject& box = scene.objects[n];
  const glm::dmat3 from_world = glm::transpose(pose.world_from_object);
  const glm::dvec3 half(0.5 * box.size_m.x, 0.5 * box.size_m.y, 0.5 * box.size_m.z);
  const glm::dvec3 middle(0.0, 0.0, (0.5 - box.draught) * box.size_m.z);
  const glm::dvec3 from = from_world * (ray.from - pose.position_world) - middle;
  const glm::dvec3 along = from_world * ray.along;
  double near = 0.0, far = std::numeric_limits<double>::infinity();
  int axis = -1;
  for (int k = 0; k < 3; ++k) {
    const double a = (-half[k] - from[k]) / along[k], b = (half[k] - from[k]) / along[k];
    if (std::min(a, b) > near) near = std::min(a, b), axis = k;
    far = std::min(far, std::max(a, b));
  }
  if (axis < 0 || near >= far || near >= hit.distance) return;
  const glm::dvec3 at = from + near * along + glm::dvec3(0.0, 0.0, half.z);
  const double c = box.checker_m;
  hit = {near, static_cast<int>(n),
         c == 0.0 || is_light(at[(axis + 1) % 3] / c, at[(axis + 2) % 3] / c)};
}

struct Pool : Shot {
  explicit Pool(const scene::Scene& scene) : world(scene) {}

  const Target& draw(const View& from, FrameOptions options = {}) {
    options.keep_linear = true;
    options.labels.add(Label::kId);
    options.water_triangles = 500;
    return Shot::draw(world, from, 3.0, options);
  }

  Hit meet(const Ray& ray) const {
    const scene::Scene& scene = world.scene();
    Hit hit;
    for (std::size_t n = 0; n < scene.objects.size(); ++n)
      meet_box(scene, n, state().meshes.objects.poses[n], ray, hit);
    const double floor = (kFloor_m - ray.from.z) / ray.along.z;
    if (floor > 0.0 && floor < hit.distance) {
      const glm::dvec3 p = ray.from + floor * ray.along;
      const double c = scene.terrain->checker_m;
      hit = {floor, kFloor, is_light(p.x / c, p.y / c)};
    }
    return hit;
  }

  // The ray from the eye through a place of the picture up to the water.
  Ray seen(double x_px, double y_px) const {
    return {
        view.eye_world,
        glm::normalize(glm::dvec3(view.ray(static_cast<float>(x_px), static_cast<float>(y_px))))};
  }
  Ray to_level(const Ray& ray) const {
    return {ray.from + (-ray.from.z / ray.along.z) * ray.along, ray.along};
  }
  Hit mirrored(double x_px, double y_px) const {
    Ray ray = to_level(seen(x_px, y_px));
    ray.along.z = -ray.along.z;
    return meet(ray);
  }
  Hit bent(double x_px, double y_px) const {
    Ray ray = to_level(seen(x_px, y_px));
    ray.along.x /= kPoolIndex, ray.along.y /= kPoolIndex;
    ray.along.z = -std::sqrt(1.0 - ray.along.x * ray.along.x - ray.along.y * ray.along.y);
    return meet(ray);
  }

  // Calls check(pixel's light, hit) for the pixels of water where `hit_at` is the same everywhere
  // within so many pixels.
  void for_sure(double within_px, const std::function<Hit(double, double)>& hit_at,
                const std::function<void(glm::vec3, const Hit&)>& check) const {
    for (int y = 0; y < view.height_px; ++y)
      for (int x = 0; x < view.width_px; ++x) {
        if (target.labels.id[at(x, y)] != kWaterId) continue;
        const Hit hit = hit_at(x + 0.5, y + 0.5);
        bool sure = true;
        for (const double dx : {-within_px, within_px})
          for (const double dy : {-within_px, within_px})
            sure = sure && hit_at(x + 0.5 + dx, y + 0.5 + dy) == hit;
        if (sure) check(linear(x, y), hit);
      }
  }

  World world;
};

View view_from(glm::dvec3 eye_m, double heading_rad, double pitch_rad, double fov_y_rad,
               int width_px, int height_px) {
  return make_view(eye_m, camera_axes(heading_rad, pitch_rad, 0.0),
                   lens_of_fov(fov_y_rad, width_px, height_px), 0.05f, width_px, height_px);
}

// Whether the squares of one thing lie where rays see them.
struct Squares {
  int light = 0, dark = 0, wrong = 0;
  double contrast = 0.0;
};

// Counts the pixels of squares that are sure within so many. What is brighter than the middle
// between those that show one square wholly is light; where squares meet at a corner nothing is.
Squares count_squares(const Pool& pool, int what, double within_px,
                      const std::function<Hit(double, double)>& hit_at) {
  glm::dvec2 sum(0.0), count(0.0);
  const auto of_thing = [&](double px, const auto& visit) {
    pool.for_sure(px, hit_at, [&](glm::vec3 light, const Hit& hit) {
      if (hit.what == what) visit(static_cast<double>(light.x), hit.light ? 0 : 1);
    });
  };
  of_thing(1.5, [&](double light, int dark) { sum[dark] += light, ++count[dark]; });
  const glm::dvec2 mean = sum / count;
  Squares squares;
  squares.contrast = (mean[0] - mean[1]) / (mean[0] + mean[1]);
  of_thing(within_px, [&](double light, int dark) {
    ++(dark ? squares.dark : squares.light);
    const double over = light - 0.5 * (mean[0] + mean[1]);
    squares.wrong += (dark ? over : -over) > 0.02 * (mean[0] - mean[1]);
  });
  return squares;
}

TEST(Pool, AFlatMirrorShowsTheTowerToASubPixel) {
  Pool pool(pool_scene(1.0));
  pool.draw(view_from({0.4, -4.0, 1.3}, 0.2, -0.33, 0.7, 240, 180));
  const Squares squares = count_squares(pool, kTower, 1.0 / 16.0,
                                        [&](double x, double y) { return pool.mirrored(x, y); });
  EXPECT_GT(squares.light, 500);
  EXPECT_GT(squares.dark, 500);
  EXPECT_EQ(squares.wrong, 0);
}

// By the angle to the vertical in the middle of the picture.
TEST(Pool, TheFloorLiesWhereSnellsLawPutsIt) {
  Pool pool(pool_scene(0.0));
  for (const double degrees : {0.0, 25.0, 45.0, 60.0, 72.0}) {
    pool.draw(view_from({-4.0, -9.0, 2.0}, 0.0, (degrees - 90.0) * kPi / 180.0, 0.25, 160, 120));
    const Squares squares =
        count_squares(pool, kFloor, 0.5, [&](double x, double y) { return pool.bent(x, y); });
    EXPECT_GT(squares.light, 2000) << degrees;
    EXPECT_GT(squares.dark, 2000) << degrees;
    EXPECT_EQ(squares.wrong, 0) << degrees;
  }
}

// The pole leans to the right, 30 degrees.
TEST(Pool, AStraightPoleIsBentAtTheLevel) {
  Pool pool(pool_scene(0.0));
  scene::GivenPose leaning{kPole, {}};
  leaning.pose.position_world = {-2.0, 0.0, 0.0};
  const double a = kPi / 6.0;
  leaning.pose.world_from_object =
      glm::dmat3(glm::dvec3(std::cos(a), 0.0, -std::sin(a)), glm::dvec3(0.0, 1.0, 0.0),
                 glm::dvec3(std::sin(a), 0.0, std::cos(a)));
  pool.draw(view_from({-2.0, -3.5, 1.4}, 0.0, -0.5, 0.9, 320, 240), {.poses = {&leaning, 1}});
  int pole = 0, other = 0, wrong = 0;
  pool.for_sure(
      1.0, [&](double x, double y) { return pool.bent(x, y); },
      [&](glm::vec3 light, const Hit& hit) {
        const bool is_pole = hit.what == kPole;
        if (!is_pole && hit.what != kFloor) return;
        ++(is_pole ? pole : other);
        // Yellow on black and white.
        wrong += (light.z < 0.3f * light.x) != is_pole;
      });
  EXPECT_GT(pole, 60);
  EXPECT_GT(other, 10000);
  EXPECT_EQ(wrong, 0);
}

// Beyond Snell's window the surface is a whole mirror of the floor.
TEST(Pool, TotalReflectionShowsALegibleFloor) {
  Pool pool(pool_scene({}));
  pool.draw(view_from({-4.0, -8.0, -1.5}, 0.0, 0.25, 0.4, 320, 240));
  const Squares squares =
      count_squares(pool, kFloor, 0.25, [&](double x, double y) { return pool.mirrored(x, y); });
  EXPECT_GT(squares.light, 3000);
  EXPECT_GT(squares.dark, 3000);
  EXPECT_EQ(squares.wrong, 0);
  EXPECT_GT(squares.contrast, 0.8);  // that of the squares is 0.86
}

// Two lines for apparent over true depth: of the tower's foot, at its left edge.
TEST(Pool, ThePapersRefractionIsItsTwoLines) {
  scene::Scene scene = pool_scene(0.0);
  const auto foot_px = [&](scene::RefractionModel model) {
    scene.water.refraction = model;
    Pool pool(scene);
    pool.draw(view_from({1.0, -2.0, 2.0}, 0.0, -0.75, 0.3, 64, 480));
    for (int y = pool.view.height_px - 1; y >= 0; --y) {
      const glm::vec3 light = pool.linear(33, y);
      if (light.z < 0.3f * light.x) return y + 1;  // red on grey
    }
    return -1;
  };
  // It stands 3.5 m away, 2 m down.
  double air = 0.0, high = 1.5;  // the ray's angle in air
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (air + high);
    const double reached =
        2.0 * std::tan(middle) + 2.0 * std::tan(std::asin(std::sin(middle) / kPoolIndex));
    (reached < 3.5 ? air : high) = middle;
  }
  const auto expected_px = [&](double k) {
    const double below = std::atan2(2.0 + 2.0 * k, 3.5);
    return 240.0 + 240.0 * std::tan(below - 0.75) / std::tan(0.15);
  };
  const double exact = std::tan(std::asin(std::sin(air) / kPoolIndex)) / std::tan(air);
  const double paper = air <= 0.8 ? 0.75 - 0.16 * air : 1.26 - 0.8 * air;
  ASSERT_GT(std::abs(expected_px(exact) - expected_px(paper)), 4.0);
  EXPECT_NEAR(foot_px(scene::RefractionModel::kExact), expected_px(exact), 1.0);
  EXPECT_NEAR(foot_px(scene::RefractionModel::kPaper), expected_px(paper), 1.0);
}

// The weight is the share of the mirror at any angle.
TEST(Pool, AConstantWeightBlendsTheTwoImages) {
  const View view = view_from({0.0, -6.0, 1.6}, 0.1, -0.4, 0.8, 64, 48);
  const auto light_of = [&](double weight) { return Pool(pool_scene(weight)).draw(view).linear; };
  const auto mirror = light_of(1.0), water = light_of(0.0), both = light_of(0.25);
  for (std::size_t i = 0; i < both.size(); ++i)
    ASSERT_NEAR(both[i], 0.25f * mirror[i] + 0.75f * water[i], 1e-4f) << i;
}

// Slopes that a pixel does not show spread what it mirrors: the same light with less contrast.
// Still water has none.
TEST(Pool, ImagesAreSofterInRoughWater) {
  const View view = view_from({0.4, -9.0, 2.5}, 0.0, -0.2, 0.5, 96, 72);
  struct Picture {
    double mean = 0.0, steps = 0.0;  // between neighbours of a row
    std::vector<float> linear;
  };
  const auto draw = [&](double wind_mps, PartSet without) {
    scene::Scene scene = pool_scene(1.0);
    scene.sea.wind_speed_mps = wind_mps;
    scene.water.distortion = 0.3;
    Picture picture{.linear = Pool(scene).draw(view, {.without = without}).linear};
    for (std::size_t i = 1; i < picture.linear.size() / 3; ++i) {
      picture.mean += static_cast<double>(picture.linear[3 * i]);
      picture.steps += std::abs(static_cast<double>(picture.linear[3 * i]) -
                                static_cast<double>(picture.linear[3 * i - 3]));
    }
    return picture;
  };
  const Picture soft = draw(8.0, {}), hard = draw(8.0, {Part::kImageBlur});
  EXPECT_NEAR(soft.mean / hard.mean, 1.0, 0.02);
  EXPECT_LT(soft.steps, 0.9 * hard.steps);
  EXPECT_EQ(draw(0.0, {}).linear, draw(0.0, {Part::kImageBlur}).linear);
}

// ---- A plane of the caller's

TEST(Pool, AClipPlaneCutsTheWorldAndItsImages) {
  Pool pool(pool_scene(1.0));
  const View view = view_from({0.4, -4.0, 1.3}, 0.2, -0.2, 0.9, 160, 120);
  FrameOptions cut{.clip_plane = glm::dvec4(0.0, 0.0, -2.0, 2.0)};  // up to 1 m
  cut.labels.add(Label::kDepth);
  const Target& target = pool.draw(view, cut);
  double highest_m = 0.0;
  int tower = 0;
  for (std::size_t i = 0; i < target.labels.id.size(); ++i) {
    if (target.labels.id[i] != kFirstObjectId + kTower) continue;
    ++tower;
    const int x = static_cast<int>(i) % view.width_px, y = static_cast<int>(i) / view.width_px;
    highest_m = std::max(highest_m, position_of(view, x, y, target.labels.depth_m[i]).z);
  }
  EXPECT_GT(tower, 100);
  EXPECT_NEAR(highest_m, 1.0, 0.03);
  // What the mirror shows over 1 m is sky.
  int sky = 0, mirrored = 0;
  pool.for_sure(
      0.6, [&](double x, double y) { return pool.mirrored(x, y); },
      [&](glm::vec3 light, const Hit& hit) {
        if (hit.what != kTower) return;
        ++mirrored;
        sky += light.z > 0.8f;
      });
  EXPECT_GT(sky, mirrored / 4);
  EXPECT_LT(sky, mirrored);
}

// What one side of a plane shows and what the other shows is all there is.
TEST(Pool, TwoSidesOfAPlaneMakeTheWhole) {
  Pool pool(pool_scene({}));
  const View view = view_from({0.4, -4.0, 1.3}, 0.2, -0.2, 0.9, 160, 120);
  const glm::dvec4 plane(1.0, 0.3, 0.1, -1.2);
  const auto ids = [&](std::optional<glm::dvec4> clip) {
    return pool.draw(view, {.clip_plane = clip}).labels.id;
  };
  const auto all = ids(std::nullopt), one = ids(plane), other = ids(-plane);
  int from_one = 0, from_other = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    ASSERT_TRUE(one[i] == all[i] || other[i] == all[i]) << i;
    (one[i] == all[i] ? from_one : from_other) += 1;
  }
  EXPECT_GT(from_one, 1000);
  EXPECT_GT(from_other, 1000);
}

}  // namespace
}  // namespace swell::render
