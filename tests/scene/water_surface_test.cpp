// What the surface answers: against sines in closed form, against itself as it is drawn, from many
// threads.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <thread>
#include <vector>

#include "constants.h"
#include "math/random.h"
#include "scene/scene.h"
#include "scene/water.h"

namespace swell::scene {
namespace {

std::vector<glm::dvec2> random_points(int count, glm::dvec2 centre, double range_m) {
  std::vector<glm::dvec2> points;
  for (int i = 0; i < count; ++i)
    points.push_back(
        centre +
        range_m * (glm::dvec2(random_uniform(3, 2 * i), random_uniform(3, 2 * i + 1)) - 0.5));
  return points;
}

// Two waves with known frequencies: 0.6 sin(2 pi (x / 40 - t / 5)) + 0.3 sin(2 pi (y / 25 - t /
// 4)).
Scene sine_scene() {
  Scene scene;
  scene.sea.spectrum = false;
  scene.sea.sines = {{0.6, 40.0, 0.5 * kPiRef, 0.0, 5.0}, {0.3, 25.0, 0.0, 0.0, 4.0}};
  scene.area.size_m = {2000.0, 1000.0};
  return scene;
}
double sine_height(glm::dvec2 p, double t_s) {
  return 0.6 * std::sin(2.0 * kPiRef * (p.x / 40.0 - t_s / 5.0)) +
         0.3 * std::sin(2.0 * kPiRef * (p.y / 25.0 - t_s / 4.0));
}
glm::dvec2 sine_slope(glm::dvec2 p, double t_s) {
  return {0.6 * 2.0 * kPiRef / 40.0 * std::cos(2.0 * kPiRef * (p.x / 40.0 - t_s / 5.0)),
          0.3 * 2.0 * kPiRef / 25.0 * std::cos(2.0 * kPiRef * (p.y / 25.0 - t_s / 4.0))};
}

Scene windy_scene() {
  Scene scene;
  scene.sea.resolution = 64;
  return scene;
}

Scene island_scene() {
  Scene scene = windy_scene();
  scene.terrain.emplace();
  return scene;
}

// A beach of 1:40 with the sea in the north, a swell of three trains and a spectrum offshore.
Scene beach_scene() {
  Scene scene = windy_scene();
  scene.sea.wind_speed_mps = 8.0;
  scene.sea.patch_lengths_m = {180.0, 27.0};
  scene.terrain.emplace();
  scene.terrain->coast_m = {{-1000.0, -150.0}, {0.0, -150.0}, {1000.0, -200.0}};
  scene.terrain->beach_slope = 0.025;
  scene.terrain->beach_size_m = 800.0;
  scene.coast.model = CoastModel::kBlend;
  scene.coast.trains = 3;
  scene.coast.grid_spacing_m = 10.0;
  return scene;
}

// A scene's surface at one time, with all that it looks at.
struct Snapshot {
  Snapshot(const Scene& scene, double t_s) : water(scene), workers(1) {
    surface.emplace(water.at(t_s, frame, workers));
  }
  const WaterSurface* operator->() const { return &*surface; }
  Water water;
  Workers workers;
  ocean::SeaFrame frame;
  std::optional<WaterSurface> surface;
};

TEST(WaterSurface, SinesHaveTheirHeightsAndNormalsInThePastAndInTheFuture) {
  for (const double t_s : {-1234.5, 0.0, 0.7, 86400.25}) {
    const Snapshot water(sine_scene(), t_s);
    for (const glm::dvec2& p : random_points(200, {0.0, 0.0}, 700.0)) {
      EXPECT_NEAR(water->height(p), sine_height(p, t_s), 2e-6);
      glm::vec2 slope;
      glm::vec3 normal;
      water->slopes({&p, 1}, {&slope, 1});
      water->normals({&p, 1}, {&normal, 1});
      const glm::dvec2 want = sine_slope(p, t_s);
      EXPECT_NEAR(slope.x, want.x, 1e-6);
      EXPECT_NEAR(slope.y, want.y, 1e-6);
      const glm::dvec3 up = glm::normalize(glm::dvec3(-want, 1.0));
      EXPECT_LT(glm::distance(glm::dvec3(normal), up), 1e-6);
    }
  }
}

TEST(WaterSurface, TheSeaIsFlatFromTheAreasBorderOn) {
  const Snapshot water(sine_scene(), 3.0);
  EXPECT_EQ(water->height({1000.0, 0.0}), 0.0f);
  EXPECT_EQ(water->height({0.0, -500.0}), 0.0f);
  EXPECT_EQ(water->height({1e8, 1e8}), 0.0f);
  const glm::dvec2 p(900.0, 3.0);  // half way through the fading: 3 t^2 - 2 t^3 = 1/2
  EXPECT_NEAR(water->height(p), 0.5 * sine_height(p, 3.0), 2e-6);
}

TEST(WaterSurface, SlopesAreThoseOfTheHeightsWhereTheSeaFades) {
  const Snapshot water(sine_scene(), 3.0);
  const double h = 0.1;
  for (const glm::dvec2& p : random_points(200, {930.0, 430.0}, 100.0)) {
    glm::vec2 slope;
    water->slopes({&p, 1}, {&slope, 1});
    const double x = water->height(p + glm::dvec2(h, 0)) - water->height(p - glm::dvec2(h, 0));
    const double y = water->height(p + glm::dvec2(0, h)) - water->height(p - glm::dvec2(0, h));
    EXPECT_NEAR(slope.x, x / (2.0 * h), 2e-4);
    EXPECT_NEAR(slope.y, y / (2.0 * h), 2e-4);
  }
}

TEST(WaterSurface, TheWaterRisesAsFastAsItsHeightGrows) {
  const double dt_s = 0.01;
  Snapshot early(sine_scene(), 3.0 - dt_s), water(sine_scene(), 3.0),
      late(sine_scene(), 3.0 + dt_s);
  ocean::VelocityFrame velocity;
  ocean::advance_velocity(water.water.sea(), water.frame, velocity, water.workers);
  for (const glm::dvec2& p : random_points(100, {930.0, 430.0}, 100.0)) {  // on the fading edge
    glm::vec3 v;
    water->velocities({&p, 1}, velocity, {&v, 1});
    EXPECT_NEAR(v.z, (late->height(p) - early->height(p)) / (2.0 * dt_s), 1e-4);
  }
}

// The sea's weight, the trains' share and the edge all change from place to place here.
TEST(WaterSurface, TheWaterOfABeachRisesAsFastAsItsHeightGrows) {
  const double dt_s = 2e-3;
  const Water water(beach_scene());
  Workers workers(1);
  for (const double t_s : {-300.0, 42.0}) {
    ocean::SeaFrame before, frame, after;
    const WaterSurface early = water.at(t_s - dt_s, before, workers),
                       now = water.at(t_s, frame, workers),
                       late = water.at(t_s + dt_s, after, workers);
    ocean::VelocityFrame velocity;
    ocean::advance_velocity(water.sea(), frame, velocity, workers);
    int wrong = 0, moving = 0, drifting = 0;
    for (const glm::dvec2& p : random_points(1000, {0.0, 0.0}, 850.0)) {
      glm::vec3 v;
      now.velocities({&p, 1}, velocity, {&v, 1});
      const double rate = (late.height(p) - early.height(p)) / (2.0 * dt_s);
      wrong += std::abs(v.z - rate) > 3e-3;
      moving += std::abs(v.z) > 0.02;
      drifting += std::hypot(v.x, v.y) > 0.02;
    }
    EXPECT_GT(moving, 500);
    EXPECT_GT(drifting, 500);
    EXPECT_LE(wrong, 10);  // a difference may straddle a sharp crest
  }
}

// Mean square height along a line of one depth, over five minutes.
double variance_along(const Scene& scene, double y_m) {
  constexpr int kPoints = 32, kTimes = 100;
  const Water water(scene);
  Workers workers(1);
  ocean::SeaFrame frame;
  std::vector<glm::dvec2> p;
  for (int i = 0; i < kPoints; ++i) p.emplace_back(-300.0 + 18.0 * i, y_m);
  std::vector<float> z(p.size());
  double sum = 0.0;
  for (int n = 0; n < kTimes; ++n) {
    water.at(3.1 * n, frame, workers).heights(p, z);
    for (const double height : z) sum += height * height / (kPoints * kTimes);
  }
  return sum;
}

// Where trains and spectrum have half of the energy each, the sea is as high as the mean of both.
TEST(WaterSurface, ABlendedCoastKeepsItsEnergy) {
  Scene scene = beach_scene();
  scene.terrain->coast_m = {{-1000.0, -300.0}, {1000.0, -300.0}};
  const Water water(scene);
  const double midway_m = 0.25 * static_cast<double>(water.coast()->peak_wavelength_m);
  const double y_m = -300.0 + midway_m / scene.terrain->beach_slope;
  const double blend = variance_along(scene, y_m);
  scene.coast.model = CoastModel::kTrains;
  const double trains = variance_along(scene, y_m);
  scene.coast.model = CoastModel::kNone;
  const double spectrum = variance_along(scene, y_m);
  EXPECT_NEAR(blend / (0.5 * (trains + spectrum)), 1.0, 0.1) << trains << " " << spectrum;
}

TEST(WaterSurface, ABatchOfAnyLengthGivesWhatEachPointGives) {
  const Snapshot water(island_scene(), 5.0);
  const auto points = random_points(700, {0.0, 0.0}, 1500.0);
  for (const std::size_t count : {0u, 1u, 7u, 16u, 255u, 257u, 700u}) {
    std::vector<float> heights(count);
    water->heights(std::span(points).first(count), heights);
    for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(heights[i], water->height(points[i])) << i;
  }
}

TEST(WaterSurface, LandAndItsWaterlineDoNotMove) {
  const Snapshot early(island_scene(), 1.0), late(island_scene(), 4.0);
  EXPECT_EQ(early->height({0.0, 0.0}), 0.0f);  // the middle of the island
  EXPECT_EQ(late->height({0.0, 0.0}), 0.0f);
  EXPECT_FALSE(early->in_water({0.0, 0.0, -0.1}));
}

TEST(WaterSurface, WaterIsBetweenTheSurfaceAndTheGround) {
  const Snapshot water(island_scene(), 2.0);
  const glm::dvec2 p(900.0, 600.0);  // beyond the island's apron: floor at -60 m
  const double z = water->height(p);
  EXPECT_TRUE(water->in_water({p, z}));
  EXPECT_TRUE(water->in_water({p, z - 1e-6}));
  EXPECT_FALSE(water->in_water({p, z + 1e-6}));
  EXPECT_TRUE(water->in_water({p, -59.0}));
  EXPECT_FALSE(water->in_water({p, -61.0}));
  EXPECT_TRUE(Snapshot(windy_scene(), 2.0)->in_water({p, -5000.0}));
}

// The oracle steps by a millimetre or so.
double brute_distance(const WaterSurface& surface, glm::dvec3 origin, glm::dvec3 along,
                      double end_m, double step_m) {
  const auto above = [&](double s) {
    const glm::dvec3 p = origin + s * along;
    return p.z > static_cast<double>(surface.height(glm::dvec2(p)));
  };
  const bool start = above(0.0);
  for (double s = 0.0; s <= end_m; s += step_m)
    if (above(s) != start) return s;
  return -1.0;
}

void expect_first_hits(const Scene& scene) {
  const Snapshot water(scene, 11.0);
  int hits = 0;
  for (int i = 0; i < 100; ++i) {
    const auto dice = [&](int n) { return random_uniform(9, 10 * i + n); };
    const glm::dvec3 origin(800.0 * (dice(0) - 0.5), 800.0 * (dice(1) - 0.5),
                            12.0 * (dice(2) - 0.3));
    const double heading = 2.0 * kPiRef * dice(3),
                 down = (dice(4) - 0.6) * (dice(5) < 0.5 ? 0.3 : 3.0);
    const glm::dvec3 along = glm::normalize(glm::dvec3(std::cos(heading), std::sin(heading), down));
    const double step = 0.005;
    const double want = brute_distance(*water.surface, origin, along, 100.0, step);
    const auto hit = water->intersect(origin, 7.0 * along, 100.0);
    ASSERT_EQ(hit.has_value(), want >= 0.0) << i;
    if (!hit) continue;
    ++hits;
    EXPECT_NEAR(hit->distance_m, want, step + 1e-6) << i;
    EXPECT_NEAR(hit->p_world.z, water->height(glm::dvec2(hit->p_world)), 2e-5) << i;
    EXPECT_EQ(hit->from_above, origin.z > water->height(glm::dvec2(origin))) << i;
  }
  EXPECT_GT(hits, 30);
}

TEST(WaterSurface, RaysHitWhereSmallStepsFirstPassTheSurface) {
  Scene scene = windy_scene();
  expect_first_hits(scene);
  scene.sea.choppiness = 1.0;
  expect_first_hits(scene);
}

float ground_at(const Snapshot& water, glm::dvec2 p) {
  float ground_m = 0.0f;
  sample_heights(*water.water.terrain(), {&p, 1}, {&ground_m, 1});
  return ground_m;
}

// The water's surface goes on below the land at mean level: who looks at a beach sees whichever
// comes first, which in_water() tells.
TEST(WaterSurface, RaysAtABeachMeetWaterOrTheLandAboveIt) {
  const Snapshot water(beach_scene(), 9.0);
  int wet = 0, dry = 0;
  for (int i = 0; i < 60; ++i) {
    const auto dice = [&](int n) { return random_uniform(12, 4 * i + n); };
    const glm::dvec3 origin(600.0 * (dice(0) - 0.5), -260.0 + 250.0 * dice(1), 12.0);
    const glm::dvec3 along =
        glm::normalize(glm::dvec3(dice(2) - 0.5, dice(3) - 0.5, -0.3 - dice(2)));
    const auto hit = water->intersect(origin, along, 200.0);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->distance_m, brute_distance(*water.surface, origin, along, 200.0, 0.01), 0.011);
    const double above_ground = hit->p_world.z - ground_at(water, glm::dvec2(hit->p_world));
    if (std::abs(above_ground) < 1e-3) continue;  // the waterline itself
    const bool in_sea = above_ground > 0.0;
    EXPECT_EQ(water->in_water(hit->p_world - glm::dvec3(0.0, 0.0, 1e-4)), in_sea);
    EXPECT_FALSE(water->in_water(hit->p_world + glm::dvec3(0.0, 0.0, 1e-4)));
    (in_sea ? wet : dry) += 1;
  }
  EXPECT_GT(wet, 15);
  EXPECT_GT(dry, 5);
}

TEST(WaterSurface, RaysThatLeaveTheSeaBehindHitNothing) {
  const Snapshot water(windy_scene(), 0.0);
  EXPECT_FALSE(water->intersect({0, 0, 50}, {0, 0, 1}, 1e6));
  EXPECT_FALSE(water->intersect({0, 0, 50}, {1, 0, 0}, 1e6));
  EXPECT_FALSE(water->intersect({0, 0, 50}, {0, 0, -1}, 30.0));
  const auto down = water->intersect({3, 4, 50}, {0, 0, -1}, 100.0);
  ASSERT_TRUE(down);
  EXPECT_NEAR(down->p_world.z, water->height({3, 4}), 1e-6);
  EXPECT_TRUE(down->from_above);
  // Far out it meets waves, or the flat sea around a limited one.
  const glm::dvec3 eye(0.0, 0.0, 100.0), along = glm::normalize(glm::dvec3(1.0, 0.0, -0.002));
  const auto far = water->intersect(eye, along, 1e6);
  ASSERT_TRUE(far);
  // The surface is passed within a micrometre of the way; heights have steps of their own.
  const auto is_above = [&](double s) {
    const glm::dvec3 p = eye + s * along;
    return p.z > static_cast<double>(water->height(glm::dvec2(p)));
  };
  EXPECT_TRUE(is_above(far->distance_m - 1e-6));
  EXPECT_FALSE(is_above(far->distance_m + 1e-9));
  EXPECT_NEAR(far->p_world.z, water->height(glm::dvec2(far->p_world)), 2e-5);
  EXPECT_NE(far->p_world.z, 0.0);
  Scene limited = windy_scene();
  limited.area.size_m = {3000.0, 2000.0};
  const Snapshot flat(limited, 0.0);
  const auto beyond = flat->intersect({0, 0, 100}, {1.0, 0, -0.002}, 1e6);
  ASSERT_TRUE(beyond);
  EXPECT_NEAR(beyond->p_world.x, 50000.0, 1e-3);
}

TEST(WaterSurface, ASideWithoutASizeHasNoEnd) {
  Scene scene = sine_scene();
  scene.area.size_m = {0.0, 1000.0};
  const Snapshot water(scene, 2.0);
  for (const double x : {0.0, 5e4, -8e5}) {
    EXPECT_NEAR(water->height({x, 100.0}), sine_height({x, 100.0}, 2.0), 2e-3) << x;
    EXPECT_EQ(water->height({x, 501.0}), 0.0f) << x;
  }
}

// Everything a surface answers.
struct Answers {
  std::vector<float> heights;
  std::vector<glm::vec2> slopes;
  std::vector<glm::vec3> normals, velocities;
  std::vector<double> distances;
  bool operator==(const Answers&) const = default;
};
Answers ask_all(const WaterSurface& surface, const ocean::VelocityFrame& velocity,
                std::span<const glm::dvec2> points) {
  Answers a{std::vector<float>(points.size()),
            std::vector<glm::vec2>(points.size()),
            std::vector<glm::vec3>(points.size()),
            std::vector<glm::vec3>(points.size()),
            {}};
  surface.heights(points, a.heights);
  surface.slopes(points, a.slopes);
  surface.normals(points, a.normals);
  surface.velocities(points, velocity, a.velocities);
  for (std::size_t i = 0; i < points.size(); i += 100) {
    const auto hit = surface.intersect({points[i], 9.0}, {0.4, 0.2, -1.0}, 100.0);
    a.distances.push_back(hit ? hit->distance_m : -1.0);
  }
  return a;
}

TEST(WaterSurface, ThreadsMayAskAtOnce) {
  Snapshot water(beach_scene(), 5.0);
  ocean::VelocityFrame velocity;
  ocean::advance_velocity(water.water.sea(), water.frame, velocity, water.workers);
  const auto points = random_points(1000, {0.0, 0.0}, 900.0);
  const Answers want = ask_all(*water.surface, velocity, points);
  std::vector<Answers> got(4);
  {
    std::vector<std::jthread> threads;
    for (Answers& answers : got)
      threads.emplace_back([&] {
        for (int n = 0; n < 3; ++n) answers = ask_all(*water.surface, velocity, points);
      });
  }
  for (const Answers& answers : got) EXPECT_TRUE(answers == want);
}

}  // namespace
}  // namespace swell::scene
