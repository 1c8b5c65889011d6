// How ripples move what water shows, by formula (9) and the formulas of glitter that the paper ties
// to the same normal map. Source: Ma, Zhu, Gong, 2006:
//   T' = T + C0 T N   reflection and refraction, each axis by itself
//   T' = T + Cp N     projected glitter
// with T the place in the picture and N the normal's parts to the right and away from the eye. (Of
// caustics, T' = T + Cc N: caustic_bend_test.cpp.)
#include <gtest/gtest.h>

#include <cmath>
#include <deque>

#include "render/drawn_water.h"
#include "render/shaders/optics_kernels.h"

namespace swell::render {
namespace {

constexpr glm::ivec2 kRuler_px(256, 250);
constexpr double kC0 = 0.4, kFovY_deg = 50.0;
constexpr float kHeading_deg = 35.0f;

// A picture whose red says where a texel is from the left, and its green where it is from the top.
struct Ruler {
  Ruler() {
    texture::resize_image(kRuler_px.x, kRuler_px.y, image);
    for (int y = 0; y < kRuler_px.y; ++y)
      for (int x = 0; x < kRuler_px.x; ++x)
        image.texels[static_cast<std::size_t>(y * image.stride + x)] =
            0xff000000u | static_cast<std::uint32_t>(y) << 8 | static_cast<std::uint32_t>(x);
    texture::fill_padding(image);
  }

  // Of light x, whose code is 255 sqrt(x / (x + 1)).
  static double code(double light) { return 255.0 * std::sqrt(light / (light + 1.0)); }

