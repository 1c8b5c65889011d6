// The line where sea and land meet, as it is seen.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "render/labelled_frame.h"
#include "render/world/terrain_maps.h"
#include "render/world/world_state.h"

namespace swell::render {
namespace {

constexpr glm::ivec2 kSize_px(1280, 720);

double luma(std::uint32_t rgba) {
  const auto channel = [&](int shift) { return static_cast<double>(rgba >> shift & 255u); };
  return 0.2126 * channel(0) + 0.7152 * channel(8) + 0.0722 * channel(16);
}

// Marks what is at most `reach_px` from both water and land.
std::vector<char> mark_shore(const LabelledFrame& frame, int reach_px) {
  const glm::ivec2 size(frame.view.width_px, frame.view.height_px);
  const std::vector<std::uint32_t>& id = frame.labels().id;
  std::vector<char> near(id.size(), 0);
  for (int y = 1; y < size.y; ++y)
    for (int x = 1; x < size.x; ++x) {
      const std::uint32_t here = id[frame.at({x, y})];
      const auto meets = [&](std::uint32_t other) {
        return (here == kWaterId && other == kLandId) || (here == kLandId && other == kWaterId);
      };
      if (!meets(id[frame.at({x - 1, y})]) && !meets(id[frame.at({x, y - 1})])) continue;
      for (int v = std::max(y - reach_px, 0); v <= std::min(y + reach_px, size.y - 1); ++v)
        for (int u = std::max(x - reach_px, 0); u <= std::min(x + reach_px, size.x - 1); ++u)
          near[frame.at({u, v})] = 1;
    }
  return near;
}

// Pixels of water near the shore that are darker than each of their eight neighbours by a tenth,
// though they mirror nothing dark: a hill's image breaks up into small pieces at its edge.
int count_specks(const LabelledFrame& frame) {
  const std::vector<char> near = mark_shore(frame, 30);
  const auto luma_at = [&](int x, int y) { return luma(frame.target.rgba[frame.at({x, y})]); };
  int specks = 0;
  for (int y = 1; y + 1 < frame.view.height_px; ++y)
    for (int x = 1; x + 1 < frame.view.width_px; ++x) {
      const std::size_t at = frame.at({x, y});
      const bool mirrors = (frame.labels().flags[at] & kShowsMirrored) != 0;
      if (!near[at] || mirrors || frame.labels().id[at] != kWaterId) continue;
      double darkest = 255.0;
      for (int v = -1; v <= 1; ++v)
        for (int u = -1; u <= 1; ++u)
          if (u != 0 || v != 0) darkest = std::min(darkest, luma_at(x + u, y + v));
      specks += darkest - luma_at(x, y) > 25.0;
    }
  return specks;
}

// Pixels of water near the shore that show no floor.
int count_floorless(const LabelledFrame& frame) {
  const std::vector<char> near = mark_shore(frame, 30);
  int count = 0;
  for (std::size_t i = 0; i < near.size(); ++i)
    count += near[i] && frame.labels().id[i] == kWaterId &&
             (frame.labels().flags[i] & kShowsRefracted) == 0;
  return count;
}

View view_from(const scene::Scene& scene, glm::dvec3 eye, double heading_rad, double pitch_rad) {
  return make_view(eye, camera_axes(heading_rad, pitch_rad, 0.0),
                   lens_of_fov(scene.camera.fov_y_rad, kSize_px.x, kSize_px.y), 0.25f, kSize_px.x,
                   kSize_px.y);
}

constexpr std::array kDistortions = {0.06, 0.2, 0.5};

// ---- Lookups

class ShippedShores : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scenes, ShippedShores, testing::Values("beach", "lagoon"),
                         [](const auto& test) { return std::string(test.param); });

TEST_P(ShippedShores, HaveNoDarkSpecksHoweverFarLookupsAreMoved) {
  scene::Scene scene = load_shipped(GetParam());
  const scene::Camera& camera = scene.camera;
  const View view = view_from(scene, camera.eye_m, camera.heading_rad, camera.pitch_rad);
  for (const double distortion : kDistortions) {
    scene.water.distortion = distortion;
    const World world = world_of(scene);
    for (const double t_s : {0.0, 5.0, 23.0}) {
      const LabelledFrame frame(world, view, t_s);
      EXPECT_EQ(count_specks(frame), 0) << distortion << " " << t_s;
    }
  }
}

// The lagoon in a strong breeze, from where there is a floor under all of the water near the shore.
// Lookups that were moved onto dry land found nothing, and showed deep water in the shallows.
TEST(Lookups, ShowTheFloorOfShallowWaterHoweverSteepItsWaves) {
  scene::Scene scene = load_shipped("lagoon");
  scene.sea.wind_speed_mps = 12.0;
  scene.sea.amplitude_scale = 1.0;
  for (const double distortion : kDistortions) {
    scene.water.distortion = distortion;
    const World world = world_of(scene);
    const auto expect_floor = [&](const View& view, double t_s) {
      const LabelledFrame frame(world, view, t_s);
      EXPECT_EQ(count_floorless(frame), 0) << distortion;
      EXPECT_EQ(count_specks(frame), 0) << distortion;
    };
    expect_floor(view_from(scene, {178.2, 90.7, 2.5}, 4.24, -0.15), 3.7);
    expect_floor(view_from(scene, {-190.3, -61.5, 6.0}, 1.26, -0.15), 14.8);
  }
}

// Shallow water without foam, in the lower half of the picture, that is darker by a ninth than such
// water around it: means of 9 x 1 pixels against those of 91 x 31, at every third pixel.
int count_dashes(const LabelledFrame& frame) {
  const Labels& labels = frame.labels();
  const glm::ivec2 size(frame.view.width_px, frame.view.height_px);
  const auto is_bare = [&](std::size_t at) {
    return labels.id[at] == kWaterId && labels.foam[at] < 0.02f;
  };
  const auto mean = [&](glm::ivec2 middle, glm::ivec2 half) {
    const glm::ivec2 low = glm::max(middle - half, glm::ivec2(0));
    const glm::ivec2 high = glm::min(middle + half, size - 1);
    double sum = 0.0, count = 0.0;
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x)
        if (const std::size_t at = frame.at({x, y}); is_bare(at)) {
          sum += luma(frame.target.rgba[at]);
          ++count;
        }
    return sum / count;
  };
  int dashes = 0, looked = 0;
  frame.for_pixels(3, [&](glm::ivec2 p) {
    if (p.y < size.y / 2 || !is_bare(frame.at(p))) return;
    dashes += mean(p, {4, 0}) < 0.89 * mean(p, {45, 15});
    ++looked;
  });
  EXPECT_GT(looked, 1000);
  return dashes;
}

