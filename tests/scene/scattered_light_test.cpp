// Light scattered many times: its moments, level layers, and those against a round earth.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "math/elementary.h"
#include "math/random.h"
#include "scene/layered_light.h"
#include "scene/round_light.h"

namespace swell::scene {
namespace {

// Of f(x) over [-1, 1].
template <class F>
double integral(const F& f) {
  constexpr int kSteps = 20000;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) sum += f(-1.0 + (2.0 * i + 1.0) / kSteps);
  return sum * 2.0 / kSteps;
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
  for (const double turbidity : {1.0, 10.0})
    for (const auto& layer : make_layers(make_air(turbidity)).layers)
      for (const Layer& channel : layer)
        for (int j = 0; j < kHalf; ++j) {
          EXPECT_NEAR(channel.passes[j] + channel.near[j] + channel.far[j], 1.0f, 1e-5f);
          EXPECT_LE(channel.reach_m[j], 0.5001f * channel.across_m[j]);
        }
}

TEST(LayeredLight, ThePathOverheadHasTheKnownDepth) {
  const Air air = make_air(4.0);
  double depth = 0.0, sine = 0.0;
  const Layers layers = make_layers(air);
  const auto steepest = static_cast<std::size_t>(
      std::max_element(layers.sine.begin(), layers.sine.end()) - layers.sine.begin());
  for (const auto& layer : layers.layers) depth += double{layer[1].depth[steepest]};
  sine = layers.sine[steepest];
  const double known =
      air.rayleigh_per_m.y * 8000.0 + air.mie_per_m.y * 1200.0 + air.ozone_per_m.y * 15000.0;
  EXPECT_NEAR(depth * sine, known, 2e-3 * known);
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

// Two ways to the same light, where both hold: clear air, a sun at 7 to 10 degrees, up to 2 km.
TEST(LayeredLight, IsThatOfARoundEarthWhereTheSunIsUp) {
  Workers workers(2);
  const Atmosphere air = make_atmosphere(1.5, workers);
  const RoundLight round = scatter_on_round_earth(air, workers);
  const Layers layers = make_layers(air.air);
  for (const int column : {27, 30}) {
    const LayeredLight level = scatter_in_layers(air, layers, source_sine(column));
    for (const int row : {0, 5, 10})
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(level.mean[row][c] / round.multiple[row * kSourceSines + column][c], 1.0f,
                    0.05f)
            << column << " " << row << " " << c;
  }
}

}  // namespace
}  // namespace swell::scene
