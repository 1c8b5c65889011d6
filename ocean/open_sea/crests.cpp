#include "ocean/open_sea/crests.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "math/check.h"
#include "ocean/open_sea/crests_kernels.h"

namespace swell::ocean {
namespace {

// Choppiness times the root of the mean square slope, at most: waves of five standard deviations
// would fold over themselves with a ninth more.
constexpr double kMostFolding = 0.18;

constexpr int kRowsAtOnce = 16;

// Wave numbers of a patch and the variances of their waves, in ascending order.
std::vector<std::pair<double, double>> variances_by_wave_number(const PatchWaves& waves) {
  std::vector<std::pair<double, double>> sorted;
  for (int j = 0; j < waves.size; ++j) {
    for (int i = 0; i < waves.size; ++i) {
      const std::size_t at = wave_position(i, j, waves.size);
      double variance_m2 = 0.0;
      for (const auto* table : {&waves.cos_re, &waves.sin_re, &waves.cos_im, &waves.sin_im})
        variance_m2 += 0.5 * static_cast<double>((*table)[at]) * static_cast<double>((*table)[at]);
      if (variance_m2 == 0.0) continue;
      sorted.emplace_back(glm::length(wave_vector(i, j, waves.size, waves.length_m)), variance_m2);
    }
  }
  std::ranges::sort(sorted);
  return sorted;
}

// The mean over pairs of waves, each counted by its variance, of the smaller wave number.
double mean_smaller_wave_number(const PatchWaves& waves) {
  const auto sorted = variances_by_wave_number(waves);
  double sum = 0.0, above = 0.0;
  for (auto it = sorted.rbegin(); it != sorted.rend(); ++it) {
    const auto [k, variance_m2] = *it;
    sum += k * variance_m2 * (variance_m2 + 2.0 * above);
    above += variance_m2;
  }
  return above > 0.0 ? sum / (above * above) : 0.0;
}

template <class Body>
void for_row_ranges(int rows, Workers& workers, const Body& body) {
  workers.for_each(static_cast<std::size_t>(rows / kRowsAtOnce), [&](std::size_t i, int) {
    const int first = static_cast<int>(i) * kRowsAtOnce;
    body(first, first + kRowsAtOnce);
  });
}

}  // namespace

Crests make_crests(const PatchWaves& waves, double choppiness) {
  if (choppiness == 0.0 || waves.variance_m2 == 0.0) return {};
  const double most = kMostFolding / std::sqrt(waves.slope_variance);
  const double c = std::min(choppiness, most);
  const double rise_per_m = c * mean_smaller_wave_number(waves);
  return {static_cast<float>(c), static_cast<float>(rise_per_m),
          static_cast<float>(rise_per_m * waves.variance_m2 - c * waves.variance_k_m)};
}

void sharpen_crests(const Crests& crests, const LinearWaves& linear, PatchFrame& patch,
                    Workers& workers) {
  for_row_ranges(patch.resolution, workers,
                 [&](int first, int last) { warp_rows(crests, linear, first, last, patch); });
  for_row_ranges(patch.resolution, workers,
                 [&](int first, int last) { steepen_rows(crests, first, last, patch); });
}

void sharpen_velocities(const Crests& crests, const PatchFrame& patch, PatchVelocity velocity,
                        std::vector<float>& linear, Workers& workers) {
  const std::size_t samples = patch.height_m.size();
  SWELL_CHECK(patch.displaced_x_m.size() == samples, "{} samples, {} displaced", samples,
              patch.displaced_x_m.size());
  linear.resize(std::max(linear.size(), 3 * samples));
  auto to = linear.begin();
  for (const auto field : {velocity.x_mps, velocity.y_mps, velocity.z_mps})
    to = std::ranges::copy(field, to).out;
  for_row_ranges(patch.resolution, workers, [&](int first, int last) {
    move_rows(crests, patch, linear.data(), first, last, velocity);
  });
}

}  // namespace swell::ocean
