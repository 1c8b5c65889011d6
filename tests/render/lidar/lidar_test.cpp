// A lidar's returns: closed forms, the surfaces that queries answer for, the same bits, noise.
#include "render/measure/lidar.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <vector>

#include "constants.h"
#include "math/random.h"
#include "math/simd_target.h"
#include "ocean/water_surface.h"
#include "render/labels/label_channels.h"
#include "render/measure/lidar_patterns.h"
#include "render/shot.h"
#include "scene/water.h"
#include "scratch_folder.h"
#include "terrain/height_grid.h"

namespace swell::render {
namespace {

using Returns = std::vector<LidarReturn>;

Returns scanned(const World& world, const LidarScan& scan, int threads = 2) {
  Workers workers(threads);
  Lidar lidar(world, workers);
  Returns returns(scan.beams.size());
  lidar.scan(scan, returns, workers);
  return returns;
}

bool same_bits(const Returns& a, const Returns& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

std::vector<LidarBeam> turn_of(const char* model, int columns) {
  return spinning_beams(*find_spinning_model(model), {.columns = columns});
}

glm::dvec3 direction(const LidarBeam& b) {
  const double level = std::cos(b.elevation_rad);
  return {level * std::cos(b.azimuth_rad), level * std::sin(b.azimuth_rad),
          std::sin(b.elevation_rad)};
}

// A flat sea without wind, with what stands on it.
World calm_world(const std::vector<scene::FloatingObject>& objects = {}) {
  scene::Scene scene;
  scene.sea.wind_speed_mps = 0.0;
  scene.objects = objects;
  return world_of(scene);
}

scene::FloatingObject fixed(scene::ObjectKind kind, glm::dvec2 position_m, double size_m) {
  scene::FloatingObject object = scene::common_object(kind);
  object.motion = scene::Motion::kFixed;
  object.position_m = position_m;
  object.size_m = glm::dvec3(size_m);
  object.draught = 0.5;
  object.colour = {0.6f, 0.3f, 0.3f};
  return object;
}

TEST(Lidar, MeetsAFlatSeaAndNothingInTheSky) {
  const std::vector<LidarBeam> beams = {
      {0.3, -0.5}, {1.0, -0.05}, {0.0, -0.5 * kPiRef}, {2.0, 0.1}};
  const Returns r = scanned(calm_world(), {.begin = {{5.0, 7.0, 3.0}}, .beams = beams});
  EXPECT_NEAR(r[0].range_m, 3.0 / std::sin(0.5), 1e-4);
  EXPECT_NEAR(r[1].range_m, 3.0 / std::sin(0.05), 5e-4);
  EXPECT_NEAR(r[2].range_m, 3.0, 1e-4);
  EXPECT_NEAR(r[0].incidence_rad, 0.5 * kPiRef - 0.5, 1e-3);
  EXPECT_EQ(r[0].id, kWaterId);
  EXPECT_EQ(r[0].klass, kWaterClass);
  EXPECT_NEAR(r[0].p_sensor.x, 3.0 / std::tan(0.5) * std::cos(0.3), 1e-3);
  EXPECT_NEAR(r[0].p_sensor.z, -3.0, 1e-3);
  EXPECT_GT(r[2].intensity, 0.2) << "a mirror straight below";
  EXPECT_LT(r[0].intensity, 1e-6) << "which shows nothing aslant";
  EXPECT_EQ(r[3].range_m, HUGE_VALF);
  EXPECT_EQ(r[3].id, kSkyId);
  EXPECT_EQ(r[3].klass, kSkyClass);
  EXPECT_TRUE(std::isnan(r[3].p_sensor.x));
}

// Cox and Munk's facets on a flat sea: F p / (4 cos^5 theta) of what a white surface's 1 / pi is,
// p = exp(-tan^2 theta / s^2) / (pi s^2), s^2 = 0.003 + 0.00512 U.
TEST(Lidar, IntensitiesOfAFlatSeaInAWindAreThoseOfItsFormula) {
  scene::Scene scene;
  scene.sea.wind_speed_mps = 8.0;
  scene.sea.spectrum = false;
  scene.sea.whitecaps = 0.0;
  std::vector<LidarBeam> beams;
  for (int n = 0; n < 6; ++n) beams.push_back({0.7 * n, -0.5 * kPiRef + 0.08 * n});
  const Returns r = scanned(world_of(scene), {.begin = {{0.0, 0.0, 6.0}}, .beams = beams});
  for (int n = 0; n < 6; ++n) {
    const double theta = 0.08 * n, s2 = 0.003 + 0.00512 * 8.0;
    const double facets = std::exp(-std::pow(std::tan(theta), 2.0) / s2) / (kPiRef * s2);
    const double echo = kPiRef * 0.0198 * facets / (4.0 * std::pow(std::cos(theta), 5.0));
    EXPECT_NEAR(r[static_cast<std::size_t>(n)].intensity, echo, 1e-4 * echo + 1e-6) << n;
  }
}

TEST(Lidar, FogTakesAwayLightOnBothWays) {
  constexpr float kPerMetre = 0.02f;
  scene::Scene scene;
  scene.sea.wind_speed_mps = 0.0;
  scene.objects = {fixed(scene::ObjectKind::kBox, {20.0, 0.0}, 4.0)};
  const std::vector<LidarBeam> beams = {{0.0, 0.0}, {0.0, -0.5 * kPiRef}};
  const LidarScan scan = {.begin = {{0.0, 0.0, 1.0}}, .beams = beams};
  const Returns clear = scanned(world_of(scene), scan);
  scene.air.fog_top_m = 100.0;
  scene.air.attenuation_per_m = glm::vec3(kPerMetre);
  const Returns foggy = scanned(world_of(scene), scan);
  EXPECT_NEAR(clear[0].range_m, 18.0, 1e-4);
  EXPECT_NEAR(foggy[0].intensity / clear[0].intensity,
              std::exp(-36.0 * static_cast<double>(kPerMetre)), 1e-5);
  EXPECT_EQ(foggy[0].range_m, clear[0].range_m);
}

TEST(Lidar, MeetsABoxWhereItStands) {
  scene::FloatingObject box = fixed(scene::ObjectKind::kBox, {20.0, 0.0}, 4.0);
  const std::vector<LidarBeam> beams = {{0.0, 0.0}, {0.05, 0.02}, {0.0, -0.1}, {0.2, 0.0}};
  const Returns r = scanned(calm_world({box}), {.begin = {{0.0, 0.0, 1.0}}, .beams = beams});
  EXPECT_NEAR(r[0].range_m, 18.0, 1e-5);
  EXPECT_NEAR(r[1].range_m, 18.0 / (std::cos(0.05) * std::cos(0.02)), 1e-5);
  EXPECT_EQ(r[0].id, kFirstObjectId);
  EXPECT_EQ(r[0].klass, kObjectClass);
  EXPECT_NEAR(r[0].intensity, 0.4, 1e-5) << "the mean of its colour";
  EXPECT_NEAR(r[1].intensity, 0.4 * std::cos(0.05) * std::cos(0.02), 1e-5);
  EXPECT_EQ(r[2].id, kWaterId) << "before it";
  EXPECT_EQ(r[3].range_m, HUGE_VALF) << "beside it";
}

TEST(Lidar, MeetsAFormWhereItsFunctionIs) {
  const ScratchFolder folder;
  scene::FloatingObject ball = fixed(scene::ObjectKind::kImplicit, {20.0, 0.0}, 5.0);
  ball.file = folder
                  .write("ball.toml",
                         "[[form]]\nsize = [5, 5, 5]\nat = [0, 0, 0.5]\npainted = true\n"
                         "colour = [1, 1, 1]\n")
                  .string();
  const glm::dvec3 eye(0.0, 0.0, 1.0), middle(20.0, 0.0, 0.5);
  std::vector<LidarBeam> beams;
  for (std::uint64_t n = 0; n < 300; ++n)
    beams.push_back({0.3 * (random_uniform(1, 2 * n) - 0.5), 0.2 * random_uniform(1, 2 * n + 1)});
  const World world = calm_world({ball});
  const Returns r = scanned(world, {.begin = {eye}, .beams = beams});
  int hits = 0;
  for (std::size_t n = 0; n < beams.size(); ++n) {
    const glm::dvec3 along = direction(beams[n]);
    const double b = glm::dot(middle - eye, along);
    const double under = b * b - glm::dot(middle - eye, middle - eye) + 2.5 * 2.5;
    if (std::abs(under) < 0.01) continue;  // along its edge
    if (under < 0.0) {
      EXPECT_EQ(r[n].range_m, HUGE_VALF) << n;
      continue;
    }
    ++hits;
    const double s = b - std::sqrt(under);
    EXPECT_NEAR(r[n].range_m, s, 2e-4) << n;
    const double cosine = -glm::dot(along, eye + s * along - middle) / 2.5;
    if (cosine > 0.2) {
      EXPECT_NEAR(r[n].intensity, 0.4 * cosine, 0.004) << n;
      EXPECT_EQ(r[n].id, kFirstObjectId) << n;
    }
  }
  EXPECT_GT(hits, 60);
}

// Returns lie on what queries answer for, and nothing of that lies before them.
void expect_on_surfaces(const World& world, glm::dvec3 eye_world, double t_s) {
  const auto beams = turn_of("hdl-32e", 45);
  const Returns returns = scanned(world, {.t_s = t_s, .begin = {eye_world}, .beams = beams});
  Workers workers(2);
  ocean::SeaFrame frame;
  const scene::Water water = world.water();
  const scene::WaterSurface surface = water.at(t_s, frame, workers);
  const auto ground = [&](glm::dvec2 p) {
    return water.terrain() ? terrain::height_at(*water.terrain(), p) : -HUGE_VAL;
  };
  int on_water = 0, on_land = 0;
  for (std::size_t n = 0; n < beams.size(); ++n) {
    const glm::dvec3 along = direction(beams[n]);
    const auto range = static_cast<double>(returns[n].range_m);
    const glm::dvec3 p = eye_world + range * along;
    if (returns[n].id == kWaterId) {
      ++on_water;
      const double slack = 1e-3 * std::max(-along.z, 0.01);
      EXPECT_NEAR(p.z, static_cast<double>(surface.height(glm::dvec2(p))), slack) << n;
    }
    if (returns[n].id == kLandId) {
      ++on_land;
      EXPECT_NEAR(p.z, ground(glm::dvec2(p)), 1e-4) << n;
    }
    const double end_m = std::min(range, 120.0);
    const auto met = surface.intersect(eye_world, along, end_m);
    EXPECT_TRUE(!met || met->distance_m > range - 1e-3) << n << ": water at " << met->distance_m;
    for (double s = 0.5; s < end_m - 0.01; s += 0.5) {
      const glm::dvec3 q = eye_world + s * along;
      EXPECT_GT(q.z, ground(glm::dvec2(q))) << n << ": ground before " << range;
    }
  }
  EXPECT_GT(on_water, 150);
  EXPECT_EQ(on_land > 0, world.scene().terrain.has_value());
}

TEST(Lidar, MeetsWavesOfTheOpenOcean) {
  expect_on_surfaces(shipped_world("open_ocean"), {0.0, 0.0, 9.0}, 12.0);
}

TEST(Lidar, MeetsTheHarboursWaterAndLand) {
  expect_on_surfaces(shipped_world("harbour"), {-12.0, -18.0, 3.2}, 2.0);
}

TEST(Lidar, MeetsARiverAndItsBanks) {
  const World world(scene::load_scene(SWELL_SOURCE_DIR "/tests/scenes/river_bank.toml"), 2);
  expect_on_surfaces(world, world.scene().camera.eye_m, 2.0);
}

TEST(Lidar, IsTheSameBitsOnAnyThreadsAndTarget) {
  for (const char* const name : {"harbour", "river", "everything"}) {
    const World& world = shipped_world(name);
    const auto beams = turn_of("vlp-16", 128);
    const SensorPose begin{world.scene().camera.eye_m};
    const LidarScan scan{.t_s = 3.0,
                         .begin = begin,
                         .end = SensorPose{begin.position_world + glm::dvec3(0.5, 0.0, 0.0)},
                         .duration_s = 0.1,
                         .moments = 2,
                         .beams = beams,
                         .reach_m = 50.0,
                         .range_noise_m = 0.02};
    const Returns one = scanned(world, scan, 1);
    for (const int threads : {2, 3}) EXPECT_TRUE(same_bits(scanned(world, scan, threads), one));
    const SimdTarget before = current_simd_target();
    for (const SimdTarget target : simd_targets()) {
      if (!simd_target_available(target)) continue;
      select_simd_target(target);
      EXPECT_TRUE(same_bits(scanned(world, scan), one)) << name << " " << simd_target_name(target);
    }
    select_simd_target(before);
  }
}

TEST(Lidar, AScanLeavesNoTraceInTheNext) {
  const World& world = shipped_world("harbour");
  Workers workers(2);
  Lidar lidar(world, workers);
  const auto beams = turn_of("vlp-16", 64);
  const LidarScan first{.t_s = 1.0, .begin = {{0.0, 0.0, 4.0}}, .beams = beams};
  LidarScan second = first;
  second.t_s = 7.0;
  second.begin.position_world = {-12.0, -18.0, 3.2};
  Returns returns(beams.size());
  lidar.scan(first, returns, workers);
  lidar.scan(second, returns, workers);
  EXPECT_TRUE(same_bits(returns, scanned(world, second)));
}

TEST(Lidar, ARollingShutterMovesBeamsAndMomentsMoveTheWorld) {
  const World& world = shipped_world("harbour");
  auto beams = turn_of("vlp-16", 32);
  const SensorPose begin{{-12.0, -18.0, 3.2}},
      end{{-11.0, -18.0, 3.4}, glm::normalize(glm::dquat(1.0, 0.0, 0.0, 0.05))};
  const Returns rolling =
      scanned(world, {.t_s = 3.0, .begin = begin, .end = end, .duration_s = 0.1, .beams = beams});
  const Returns moments =
      scanned(world, {.t_s = 3.0, .begin = begin, .duration_s = 0.1, .moments = 4, .beams = beams});
  for (const std::size_t column : {0u, 9u, 31u}) {
    const std::vector<LidarBeam> some(beams.begin() + 16 * static_cast<std::ptrdiff_t>(column),
                                      beams.begin() + 16 * static_cast<std::ptrdiff_t>(column + 1));
    const double part = static_cast<double>(column) / 32.0;
    const glm::dquat turned =
        glm::normalize(begin.world_from_sensor * (1.0 - part) + end.world_from_sensor * part);
    const glm::dvec3 place = glm::mix(begin.position_world, end.position_world, part);
    const Returns there = scanned(world, {.t_s = 3.0, .begin = {place, turned}, .beams = some});
    const double then_s = 3.0 + 0.1 * (static_cast<double>(column * 4 / 32) + 0.5) / 4.0;
    const Returns then = scanned(world, {.t_s = then_s, .begin = begin, .beams = some});
    for (std::size_t n = 0; n < 16; ++n) {
      const LidarReturn& r = rolling[16 * column + n];
      EXPECT_TRUE(r.range_m == there[n].range_m || std::abs(r.range_m - there[n].range_m) < 1e-3f)
          << column << " " << n;
      EXPECT_EQ(moments[16 * column + n].range_m, then[n].range_m) << column << " " << n;
    }
  }
}

TEST(Lidar, NoiseAndLossesFollowFromSeedBeamAndTime) {
  scene::FloatingObject wall = fixed(scene::ObjectKind::kBox, {20.0, 0.0}, 10.0);
  wall.colour = glm::vec3(0.1f);
  const World world = calm_world({wall});
  const std::vector<LidarBeam> beams(20000);  // all straight ahead
  const auto scan = [&](double reach_m, double noise_m, std::uint64_t seed, double t_s) {
    return scanned(world, {.t_s = t_s,
                           .begin = {{0.0, 0.0, 1.0}},
                           .beams = beams,
                           .reach_m = reach_m,
                           .range_noise_m = noise_m,
                           .seed = seed});
  };
  const Returns noisy = scan(0.0, 0.03, 5, 1.0);
  double sum = 0.0, sum2 = 0.0;
  for (const LidarReturn& r : noisy) {
    const double off = static_cast<double>(r.range_m) - 15.0;
    sum += off, sum2 += off * off;
  }
  const auto count = static_cast<double>(beams.size());
  EXPECT_NEAR(sum / count, 0.0, 1e-3);
  EXPECT_NEAR(std::sqrt(sum2 / count), 0.03, 6e-4);
  EXPECT_TRUE(same_bits(scan(0.0, 0.03, 5, 1.0), noisy));
  EXPECT_FALSE(same_bits(scan(0.0, 0.03, 6, 1.0), noisy));
  EXPECT_FALSE(same_bits(scan(0.0, 0.03, 5, 1.5), noisy));
  // At 15 m a wall of reflectance 0.1 is at the threshold of a reach of 15 m.
  for (const auto& [reach_m, expected] : {std::pair(15.0, 0.5), std::pair(14.7, 0.3414)}) {
    int seen = 0;
    for (const LidarReturn& r : scan(reach_m, 0.0, 5, 1.0)) {
      seen += r.range_m < HUGE_VALF;
      EXPECT_EQ(r.id, r.range_m < HUGE_VALF ? kFirstObjectId : kSkyId);
    }
    EXPECT_NEAR(seen / count, expected, 0.012) << reach_m;
  }
}

TEST(Lidar, WaterAslantIsLostAndStraightDownIsSeen) {
  const World& world = shipped_world("open_ocean");
  const auto seen = [&](double elevation_rad) {
    std::vector<LidarBeam> beams;
    for (int n = 0; n < 400; ++n) beams.push_back({0.0157 * n, elevation_rad});
    int count = 0;
    for (const LidarReturn& r :
         scanned(world, {.begin = {{0.0, 0.0, 12.0}}, .beams = beams, .reach_m = 60.0}))
      count += r.range_m < HUGE_VALF;
    return count;
  };
  EXPECT_GT(seen(-0.49 * kPiRef), 200);
  EXPECT_LT(seen(-0.25), 100);
}

TEST(Lidar, TellsRangesBetweenItsBoundsAndObjectsWhereTheyArePut) {
  const World world = calm_world({fixed(scene::ObjectKind::kBox, {20.0, 0.0}, 4.0)});
  const std::vector<LidarBeam> ahead = {{0.0, 0.0}};
  const auto range = [&](double least_m, double most_m, std::vector<scene::GivenPose> poses = {}) {
    return scanned(world, {.begin = {{0.0, 0.0, 1.0}},
                           .beams = ahead,
                           .least_m = least_m,
                           .most_m = most_m,
                           .poses = poses})[0]
        .range_m;
  };
  EXPECT_NEAR(range(0.0, 100.0), 18.0, 1e-5);
  EXPECT_EQ(range(0.0, 17.9), HUGE_VALF);
  EXPECT_EQ(range(18.1, 100.0), HUGE_VALF);
  scene::GivenPose nearer;
  nearer.pose.position_world = {12.0, 0.0, 0.0};
  EXPECT_NEAR(range(0.0, 100.0, {nearer}), 10.0, 1e-5);
}

TEST(Lidar, UnderWaterNothingComesBack) {
  const auto beams = turn_of("vlp-16", 8);
  for (const LidarReturn& r : scanned(calm_world(), {.begin = {{0.0, 0.0, -1.0}}, .beams = beams}))
    EXPECT_EQ(r.range_m, HUGE_VALF);
}

TEST(LidarDeathTest, RefusesScansOutOfTheirRanges) {
  const World world = calm_world();
  const std::vector<LidarBeam> beams = {{0.0, 0.0}};
  const auto refuses = [&](const std::function<void(LidarScan&)>& spoil) {
    LidarScan scan{.beams = beams};
    spoil(scan);
    EXPECT_DEATH(scanned(world, scan, 1), "");
  };
  refuses([](LidarScan& s) { s.t_s = std::nan(""); });
  refuses([](LidarScan& s) { s.most_m = -1.0; });
  refuses([](LidarScan& s) { s.moments = 3; });
  refuses([](LidarScan& s) { s.begin.world_from_sensor = {2, 0, 0, 0}; });
}

}  // namespace
}  // namespace swell::render
