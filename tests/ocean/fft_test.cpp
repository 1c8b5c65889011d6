#include "ocean/spectrum/fft.h"

#include <gtest/gtest.h>
#include <kiss_fftnd.h>

#include <cmath>
#include <complex>
#include <cstring>
#include <numbers>
#include <random>
#include <vector>

#include "ocean/simd_targets.h"

namespace swell::ocean {
namespace {

using Complex = std::complex<double>;

std::vector<Complex> random_plane(int size, unsigned seed) {
  std::mt19937 bits(seed);
  std::vector<Complex> plane(static_cast<std::size_t>(size) * size);
  for (Complex& v : plane) {
    // Floats, so that the input is the same for every transform.
    const float re = static_cast<float>(bits()) * 0x1p-31f - 1.0f;
    const float im = static_cast<float>(bits()) * 0x1p-31f - 1.0f;
    v = {re, im};
  }
  return plane;
}

// A row-major plane as the FFT's input batches.
bool fill_from_plane(const FftPlan& plan, const std::vector<Complex>& plane, int column0, float* re,
                     float* im) {
  for (int j = 0; j < plan.size; ++j) {
    for (int lane = 0; lane < kFftBatch; ++lane) {
      const Complex v = plane[static_cast<std::size_t>(j * plan.size + column0 + lane)];
      re[plan.slot[j] * kFftBatch + lane] = static_cast<float>(v.real());
      im[plan.slot[j] * kFftBatch + lane] = static_cast<float>(v.imag());
    }
  }
  return true;
}

struct Planes {
  std::vector<float> re, im;
  bool operator==(const Planes&) const = default;
};

Planes transform(const std::vector<Complex>& input, int size, int threads = 1) {
  const FftPlan plan = make_fft_plan(size);
  Planes result{std::vector<float>(input.size()), std::vector<float>(input.size())};
  const FftOutput output{result.re.data(), result.im.data()};
  std::vector<float> planes;
  Workers workers(threads);
  const auto fill = [&](int, int column0, float* re, float* im) {
    return fill_from_plane(plan, input, column0, re, im);
  };
  inverse_fft_2d(plan, fill, {&output, 1}, planes, workers);
  return result;
}

// Sum in double, one axis after the other, with the C library's sine and cosine.
std::vector<Complex> direct_sum(const std::vector<Complex>& input, int size) {
  std::vector<Complex> roots(size);
  for (int i = 0; i < size; ++i) roots[i] = std::polar(1.0, 2.0 * std::numbers::pi * i / size);
  const auto along = [&](const std::vector<Complex>& from, int step, int line_step) {
    std::vector<Complex> to(from.size());
    for (int line = 0; line < size; ++line) {
      for (int u = 0; u < size; ++u) {
        Complex sum = 0.0;
        for (int x = 0; x < size; ++x) {
          sum += from[line * line_step + x * step] * roots[x * u % size];
        }
        to[line * line_step + u * step] = sum;
      }
    }
    return to;
  };
  return along(along(input, 1, size), size, 1);
}

double relative_rms_error(const Planes& got, const std::vector<Complex>& want) {
  double error = 0.0, norm = 0.0;
  for (std::size_t i = 0; i < want.size(); ++i) {
    error += std::norm(Complex(got.re[i], got.im[i]) - want[i]);
    norm += std::norm(want[i]);
  }
  return std::sqrt(error / norm);
}

class FftOfSize : public testing::TestWithParam<int> {};

TEST_P(FftOfSize, EqualsTheDirectSumInDouble) {
  const int size = GetParam();
  const auto input = random_plane(size, 1);
  const auto want = direct_sum(input, size);
  const double bound = 3e-7 * std::sqrt(2.0 * std::log2(size));
  for_each_simd_target([&] { EXPECT_LE(relative_rms_error(transform(input, size), want), bound); });
}

TEST_P(FftOfSize, EqualsKissFft) {
  const int size = GetParam();
  const auto input = random_plane(size, 2);
  std::vector<kiss_fft_cpx> in(input.size()), out(input.size());
  for (std::size_t i = 0; i < input.size(); ++i) {
    in[i] = {static_cast<float>(input[i].real()), static_cast<float>(input[i].imag())};
  }
  const int sizes[] = {size, size};
  kiss_fftnd_cfg config = kiss_fftnd_alloc(sizes, 2, 1, nullptr, nullptr);
  kiss_fftnd(config, in.data(), out.data());
  kiss_fft_free(config);
  std::vector<Complex> want(out.size());
  for (std::size_t i = 0; i < out.size(); ++i) want[i] = {out[i].r, out[i].i};
  EXPECT_LE(relative_rms_error(transform(input, size), want), 1e-5);
}

TEST_P(FftOfSize, GivesTheSameBitsOnEveryTargetAndThreadCount) {
  const int size = GetParam();
  const auto input = random_plane(size, 3);
  const Planes want = transform(input, size, 1);
  for_each_simd_target([&] {
    for (const int threads : {1, 2, 3, 7}) EXPECT_TRUE(transform(input, size, threads) == want);
  });
}

TEST_P(FftOfSize, KeepsTheEnergy) {
  const int size = GetParam();
  const auto input = random_plane(size, 4);
  const Planes output = transform(input, size);
  double before = 0.0, after = 0.0;
  for (std::size_t i = 0; i < input.size(); ++i) {
    before += std::norm(input[i]);
    after += std::norm(Complex(output.re[i], output.im[i]));
  }
  EXPECT_NEAR(after / (before * size * size), 1.0, 1e-6);
}

TEST_P(FftOfSize, TurnsOneWaveIntoOneRotatingVector) {
  const int size = GetParam();
  const int u = 3, v = size - 5;
  std::vector<Complex> input(static_cast<std::size_t>(size) * size);
  input[static_cast<std::size_t>(v * size + u)] = {0.0, 2.0};
  const Planes output = transform(input, size);
  double worst = 0.0;
  for (int j = 0; j < size; ++j) {
    for (int i = 0; i < size; ++i) {
      const double angle = 2.0 * std::numbers::pi * (u * i + v * j) / size;
      const Complex want = Complex(0.0, 2.0) * std::polar(1.0, angle);
      const std::size_t at = static_cast<std::size_t>(j * size + i);
      worst = std::max(worst, std::abs(Complex(output.re[at], output.im[at]) - want));
    }
  }
  EXPECT_LE(worst, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Sizes, FftOfSize, testing::Values(16, 32, 64, 128, 256, 512),
                         testing::PrintToStringParamName());

TEST(Fft, OfTheMeanIsConstant) {
  std::vector<Complex> input(16 * 16);
  input[0] = {1.5, -0.25};
  const Planes output = transform(input, 16);
  EXPECT_EQ(output.re, std::vector<float>(16 * 16, 1.5f));
  EXPECT_EQ(output.im, std::vector<float>(16 * 16, -0.25f));
}

TEST(Fft, IsLinear) {
  const auto a = random_plane(64, 5), b = random_plane(64, 6);
  std::vector<Complex> sum(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) sum[i] = a[i] - 3.0 * b[i];
  const Planes of_a = transform(a, 64), of_b = transform(b, 64);
  std::vector<Complex> want(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    want[i] = Complex(of_a.re[i], of_a.im[i]) - 3.0 * Complex(of_b.re[i], of_b.im[i]);
  }
  EXPECT_LE(relative_rms_error(transform(sum, 64), want), 1e-6);
}

TEST(Fft, TakesColumnsReportedEmptyAsZero) {
  const int size = 64;
  auto input = random_plane(size, 7);
  for (int j = 0; j < size; ++j) {
    for (int i = 16; i < 48; ++i) input[static_cast<std::size_t>(j * size + i)] = 0.0;
  }
  const Planes want = transform(input, size);
  const FftPlan plan = make_fft_plan(size);
  Planes got{std::vector<float>(input.size()), std::vector<float>(input.size())};
  const FftOutput output{got.re.data(), got.im.data()};
  std::vector<float> planes;
  Workers workers(1);
  const auto fill = [&](int, int column0, float* re, float* im) {
    if (column0 == 16 || column0 == 32) return false;
    return fill_from_plane(plan, input, column0, re, im);
  };
  inverse_fft_2d(plan, fill, {&output, 1}, planes, workers);
  EXPECT_TRUE(got == want);
}

TEST(Fft, RunsTransformsSideBySideWithoutMixingThem) {
  const int size = 32;
  const auto a = random_plane(size, 8), b = random_plane(size, 9);
  const FftPlan plan = make_fft_plan(size);
  std::vector<float> re_a(a.size()), im_a(a.size()), re_b(a.size());
  const FftOutput outputs[] = {{re_a.data(), im_a.data()}, {re_b.data(), nullptr}};
  std::vector<float> planes;
  Workers workers(2);
  const auto fill = [&](int transform_index, int column0, float* re, float* im) {
    return fill_from_plane(plan, transform_index == 0 ? a : b, column0, re, im);
  };
  inverse_fft_2d(plan, fill, outputs, planes, workers);
  EXPECT_TRUE((Planes{re_a, im_a} == transform(a, size)));
  EXPECT_EQ(re_b, transform(b, size).re);
}

}  // namespace
}  // namespace swell::ocean