  texture::RgbaImage image;
};

// Water whose lookups are the paper's, or bounded, as a camera that is level and rolled by `roll`
// looks at it.
Shot seen_water(scene::DistortionFactor factor, double roll_deg = 0.0) {
  scene::Scene scene = shading_scene(3.0);
  scene.water.distortion = kC0;
  scene.water.distortion_factor = factor;
  View view = make_view({0.0, 0.0, 3.0}, radians(kHeading_deg), 0.0, radians(kFovY_deg), 0.25f,
                        kRuler_px.x, kRuler_px.y);
  const auto c = static_cast<float>(std::cos(radians(roll_deg))),
             s = static_cast<float>(std::sin(radians(roll_deg)));
  const glm::vec3 right = view.right, up = view.up;
  view.right = c * right - s * up;
  view.up = c * up + s * right;
  static std::deque<World> worlds;
  worlds.push_back(world_of(scene));
  return Shot(worlds.back(), view, 0.0);
}

const Water& water_of(const Shot& shot) { return shot.state().shading.material<Water>(); }

// By how much a lookup moves, in pixels to the right and up, of a normal that leans by n: to the
// right, and away from the eye.
glm::dvec2 moved_px(const Water& water, glm::dvec2 n, double below_horizon_px, float sign) {
  const Ruler ruler;
  const PlanarMap map{&ruler.image};
  // The ray's, through the middle of the picture's width.
  const double per_tan = 0.5 * kRuler_px.y / std::tan(0.5 * radians(kFovY_deg));
  const double turn = std::atan(below_horizon_px / per_tan), heading = radians(kHeading_deg);
  const glm::dvec2 right(std::cos(heading), -std::sin(heading)),
      ahead(std::sin(heading), std::cos(heading));
  const glm::vec2 slope(-n.x * right - n.y * ahead);
  const glm::vec2 at(127.5f, 124.5f + static_cast<float>(below_horizon_px));
  const DistortedLookUp lookup{at, slope, static_cast<float>(std::sin(turn)), sign};
  glm::vec3 light;
  look_up_distorted(water, map, std::span(&lookup, 1), std::span(&light, 1));
  const glm::dvec2 code(Ruler::code(light.x), Ruler::code(light.y));
  return {code.x - lookup.at_px.x, lookup.at_px.y - code.y};
}

// The sine of the ray's angle stands for its tangent: 2 % here.
TEST(FormulaNine, MovesEachAxisByC0TimesThePlaceTimesTheNormalsPart) {
  const Shot shot = seen_water(scene::DistortionFactor::kPaper);
  for (const double below_px : {20.0, 50.0})
    for (const glm::dvec2& n : {glm::dvec2(0.3, 0.0), {0.0, 0.3}, {-0.2, 0.25}, {0.25, -0.3}})
      for (const float sign : {1.0f, -1.0f}) {
        const glm::dvec2 moved = moved_px(water_of(shot), n, below_px, sign);
        const glm::dvec2 formula = static_cast<double>(sign) * kC0 * below_px * n;
        EXPECT_NEAR(moved.x, formula.x, 0.1 + 0.03 * std::abs(formula.x)) << below_px << ' ' << n.x;
        EXPECT_NEAR(moved.y, formula.y, 0.1 + 0.03 * std::abs(formula.y)) << below_px << ' ' << n.y;
      }
}

// What the paper wants of the factor: far things, which are few pixels, hold together. Things at
// the horizon do not move at all.
TEST(FormulaNine, LeavesTheHorizonAsItIs) {
  const Shot paper = seen_water(scene::DistortionFactor::kPaper);
  const glm::dvec2 moved = moved_px(water_of(paper), {0.3, 0.3}, 0.0, 1.0f);
  EXPECT_NEAR(moved.x, 0.0, 0.1);
  EXPECT_NEAR(moved.y, 0.0, 0.1);
  const Shot bounded = seen_water(scene::DistortionFactor::kBounded);
  EXPECT_GT(moved_px(water_of(bounded), {0.3, 0.3}, 0.0, 1.0f).y, 2.0);
}

// Half as far to the side.
TEST(BoundedDistortion, MovesBySixTimesTheSineUpAndDownAndByHalfOfThatToTheSide) {
  const Shot shot = seen_water(scene::DistortionFactor::kBounded);
  const double per_tan = 0.5 * kRuler_px.y / std::tan(0.5 * radians(kFovY_deg));
  const double sine = std::sin(std::atan(20.0 / per_tan));
  const glm::dvec2 n(0.08, -0.05);
  const glm::dvec2 moved = moved_px(water_of(shot), n, 20.0, 1.0f);
  const double gain_px = kC0 * kRuler_px.y * 6.0 * sine;
  EXPECT_NEAR(moved.x, 0.5 * gain_px * n.x, 0.1);
  EXPECT_NEAR(moved.y, gain_px * n.y, 0.1);
}

// A camera on its side has the world's right below or above.
TEST(FormulaNine, TurnsWithTheCamera) {
  const glm::dvec2 n(0.2, 0.1);
  const Shot level = seen_water(scene::DistortionFactor::kPaper);
  const glm::dvec2 upright = moved_px(water_of(level), n, 30.0, 1.0f);
  for (const double roll_deg : {30.0, -50.0}) {
    const Shot shot = seen_water(scene::DistortionFactor::kPaper, roll_deg);
    const glm::dvec2 moved = moved_px(water_of(shot), n, 30.0, 1.0f);
    EXPECT_NEAR(glm::length(moved), glm::length(upright), 0.15) << roll_deg;
    const double angle = std::atan2(upright.x * moved.y - upright.y * moved.x,
                                    upright.x * moved.x + upright.y * moved.y);
    EXPECT_NEAR(angle, radians(roll_deg), 0.03) << roll_deg;
  }
}

// The middle of what is thrown lies where the eye's ray meets the picture at -Cp N.
TEST(ProjectedGlitter, MovesByCpTimesTheNormalOnBothAxes) {
  scene::Scene scene = shading_scene(3.0);
  scene.water.glitter = scene::Glitter::kProjective;
  const World world = world_of(scene);
  const DrawnWater drawn(world, 0.0);
  Glitter glitter = drawn.water().glitter;
  ASSERT_NE(glitter.sun_texture, nullptr);
  const glm::dvec3 right(glitter.right), up(glitter.up), ahead(glitter.ahead);
  const glm::dvec2 away(-right.y, right.x);
  for (const float cp : {1.0f, 2.0f})
    for (const glm::dvec2& n : {glm::dvec2(0.0), {0.05, 0.0}, {0.0, 0.05}, {-0.06, 0.03}}) {
      glitter.per_slope = cp;
      glm::dvec2 sum(0.0);
      double light_sum = 0.0;
      for (int j = -60; j <= 60; ++j)
        for (int i = -60; i <= 60; ++i) {
          const glm::dvec2 at(0.01 * i, 0.01 * j);  // of the ray from the eye, at distance 1
          const glm::vec3 to_eye(-glm::normalize(ahead + at.x * right + at.y * up));
          const glm::dvec2 level(n.x * glm::dvec2(right) + n.y * away);
          const glm::vec3 normal(level, std::sqrt(1.0 - glm::dot(level, level)));
          float light = 0.0f;
          projected_glitter(glitter, std::span(&to_eye, 1), normal, 0.002f, std::span(&light, 1));
          sum += static_cast<double>(light) * at;
          light_sum += static_cast<double>(light);
        }
      ASSERT_GT(light_sum, 0.0);
      const glm::dvec2 middle = sum / light_sum, formula = -static_cast<double>(cp) * n;
      EXPECT_NEAR(middle.x, formula.x, 0.003) << cp << ' ' << n.x;
      EXPECT_NEAR(middle.y, formula.y, 0.003) << cp << ' ' << n.y;
    }
}

}  // namespace
}  // namespace swell::render