// Backs of waves mirrored a sea as dark as deep water beside bright sand: dark dashes, 400 in a
// frame.
TEST(Shallows, MirrorWaterAsBrightAsTheyAre) {
  const World& world = shipped_world("beach");
  const View view = view_from(world.scene(), {-150.0, -235.0, 2.5}, radians(20.0), radians(-12.0));
  for (const double t_s : {3.0, 7.0})
    EXPECT_EQ(count_dashes({world, view, t_s, {.edge_samples = 0}}), 0) << t_s;
}

// ---- Swash

// How water and the land that comes next to it in a row or a column, at about the same depth,
// differ: means over all such pairs and over red, green and blue.
struct Steps {
  double mean = 0.0;  // of the differences' sizes
  double bias = 0.0;  // size of the mean difference of each colour
};

Steps steps_at_shore(const LabelledFrame& frame) {
  const Labels& labels = frame.labels();
  Steps steps;
  std::array<double, 3> sums{};
  int pairs = 0;
  const auto compare = [&](std::size_t water, std::size_t land) {
    if (labels.id[water] != kWaterId || labels.id[land] != kLandId) return;
    const float depth_m = labels.depth_m[water];
    if (std::abs(depth_m - labels.depth_m[land]) > 0.1f * depth_m) return;
    ++pairs;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto channel = [&](std::size_t i) {
        return static_cast<double>(frame.target.rgba[i] >> 8 * k & 255u);
      };
      const double step = channel(water) - channel(land);
      steps.mean += std::abs(step);
      sums[k] += step;
    }
  };
  for (int y = 1; y < frame.view.height_px; ++y)
    for (int x = 1; x < frame.view.width_px; ++x)
      for (const glm::ivec2& before : {glm::ivec2(x - 1, y), glm::ivec2(x, y - 1)}) {
        compare(frame.at({x, y}), frame.at(before));
        compare(frame.at(before), frame.at({x, y}));
      }
  EXPECT_GT(pairs, 300);
  steps.mean /= 3.0 * pairs;
  for (const double sum : sums) steps.bias += std::abs(sum) / (3.0 * pairs);
  return steps;
}

