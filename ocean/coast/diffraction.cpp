#include "ocean/coast/diffraction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "math/check.h"
#include "math/elementary.h"
#include "math/stop.h"

namespace swell::ocean {
namespace {

// Beside the square: points over which the wave is brought back to that of the open sea, so that
// nothing comes back from the sides.
constexpr int kMargin = 16;
constexpr double kMostTakenBack = 0.3;
// Places a cell is asked for land at, along the wave; two across it.
constexpr int kAlong = 4;

struct Complex {
  double re = 0.0, im = 0.0;
};
Complex operator+(Complex a, Complex b) { return {a.re + b.re, a.im + b.im}; }
Complex operator-(Complex a, Complex b) { return {a.re - b.re, a.im - b.im}; }
Complex operator*(Complex a, Complex b) {
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}
Complex operator*(double s, Complex a) { return {s * a.re, s * a.im}; }
Complex inverse(Complex a) { return (1.0 / (a.re * a.re + a.im * a.im)) * Complex{a.re, -a.im}; }

// The points that the wave is marched over: rows across its direction, point (row, i) at
// middle + spacing (row - rows / 2) along + spacing (i - count / 2) across.
struct MarchGrid {
  glm::dvec2 middle, along, across;
  double spacing_m;
  int rows, count;

  MarchGrid(const terrain::Grid& grid, glm::dvec2 travel)
      : middle(grid.min_world + 0.5 * grid.extent_m()),
        along(travel),
        across(-travel.y, travel.x),
        spacing_m(grid.spacing_m),
        rows(static_cast<int>(std::ceil(1.42 * (grid.samples_x - 1))) + 3),
        count(rows + 2 * kMargin) {}

  glm::dvec2 point(int row, double i) const {
    return middle + spacing_m * ((row - 0.5 * rows) * along + (i - 0.5 * count) * across);
  }
  // Where a world point lies, as (row, i).
  glm::dvec2 place(glm::dvec2 p_world) const {
    const glm::dvec2 from_middle = (p_world - middle) / spacing_m;
    return {glm::dot(from_middle, along) + 0.5 * rows, glm::dot(from_middle, across) + 0.5 * count};
  }
};

// What lies within LandMask::kSquare points of a place.
LandMask::Around around_place(const LandMask& mask, glm::dvec2 p_world) {
  const glm::dvec2 at =
      (p_world - mask.grid.min_world) / (LandMask::kSquare * mask.grid.spacing_m) + 1.0;
  if (!(at.x >= 0.0 && at.y >= 0.0 && at.x < mask.squares_across && at.y < mask.squares_along))
    return LandMask::Around::kWater;
  const auto row = static_cast<std::size_t>(at.y);
  return mask
      .around[row * static_cast<std::size_t>(mask.squares_across) + static_cast<std::size_t>(at.x)];
}

// The part of a cell's width that land does not close.
double open_part(const LandMask& mask, const MarchGrid& march, int row, int i) {
  // No place asked below is half a cell away.
  if (march.spacing_m < LandMask::kSquare * mask.grid.spacing_m) {
    const LandMask::Around around = around_place(mask, march.point(row, i));
    if (around != LandMask::Around::kBoth) return around == LandMask::Around::kWater ? 1.0 : 0.0;
  }
  const auto is_closed = [&](double side) {
    const glm::dvec2 begin = march.point(row, i + side);
    for (int n = 0; n < kAlong; ++n) {
      const double ahead = (n + 0.5) / kAlong - 0.5;
      if (is_land(mask, begin + ahead * march.spacing_m * march.along)) return true;
    }
    return false;
  };
  return (is_closed(-0.25) ? 0.0 : 0.5) + (is_closed(0.25) ? 0.0 : 0.5);
}

// A step of Crank and Nicolson's from one row to the next: (1 + a D) u' = (1 + conj(a) D) u, D the
// second difference across, u is 1 at both ends. With X = D / (k h)^2 the step is
// 1 + X / 4 -+ i k h X / 4; what is added to a's real part makes D as good as second derivatives of
// waves three points long.
class Spreading {
 public:
  Spreading(int count, double wavelength_m, double spacing_m)
      : inverse_(static_cast<std::size_t>(count)), carried_(inverse_.size()) {
    constexpr double kShortWaves = 0.1;
    const double kh = 2.0 * kPi * spacing_m / wavelength_m;
    a_ = {kShortWaves + 0.25 / (kh * kh), -0.25 / kh};
    // Thomas' algorithm: row i is u'[i] = carried[i] - a inverse[i] u'[i + 1].
    const Complex middle = Complex{1.0, 0.0} - 2.0 * a_;
    Complex upper;
    for (std::size_t i = 1; i + 1 < inverse_.size(); ++i) {
      inverse_[i] = inverse(middle - a_ * upper);
      upper = a_ * inverse_[i];
    }
  }

