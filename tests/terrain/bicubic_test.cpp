// Maps made finer: through their samples, and right for what cubics can be.
#include "terrain/bicubic.h"

#include <gtest/gtest.h>

#include <cmath>

#include "math/random.h"

namespace swell::terrain {
namespace {

template <class Height>
HeightGrid map_of(int samples, const Height& height) {
  HeightGrid map{{{-10.0, 20.0}, 3.0, samples, samples}};
  for (int j = 0; j < samples; ++j)
    for (int i = 0; i < samples; ++i) map.height_m.push_back(static_cast<float>(height(i, j)));
  return map;
}

HeightGrid random_map(int samples) {
  return map_of(samples, [](int i, int j) {
    return 10.0 * random_uniform(4, static_cast<std::uint64_t>(100 * j + i));
  });
}

TEST(Bicubic, GoesThroughTheOldSamples) {
  Workers workers(1);
  const HeightGrid map = random_map(20), fine = refine_bicubic(map, workers);
  ASSERT_EQ(fine.grid.samples_x, 77);
  EXPECT_EQ(fine.grid.size_m(), map.grid.size_m());
  for (int j = 0; j < 20; ++j)
    for (int i = 0; i < 20; ++i)
      EXPECT_EQ(fine.height_m[fine.grid.index(4 * i, 4 * j)], map.height_m[map.grid.index(i, j)]);
}

// Keys' kernel with a = -1/2 is exact for them; by the border it takes a straight line.
TEST(Bicubic, KeepsParabolasInsideAndPlanesUpToTheBorder) {
  Workers workers(1);
  const auto parabola = [](double x, double y) {
    return 0.3 * x * x - 0.2 * y * y + 0.5 * x * y + x;
  };
  const auto plane = [](double x, double y) { return 2.0 * x - 0.7 * y + 3.0; };
  const HeightGrid curved = refine_bicubic(map_of(12, parabola), workers),
                   flat = refine_bicubic(map_of(12, plane), workers);
  for (int j = 0; j <= 44; ++j)
    for (int i = 0; i <= 44; ++i) {
      const double x = i / 4.0, y = j / 4.0;
      EXPECT_NEAR(flat.height_m[flat.grid.index(i, j)], plane(x, y), 1e-4);
      if (std::min(i, j) >= 4 && std::max(i, j) <= 40) {
        EXPECT_NEAR(curved.height_m[curved.grid.index(i, j)], parabola(x, y), 1e-4);
      }
    }
}

TEST(Bicubic, IsTheSameOnAnyNumberOfThreads) {
  Workers one(1), three(3);
  const HeightGrid map = random_map(50);
  EXPECT_EQ(refine_bicubic(map, one).height_m, refine_bicubic(map, three).height_m);
}

TEST(Bicubic, LeavesLargeMapsAsTheyAre) {
  Workers workers(2);
  const HeightGrid large{{{0.0, 0.0}, 1.0, kMostRefined, 2},
                         std::vector<float>(2 * kMostRefined, 1.0f)};
  EXPECT_EQ(refine_bicubic(large, workers).grid.samples_x, kMostRefined);
}

}  // namespace
}  // namespace swell::terrain
