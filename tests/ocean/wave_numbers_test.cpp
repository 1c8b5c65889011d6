#include "ocean/spectrum/wave_numbers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "math/random.h"
#include "ocean/simd_targets.h"
#include "ocean/spectrum/dispersion.h"

namespace swell::ocean {
namespace {

// From 1 mm to 1e7 m, and no floor at all.
std::vector<double> random_depths(std::size_t count, std::uint64_t seed) {
  std::vector<double> depth_m;
  for (std::size_t n = 0; n < count; ++n)
    depth_m.push_back(n % 50 == 49 ? std::numeric_limits<double>::infinity()
                                   : std::pow(10.0, 10.0 * random_uniform(seed, n) - 3.0));
  return depth_m;
}

TEST(WaveNumbers, AreThoseOfOneDepthBitByBitOnEveryTarget) {
  for_each_simd_target([] {
    for (const double period_s : {0.1, 1.0, 4.5, 9.0, 25.0, 1000.0}) {
      const double omega = 2.0 * M_PI / period_s;
      const std::vector<double> depth_m = random_depths(5000, 7);
      std::vector<double> k(depth_m.size()), shoaling(depth_m.size());
      wave_numbers(omega, 9.81, depth_m, k);
      shoaling_coefficients(k, depth_m, shoaling);
      for (std::size_t n = 0; n < depth_m.size(); ++n) {
        ASSERT_EQ(k[n], wave_number(omega, depth_m[n], 9.81)) << period_s << " s, " << depth_m[n];
        ASSERT_EQ(shoaling[n], shoaling_coefficient(k[n] * depth_m[n]))
            << period_s << " s, " << depth_m[n];
      }
    }
  });
}

TEST(WaveNumbers, AnyNumberOfDepthsWorksInPlace) {
  for_each_simd_target([] {
    for (std::size_t count = 0; count < 40; ++count) {
      const std::vector<double> depth_m = random_depths(count, 8);
      std::vector<double> values(count + 1, -1.0);
      const std::span<double> k = std::span(values).first(count);
      wave_numbers(1.0, 9.81, depth_m, k);
      for (std::size_t n = 0; n < count; ++n)
        ASSERT_EQ(k[n], wave_number(1.0, depth_m[n], 9.81)) << n << " of " << count;
      shoaling_coefficients(k, depth_m, k);
      for (std::size_t n = 0; n < count; ++n)
        ASSERT_EQ(k[n], shoaling_coefficient(wave_number(1.0, depth_m[n], 9.81) * depth_m[n]));
      ASSERT_EQ(values.back(), -1.0) << count;
    }
  });
}

}  // namespace
}  // namespace swell::ocean