  void step(std::span<Complex> u) {
    const std::size_t last = u.size() - 1;
    const Complex side = {a_.re, -a_.im}, middle = Complex{1.0, 0.0} - 2.0 * side;
    carried_[0] = {1.0, 0.0};
    for (std::size_t i = 1; i < last; ++i) {
      const Complex right = side * (u[i - 1] + u[i + 1]) + middle * u[i];
      carried_[i] = (right - a_ * carried_[i - 1]) * inverse_[i];
    }
    u[last] = {1.0, 0.0};
    for (std::size_t i = last; i-- > 1;) u[i] = carried_[i] - a_ * inverse_[i] * u[i + 1];
    u[0] = {1.0, 0.0};
  }

 private:
  Complex a_;
  std::vector<Complex> inverse_, carried_;
};

// How far a margin's points are brought back, from 0 at its inner end.
double taken_back(int i, int count) {
  const int inside = std::min(i, count - 1 - i);
  if (inside >= kMargin) return 0.0;
  const double part = static_cast<double>(kMargin - inside) / kMargin;
  return kMostTakenBack * part * part;
}

struct Marched {
  std::vector<float> energy, fetch_m;  // row after row
};

Marched march(const LandMask& mask, const PlaneWave& wave, const MarchGrid& grid) {
  const auto count = static_cast<std::size_t>(grid.count);
  Spreading spreading(grid.count, wave.wavelength_m, grid.spacing_m);
  std::vector<Complex> u(count, Complex{1.0, 0.0});
  constexpr float kEndless = std::numeric_limits<float>::infinity();
  std::vector<float> fetch(count, kEndless);
  Marched marched;
  marched.energy.resize(count * static_cast<std::size_t>(grid.rows));
  marched.fetch_m.resize(marched.energy.size());
  bool has_met_land = false;
  for (int row = 0; row < grid.rows; ++row) {
    check_stop();
    if (has_met_land) spreading.step(u);
    const std::size_t first = count * static_cast<std::size_t>(row);
    for (std::size_t i = 0; i < count; ++i) {
      const int column = static_cast<int>(i);
      const double back = taken_back(column, grid.count);
      u[i] = u[i] + back * (Complex{1.0, 0.0} - u[i]);
      fetch[i] += static_cast<float>(grid.spacing_m);
      // Before land takes it: water beside land has all that comes to it.
      marched.energy[first + i] = static_cast<float>(u[i].re * u[i].re + u[i].im * u[i].im);
      if (const double open = open_part(mask, grid, row, column); open < 1.0) {
        has_met_land = true;
        u[i] = open * u[i];
        fetch[i] = static_cast<float>(open) * fetch[i];
        if (open == 0.0) fetch[i] = 0.0f;
      }
      marched.fetch_m[first + i] = std::min(fetch[i], 1e9f);
    }
  }
  return marched;
}

// How many points of a square are land; 0 for squares beyond the grid.
int land_in_square(const LandMask& mask, int column, int row) {
  constexpr int kSide = LandMask::kSquare;
  const int first_x = std::max(column * kSide, 0), first_y = std::max(row * kSide, 0);
  const int end_x = std::min((column + 1) * kSide, mask.grid.samples_x);
  const int end_y = std::min((row + 1) * kSide, mask.grid.samples_y);
  int count = 0;
  for (int j = first_y; j < end_y; ++j)
    for (int i = first_x; i < end_x; ++i) count += mask.land[mask.grid.index(i, j)];
  return count;
}

void fill_around(LandMask& mask) {
  constexpr int kSide = LandMask::kSquare;
  mask.squares_across = (mask.grid.samples_x + kSide - 1) / kSide + 2;
  mask.squares_along = (mask.grid.samples_y + kSide - 1) / kSide + 2;
  const terrain::Grid squares{{}, 1.0, mask.squares_across, mask.squares_along};
  std::vector<int> land(squares.size());
  for (int j = 0; j < squares.samples_y; ++j)
    for (int i = 0; i < squares.samples_x; ++i)
      land[squares.index(i, j)] = land_in_square(mask, i - 1, j - 1);
  mask.around.assign(squares.size(), LandMask::Around::kBoth);
  for (int j = 0; j < squares.samples_y; ++j)
    for (int i = 0; i < squares.samples_x; ++i) {
      int sum = 0;
      for (int y = std::max(j - 1, 0); y <= std::min(j + 1, squares.samples_y - 1); ++y)
        for (int x = std::max(i - 1, 0); x <= std::min(i + 1, squares.samples_x - 1); ++x)
          sum += land[squares.index(x, y)];
      if (sum == 0) mask.around[squares.index(i, j)] = LandMask::Around::kWater;
      if (sum == 9 * kSide * kSide) mask.around[squares.index(i, j)] = LandMask::Around::kLand;
    }
}

}  // namespace

bool is_land(const LandMask& mask, glm::dvec2 p_world) {
  const glm::dvec2 at = (p_world - mask.grid.min_world) / mask.grid.spacing_m + 0.5;
  if (!(at.x >= 0.0 && at.y >= 0.0)) return false;
  if (!(at.x < mask.grid.samples_x && at.y < mask.grid.samples_y)) return false;
  return mask.land[mask.grid.index(static_cast<int>(at.x), static_cast<int>(at.y))] != 0;
}

LandMask make_land_mask(const terrain::ShoreMap& shore) {
  LandMask mask{shore.grid(), {}, 0, 0, {}};
  mask.land.reserve(mask.grid.size());
  for (const float height_m : shore.height_m()) mask.land.push_back(height_m > 0.0f ? 1 : 0);
  fill_around(mask);
  return mask;
}

void march_wave(const LandMask& mask, const PlaneWave& wave, const terrain::Grid& grid,
                std::span<float> energy, std::span<float> fetch_m) {
  SWELL_CHECK(energy.size() == grid.size() && fetch_m.size() == grid.size(),
              "samples={}, {} energies, {} fetches", grid.size(), energy.size(), fetch_m.size());
  const MarchGrid rows(grid, wave.travel);
  const Marched marched = march(mask, wave, rows);
  for (int j = 0; j < grid.samples_y; ++j) {
    check_stop();
    for (int i = 0; i < grid.samples_x; ++i) {
      const glm::dvec2 at = rows.place(grid.point(i, j));
      const int row = static_cast<int>(at.x), column = static_cast<int>(at.y);
      const auto fx = static_cast<float>(at.x - row), fy = static_cast<float>(at.y - column);
      const std::size_t corner = static_cast<std::size_t>(row) * rows.count + column;
      const auto bilinear = [&](const std::vector<float>& v) {
        const float* const low = v.data() + corner;
        const float* const high = low + rows.count;
        const float a = low[0] + fy * (low[1] - low[0]), b = high[0] + fy * (high[1] - high[0]);
        return a + fx * (b - a);
      };
      energy[grid.index(i, j)] = bilinear(marched.energy);
      fetch_m[grid.index(i, j)] = bilinear(marched.fetch_m);
    }
  }
}

}  // namespace swell::ocean
