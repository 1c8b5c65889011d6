// Whether the drawn sea repeats itself: the autocorrelation of pictures from high above.
#include <gtest/gtest.h>
#include <kiss_fft.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "ocean/spectrum/sea_scale.h"
#include "render/shot.h"

namespace swell::render {
namespace {

constexpr glm::ivec2 kRepetitionSize_px(320, 180);
constexpr glm::ivec2 kPadded(512, 512);
constexpr double kFov_rad = 1.05;

struct Field {
  std::vector<double> value, weight;  // rows of kPadded.x; weight is 1 in the picture
};

std::size_t at(int x, int y) {
  return static_cast<std::size_t>(y) * kPadded.x + static_cast<std::size_t>(x);
}

// Green light of a picture straight down, without what changes more slowly than waves: the mean and
// the contrast of the neighbourhood.
Field waves_of(const Shot& shot, int radius_px) {
  const auto green = [&](int x, int y) { return static_cast<double>(shot.linear(x, y).y); };
  Field field{std::vector<double>(kPadded.x * kPadded.y),
              std::vector<double>(kPadded.x * kPadded.y)};
  for (int y = 0; y < kRepetitionSize_px.y; ++y) {
    for (int x = 0; x < kRepetitionSize_px.x; ++x) {
      double sum = 0.0, squares = 0.0;
      int count = 0;
      for (int j = std::max(y - radius_px, 0);
           j <= std::min(y + radius_px, kRepetitionSize_px.y - 1); ++j) {
        for (int i = std::max(x - radius_px, 0);
             i <= std::min(x + radius_px, kRepetitionSize_px.x - 1); ++i) {
          sum += green(i, j), squares += green(i, j) * green(i, j), ++count;
        }
      }
      const double mean = sum / count, variance = squares / count - mean * mean;
      field.value[at(x, y)] = (green(x, y) - mean) / std::sqrt(variance + 1e-6 * mean * mean);
      field.weight[at(x, y)] = 1.0;
    }
  }
  return field;
}

using Spectrum = std::vector<std::complex<double>>;

// The transform of all rows, then of all columns.
Spectrum transform(Spectrum values, bool inverse) {
  const auto lines = [&](int count, int length, int step, int next) {
    const kiss_fft_cfg plan = kiss_fft_alloc(length, inverse, nullptr, nullptr);
    std::vector<kiss_fft_cpx> line(static_cast<std::size_t>(length)), result(line.size());
    for (int n = 0; n < count; ++n) {
      const auto place = [&](std::size_t i) {
        return static_cast<std::size_t>(n) * next + i * step;
      };
      for (std::size_t i = 0; i < line.size(); ++i)
        line[i] = {static_cast<float>(values[place(i)].real()),
                   static_cast<float>(values[place(i)].imag())};
      kiss_fft(plan, line.data(), result.data());
      for (std::size_t i = 0; i < line.size(); ++i) values[place(i)] = {result[i].r, result[i].i};
    }
    kiss_fft_free(plan);
  };
  lines(kPadded.y, kPadded.x, 1, kPadded.x);
  lines(kPadded.x, kPadded.y, kPadded.x, 1);
  return values;
}

// sum over p of a(p) b(p + lag), at the padded places of the lags.
std::vector<double> correlate(const std::vector<double>& a, const std::vector<double>& b) {
  const Spectrum fa = transform({a.begin(), a.end()}, false),
                 fb = transform({b.begin(), b.end()}, false);
  Spectrum product(fa.size());
  for (std::size_t i = 0; i < fa.size(); ++i) product[i] = std::conj(fa[i]) * fb[i];
  const Spectrum sums = transform(product, true);
  std::vector<double> result(sums.size());
  for (std::size_t i = 0; i < sums.size(); ++i)
    result[i] = sums[i].real() / static_cast<double>(sums.size());
  return result;
}

// The largest correlation of the field with itself moved by near to far pixels in any direction,
// where a third of the picture overlaps.
double largest_correlation(const Field& field, double near_px, double far_px) {
  std::vector<double> squares(field.value);
  for (double& v : squares) v *= v;
  const auto products = correlate(field.value, field.value);
  const auto before = correlate(squares, field.weight), after = correlate(field.weight, squares);
  const auto overlap = correlate(field.weight, field.weight);
  double largest = 0.0;
  for (int y = -kRepetitionSize_px.y; y <= kRepetitionSize_px.y; ++y) {
    for (int x = -kRepetitionSize_px.x / 2; x <= kRepetitionSize_px.x; ++x) {
      const double lag_px = std::hypot(x, y);
      const std::size_t i = at((x + kPadded.x) % kPadded.x, (y + kPadded.y) % kPadded.y);
      if (lag_px < near_px || lag_px > far_px ||
          3.0 * overlap[i] < kRepetitionSize_px.x * kRepetitionSize_px.y)
        continue;
      largest = std::max(largest, products[i] / std::sqrt(before[i] * after[i]));
    }
  }
  return largest;
}

// Seen from height_m straight down; beyond three peak wavelengths up to 5 km or what is seen.
double repetition(scene::Scene scene, double height_m, PartSet without) {
  scene.area.size_m = glm::dvec2(60000.0);
  scene.sky.haze_distance_m = 1e6;
  without.add(Part::kClouds);
  const World world = world_of(scene);
  const View view = make_view({0.0, 0.0, height_m}, 0.3, -0.5 * kPi, kFov_rad, 1.0f,
                              kRepetitionSize_px.x, kRepetitionSize_px.y);
  const Shot shot(world, view, 5.0, {.keep_linear = true, .without = without});
  const double pixel_m = 2.0 * height_m * std::tan(0.5 * kFov_rad) / kRepetitionSize_px.y;
  const double peak_m = ocean::peak_wavelength_m(scene.sea.wind_speed_mps, scene.sea.gravity_mps2);
  const int radius_px = static_cast<int>(std::ceil(peak_m / pixel_m));
  return largest_correlation(waves_of(shot, radius_px), 3.0 * peak_m / pixel_m, 5000.0 / pixel_m);
}

TEST(Repetition, IsNotSeenFromHighAbove) {
  const scene::Scene scene = load_shipped("open_ocean");
  for (const double height_m : {1500.0, 5000.0}) {
    const double tiled = repetition(scene, height_m, {});
    const double periodic = repetition(scene, height_m, {Part::kTiling});
    EXPECT_LT(tiled, 0.2) << height_m;
    EXPECT_GT(periodic, 0.4) << height_m;  // else the test sees nothing
  }
}

}  // namespace
}  // namespace swell::render
