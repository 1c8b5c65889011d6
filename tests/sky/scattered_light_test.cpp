// Light scattered many times: its moments, level layers, and those against a round earth.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "math/elementary.h"
#include "math/random.h"
#include "math/simd_target.h"
#include "sky/add_parts.h"
#include "sky/layered_light.h"
#include "sky/round_light.h"

namespace swell::sky {
namespace {

// Returns the integral of f(x) over [-1, 1].
template <class F>
double integral(const F& f) {
  constexpr int kSteps = 20000;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) sum += f(-1.0 + (2.0 * i + 1.0) / kSteps);
  return sum * 2.0 / kSteps;
}

TEST(AddParts, GivesTheBitsOfAScalarLoopOnEveryTarget) {
  const std::size_t step = 90;
  std::vector<float> parts(7), from(parts.size() * step), start(step);
  for (std::size_t k = 0; k < parts.size(); ++k)
    parts[k] = static_cast<float>(random_uniform(1, k) - 0.5);
  for (std::size_t i = 0; i < from.size(); ++i) from[i] = static_cast<float>(random_uniform(2, i));
  for (std::size_t i = 0; i < step; ++i) start[i] = static_cast<float>(random_uniform(3, i));
  const SimdTarget before = current_simd_target();
  for (const SimdTarget target : simd_targets()) {
    if (!simd_target_available(target)) continue;
    select_simd_target(target);
    for (std::size_t count = 0; count <= step; ++count) {
      std::vector<float> expected = start, sums = start;
      for (std::size_t i = 0; i < count; ++i)
        for (std::size_t k = 0; k < parts.size(); ++k) expected[i] += parts[k] * from[k * step + i];
      add_parts(parts, from.data(), step, count, sums.data());
      EXPECT_EQ(sums, expected) << count;
    }
  }
  select_simd_target(before);
}

TEST(Harmonics, TheFirstAreKnown) {
  for (const double x : {-1.0, -0.3, 0.0, 0.6, 1.0}) {
    const Harmonics k = harmonics(x);
    EXPECT_NEAR(k[moment_index(0, 0)], std::sqrt(0.5), 1e-6);
    EXPECT_NEAR(k[moment_index(1, 0)], std::sqrt(1.5) * x, 1e-6);
    EXPECT_NEAR(k[moment_index(2, 0)], std::sqrt(2.5) * (1.5 * x * x - 0.5), 1e-6);
    EXPECT_NEAR(k[moment_index(1, 1)], std::sqrt(0.75 * (1.0 - x * x)), 1e-6);
    EXPECT_NEAR(k[moment_index(2, 2)], std::sqrt(15.0 / 16.0) * (1.0 - x * x), 1e-6);
  }
}

TEST(Harmonics, AreOrthonormalInEachMode) {
  for (const int m : {0, 1, 5, 11})
    for (const int l : {m, m + 1, 12, kDegrees - 1})
      for (const int other : {m, m + 1, 12, kDegrees - 1}) {
        const double product = integral([&](double x) {
          const Harmonics k = harmonics(x);
          return double{k[moment_index(l, m)]} * double{k[moment_index(other, m)]};
        });
        EXPECT_NEAR(product, l == other ? 1.0 : 0.0, 1e-4) << l << " " << other << " " << m;
      }
}

TEST(Harmonics, IndicesOfAModeAreNeighboursAndAllAreUsed) {
  int next = 0;
  for (int m = 0; m < kModes; ++m)
    for (int l = m; l < kDegrees; ++l) EXPECT_EQ(moment_index(l, m), next++);
  EXPECT_EQ(next, kMoments);
}

TEST(PhaseFunctions, HaveTheMomentsTheySay) {
  for (const int l : {0, 1, 2, 3, 7, 19}) {
    const auto mean = [&](const auto& phase) {
      return 2.0 * kPi * integral([&](double x) {
               return phase(x) * double{harmonics(x)[moment_index(l, 0)]} /
                      std::sqrt(l + 0.5);  // the Legendre polynomial
             });
    };
    EXPECT_NEAR(mie_moment(l), mean(mie_phase), 1e-4) << l;
    EXPECT_NEAR(rayleigh_moment(l), mean(rayleigh_phase), 1e-4) << l;
  }
}

// The sum over degrees and modes between two directions is the phase function of their angle.
TEST(PhaseFunctions, AreTheSumOfTheirMoments) {
  for (int n = 0; n < 50; ++n) {
    const double a = 2.0 * random_uniform(3, 3 * n) - 1.0,
                 b = 2.0 * random_uniform(3, 3 * n + 1) - 1;
    const double azimuth = 2.0 * kPi * random_uniform(3, 3 * n + 2);
    const Harmonics at_a = harmonics(a), at_b = harmonics(b);
    double sum = 0.0;
    for (int m = 0; m <= 2; ++m)
      for (int l = m; l <= 2; ++l) {
        const int i = moment_index(l, m);
        sum += mode_norm(m) * std::cos(m * azimuth) * rayleigh_moment(l) * double{at_a[i]} *
               double{at_b[i]};
      }
    const double cos_theta = a * b + std::sqrt((1.0 - a * a) * (1.0 - b * b)) * std::cos(azimuth);
    EXPECT_NEAR(sum, rayleigh_phase(cos_theta), 1e-6) << n;
  }
}

// ---- Level layers

TEST(LayeredLight, StreamsIntegrateOverHalfASphere) {
  const Layers layers = make_layers(make_air(3.0));
  for (const int power : {0, 1, 2, 7, 19}) {
    double sum = 0.0;
    for (int j = 0; j < kHalf; ++j) sum += layers.weight[j] * std::pow(layers.sine[j], power);
    EXPECT_NEAR(sum, 1.0 / (power + 1.0), 1e-12) << power;
  }
}

// Where all places send out light 1, light 1 arrives.
TEST(LayeredLight, EvenLightStaysEven) {
  for (const double turbidity : {1.0, 10.0}) {
    const Layers layers = make_layers(make_air(turbidity));
    for (const auto* way : {&layers.down, &layers.up})
      for (const auto& layer : *way)
        for (const Layer& channel : layer)
          for (int j = 0; j < kHalf; ++j) {
            EXPECT_NEAR(channel.passes[j] + channel.near[j] + channel.far[j], 1.0f, 1e-5f);
            EXPECT_LE(channel.reach_m[j], 0.5001f * channel.across_m[j]);
            EXPECT_GE(channel.turned[j], 0.0f);
            EXPECT_LE(channel.turned[j], 1.0f);
          }
  }
}

TEST(LayeredLight, ThePathOverheadHasTheKnownDepth) {
  const Air air = make_air(4.0);
  double depth = 0.0, sine = 0.0;
  const Layers layers = make_layers(air);
  const auto steepest = static_cast<std::size_t>(
      std::max_element(layers.sine.begin(), layers.sine.end()) - layers.sine.begin());
  for (const auto& layer : layers.down) depth += double{layer[1].depth[steepest]};
  sine = layers.sine[steepest];
  const double known =
      air.rayleigh_per_m.y * 8000.0 + air.mie_per_m.y * 1200.0 + air.ozone_per_m.y * 15000.0;
  EXPECT_NEAR(depth * sine, known, 2e-3 * known);
}

// Mean radiance about a height of light that was scattered once or thrown back by the sea, from
// rays in many directions.
glm::dvec3 mean_from_rays(const Atmosphere& atmosphere, double height_m, double sun_sine) {
  constexpr int kRings = 240, kAzimuths = 12, kSteps = 100;
  glm::dvec3 sum(0.0);
  for (int i = 0; i < kRings; ++i) {
    const double x = -1.0 + (2.0 * i + 1.0) / kRings;  // rings crowd at eye height
    const double weight = 3.0 * x * x / (kRings * kAzimuths);
    const Path path = trace(atmosphere.air, height_m, x * x * x, kSteps);
    for (int k = 0; k < kAzimuths; ++k) {
      const double ahead = cosine_of(sun_sine) * std::cos(kPi * (k + 0.5) / kAzimuths);
      const LightAngles light{sun_sine, ahead};
      const double cos_theta = sun_sine * path.sine + ahead * cosine_of(path.sine);
      const Scattered once = scatter_once(atmosphere, path, light);
      sum += weight * (rayleigh_phase(cos_theta) * glm::dvec3(once.rayleigh) +
                       mie_phase(cos_theta) * glm::dvec3(once.mie));
      const double sine = light.up * path.sea_up + light.ahead * path.sea_ahead;
      if (path.meets_sea && sine > 0.0)
        sum += weight * sine / kPi * glm::dvec3(path.sea) *
               glm::dvec3(disc_transmittance(atmosphere, 0.0, sine));
    }
  }
  return sum;
}

// In thin air light is scattered once: what the streams carry is what straight rays do, at the
// horizon, too, where light comes from furthest.
TEST(LayeredLight, OfThinAirIsWhatRaysBring) {
  Workers workers(2);
  Atmosphere thin;
  thin.air = make_air(1.5);
  for (glm::dvec3* part : {&thin.air.rayleigh_per_m, &thin.air.mie_per_m, &thin.air.ozone_per_m})
    *part *= 0.02;
  fill_transmittance(thin, workers);
  const Layers layers = make_layers(thin.air);
  for (const double sun_deg : {2.0, 5.0, 20.0}) {
    const double sine = std::sin(sun_deg * kPi / 180.0);
    const LayeredLight level = scatter_in_layers(thin, layers, sine);
    for (const int row : {0, 6, 12, 19, 25, 33, 40}) {
      const glm::dvec3 known = mean_from_rays(thin, source_height_m(row), sine);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(level.mean[row][c] / known[c], 1.0, 0.09)
            << sun_deg << " " << source_height_m(row) << " " << c;
    }
  }
}

TEST(LayeredLight, TheSunOverheadLightsAllAzimuthsAlike) {
  Workers workers(2);
  const Atmosphere air = make_atmosphere(5.0, workers);
  const LayeredLight light = scatter_in_layers(air, make_layers(air.air), 1.0);
  const float mean = light.haze[0].y;
  EXPECT_GT(mean, 0.0f);
  for (int m = 1; m < kModes; ++m)
    for (int l = m; l < kDegrees; ++l)
      EXPECT_NEAR(light.haze[moment_index(l, m) * kHazeHeights].y, 0.0f, 1e-5f * mean);
}

// Two ways to the same light, where both hold: clear air, a sun at 7 to 10 degrees, up to 6 km.
TEST(LayeredLight, IsThatOfARoundEarthWhereTheSunIsUp) {
  Workers workers(2);
  const Atmosphere air = make_atmosphere(1.5, workers);
  const RoundLight round = scatter_on_round_earth(air, workers);
  const Layers layers = make_layers(air.air);
  for (const int column : {27, 30}) {
    const LayeredLight level = scatter_in_layers(air, layers, source_sine(column));
    for (const int row : {0, 5, 10, 15, 20})
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(level.mean[row][c] / round.multiple[row * kSourceSines + column][c], 1.0f,
                    0.05f)
            << column << " " << row << " " << c;
  }
}

}  // namespace
}  // namespace swell::sky
