// Fresnel's formula in the shaders against published values and identities.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "math/simd_target.h"
#include "render/shaders/optics_kernels.h"

namespace swell::render {
namespace {

class Optics : public testing::TestWithParam<SimdTarget> {
 protected:
  void SetUp() override {
    if (!simd_target_available(GetParam())) GTEST_SKIP() << "this CPU lacks the target";
    select_simd_target(GetParam());
  }
};
INSTANTIATE_TEST_SUITE_P(Targets, Optics, testing::ValuesIn(simd_targets()), [](const auto& test) {
  return std::string(simd_target_name(test.param));
});

std::vector<float> reflectance(const std::vector<float>& cos_theta, float n) {
  std::vector<float> r(cos_theta.size());
  fresnel_reflectance(cos_theta, n, r);
  return r;
}

// The textbook's two polarisations in double, by Snell's law.
struct Polarised {
  double s, p;
};
Polarised fresnel_oracle(double cos_i, double n) {
  const double sin_t = std::sqrt(1.0 - cos_i * cos_i) / n;
  const double cos_t = std::sqrt(1.0 - sin_t * sin_t);
  const double rs = (cos_i - n * cos_t) / (cos_i + n * cos_t);
  const double rp = (n * cos_i - cos_t) / (n * cos_i + cos_t);
  return {rs * rs, rp * rp};
}

TEST_P(Optics, WaterReflectsWhatTheTableSays) {
  const std::vector<double> degrees = {0, 30, 45, 60, 70, 80, 85, 88, 89};
  const std::vector<double> expected = {.02037319, .02143647, .02789836, .05969092, .13347500,
                                        .34791671, .58352348, .80404269, .89627640};
  std::vector<float> cosines;
  for (const double angle : degrees)
    cosines.push_back(static_cast<float>(std::cos(angle * M_PI / 180.0)));
  const std::vector<float> r = reflectance(cosines, 1.333f);
  for (std::size_t i = 0; i < r.size(); ++i) EXPECT_NEAR(r[i], expected[i], 1e-5) << degrees[i];
}

TEST_P(Optics, ReflectanceIsTheMeanOfBothPolarisations) {
  std::vector<float> cosines;
  for (int i = 0; i <= 2000; ++i) cosines.push_back(static_cast<float>(i) / 2000.0f);
  for (const float n : {1.05f, 1.333f, 1.5f, 2.4f}) {
    const std::vector<float> r = reflectance(cosines, n);
    for (std::size_t i = 0; i < r.size(); ++i) {
      const Polarised oracle = fresnel_oracle(cosines[i], n);
      ASSERT_NEAR(r[i], 0.5 * (oracle.s + oracle.p), 2e-6) << "cos=" << cosines[i] << " n=" << n;
    }
  }
}

TEST_P(Optics, OnlyOnePolarisationIsReflectedAtBrewstersAngle) {
  const double brewster = std::atan(1.333);
  EXPECT_NEAR(brewster * 180.0 / M_PI, 53.123226, 1e-6);
  const auto cosine = static_cast<float>(std::cos(brewster));
  const double s_only = 0.5 * fresnel_oracle(cosine, 1.333).s;
  EXPECT_NEAR(reflectance({cosine}, 1.333f)[0], s_only, 1e-7);
}

TEST_P(Optics, CosinesOutsideTheRangeAreClamped) {
  const std::vector<float> r = reflectance({0.0f, -1e-9f, 1.0f + 1e-7f, -5.0f, 7.0f}, 1.333f);
  EXPECT_NEAR(r[0], 1.0f, 1e-6);
  EXPECT_NEAR(r[1], 1.0f, 1e-6);
  EXPECT_NEAR(r[2], 0.020373188, 1e-6);
  EXPECT_NEAR(r[3], 1.0f, 1e-6);
  EXPECT_NEAR(r[4], 0.020373188, 1e-6);
}

}  // namespace
}  // namespace swell::render
