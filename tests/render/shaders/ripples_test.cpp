// The ripples, which are finer than any triangle: they drift, loop with the sea and die with the
// wind.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "ocean/water_surface.h"
#include "render/drawn_water.h"

namespace swell::render {
namespace {

constexpr double kRipplesEye_m = 4.0;

// ---- In a sea that loops

scene::Scene looping_scene(double loop_s) {
  scene::Scene scene = shading_scene(kRipplesEye_m);
  scene.sea.loop_s = loop_s;
  return scene;
}

TEST(Ripples, LoopWithTheSea) {
  const World like = world_of(shading_scene(kRipplesEye_m));
  for (const double loop_s : {1.0, 10.0, 7.25, 1200.0}) {
    const World world(looping_scene(loop_s), like, 1);
    const DrawnWater first(world, 0.125);
    DrawnWater again;
    for (const double loops : {1.0, 2.0, -1.0, 1e6}) {
      again.draw_small(world, 0.125 + loops * loop_s);
      EXPECT_EQ(again.target.rgba, first.target.rgba) << loop_s << " " << loops;
    }
    again.draw_small(world, 0.125 + 0.375 * loop_s);
    EXPECT_NE(again.target.rgba, first.target.rgba) << loop_s;
  }
}

// How far a layer's map has drifted from the time 0 to t_s, in periods: the shorter way round.
std::vector<glm::dvec2> drift_periods(const World& world, double t_s) {
  const DrawnWater before(world, 0.0), after(world, t_s);
  std::vector<glm::dvec2> drift;
  for (int i = before.water().first_ripples; i < before.water().layer_count; ++i) {
    const SlopeLayer &from = before.water().layers[i], &to = after.water().layers[i];
    const double map_fx8 = 256.0 * from.map->size;
    const glm::dvec2 moved(from.x_eye_fx8 - to.x_eye_fx8, from.y_eye_fx8 - to.y_eye_fx8);
    drift.push_back(moved / map_fx8 - glm::round(moved / map_fx8));
  }
  return drift;
}

// Whole periods a loop, within half a period of what they would be; but a layer that would move by
// less than that has one period.
TEST(Ripples, DriftByTheNearestWholePeriodsOfALoop) {
  const World free = world_of(shading_scene(kRipplesEye_m));
  for (const double loop_s : {1.0, 7.25, 20.0, 100.0}) {
    const World looping(looping_scene(loop_s), free, 1);
    const double part = 1.0 / 256.0;  // of a loop
    const auto drift = drift_periods(looping, part * loop_s),
               free_drift = drift_periods(free, part * loop_s);
    ASSERT_EQ(drift.size(), 2u);
    for (std::size_t i = 0; i < drift.size(); ++i) {
      const glm::dvec2 whole = drift[i] / part, wanted = free_drift[i] / part;
      const double slack = 1e-4;
      for (const int axis : {0, 1}) {
        EXPECT_NEAR(whole[axis], std::round(whole[axis]), slack) << loop_s << " " << i;
        const bool is_slow = std::max(std::abs(wanted.x), std::abs(wanted.y)) < 0.5;
        EXPECT_LE(std::abs(whole[axis] - wanted[axis]), (is_slow ? 1.0 : 0.5) + slack) << loop_s;
      }
      EXPECT_GE(glm::length(whole), 1.0 - slack) << loop_s << " " << i;
    }
  }
}

// ---- Under little wind

// Slope variance of all that is finer than the sea's own waves, both axes together.
double ripple_variance(const Water& water) {
  double variance = water.base_variance;
  for (int i = water.first_ripples; i < water.layer_count; ++i) {
    const SlopeLayer& layer = water.layers[i];
    variance += static_cast<double>(layer.map->lost_variance.back()) * layer.gain * layer.gain;
  }
  return variance;
}

double ripple_variance(double wind_mps) {
  scene::Scene scene = shading_scene(kRipplesEye_m);
  scene.sea.wind_speed_mps = wind_mps;
  const World world = world_of(scene);  // whose maps the drawn water refers to
  return ripple_variance(DrawnWater(world, 0.0).water());
}

TEST(Ripples, LeaveASeaWithoutWindAsGlass) {
  const double glass = ripple_variance(0.0);
  EXPECT_LE(glass, 1e-4);
  // The sun's disc, half a degree across, has slopes within 0.0023: a narrower glint would be
  // brighter than the disc itself.
  EXPECT_GE(glass, 0.5 * 0.0023 * 0.0023);
}

TEST(Ripples, GrowWithTheWind) {
  double before = 0.0;
  for (const double wind : {0.0, 0.05, 0.2, 0.5, 0.8, 0.999, 1.0, 1.5, 3.0, 8.0, 20.0, 60.0}) {
    const double variance = ripple_variance(wind);
    EXPECT_GT(variance, before) << wind;
    before = variance;
  }
}

// Slopes of all sizes together have Cox and Munk's variance, within the scatter of their values.
TEST(Ripples, MakeUpWhatTheWavesLeaveOfTheSeasSlopes) {
  for (const double wind : {1.0, 2.0, 5.0, 8.0, 11.0, 14.0}) {
    scene::Scene scene = shading_scene(kRipplesEye_m);
    scene.sea.wind_speed_mps = wind;
    scene.sea.resolution = 128;
    const World world = world_of(scene);
    const DrawnWater drawn(world, 0.0);
    double variance = ripple_variance(drawn.water());
    for (const ocean::PatchFrame& patch : drawn.state().sea->frame.patches)
      variance += static_cast<double>(patch.slope_variance);
    EXPECT_NEAR(variance, 0.003 + 0.00512 * wind, 0.004) << wind;
  }
}

}  // namespace
}  // namespace swell::render
