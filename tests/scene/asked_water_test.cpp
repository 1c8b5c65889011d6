// Water whose wakes are made when they are asked answers as water whose wakes are made at once.
#include <gtest/gtest.h>

#include <vector>

#include "math/random.h"
#include "ocean/below_frame.h"
#include "ocean/coast/train_square.h"
#include "ocean/velocity.h"
#include "ocean/water_rays.h"
#include "scene/scene.h"
#include "scene/water.h"

namespace swell::scene {
namespace {

// Hulls beside a shore, which keeps their waves from the land.
Scene busy_scene() {
  Scene scene;
  scene.sea.resolution = 64;
  scene.terrain.emplace();
  scene.terrain->coast_m = {{-600.0, 40.0}, {600.0, 40.0}};
  scene.terrain->beach_size_m = 400.0;
  ocean::Disturbance hull;
  hull.kind = ocean::DisturbanceKind::kHull;
  hull.path_m = {{-60.0, 0.0}, {40.0, 20.0}, {0.0, -40.0}};
  scene.disturbances.push_back(hull);
  hull.path_m = {{200.0, -100.0}, {260.0, -60.0}, {200.0, -20.0}};
  hull.hull_m = {1.8, 5.2, 0.4};
  scene.disturbances.push_back(hull);
  return scene;
}

constexpr double kBusy_s = 12.5;

// All that can be asked of it.
struct AllAnswers {
  std::vector<float> height_m, foam;
  std::vector<glm::vec2> slope;
  std::vector<glm::vec3> velocity_mps, motion_mps;
  std::vector<double> hit_m, met_m;
  bool operator==(const AllAnswers&) const = default;
};

class AskedWater : public testing::TestWithParam<bool> {
 protected:
  AllAnswers ask(ocean::MakeWakes when) const {
    const Water water(scene_);
    Workers workers(2);
    ocean::SeaFrame frame;
    const WaterSurface surface = water.at(kBusy_s, frame, workers, {}, when);
    AllAnswers answers;
    if (GetParam()) {  // before anything else has made the wakes
      ask_motions(water, surface, frame, answers, workers);
      ask_rays(water, surface, frame, answers);
    }
    answers.height_m.resize(points_.size()), answers.foam.resize(points_.size());
    answers.slope.resize(points_.size());
    surface.heights(points_, answers.height_m);
    surface.slopes(points_, answers.slope);
    ocean::WhitecapFrame whitecaps;
    const auto foam = ocean::make_whitecaps(water.sea(), water.coast(), workers);
    ocean::advance_whitecaps(foam, kBusy_s, whitecaps, workers);
    surface.foam(points_, whitecaps, answers.foam);
    if (!GetParam()) ask_motions(water, surface, frame, answers, workers);
    return answers;
  }

 private:
  void ask_motions(const Water& water, const WaterSurface& surface, const ocean::SeaFrame& frame,
                   AllAnswers& answers, Workers& workers) const {
    ocean::VelocityFrame velocity;
    ocean::advance_velocity(water.sea(), frame, velocity, workers);
    answers.velocity_mps.resize(points_.size());
    surface.velocities(points_, velocity, answers.velocity_mps);
    ocean::BelowFrame below;
    ocean::begin_below(water.sea(), frame, &velocity, below);
    std::vector<glm::dvec3> deep;
    for (std::size_t n = 0; n < 200; ++n)
      deep.emplace_back(points_[n], -0.02 * static_cast<double>(n));
    std::vector<ocean::WaterMotion> motion(deep.size());
    surface.motions(deep, {}, ocean::kSeaDensity_kg_m3, below, workers, motion);
    for (const ocean::WaterMotion& m : motion)
      for (const glm::vec3& v : {m.velocity_mps, m.acceleration_mps2, glm::vec3(m.pressure_pa)})
        answers.motion_mps.push_back(v);
  }

  void ask_rays(const Water& water, const WaterSurface& surface, const ocean::SeaFrame& frame,
                AllAnswers& answers) const {
    std::vector<glm::dvec3> from, along;
    for (std::size_t n = 0; n < 200; ++n) {
      from.emplace_back(points_[n], 9.0);
      along.push_back(glm::normalize(glm::dvec3(0.3, 0.8, -0.4)));
      const auto hit = surface.intersect(from[n], along[n], 100.0);
      answers.hit_m.push_back(hit ? hit->distance_m : -1.0);
    }
    const std::vector<double> far_m(from.size(), 100.0);
    answers.met_m.resize(from.size());
    const ocean::WaterParts parts{&water.sea(),  scene_.area, water.terrain(),
                                  water.coast(), {},          water.shelter()};
    ocean::meet_water(surface, ocean::frame_bounds(parts, frame, {}), {from, along, far_m},
                      answers.met_m);
  }

  Scene scene_ = busy_scene();
  std::vector<glm::dvec2> points_ = [] {
    std::vector<glm::dvec2> p;
    for (std::uint64_t n = 0; n < 3000; ++n)
      p.push_back(
          {60.0 * (random_uniform(7, 2 * n) - 0.5), 60.0 * (random_uniform(7, 2 * n + 1) - 0.5)});
    return p;
  }();
};

TEST_P(AskedWater, HasTheBitsOfWaterThatIsMadeAtOnce) {
  EXPECT_EQ(ask(ocean::MakeWakes::kWhenAsked), ask(ocean::MakeWakes::kNow));
}

INSTANTIATE_TEST_SUITE_P(WithWavesBelowFirstOrLast, AskedWater, testing::Bool());

}  // namespace
}  // namespace swell::scene
