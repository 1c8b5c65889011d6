#include "ocean/spectrum/patch_waves.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "constants.h"
#include "ocean/simd_targets.h"

namespace swell::ocean {
namespace {

constexpr double kLength = 400.0;

PatchWaves waves_of(int size, std::uint64_t seed = 1, int patch = 0) {
  const WaveSystem sea = make_wind_sea(15.0, 1.0, kG);
  const WaveBand band{0.0, kTurn / kLength * 15.5};
  return make_patch_waves({{sea}}, band, kLength, size, 1.0, seed, patch);
}

// h(k, t) of every FFT index, row-major: the batches that feed the FFT, put back in order.
std::vector<std::complex<float>> wave_plane(const PatchWaves& waves, double t_s) {
  const FftPlan plan = make_fft_plan(waves.size);
  std::vector<std::complex<float>> plane(static_cast<std::size_t>(waves.size) * waves.size);
  alignas(64) float re[kMaxFftSize * kFftBatch], im[kMaxFftSize * kFftBatch];
  for (int column0 = 0; column0 < waves.size; column0 += kFftBatch) {
    if (!fill_heights(waves, nullptr, plan, t_s, column0, re, im)) continue;
    for (int j = 0; j < waves.size; ++j) {
      for (int lane = 0; lane < kFftBatch; ++lane) {
        const int at = plan.slot[j] * kFftBatch + lane;
        plane[static_cast<std::size_t>(j * waves.size + column0 + lane)] = {re[at], im[at]};
      }
    }
  }
  return plane;
}

TEST(WaveVector, IsZeroInTheCornerAndNegativeInTheUpperHalf) {
  const double dk = kTurn / 100.0;
  EXPECT_EQ(wave_vector(0, 0, 16, 100.0), glm::dvec2(0.0, 0.0));
  EXPECT_DOUBLE_EQ(wave_vector(7, 1, 16, 100.0).x, 7 * dk);
  EXPECT_DOUBLE_EQ(wave_vector(7, 1, 16, 100.0).y, dk);
  EXPECT_DOUBLE_EQ(wave_vector(8, 15, 16, 100.0).x, -8 * dk);
  EXPECT_DOUBLE_EQ(wave_vector(8, 15, 16, 100.0).y, -dk);
}

TEST(PatchWaves, AreHermitianBitForBit) {
  const PatchWaves waves = waves_of(64);
  for_each_simd_target([&] {
    for (const double t : {0.0, 12.34, 98765.4321}) {
      const auto h = wave_plane(waves, t);
      int nonzero = 0;
      for (int j = 0; j < 64; ++j) {
        for (int i = 0; i < 64; ++i) {
          const auto a = h[j * 64 + i], b = h[(64 - j) % 64 * 64 + (64 - i) % 64];
          if (a == 0.0f && b == 0.0f) continue;
          ++nonzero;
          ASSERT_EQ(std::bit_cast<unsigned>(a.real()), std::bit_cast<unsigned>(b.real()));
          ASSERT_EQ(std::bit_cast<unsigned>(a.imag()), std::bit_cast<unsigned>(-b.imag()));
        }
      }
      EXPECT_GT(nonzero, 600);
    }
  });
}

TEST(PatchWaves, MakeARealField) {
  const int size = 64;
  const PatchWaves waves = waves_of(size);
  const FftPlan plan = make_fft_plan(size);
  std::vector<float> height(static_cast<std::size_t>(size) * size), rest(height.size()), planes;
  const FftOutput output{height.data(), rest.data()};
  Workers workers(1);
  const auto fill = [&](int, int column0, float* re, float* im) {
    return fill_heights(waves, nullptr, plan, 33.0, column0, re, im);
  };
  inverse_fft_2d(plan, fill, {&output, 1}, planes, workers);
  double real = 0.0, imaginary = 0.0;
  for (const float h : height) real += h * h;
  for (const float r : rest) imaginary += r * r;
  EXPECT_GT(real, 0.1 * size * size);
  EXPECT_LE(std::sqrt(imaginary / real), 1e-6);
}

TEST(PatchWaves, HaveNoMeanAndNoNyquistWaves) {
  const WaveSystem sea = make_wind_sea(15.0, 1.0, kG);
  const auto h = wave_plane(make_patch_waves({{sea}}, {0.0, 100.0}, kLength, 32, 1.0, 1, 0), 3.0);
  EXPECT_EQ(h[0], 0.0f);
  for (int i = 0; i < 32; ++i) {
    EXPECT_EQ(h[16 * 32 + i], 0.0f);
    EXPECT_EQ(h[i * 32 + 16], 0.0f);
  }
}

// Every h(k, .) swings with its own frequency: h(t + d) + h(t - d) = 2 cos(omega d) h(t).
TEST(PatchWaves, EachObeyTheDeepWaterDispersionAlsoAfterYears) {
  const int size = 64;
  const PatchWaves waves = waves_of(size);
  const double d = 0.75;
  for_each_simd_target([&] {
    for (const double t : {0.0, 100.0, -5000.0, 1e9}) {
      const auto before = wave_plane(waves, t - d), now = wave_plane(waves, t);
      const auto after = wave_plane(waves, t + d);
      double rms = 0.0;
      for (const auto& h : now) rms += std::norm(h);
      rms = std::sqrt(rms / static_cast<double>(now.size()));
      for (int j = 0; j < size; ++j) {
        for (int i = 0; i < size; ++i) {
          const double ky = kTurn / kLength * (j < size / 2 ? j : j - size);
          const double kx = kTurn / kLength * (i < size / 2 ? i : i - size);
          const double omega = std::sqrt(kG * std::hypot(kx, ky));
          const int at = j * size + i;
          const auto want = 2.0f * static_cast<float>(std::cos(omega * d)) * now[at];
          ASSERT_NEAR(std::abs(before[at] + after[at] - want), 0.0, 2e-4 * rms) << i << ' ' << j;
        }
      }
    }
  });
}

// One wave alone: a(k) e^(-i omega t), so its phase falls with time where it travels to +k.
TEST(PatchWaves, TurnTheWayTheyTravel) {
  // No directions but one: waves towards east stand in column 1 .. n/2 with falling phase.
  const PatchWaves waves = [] {
    const WaveSystem east = make_wind_sea(15.0, 1.5 * std::numbers::pi, kG);
    return make_patch_waves({{east}}, {0.0, kTurn / kLength * 15.5}, kLength, 32, 1.0, 7, 0);
  }();
  const double dt = 0.05;
  const auto h0 = wave_plane(waves, 10.0), h1 = wave_plane(waves, 10.0 + dt);
  double turned = 0.0, weight = 0.0;
  for (int i = 1; i < 10; ++i) {  // k = (i, 0): towards east
    const std::complex<double> a = h0[i], b = h1[i];
    const double omega = std::sqrt(kG * kTurn / kLength * i);
    turned += std::norm(a) * std::arg(b / a) / (omega * dt);
    weight += std::norm(a);
  }
  EXPECT_NEAR(turned / weight, -1.0, 0.1);
}

TEST(PatchWaves, KeepTheLongWavesWhenTheGridGetsFiner) {
  const auto coarse = wave_plane(waves_of(32), 5.0), fine = wave_plane(waves_of(128), 5.0);
  int nonzero = 0;
  for (int y = -15; y <= 15; ++y) {
    for (int x = -15; x <= 15; ++x) {
      const auto a = coarse[(y + 32) % 32 * 32 + (x + 32) % 32];
      ASSERT_EQ(a, fine[(y + 128) % 128 * 128 + (x + 128) % 128]);
      nonzero += a != 0.0f;
    }
  }
  EXPECT_GT(nonzero, 600);
}

TEST(PatchWaves, DifferBySeedAndPatch) {
  const auto h = wave_plane(waves_of(32), 5.0);
  EXPECT_EQ(h, wave_plane(waves_of(32), 5.0));
  EXPECT_NE(h, wave_plane(waves_of(32, 2), 5.0));
  EXPECT_NE(h, wave_plane(waves_of(32, 1, 1), 5.0));
}

TEST(PatchWaves, StayInsideTheirBandToHalfACell) {
  const WaveSystem sea = make_wind_sea(15.0, 1.0, kG);
  const double dk = kTurn / kLength;
  const auto h =
      wave_plane(make_patch_waves({{sea}}, {5.0 * dk, 9.0 * dk}, kLength, 64, 1.0, 1, 0), 0);
  int nonzero = 0;
  for (int j = 0; j < 64; ++j) {
    for (int i = 0; i < 64; ++i) {
      const double k = std::hypot(i < 32 ? i : i - 64, j < 32 ? j : j - 64);
      if (k < 5.0 - 0.7072 || k > 9.0 + 0.7072) {
        EXPECT_EQ(h[j * 64 + i], 0.0f);
      }
      nonzero += h[j * 64 + i] != 0.0f;
    }
  }
  EXPECT_GT(nonzero, 150);
}

}  // namespace
}  // namespace swell::ocean
