#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "constants.h"
#include "math/random.h"
#include "texture/improved_noise.h"
#include "texture/lattice.h"
#include "texture/perlin.h"

namespace swell::texture {
namespace {

constexpr Interpolation kAll[] = {Interpolation::kLinear, Interpolation::kCosine,
                                  Interpolation::kCubic};

double random_in(double lo, double hi, std::uint64_t counter) {
  return lo + (hi - lo) * random_uniform(99, counter);
}

double reference_weight(Interpolation interpolation, double t) {
  if (interpolation == Interpolation::kLinear) return t;
  if (interpolation == Interpolation::kCosine) return (1 - std::cos(kPiRef * t)) / 2;
  return 3 * t * t - 2 * t * t * t;
}

TEST(LatticePosition, IsTheFloorAndWhatIsOverItEverywhere) {
  std::vector<double> xs = {0.0,           -0.0,         1.0,    -1.0,     255.0,
                            256.0,         -256.0,       0.5,    -0x1p-60, 0x1p51 + 0.5,
                            -0x1p51 - 0.5, 0x1p52 - 1.0, 0x1p52, -0x1p52,  0x1p53 + 2.0,
                            -0x1p60,       0x1p64,       -1e300};
  for (std::uint64_t n = 0; n < 2000; ++n) xs.push_back(random_in(-1000.0, 1000.0, n));
  for (const double x : xs) {
    const LatticePosition at = lattice_position(x, 64);
    const double cell = std::fmod(std::floor(x), 64.0);
    EXPECT_EQ(at.cell, cell < 0.0 ? cell + 64.0 : cell) << x;
    EXPECT_EQ(at.fraction, x - std::floor(x)) << x;
    EXPECT_FALSE(std::signbit(at.fraction)) << x;
  }
}

TEST(InterpolationWeight, FollowsItsFormula) {
  for (const Interpolation interpolation : kAll) {
    EXPECT_EQ(interpolation_weight(interpolation, 0.0), 0.0);
    EXPECT_EQ(interpolation_weight(interpolation, 1.0), 1.0);
    EXPECT_EQ(interpolation_weight(interpolation, 0.5), 0.5);
    for (int i = 0; i <= 1000; ++i) {
      EXPECT_NEAR(interpolation_weight(interpolation, i / 1000.0),
                  reference_weight(interpolation, i / 1000.0), 1e-15);
    }
  }
}

TEST(PerlinNoise, EqualsTheLatticeValuesAtLatticePoints) {
  for (const Interpolation interpolation : kAll) {
    const PerlinNoise noise(7, interpolation);
    std::set<double> values;
    for (int i = -3; i < 6; ++i) {
      for (int j = -3; j < 6; ++j) {
        for (int k = 250; k < 260; ++k) {
          ASSERT_EQ(noise.noise3(i, j, k), noise.lattice3(i, j, k));
          values.insert(noise.lattice3(i, j, k));
        }
      }
    }
    EXPECT_GT(values.size(), 200u);  // not one constant
  }
}

TEST(PerlinNoise, BlendsTheEightLatticeValuesAround) {
  for (const Interpolation interpolation : kAll) {
    const PerlinNoise noise(8, interpolation);
    for (int n = 0; n < 5000; ++n) {
      const double p[3] = {random_in(-300, 300, 3 * n), random_in(-300, 300, 3 * n + 1),
                           random_in(-300, 300, 3 * n + 2)};
      double want = 0.0;
      for (int corner = 0; corner < 8; ++corner) {
        double weight = 1.0;
        int cell[3];
        for (int axis = 0; axis < 3; ++axis) {
          const double w = reference_weight(interpolation, p[axis] - std::floor(p[axis]));
          const int step = corner >> axis & 1;
          weight *= step == 1 ? w : 1 - w;
          cell[axis] = static_cast<int>(std::floor(p[axis])) + step;
        }
        want += weight * noise.lattice3(cell[0], cell[1], cell[2]);
      }
      ASSERT_NEAR(noise.noise3(p[0], p[1], p[2]), want, 1e-12);
    }
  }
}

TEST(PerlinNoise, OneAndTwoDimensionsBlendTheirLatticeValues) {
  for (const Interpolation interpolation : kAll) {
    const PerlinNoise noise(9, interpolation);
    for (int n = 0; n < 2000; ++n) {
      const double x = random_in(-300, 300, 2 * n), y = random_in(-300, 300, 2 * n + 1);
      const double i = std::floor(x), j = std::floor(y);
      const double u = reference_weight(interpolation, x - i);
      const double v = reference_weight(interpolation, y - j);
      ASSERT_NEAR(noise.noise1(x), (1 - u) * noise.noise1(i) + u * noise.noise1(i + 1), 1e-12);
      const double lower = (1 - u) * noise.noise2(i, j) + u * noise.noise2(i + 1, j);
      const double upper = (1 - u) * noise.noise2(i, j + 1) + u * noise.noise2(i + 1, j + 1);
      ASSERT_NEAR(noise.noise2(x, y), (1 - v) * lower + v * upper, 1e-12);
    }
  }
}

TEST(PerlinNoise, StaysInRangeAndFillsIt) {
  for (const Interpolation interpolation : kAll) {
    const PerlinNoise noise(10, interpolation);
    double lowest = 0.0, highest = 0.0, sum = 0.0;
    for (int n = 0; n < 100000; ++n) {
      const double value = noise.noise3(random_in(0, 256, 3 * n), random_in(0, 256, 3 * n + 1),
                                        random_in(0, 256, 3 * n + 2));
      lowest = std::min(lowest, value);
      highest = std::max(highest, value);
      sum += value;
    }
    EXPECT_GE(lowest, -1.0);
    EXPECT_LE(highest, 1.0);
    EXPECT_LT(lowest, -0.7);
    EXPECT_GT(highest, 0.7);
    EXPECT_NEAR(sum / 100000, 0.0, 0.08);  // the mean of 256 random values
  }
}

TEST(PerlinNoise, RepeatsAfter256) {
  const PerlinNoise noise(11);
  for (int n = 0; n < 1000; ++n) {
    const double x = random_in(-4, 4, 2 * n), y = random_in(-4, 4, 2 * n + 1);
    ASSERT_NEAR(noise.noise1(x), noise.noise1(x + 256), 1e-12);
    ASSERT_NEAR(noise.noise2(x, y), noise.noise2(x - 256, y + 512), 1e-12);
    ASSERT_NEAR(noise.noise3(x, y, 0.3), noise.noise3(x + 256, y - 1024, 256.3), 1e-12);
  }
}

TEST(PerlinNoise, IsContinuousAndSmoothUnlessLinear) {
  const double h = 1e-6;
  for (const Interpolation interpolation : kAll) {
    const PerlinNoise noise(12, interpolation);
    double largest_kink = 0.0;
    for (int n = 0; n < 500; ++n) {
      const double y = random_in(0, 256, 2 * n), z = random_in(0, 256, 2 * n + 1);
      const double here = noise.noise3(n, y, z);
      const double left = noise.noise3(n - h, y, z), right = noise.noise3(n + h, y, z);
      ASSERT_NEAR(left, here, 3e-6);
      ASSERT_NEAR(right, here, 3e-6);
      largest_kink = std::max(largest_kink, std::abs((right - here) - (here - left)) / h);
    }
    if (interpolation == Interpolation::kLinear) {
      EXPECT_GT(largest_kink, 0.5);
    } else {
      EXPECT_LT(largest_kink, 1e-3);
    }
  }
}

TEST(PerlinNoise, FractalsAreSumsOfOctaves) {
  const PerlinNoise noise(13);
  for (int n = 0; n < 200; ++n) {
    const double x = random_in(-9, 9, 3 * n), y = random_in(-9, 9, 3 * n + 1),
                 z = random_in(-9, 9, 3 * n + 2);
    EXPECT_EQ(noise.fractal2(x, y, 1, 0.5), noise.noise2(x, y));
    EXPECT_EQ(noise.fractal3(x, y, z, 5, 0.0), noise.noise3(x, y, z));
    EXPECT_NEAR(
        noise.fractal2(x, y, 3, 0.5),
        noise.noise2(x, y) + 0.5 * noise.noise2(2 * x, 2 * y) + 0.25 * noise.noise2(4 * x, 4 * y),
        1e-15);
    EXPECT_NEAR(noise.fractal3(x, y, z, 2, 0.7),
                noise.noise3(x, y, z) + 0.7 * noise.noise3(2 * x, 2 * y, 2 * z), 1e-15);
  }
}

// Some places share a cell, some jump between cells, go back, or are no numbers.
TEST(PerlinNoise, FractalOfARowIsThatOfEachPlace) {
  std::vector<double> x;
  for (int n = 0; n < 300; ++n) x.push_back(0.07 * n - 9.0);
  for (int n = 0; n < 100; ++n) x.push_back(random_in(-400, 400, 7 * n));
  for (const double far : {-0.0, 256.0, -256.0, 6e15, -6e15, 1e300}) x.push_back(far);
  x.push_back(std::numeric_limits<double>::infinity());
  x.push_back(0.5);
  x.push_back(std::numeric_limits<double>::quiet_NaN());
  x.push_back(0.5);
  std::vector<double> sums(x.size());
  for (const Interpolation interpolation : kAll)
    for (const double y : {0.3, -17.9, 255.5, 6e15}) {
      const PerlinNoise noise(13, interpolation);
      noise.fractal2_row(x, y, 5, 0.6, sums);
      for (std::size_t n = 0; n < x.size(); ++n) {
        const double alone = noise.fractal2(x[n], y, 5, 0.6);
        if (std::isnan(alone))
          EXPECT_TRUE(std::isnan(sums[n])) << x[n];
        else
          EXPECT_EQ(sums[n], alone) << x[n] << ' ' << y;
      }
    }
}

TEST(PerlinNoise, ARowOfPeriodicFractalNoiseHasTheSameBits) {
  std::vector<double> x, sums(300);
  for (std::size_t n = 0; n < sums.size(); ++n) x.push_back(-3.0 + 0.07 * static_cast<double>(n));
  for (const Interpolation interpolation : kAll)
    for (const int period : {1, 8, 256}) {
      const PerlinNoise noise(15, interpolation);
      noise.periodic_fractal3_row(x, 2.3, -0.4, period, 5, 0.6, sums);
      for (std::size_t n = 0; n < x.size(); ++n)
        EXPECT_EQ(sums[n], noise.periodic_fractal3(x[n], 2.3, -0.4, period, 5, 0.6)) << x[n];
    }
}

TEST(PerlinNoise, PeriodicFractalTilesAlongEachAxis) {
  const PerlinNoise noise(14);
  for (const int period : {1, 2, 8, 256}) {
    bool varies = false;
    for (int n = 0; n < 200; ++n) {
      const double x = random_in(-2, 2, 3 * n), y = random_in(-2, 2, 3 * n + 1),
                   z = random_in(-2, 2, 3 * n + 2);
      const double value = noise.periodic_fractal3(x, y, z, period, 4, 0.5);
      ASSERT_NEAR(noise.periodic_fractal3(x + period, y, z, period, 4, 0.5), value, 1e-11);
      ASSERT_NEAR(noise.periodic_fractal3(x, y - period, z, period, 4, 0.5), value, 1e-11);
      ASSERT_NEAR(noise.periodic_fractal3(x, y, z + 3 * period, period, 4, 0.5), value, 1e-11);
      varies |= std::abs(value - noise.periodic_fractal3(x + 0.4, y, z, period, 4, 0.5)) > 0.01;
    }
    EXPECT_TRUE(varies);
  }
  EXPECT_EQ(noise.periodic_fractal3(1.3, 2.4, 3.5, 256, 1, 0.5), noise.noise3(1.3, 2.4, 3.5));
}

TEST(PerlinNoise, SeedsDiffer) {
  int equal = 0;
  for (int i = 0; i < 100; ++i) equal += PerlinNoise(1).noise1(i) == PerlinNoise(2).noise1(i);
  EXPECT_LT(equal, 5);
}

TEST(PerlinNoise, StrangeCoordinatesAreSafe) {
  const PerlinNoise noise(15);
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  for (const double x : {1e6, -1e6, 1e17, -1e300}) {
    EXPECT_LE(std::abs(noise.noise3(x, -x, 0.5)), 1.0);
  }
  EXPECT_EQ(noise.noise1(0x1p60), noise.noise1(0.0));
  for (const double x : {nan, inf, -inf}) {
    EXPECT_TRUE(std::isnan(noise.noise1(x)));
    EXPECT_TRUE(std::isnan(noise.noise2(x, 0.5)));
    EXPECT_TRUE(std::isnan(noise.noise3(0.5, 0.5, x)));
  }
}

TEST(ImprovedNoise, GivesPerlinsValues) {
  const ImprovedNoise noise;
  EXPECT_NEAR(noise.noise3(3.14, 42, 7), 0.13691995878400012, 1e-15);
  EXPECT_EQ(noise.noise3(.5, .5, .5), -0.25);
  EXPECT_NEAR(noise.noise3(.25, .5, .75), -0.2697153091430664, 1e-15);
  EXPECT_EQ(noise.noise3(1.5, 2.5, 3.5), 0.125);
  EXPECT_NEAR(noise.noise3(-.5, -1.25, 2.75), -0.2264237403869629, 1e-15);
  EXPECT_NEAR(noise.noise3(10.1, 20.2, 30.3), -0.4249812496, 1e-10);
  EXPECT_EQ(noise.noise3(255.5, 255.5, 255.5), -0.875);
  EXPECT_NEAR(noise.noise3(100.75, -3.125, .0625), 0.16427981015429793, 1e-15);
}

TEST(ImprovedNoise, IsZeroAtLatticePointsAndRepeatsAfter256) {
  for (const ImprovedNoise& noise : {ImprovedNoise(), ImprovedNoise(3)}) {
    for (int n = 0; n < 1000; ++n) {
      const double x = random_in(-300, 300, 3 * n), y = random_in(-300, 300, 3 * n + 1),
                   z = random_in(-300, 300, 3 * n + 2);
      ASSERT_EQ(noise.noise3(std::floor(x), std::floor(y), std::floor(z)), 0.0);
      ASSERT_NEAR(noise.noise3(x, y, z), noise.noise3(x + 256, y - 512, z + 256), 1e-11);
    }
  }
}

TEST(ImprovedNoise, HasTheKnownRangeAndMoments) {
  const ImprovedNoise noise;
  double largest = 0.0, sum = 0.0, squares = 0.0;
  const int count = 200000;
  for (int n = 0; n < count; ++n) {
    const double value = noise.noise3(random_in(0, 256, 3 * n), random_in(0, 256, 3 * n + 1),
                                      random_in(0, 256, 3 * n + 2));
    largest = std::max(largest, std::abs(value));
    sum += value;
    squares += value * value;
  }
  EXPECT_LE(largest, 1.0);
  EXPECT_GT(largest, 0.8);
  EXPECT_NEAR(sum / count, 0.0, 3e-3);
  EXPECT_NEAR(squares / count, 0.0731, 2e-3);
}

TEST(ImprovedNoise, HasAContinuousDerivative) {
  const ImprovedNoise noise;
  const double h = 1e-5;
  for (int n = 0; n < 500; ++n) {
    const double y = random_in(0, 256, 2 * n), z = random_in(0, 256, 2 * n + 1);
    const double here = noise.noise3(n, y, z);
    const double left = (here - noise.noise3(n - h, y, z)) / h;
    const double right = (noise.noise3(n + h, y, z) - here) / h;
    ASSERT_NEAR(left, right, 1e-3);
  }
}

TEST(ImprovedNoise, StrangeCoordinatesAreSafe) {
  const ImprovedNoise noise;
  EXPECT_LE(std::abs(noise.noise3(1e6 + 0.25, -1e6 - 0.25, 1e15)), 1.0);
  EXPECT_TRUE(std::isnan(noise.noise3(std::nan(""), 0.5, 0.5)));
  EXPECT_TRUE(std::isnan(noise.noise3(0.5, std::numeric_limits<double>::infinity(), 0.5)));
}

}  // namespace
}  // namespace swell::texture
