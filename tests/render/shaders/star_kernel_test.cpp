// The stars: how many, how bright, and that a picture's pixels do not change their light.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/shaders/shader_kernels.h"
#include "texture/on_every_target.h"

namespace swell::render {
namespace {

class StarKernel : public texture::OnEveryTarget {};
INSTANTIATE_TEST_SUITE_P(Targets, StarKernel, texture::every_target(), texture::target_name);

// Directions on a fine grid about the zenith, where air takes the same of all.
struct Patch {
  explicit Patch(double half_m, int points) : side(points), step(2.0 * half_m / points) {
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i)
        directions.push_back(
            glm::normalize(glm::vec3((i + 0.5) * step - half_m, (j + 0.5) * step - half_m, 1.0)));
  }
  std::vector<float> see(const Stars& stars, float radius) const {
    std::vector<glm::vec3> light(directions.size());
    star_light(stars, directions, radius, light);
    std::vector<float> green;
    for (const glm::vec3& x : light) green.push_back(x.y);
    return green;
  }
  int side;
  double step;
  std::vector<glm::vec3> directions;
};

Stars stars_of_brightness(float brightness) {
  Stars stars;
  stars.on = true;
  stars.brightness = brightness;
  return stars;
}

double sum_of(const std::vector<float>& values) {
  double sum = 0.0;
  for (const float x : values) sum += x;
  return sum;
}

// The light of all does not depend on how wide their spots are.
TEST_P(StarKernel, LightIsThatOfTheStars) {
  const Patch patch(0.1, 1000);
  const Stars stars = stars_of_brightness(1.0f);
  const double narrow = sum_of(patch.see(stars, 6e-4f)), wide = sum_of(patch.see(stars, 1.6e-3f));
  ASSERT_GT(narrow, 0.0);
  EXPECT_NEAR(wide / narrow, 1.0, 0.02);
  // So many stars have the sphere's 4 pi / 5400 each; the mean of rank^(-0.4/0.51) is
  // near 3.5, that of so few anything about it.
  const double light = narrow * patch.step * patch.step * std::exp(0.23 / 1.03);
  const double expected = 0.04 * 5400.0 / (4.0 * 3.14159265) * 3.5;
  EXPECT_GT(light, 0.3 * expected);
  EXPECT_LT(light, 4.0 * expected);
}

// Spots lie in their cells whole: nothing is cut off.
TEST_P(StarKernel, SpotsEndDark) {
  const Patch patch(0.15, 1500);
  const std::vector<float> light = patch.see(stars_of_brightness(1.0f), 1.5e-3f);
  const float most = *std::ranges::max_element(light);
  ASSERT_GT(most, 0.0f);
  for (int j = 0; j < patch.side; ++j)
    for (int i = 1; i < patch.side; ++i) {
      const float a = light[static_cast<std::size_t>(j * patch.side + i)];
      const float b = light[static_cast<std::size_t>(j * patch.side + i - 1)];
      // 2e-4 apart the spot (1 - r^2)^2 changes by at most a fifth of its height.
      if (a == 0.0f || b == 0.0f) {
        EXPECT_LT(std::max(a, b), 0.08f * most);
      }
    }
}

// Every star is in the list once: as many as magnitudes have it.
TEST_P(StarKernel, FewAreBright) {
  const Patch patch(0.25, 2000);
  const std::vector<float> light = patch.see(stars_of_brightness(1.0f), 7e-4f);
  int faint = 0, bright = 0;
  for (int j = 1; j + 1 < patch.side; ++j)
    for (int i = 1; i + 1 < patch.side; ++i) {
      const auto at = [&](int dx, int dy) {
        return light[static_cast<std::size_t>((j + dy) * patch.side + i + dx)];
      };
      const float here = at(0, 0);
      if (here == 0.0f || here < at(1, 0) || here <= at(-1, 0) || here < at(0, 1) ||
          here <= at(0, -1))
        continue;
      // The peak of magnitude 6 has 3 / (pi r^2).
      const double ratio = here * 7e-4 * 7e-4 * 3.14159265 / 3.0 * std::exp(0.23 / 1.03);
      ++(ratio > 10.0 ? bright : faint);  // brighter than magnitude 3.5
    }
  // A quarter of a steradian has 107 stars, 6 of them that bright.
  EXPECT_NEAR(faint + bright, 107, 35);
  EXPECT_GT(bright, 1);
  EXPECT_LT(bright, 20);
}

TEST_P(StarKernel, WideSpotsAreNotDrawn) {
  const Patch patch(0.1, 100);
  EXPECT_EQ(sum_of(patch.see(stars_of_brightness(1.0f), 0.05f)), 0.0);
}

}  // namespace
}  // namespace swell::render
