// Whitecaps as pictures have them: how much of the sea they hide from near and far, what is asked
// of them, and that a frame alone is the frame of a sequence.
#include "ocean/open_sea/whitecaps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <vector>

#include "render/drawn_foam.h"
#include "render/sea/sea_maps.h"
#include "sky/sky_light.h"

namespace swell::render {
namespace {

scene::Scene open_sea(double wind_mps) {
  scene::Scene scene;
  scene.sea.wind_speed_mps = wind_mps;
  scene.sea.resolution = 64;
  scene.area.size_m = {40000.0, 40000.0};
  scene.detail.water_triangles = 4000;
  return scene;
}

// Over some seconds, of a view that holds the longest patch.
double mean_drawn_cover(const World& world, double height_m, int frames) {
  Shot film;
  double sum = 0.0;
  for (int k = 0; k < frames; ++k) {
    film.draw(world, from_above({0.0, 0.0}, height_m, 192), 30.0 + 3.0 * k,
              {.labels = LabelSet::all()});
    sum += mean_of(film.target.labels.foam);
  }
  return sum / frames;
}

struct Moments {
  double count = 0.0, sum = 0.0, squares = 0.0;
  void add(double value) {
    count += 1.0;
    sum += value;
    squares += value * value;
  }
  double mean() const { return sum / count; }
  double deviation() const { return std::sqrt(squares / count - mean() * mean()); }
};

// OPT-16: within 35 % of the law.
TEST(DrawnWhitecaps, CoverWhatTheWindSays) {
  for (const double wind : {6.0, 10.0, 15.0, 20.0}) {
    const World world = world_of(open_sea(wind));
    EXPECT_NEAR(mean_drawn_cover(world, 640.0, 6) / ocean::whitecap_cover(wind), 1.0, 0.35) << wind;
  }
}

// OPT-17.
TEST(DrawnWhitecaps, AreNoneBelow3Point7MetresASecond) {
  const World world = world_of(open_sea(3.6));
  EXPECT_EQ(mean_drawn_cover(world, 100.0, 1), 0.0);
}

// Maps of eight bits, their levels and lace: none loses foam or makes some.
TEST(DrawnWhitecaps, CoverAsMuchFromFarAsFromNear) {
  const World world = world_of(open_sea(12.0));
  const double expected = ocean::whitecap_cover(12.0);
  for (const double height_m : {1300.0, 3000.0, 8000.0})
    EXPECT_NEAR(mean_drawn_cover(world, height_m, 3) / expected, 1.0, 0.25) << height_m;
}

// The lace leaves the mean as it is: pictures against the library's answers at the same places.
TEST(DrawnWhitecaps, AreWhatIsAskedInTheMeanOverTheirLace) {
  for (const double height_m : {40.0, 120.0, 300.0}) {
    const FoamComparison c = compare_foam(open_sea(15.0), {0.0, 0.0}, height_m, 16);
    ASSERT_GT(c.asked / c.blocks, 0.005) << height_m;
    EXPECT_NEAR(c.drawn / c.asked, 1.0, 0.15) << height_m;
    // Lace as coarse as the blocks is noise to them; foam elsewhere than asked gives 0.
    EXPECT_GT(c.likeness(), 0.5) << height_m;
  }
}

// Two spots of foam, of which one lies on the map's corner.
ocean::WhitecapFrame::Patch spots() {
  constexpr std::size_t kSize = ocean::kFoamMapSize;
  ocean::WhitecapFrame::Patch patch;
  patch.before.assign(kSize * kSize, 3);  // too little to be seen
  patch.after = patch.before;
  patch.before[0] = 255;
  patch.after[100 * kSize + 77] = 12;
  return patch;
}

TEST(FoamBlocks, HoldAllThatSamplesOfTheirLevelsFind) {
  constexpr int kSize = ocean::kFoamMapSize;
  const ocean::WhitecapFrame::Patch patch = spots();
  std::vector<float> values(patch.before.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] =
        2.0f * std::max(ocean::foam_of_code(patch.before[i]), ocean::foam_of_code(patch.after[i])) -
        1.0f;
  texture::PackedMap1 map;
  texture::pack_map1(kSize, values, map);
  const FoamBlocks blocks = find_foam_blocks(patch);
  EXPECT_TRUE(blocks.are_few);
  int finding = 0;
  for (int level = 0; level <= FoamBlocks::kFinest; ++level)
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        const int side = kSize >> level;
        const std::uint32_t none = 0x81818181u;  // four times -127
        if (map.words[side * side + (y >> level) * side + (x >> level)] == none) continue;
        ++finding;
        EXPECT_EQ(blocks.row[y / 16] >> (x / 8) & 1, 1u) << x << " " << y << " " << level;
      }
  EXPECT_GE(finding, 2 * (4 + 16));
}

TEST(FoamBlocks, AreSetAroundFoamAlone) {
  const FoamBlocks blocks = find_foam_blocks(spots());
  int count = 0;
  for (const std::uint32_t row : blocks.row) count += std::popcount(row);
  EXPECT_LE(count, 2 * 3 * 2);
  ocean::WhitecapFrame::Patch full = spots();
  full.after.assign(full.after.size(), 200);
  EXPECT_FALSE(find_foam_blocks(full).are_few);
}

TEST(DrawnWhitecaps, AreTheSameInAFrameAloneAndInASequence) {
  const World world = world_of(open_sea(15.0));
  const View view = make_view({0.0, 0.0, 12.0}, 0.4, -0.15, 0.9, 0.25f, 96, 64);
  Shot film;
  for (const double t_s : {2.0, 2.1, 2.2, 2.3, 2.4, 9.0, 2.3})
    EXPECT_EQ(film.draw(world, view, t_s).rgba, Shot(world, view, t_s).target.rgba) << t_s;
}

TEST(DrawnWhitecaps, CanBeLeftOut) {
  scene::Scene scene = open_sea(15.0);
  const World with = world_of(scene);
  scene.sea.whitecaps = 0.0;
  const World without = world_of(scene);
  const View view = make_view({0.0, 0.0, 12.0}, 0.4, -0.15, 0.9, 0.25f, 96, 64);
  const Shot left_out(with, view, 2.0, {.without = {Part::kWhitecaps}});
  EXPECT_NE(Shot(with, view, 2.0).target.rgba, left_out.target.rgba);
  EXPECT_EQ(Shot(without, view, 2.0).target.rgba, left_out.target.rgba);
}

// A gale with foam at this place.
scene::Scene white_sea() {
  scene::Scene scene = open_sea(20.0);
  scene.sea.tiling = false;
  return scene;
}

// The light of pixels that foam hides all of, over that of level snow.
Moments light_of_whole_foam(const scene::Scene& scene) {
  const World world = world_of(scene);
  Shot film;
  Moments light_over_snow;
  for (int n = 0; n < 8; ++n) {
    const Target& target = film.draw(world, from_above({0.0, 0.0}, 60.0, 160), 30.0 + 5.0 * n,
                                     {.keep_linear = true, .labels = LabelSet::all()});
    const Light& light = film.state().shading.light;
    const double snow =
        0.8 * static_cast<double>(light.ambient.y + light.sun_irradiance.y * light.sun_direction.z /
                                                        std::numbers::pi_v<float>);
    for (std::size_t i = 0; i < target.labels.foam.size(); ++i)
      if (target.labels.foam[i] >= 0.99f)
        light_over_snow.add(static_cast<double>(target.linear[3 * i + 1]) / snow);
  }
  return light_over_snow;
}

// White foam in the sun is as bright as snow there, and no brighter.
TEST(DrawnWhitecaps, AreAsBrightAsSnow) {
  const Moments light = light_of_whole_foam(white_sea());
  ASSERT_GT(light.count, 50.0);
  EXPECT_GT(light.mean(), 0.55);
  EXPECT_LT(light.mean(), 1.1);
}

// Where foam hides all, lace and tears go on in it. After sunset, when slopes make no difference.
TEST(DrawnWhitecaps, HaveDepthInside) {
  scene::Scene scene = white_sea();
  scene.sky.sun_elevation_rad = -0.05;
  scene.sky.sun_direction =
      sky::sun_direction(scene.sky.sun_azimuth_rad, scene.sky.sun_elevation_rad);
  const Moments light = light_of_whole_foam(scene);
  ASSERT_GT(light.count, 50.0);
  EXPECT_GT(light.deviation() / light.mean(), 0.05);
}

// Water between and around foam is full of bubbles: brighter than the same water without.
TEST(DrawnWhitecaps, LieInWaterThatIsBrighterForTheirBubbles) {
  const World world = world_of(white_sea());
  Shot foamy, bare;
  int brighter = 0, darker = 0;
  for (int n = 0; n < 8; ++n) {
    const double t_s = 30.0 + 5.0 * n;
    const auto draw = [&](PartSet parts, Shot& film) -> const Target& {
      return film.draw(world, from_above({0.0, 0.0}, 20.0, 160), t_s,
                       {.keep_linear = true, .without = parts, .labels = LabelSet::all()});
    };
    const Target &with = draw({}, foamy), &without = draw({Part::kWhitecaps}, bare);
    for (std::size_t i = 0; i < with.labels.foam.size(); ++i) {
      if (with.labels.foam[i] > 0.0f) continue;
      const float change = with.linear[3 * i + 1] / without.linear[3 * i + 1];
      brighter += change > 1.05f;
      darker += change < 0.95f;
    }
  }
  EXPECT_GT(brighter, 100);
  EXPECT_LT(darker, 0.02 * brighter);  // glints
}

}  // namespace
}  // namespace swell::render
