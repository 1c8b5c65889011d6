// Figures of waves: what has to be where in them.
#include "tools/figures/wave_figures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <numbers>
#include <sstream>

namespace swell::apps {
namespace {

constexpr double kDeg = std::numbers::pi / 180.0;

int brightness(const texture::Image8& image, int x, int y) {
  const std::size_t at = 3 * (static_cast<std::size_t>(y) * image.width + x);
  return image.pixels[at] + image.pixels[at + 1] + image.pixels[at + 2];
}

TEST(WaveFilter, IsBrightestWhereTheWindBlowsToNearThePeak) {
  constexpr int kSize = 151;  // 6 k_m wide
  const ocean::WaveSystem wind = ocean::make_wind_sea(15.0, 240.0 * kDeg, 9.81);
  const texture::Image8 image = draw_filter(wind, kSize);
  int best_x = 0, best_y = 0;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x)
      if (brightness(image, x, y) > brightness(image, best_x, best_y)) best_x = x, best_y = y;
  const double east = best_x - 75.0, north = 75.0 - best_y;
  EXPECT_NEAR(std::atan2(east, north) / kDeg, 60.0, 4.0);
  EXPECT_NEAR(std::hypot(east, north) * 6.0 / kSize, 0.95, 0.1);  // k^-3/4 pulls it below k_m
  const auto opposite_x = 150 - best_x, opposite_y = 150 - best_y;
  EXPECT_LT(brightness(image, opposite_x, opposite_y), brightness(image, 75, 75) + 60);
}

// One wave to the east over a plane beach: depth = -x / 20 north and south alike.
class WaveFigures : public testing::Test {
 protected:
  static scene::Scene beach_scene() {
    return scene::parse_scene(
        "[sea]\nspectrum = false\nsize_m = [4000, 4000]\n"
        "[[sea.sines]]\namplitude_m = 1.0\nwavelength_m = 30.0\nto_deg = 90\n"
        "[terrain]\ncoast_m = [[0, -500], [0, 500]]\nbeach_slope = 0.05\n"
        "beach_size_m = 400.0\nfloor_depth_m = 8.0\n[coast]\nmodel = \"none\"\n",
        "beach.toml");
  }
  const scene::Water water_{beach_scene()};
  ocean::SeaFrame frame_;
  Workers workers_{1};
  const scene::WaterSurface surface_ = water_.at(0.0, frame_, workers_);
};

TEST_F(WaveFigures, TheMapHasLandInTheEastAndCrestsAWavelengthApart) {
  const texture::Image8 image =
      draw_map(surface_, water_.terrain(), {{0.0, 0.0}, 400.0, 400, {-1.0, 0.0}});
  const auto red = [&](int x) { return image.pixels[3 * (200u * 400u + x)]; };
  const auto blue = [&](int x) { return image.pixels[3 * (200u * 400u + x) + 2]; };
  for (int x = 210; x < 400; ++x) EXPECT_GT(red(x), blue(x)) << x;
  // Pixels are metres; 150 of them hold five waves, which are dark for half a length each.
  int rises = 0;
  for (int x = 11; x < 160; ++x) rises += red(x - 1) < 34 && red(x) >= 34;  // deep water's red
  EXPECT_EQ(rises, 5);
}

// The points of the surface's line, in pixels.
std::vector<glm::dvec2> surface_line(const std::string& svg) {
  const std::string before = "points=\"";
  const std::size_t first = svg.find(before, svg.find("<polyline")) + before.size();
  std::istringstream text(svg.substr(first, svg.find('"', first) - first));
  std::vector<glm::dvec2> points;
  glm::dvec2 p;
  char comma = ',';
  while (text >> p.x >> comma >> p.y) points.push_back(p);
  return points;
}

TEST_F(WaveFigures, TheSectionIsTrueToItsScale) {
  const std::string svg =
      draw_section(surface_, nullptr, {-190.0, 0.0}, {-100.0, 0.0}, "waves & <floor>");
  EXPECT_NE(svg.find("waves &amp; &lt;floor>"), std::string::npos);
  EXPECT_NE(svg.find("heights x 9.8"), std::string::npos) << svg.substr(0, 600);
  const std::vector<glm::dvec2> line = surface_line(svg);
  ASSERT_GT(line.size(), 500u);
  const auto [lowest, highest] = std::ranges::minmax(line, {}, &glm::dvec2::y);
  // 2 m and twice 0.16 m of margin are 228 px high; 90 m are 900 px wide.
  EXPECT_NEAR(highest.y - lowest.y, 228.0 * 2.0 / 2.32, 0.5);
  EXPECT_NEAR(line.back().x - line.front().x, 900.0, 0.1);
  int crossings = 0;
  const double middle = 0.5 * (lowest.y + highest.y);
  for (std::size_t i = 1; i < line.size(); ++i)
    crossings += (line[i - 1].y < middle) != (line[i].y < middle);
  EXPECT_NEAR(crossings, 6, 1);  // three wavelengths, the ends may lie on the middle
}

}  // namespace
}  // namespace swell::apps
