#include "lod/slope_bounds.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "math/check.h"

namespace swell::lod {
namespace {

constexpr int kMostLevels = 11;  // 1024 x 1024 cells
constexpr float kCodes = 127.0f;

using Codes = std::array<std::int8_t, 4>;

std::uint32_t largest_of_each(std::uint32_t a, std::uint32_t b) {
  Codes x = std::bit_cast<Codes>(a);
  const Codes y = std::bit_cast<Codes>(b);
  for (std::size_t i = 0; i < 4; ++i) x[i] = std::max(x[i], y[i]);
  return std::bit_cast<std::uint32_t>(x);
}

// One array of heights as the slopes of its edges.
struct Edges {
  std::span<const float> height_m;
  int samples;
  float inv_spacing;

  float at(int i, int j) const { return height_m[static_cast<std::size_t>(j) * samples + i]; }
  float slope_x(int i, int j) const { return (at(i + 1, j) - at(i, j)) * inv_spacing; }
  float slope_y(int i, int j) const { return (at(i, j + 1) - at(i, j)) * inv_spacing; }
};

float steepest(const Edges& edges) {
  float most = 0.0f;
  for (int j = 0; j < edges.samples; ++j)
    for (int i = 0; i + 1 < edges.samples; ++i)
      most = std::max({most, std::abs(edges.slope_x(i, j)), std::abs(edges.slope_y(j, i))});
  return most;
}

std::uint32_t encode(float slope_x, float slope_y, float unit) {
  const auto code = [&](float slope) {
    return static_cast<std::int8_t>(std::min(std::ceil(slope / unit), kCodes));
  };
  return std::bit_cast<std::uint32_t>(
      Codes{code(slope_x), code(-slope_x), code(slope_y), code(-slope_y)});
}

// The grid's squares that cell `k` of 2^q touches, on one axis: [first, last].
struct Squares {
  int first, last;
};

Squares squares_of(int k, int q, int samples) {
  const std::int64_t squares = samples - 1;
  return {static_cast<int>((k * squares) >> q),
          static_cast<int>((((k + 1) * squares + (1 << q) - 1) >> q) - 1)};
}

std::uint32_t bound_cell(const Edges& edges, Squares x, Squares y, float unit) {
  constexpr Codes kLowest = {-127, -127, -127, -127};
  std::uint32_t bound = std::bit_cast<std::uint32_t>(kLowest);
  for (int j = y.first; j <= y.last; ++j) {
    for (int i = x.first; i <= x.last; ++i) {
      bound = largest_of_each(bound, encode(edges.slope_x(i, j), edges.slope_y(i, j), unit));
      bound =
          largest_of_each(bound, encode(edges.slope_x(i, j + 1), edges.slope_y(i + 1, j), unit));
    }
  }
  return bound;
}

}  // namespace

SlopeBounds::SlopeBounds(std::span<const float> height_m, int samples, double spacing_m) {
  SWELL_CHECK(samples >= 2 && height_m.size() == static_cast<std::size_t>(samples) * samples,
              "samples={} height_m={}", samples, height_m.size());
  SWELL_CHECK(std::isfinite(spacing_m) && spacing_m > 0.0, "spacing_m={}", spacing_m);
  SWELL_CHECK(std::ranges::all_of(height_m, [](float z) { return std::isfinite(z); }),
              "wanted finite heights");
  const Edges edges{height_m, samples, static_cast<float>(1.0 / spacing_m)};
  levels_ = std::min<int>(kMostLevels, 1 + std::bit_width(static_cast<unsigned>(samples - 2)));
  const float most = steepest(edges);
  unit_ = std::max(most / kCodes, 1e-9f);
  cells_.resize(static_cast<std::size_t>(slope_level_begin(levels_)));

  const auto cell = [&](int q, int i, int j) -> std::uint32_t& {
    return cells_[static_cast<std::size_t>(slope_level_begin(q) + (j << q) + i)];
  };
  const int finest = levels_ - 1;
  for (int j = 0; j < 1 << finest; ++j)
    for (int i = 0; i < 1 << finest; ++i)
      cell(finest, i, j) =
          bound_cell(edges, squares_of(i, finest, samples), squares_of(j, finest, samples), unit_);
  for (int q = finest - 1; q >= 0; --q)
    for (int j = 0; j < 1 << q; ++j)
      for (int i = 0; i < 1 << q; ++i)
        cell(q, i, j) = largest_of_each(
            largest_of_each(cell(q + 1, 2 * i, 2 * j), cell(q + 1, 2 * i + 1, 2 * j)),
            largest_of_each(cell(q + 1, 2 * i, 2 * j + 1), cell(q + 1, 2 * i + 1, 2 * j + 1)));
}

}  // namespace swell::lod
