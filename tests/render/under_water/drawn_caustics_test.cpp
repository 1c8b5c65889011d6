// Caustics in pictures: on the floor that is seen through the water, under the waves that are
// drawn.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "render/measures.h"
#include "render/shot.h"
#include "render/under_water/flat_floor.h"
#include "scene/water.h"

namespace swell::render {
namespace {

constexpr double kCausticsEye_m = 4.0;
constexpr int kCausticsSize_px = 128;

class DrawnCaustics : public FlatFloor {
 protected:
  scene::Scene shallow_water(double depth_m, double waves) const {
    scene::Scene scene = flat_floor(depth_m, waves);
    scene.detail.water_triangles = scene.detail.terrain_triangles = 2000;
    return scene;
  }
};

View looking_down() {
  return make_view({0.0, 0.0, kCausticsEye_m}, 0.0, -0.5 * std::numbers::pi, 0.5, 0.25f,
                   kCausticsSize_px, kCausticsSize_px);
}

Target draw(const World& world, double t_s, PartSet without = {}) {
  return Shot(world, looking_down(), t_s, {.keep_linear = true, .without = without}).target;
}

// What caustics add to the green light of each pixel, in parts of the mean without them.
std::vector<double> added_light(const World& world, double t_s) {
  const std::vector<float> with = green_light(draw(world, t_s)),
                           without = green_light(draw(world, t_s, {Part::kCaustics}));
  std::vector<double> added(with.begin(), with.end());
  double mean = 0.0;
  for (std::size_t i = 0; i < added.size(); ++i) {
    added[i] -= without[i];
    mean += static_cast<double>(without[i]) / (kCausticsSize_px * kCausticsSize_px);
  }
  for (double& x : added) x /= mean;
  return added;
}

double deviation(const std::vector<double>& a) {
  double sum = 0.0, squares = 0.0;
  for (const double x : a) sum += x, squares += x * x;
  const auto n = static_cast<double>(a.size());
  return std::sqrt(squares / n - sum * sum / (n * n));
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  double sum_a = 0.0, sum_b = 0.0, both = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum_a += a[i], sum_b += b[i], both += a[i] * b[i];
  const auto n = static_cast<double>(a.size());
  return (both / n - sum_a * sum_b / (n * n)) / (deviation(a) * deviation(b));
}

// The places of the floor that the pixels show: Snell's law for a level surface.
std::vector<glm::dvec2> places_on_floor(double depth_m) {
  const View view = looking_down();
  std::vector<glm::dvec2> places;
  for (int y = 0; y < kCausticsSize_px; ++y) {
    for (int x = 0; x < kCausticsSize_px; ++x) {
      const glm::dvec3 ray = glm::normalize(
          glm::dvec3(view.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f)));
      const double sine = std::hypot(ray.x, ray.y), below = sine / 1.333;
      const double away_m =
          kCausticsEye_m * sine / -ray.z + depth_m * below / std::sqrt(1 - below * below);
      places.push_back(sine > 0.0 ? glm::dvec2(ray) / sine * away_m : glm::dvec2(0.0));
    }
  }
  return places;
}

// Returns minus the sea's Laplacian over the places, times 0.12 m, by the library's own slopes.
std::vector<double> minus_laplacian(const scene::Scene& scene, double t_s,
                                    const std::vector<glm::dvec2>& places) {
  constexpr double kStep_m = 0.06;
  const scene::Water water(scene);
  Workers workers(1);
  ocean::SeaFrame sea;
  ocean::advance(water.sea(), t_s, sea, workers);
  std::vector<double> result(places.size(), 0.0);
  for (const double sign : {1.0, -1.0}) {
    for (const int axis : {0, 1}) {
      std::vector<glm::dvec2> moved = places;
      for (glm::dvec2& p : moved) p[axis] += sign * kStep_m;
      std::vector<float> slope_x(places.size()), slope_y(places.size());
      ocean::sample_slopes(sea, moved, slope_x, slope_y);
      const std::vector<float>& slope = axis == 0 ? slope_x : slope_y;
      for (std::size_t i = 0; i < places.size(); ++i)
        result[i] -= sign * static_cast<double>(slope[i]);
    }
  }
  return result;
}

TEST_F(DrawnCaustics, LieUnderTheBendsOfTheDrawnSea) {
  const double depth_m = 0.5, t_s = 7.0;
  const scene::Scene scene = shallow_water(depth_m, 0.3);
  const World world = world_of(scene);
  const std::vector<double> added = added_light(world, t_s);
  EXPECT_GT(deviation(added), 0.01);
  EXPECT_GT(correlation(added, minus_laplacian(scene, t_s, places_on_floor(depth_m))), 0.9);
  // Not those of another time.
  EXPECT_LT(std::abs(correlation(added, minus_laplacian(scene, 9.0, places_on_floor(depth_m)))),
            0.3);
}

TEST_F(DrawnCaustics, OfAnotherSeedAreOthers) {
  scene::Scene scene = shallow_water(2.0, 0.6);
  const World world = world_of(scene);
  scene.sea.seed = 77;
  const World other = world_of(scene);
  const std::vector<double> here = added_light(world, 3.0), there = added_light(other, 3.0);
  EXPECT_GT(deviation(here), 0.05);
  EXPECT_GT(deviation(there), 0.05);
  EXPECT_LT(std::abs(correlation(here, there)), 0.3);
}

// Contrast rises with depth to the focus of the waves and falls beyond it.
TEST_F(DrawnCaustics, HaveMostContrastAtSomeDepth) {
  std::vector<double> contrast;
  for (const double depth_m : {0.05, 1.5, 12.0}) {
    scene::Scene scene = shallow_water(depth_m, 0.6);
    scene.sea.patch_lengths_m = {23.0, 5.3};  // the longer one's tiles differ: it has no maps
    const World world = world_of(scene);
    contrast.push_back(deviation(added_light(world, 3.0)));
  }
  EXPECT_GT(contrast[1], 0.1);
  EXPECT_LT(contrast[0], 0.3 * contrast[1]);
  EXPECT_LT(contrast[2], 0.5 * contrast[1]);
}

TEST_F(DrawnCaustics, AreThoseOfAWholeLoopBefore) {
  scene::Scene scene = shallow_water(2.0, 0.6);
  scene.sea.loop_s = 20.0;
  const World world = world_of(scene);
  const std::uint64_t first = picture_hash(draw(world, 3.0));
  EXPECT_EQ(picture_hash(draw(world, 23.0)), first);
  EXPECT_NE(picture_hash(draw(world, 13.0)), first);
}

// The root mean square by which pixels differ from the mean of those to their left and right.
double grain(const World& world, const View& view) {
  const std::vector<float> light =
      green_light(Shot(world, view, 3.0, {.keep_linear = true}).target);
  double squares = 0.0, count = 0.0;
  for (int y = 0; y < view.height_px; ++y)
    for (int x = 1; x + 1 < view.width_px; ++x) {
      const float* const at = light.data() + y * view.width_px + x;
      const auto by = static_cast<double>(at[0] - 0.5f * (at[-1] + at[1]));
      squares += by * by;
      count += 1.0;
    }
  return std::sqrt(squares / count);
}

// Through waves neighbouring pixels look past each other. What is finer than that would be noise,
// ten times as grainy as the floor is through level water.
TEST_F(DrawnCaustics, OfAFarFloorAreNoNoise) {
  const View far = make_view({0.0, 0.0, kCausticsEye_m}, 0.0, -0.25, 0.9, 0.25f, 960, 540);
  scene::Scene scene = shallow_water(2.0, 0.6);
  const World level = world_of(scene);
  scene.water.distortion = 1.0;
  const World bent = world_of(scene);
  EXPECT_LT(grain(bent, far), 3.0 * grain(level, far));
}

TEST_F(DrawnCaustics, OfNoContrastAreNone) {
  scene::Scene scene = shallow_water(2.0, 0.6);
  const World world = world_of(scene);
  scene.water.caustics = 0.0;
  const World without = world_of(scene);
  const std::uint64_t plain = picture_hash(draw(without, 3.0));
  EXPECT_EQ(picture_hash(draw(world, 3.0, {Part::kCaustics})), plain);
  EXPECT_NE(picture_hash(draw(world, 3.0)), plain);
}

}  // namespace
}  // namespace swell::render
