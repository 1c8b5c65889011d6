#include "lod/relief_bounds.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "math/check.h"

namespace swell::lod {
namespace {

constexpr int kMostLevels = 11;  // 1024 x 1024 cells
constexpr float kSlopeCodes = 127.0f, kHeightCodes = 32767.0f;

template <class Codes>
void include(Codes& codes, const Codes& more) {
  for (std::size_t i = 0; i < codes.size(); ++i) codes[i] = std::max(codes[i], more[i]);
}

// The least of the whole numbers of units that are not smaller.
template <class Code>
Code encode(float value, float unit, float most) {
  return static_cast<Code>(std::min(std::ceil(value / unit), most));
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

float highest(std::span<const float> height_m) {
  float most = 0.0f;
  for (const float z : height_m) most = std::max(most, std::abs(z));
  return most;
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

// The ranges in one cell, before rounding; as in ReliefCell.
struct Ranges {
  static constexpr float kLeast = std::numeric_limits<float>::lowest();
  std::array<float, 4> slope = {kLeast, kLeast, kLeast, kLeast};
  std::array<float, 2> height = {kLeast, kLeast};
};

Ranges bound_squares(const Edges& edges, Squares x, Squares y) {
  Ranges bound;
  const auto include_slope = [&](std::size_t axis, float slope) {
    bound.slope[axis] = std::max(bound.slope[axis], slope);
    bound.slope[axis + 1] = std::max(bound.slope[axis + 1], -slope);
  };
  for (int j = y.first; j <= y.last + 1; ++j) {
    for (int i = x.first; i <= x.last + 1; ++i) {
      if (i <= x.last) include_slope(0, edges.slope_x(i, j));
      if (j <= y.last) include_slope(2, edges.slope_y(i, j));
      bound.height[0] = std::max(bound.height[0], edges.at(i, j));
      bound.height[1] = std::max(bound.height[1], -edges.at(i, j));
    }
  }
  return bound;
}

ReliefCell encode_cell(const Ranges& ranges, float slope_unit, float height_unit) {
  ReliefCell cell;
  for (std::size_t i = 0; i < 4; ++i)
    cell.slope[i] = encode<std::int8_t>(ranges.slope[i], slope_unit, kSlopeCodes);
  for (std::size_t i = 0; i < 2; ++i)
    cell.height[i] = encode<std::int16_t>(ranges.height[i], height_unit, kHeightCodes);
  return cell;
}

}  // namespace

ReliefBounds::ReliefBounds(std::span<const float> height_m, int samples, double spacing_m) {
  SWELL_CHECK(samples >= 2 && height_m.size() == static_cast<std::size_t>(samples) * samples,
              "samples={} height_m={}", samples, height_m.size());
  SWELL_CHECK(std::isfinite(spacing_m) && spacing_m > 0.0, "spacing_m={}", spacing_m);
  SWELL_CHECK(std::ranges::all_of(height_m, [](float z) { return std::isfinite(z); }),
              "wanted finite heights");
  const Edges edges{height_m, samples, static_cast<float>(1.0 / spacing_m)};
  levels_ = std::min<int>(kMostLevels, 1 + std::bit_width(static_cast<unsigned>(samples - 2)));
  slope_unit_ = std::max(steepest(edges) / kSlopeCodes, 1e-9f);
  height_unit_m_ = std::max(highest(height_m) / kHeightCodes, 1e-9f);
  cells_.resize(static_cast<std::size_t>(relief_level_begin(levels_)));

  const auto cell = [&](int q, int i, int j) -> ReliefCell& {
    return cells_[static_cast<std::size_t>(relief_level_begin(q) + (j << q) + i)];
  };
  const int finest = levels_ - 1;
  for (int j = 0; j < 1 << finest; ++j) {
    for (int i = 0; i < 1 << finest; ++i) {
      const Ranges ranges =
          bound_squares(edges, squares_of(i, finest, samples), squares_of(j, finest, samples));
      cell(finest, i, j) = encode_cell(ranges, slope_unit_, height_unit_m_);
    }
  }
  for (int q = finest - 1; q >= 0; --q) {
    for (int j = 0; j < 2 << q; ++j) {
      for (int i = 0; i < 2 << q; ++i) {
        const ReliefCell& part = cell(q + 1, i, j);
        ReliefCell& whole = cell(q, i / 2, j / 2);
        if (i % 2 == 0 && j % 2 == 0) whole = part;
        include(whole.slope, part.slope);
        include(whole.height, part.height);
      }
    }
  }
}

}  // namespace swell::lod