// The sheets on the sand are the sea's water, with its ripples and its foam: one does not see where
// the one ends and the other begins. Ripples alone make neighbours differ by 2 to 9.
TEST(Swash, GoesOnWhereTheSeaEnds) {
  const World& world = shipped_world("beach");
  const scene::Camera& camera = world.scene().camera;
  const FrameOptions options = {.edge_samples = 0};  // which would blend the two
  for (const double t_s : {0.0, 3.0, 6.0, 9.0, 12.0}) {
    const auto expect_joined = [&](glm::dvec3 eye, double pitch_rad) {
      const View view = view_from(world.scene(), eye, camera.heading_rad, pitch_rad);
      const Steps steps = steps_at_shore({world, view, t_s, options});
      EXPECT_LT(steps.bias, 8.0) << t_s;
      EXPECT_LT(steps.mean, 15.0) << t_s;
    };
    expect_joined(camera.eye_m, camera.pitch_rad);
    expect_joined({-150.0, -235.0, 2.5}, -0.2);
    expect_joined({-100.0, -230.0, 80.0}, -1.4);
  }
}

// ---- The floor

// Mean square-root code of the ground's reflectance, red and green together, by height in steps of
// 0.1 m from 3 m below the water to 1 m over it.
std::vector<double> ground_codes(const World& world) {
  constexpr double kLow_m = -3.0, kStep_m = 0.1;
  constexpr int kSteps = 40;
  const terrain::HeightGrid& land = *world.state().terrain;
  const texture::RgbaImage& albedo = world.state().terrain_maps->albedo;
  const terrain::Grid texels{land.grid.min_world, land.grid.size_m() / albedo.width, albedo.width,
                             albedo.height};
  const std::vector<float> height_m = terrain::resample(land, texels).height_m;
  std::vector<double> sum(kSteps), count(kSteps);
  for (int y = 0; y < albedo.height; ++y)
    for (int x = 0; x < albedo.width; ++x) {
      const double above_m = height_m[static_cast<std::size_t>(y) * albedo.width + x] - kLow_m;
      const auto step = static_cast<std::size_t>(std::max(above_m / kStep_m, 0.0));
      if (above_m < 0.0 || step >= kSteps) continue;
      const std::uint32_t texel = albedo.texels[static_cast<std::size_t>(y) * albedo.stride + x];
      sum[step] += 0.5 * ((texel & 255u) + (texel >> 8 & 255u));
      ++count[step];
    }
  for (std::size_t k = 0; k < kSteps; ++k) sum[k] /= count[k];
  return sum;
}

// Once it did in one step at half a metre of depth, from wet sand to dry, which drew a line along
// every shore.
TEST(Floor, BrightensWithDepthLittleByLittle) {
  for (const char* name : {"beach", "lagoon"}) {
    const std::vector<double> code = ground_codes(shipped_world(name));
    for (std::size_t k = 1; k < code.size(); ++k)
      EXPECT_NEAR(code[k], code[k - 1], 12.0) << name << " " << k;
    const double darkest = *std::ranges::min_element(code);
    EXPECT_GT(code.front(), darkest + 10.0) << name;
    EXPECT_GT(code.back(), darkest + 10.0) << name;
  }
}

}  // namespace
}  // namespace swell::render
