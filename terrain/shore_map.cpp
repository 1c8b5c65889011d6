#include "terrain/shore_map.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "math/elementary.h"
#include "math/large_array.h"
#include "math/stop.h"
#include "terrain/apron.h"

namespace swell::terrain {
namespace {

constexpr float kFar = 1e18f;  // squared cells: there is no line in this row
constexpr std::size_t kRowsATask = 16;

Grid map_grid(const HeightGrid& land) {
  const Grid square = square_with_apron(land);
  const int cells = std::clamp(square.samples_x - 1, 1, kShoreMapCells);
  return {square.min_world, square.size_m() / cells, cells + 1, cells + 1};
}

// Calls body(n) for the n in [0, count), some at a time.
template <class Body>
void for_each_line(std::size_t count, Workers& workers, const Body& body) {
  workers.for_each((count + kRowsATask - 1) / kRowsATask, [&](std::size_t task, int) {
    for (std::size_t n = task * kRowsATask; n < std::min(count, (task + 1) * kRowsATask); ++n) {
      check_stop();
      body(n);
    }
  });
}

// A line of samples in an array: a row, or a column.
template <class T>
struct Line {
  T* first;
  std::size_t stride, count;
  T& operator[](std::size_t i) const { return first[i * stride]; }
};

// Squared distances, in cells, from each sample to the nearest place on the line where the heights
// pass through 0.
void distances_on_line(const Line<const float>& height, const Line<float>& squared) {
  const std::size_t n = height.count;
  const auto place = [&](std::size_t i) {  // between i and i + 1
    return static_cast<float>(i) + height[i] / (height[i] - height[i + 1]);
  };
  const auto crosses = [&](std::size_t i) { return (height[i] > 0.0f) != (height[i + 1] > 0.0f); };
  float last = -kFar;
  for (std::size_t i = 0; i < n; ++i) {
    squared[i] = static_cast<float>(i) - last;
    if (i + 1 < n && crosses(i)) last = place(i);
  }
  last = kFar;
  for (std::size_t i = n; i-- > 0;) {
    if (i + 1 < n && crosses(i)) last = place(i);
    const float near = std::min(squared[i], last - static_cast<float>(i));
    squared[i] = std::min(near * near, kFar);
  }
}

// Storage of lower_envelope(), as long as a line and one more.
struct Envelope {
  std::vector<std::size_t> root;
  std::vector<float> from, value;
};

// min over j of value(j) + (i - j)^2, for each i: the lower envelope of parabolas.
void lower_envelope(const Line<float>& line, Envelope& store) {
  const std::size_t n = line.count;
  store.root.resize(n);
  store.from.resize(n + 1);
  store.value.resize(n);
  for (std::size_t i = 0; i < n; ++i) store.value[i] = line[i];
  std::size_t count = 0;  // of parabolas in the envelope
  for (std::size_t j = 0; j < n; ++j) {
    if (store.value[j] >= kFar) continue;
    const auto q = static_cast<double>(j);
    float meet = -kInfinity<float>;
    while (count > 0) {
      const auto p = static_cast<double>(store.root[count - 1]);
      const double rise = static_cast<double>(store.value[j]) + q * q -
                          static_cast<double>(store.value[store.root[count - 1]]) - p * p;
      meet = static_cast<float>(rise / (2.0 * (q - p)));
      if (meet > store.from[count - 1]) break;
      --count;
      meet = -kInfinity<float>;
    }
    store.root[count] = j;
    store.from[count] = meet;
    store.from[++count] = kInfinity<float>;
  }
  if (count == 0) return;
  for (std::size_t i = 0, k = 0; i < n; ++i) {
    while (store.from[k + 1] < static_cast<float>(i)) ++k;
    const float by = static_cast<float>(i) - static_cast<float>(store.root[k]);
    line[i] = store.value[store.root[k]] + by * by;
  }
}

// Squared distances, in cells, to where rows cross the line, or columns.
LargeArray<float> squared_distances(std::span<const float> height, std::size_t side, bool rows,
                                    Workers& workers) {
  auto squared = make_large<float>(height.size());
  const std::size_t along = rows ? 1 : side, across = rows ? side : 1;
  for_each_line(side, workers, [&](std::size_t n) {
    distances_on_line({height.data() + n * across, along, side},
                      {squared.data() + n * across, along, side});
  });
  for_each_line(side, workers, [&](std::size_t n) {
    Envelope store;
    lower_envelope({squared.data() + n * along, across, side}, store);
  });
  return squared;
}

float lerp(float a, float b, float t) { return a + t * (b - a); }

// Where a place is: the number of a cell's first point, and parts of the cell.
struct Cell {
  std::size_t corner;
  float x, y;
};

Cell cell_at(const Grid& grid, double x, double y) {
  const double last = grid.samples_x - 1;
  const glm::dvec2 at = (glm::dvec2(x, y) - grid.min_world) / grid.spacing_m;
  const double i = std::clamp(at.x, 0.0, last), j = std::clamp(at.y, 0.0, last);
  const int column = std::min(static_cast<int>(i), grid.samples_x - 2);
  const int row = std::min(static_cast<int>(j), grid.samples_y - 2);
  return {grid.index(column, row), static_cast<float>(i - column), static_cast<float>(j - row)};
}

float blend(const Grid& grid, const Cell& cell, const std::vector<float>& values) {
  const float* const low = values.data() + cell.corner;
  const float* const high = low + grid.samples_x;
  return lerp(lerp(low[0], low[1], cell.x), lerp(high[0], high[1], cell.x), cell.y);
}

}  // namespace

ShoreMap::ShoreMap(const HeightGrid& land, Workers& workers) : grid_(map_grid(land)) {
  const auto side = static_cast<std::size_t>(grid_.samples_x);
  resize_large(height_m_, grid_.size());
  for_each_line(side, workers, [&](std::size_t j) {
    std::vector<glm::dvec2> p(side);
    for (std::size_t i = 0; i < side; ++i)
      p[i] = grid_.point(static_cast<int>(i), static_cast<int>(j));
    sample_heights(land, p, std::span(height_m_).subspan(j * side, side));
  });
  const LargeArray<float> by_row = squared_distances(height_m_, side, true, workers);
  const LargeArray<float> by_column = squared_distances(height_m_, side, false, workers);
  has_line_ = std::min(by_row.front(), by_column.front()) < kFar;
  const auto cell_m = static_cast<float>(grid_.spacing_m);
  const float diagonal_m = cell_m * std::sqrt(2.0f) * static_cast<float>(side - 1);
  resize_large(distance_m_, grid_.size());
  for (std::size_t k = 0; k < distance_m_.size(); ++k) {
    const float squared = std::min(by_row[k], by_column[k]);
    const float far_m = squared < kFar ? cell_m * std::sqrt(squared) : diagonal_m;
    distance_m_[k] = height_m_[k] > 0.0f ? -far_m : far_m;
  }
}

ShoreMap::ShoreMap(const Grid& grid, std::vector<float> signed_distance_m,
                   std::vector<float> height_m, std::vector<float> surf)
    : grid_(grid),
      distance_m_(std::move(signed_distance_m)),
      height_m_(std::move(height_m)),
      surf_(std::move(surf)) {
  const auto [least, most] = std::ranges::minmax(distance_m_);
  has_line_ = least < 0.0f && most > 0.0f;
}

ShorePoint ShoreMap::sample(double x, double y) const {
  const Cell cell = cell_at(grid_, x, y);
  const float* const low = distance_m_.data() + cell.corner;
  const float* const high = low + grid_.samples_x;
  const glm::vec2 rise(lerp(low[1] - low[0], high[1] - high[0], cell.y),
                       lerp(high[0] - low[0], high[1] - low[1], cell.x));
  const float length = std::sqrt(rise.x * rise.x + rise.y * rise.y);
  return {blend(grid_, cell, distance_m_), blend(grid_, cell, height_m_),
          length > 0.0f ? -rise / length : glm::vec2(0.0f)};
}

float ShoreMap::surf_at(double x, double y) const {
  return surf_.empty() ? 1.0f : blend(grid_, cell_at(grid_, x, y), surf_);
}

}  // namespace swell::terrain
