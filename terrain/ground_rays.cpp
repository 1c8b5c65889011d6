#include "terrain/ground_rays.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/check.h"

namespace swell::terrain {

struct GroundRays::Walk {
  glm::dvec3 origin, along;  // in the world
  glm::dvec2 at, per_m;      // in samples: at + s per_m
  double from = 0.0, to = 0.0;

  double z(double s) const { return origin.z + s * along.z; }
  bool empty() const { return !(from <= to); }
  Walk between(double first, double last) const {
    Walk part = *this;
    part.from = std::max(from, first);
    part.to = std::min(to, last);
    return part;
  }
  // The part over a rectangle of samples.
  Walk over(glm::dvec2 low, glm::dvec2 high) const {
    Walk part = *this;
    for (int k = 0; k < 2; ++k) {
      if (per_m[k] == 0.0) {
        if (at[k] < low[k] || at[k] > high[k]) part.to = -1.0;
        continue;
      }
      const double a = (low[k] - at[k]) / per_m[k], b = (high[k] - at[k]) / per_m[k];
      part = part.between(std::min(a, b), std::max(a, b));
    }
    return part;
  }
  // The part that is no higher.
  Walk below(double height_m) const {
    if (along.z == 0.0) return origin.z > height_m ? between(0.0, -1.0) : *this;
    const double s = (height_m - origin.z) / along.z;
    return along.z < 0.0 ? between(s, to) : between(from, s);
  }
};

namespace {

int width_of(int cells, int level) { return (cells + (1 << level) - 1) >> level; }

// The first t in [0, end] at which a t^2 + b t + c, c > 0, is 0.
std::optional<double> first_root(double a, double b, double c, double end) {
  double t = HUGE_VAL;
  if (a == 0.0) {
    if (b < 0.0) t = -c / b;
  } else if (const double d = b * b - 4.0 * a * c; d >= 0.0) {
    const double q = -0.5 * (b + std::copysign(std::sqrt(d), b));
    for (const double root : {q / a, c / q})
      if (root >= 0.0) t = std::min(t, root);
  }
  if (t <= end) return t;
  return std::nullopt;
}

}  // namespace

double steepest_between(const HeightGrid& ground, double low_m, double high_m) {
  const Grid& grid = ground.grid;
  float steepest2 = 0.0f;  // of a step from sample to sample, along both axes
  for (int j = 0; j + 1 < grid.samples_y; ++j)
    for (int i = 0; i + 1 < grid.samples_x; ++i) {
      const float* const south = &ground.height_m[grid.index(i, j)];
      const float* const north = south + grid.samples_x;
      const auto [low, high] = std::minmax({south[0], south[1], north[0], north[1]});
      if (static_cast<double>(low) > high_m || static_cast<double>(high) < low_m) continue;
      const float x = std::max(std::abs(south[1] - south[0]), std::abs(north[1] - north[0]));
      const float y = std::max(std::abs(north[0] - south[0]), std::abs(north[1] - south[1]));
      steepest2 = std::max(steepest2, x * x + y * y);
    }
  return static_cast<double>(std::sqrt(steepest2)) / grid.spacing_m;
}

GroundRays::GroundRays(const HeightGrid& ground) : ground_(&ground) {
  const Grid& grid = ground.grid;
  SWELL_CHECK(grid.samples_x >= 2 && grid.samples_y >= 2, "samples={} x {}", grid.samples_x,
              grid.samples_y);
  cells_ = {grid.samples_x - 1, grid.samples_y - 1};
  while (width_of(std::max(cells_.x, cells_.y), levels_) > 1) ++levels_;
  most_.resize(static_cast<std::size_t>(levels_) + 1);
  for (int level = 1; level <= levels_; ++level) {
    const auto width = static_cast<std::size_t>(width_of(cells_.x, level));
    auto& most = most_[static_cast<std::size_t>(level)];
    most.assign(width * static_cast<std::size_t>(width_of(cells_.y, level)), -HUGE_VALF);
    const glm::ivec2 finer(width_of(cells_.x, level - 1), width_of(cells_.y, level - 1));
    for (int j = 0; j < finer.y; ++j)
      for (int i = 0; i < finer.x; ++i) {
        float& block =
            most[static_cast<std::size_t>(j >> 1) * width + static_cast<std::size_t>(i >> 1)];
        block = std::max(block, highest(level - 1, {i, j}));
      }
  }
}

float GroundRays::highest(int level, glm::ivec2 block) const {
  if (level > 0)
    return most_[static_cast<std::size_t>(level)]
                [static_cast<std::size_t>(block.y) *
                     static_cast<std::size_t>(width_of(cells_.x, level)) +
                 static_cast<std::size_t>(block.x)];
  const float* const south = &ground_->height_m[ground_->grid.index(block.x, block.y)];
  const float* const north = south + ground_->grid.samples_x;
  return std::max(std::max(south[0], south[1]), std::max(north[0], north[1]));
}

std::optional<double> GroundRays::meet(glm::dvec3 origin_world, glm::dvec3 along,
                                       double farthest_m) const {
  const Grid& grid = ground_->grid;
  Walk walk{origin_world,
            along,
            (glm::dvec2(origin_world) - grid.min_world) / grid.spacing_m,
            glm::dvec2(along) / grid.spacing_m,
            0.0,
            farthest_m};
  float most = highest(levels_, {0, 0});
  if (ground_->apron.width_m > 0.0) most = std::max(most, ground_->highest_m);
  walk = walk.below(static_cast<double>(most));
  if (walk.empty() || origin_world.z <= height_at(*ground_, glm::dvec2(origin_world)))
    return std::nullopt;
  const Walk on_grid = walk.over({0.0, 0.0}, cells_);
  if (on_grid.empty()) return march(walk);
  if (on_grid.from > walk.from)
    if (const auto met = march(walk.between(0.0, on_grid.from))) return met;
  if (const auto met = meet_in_block(on_grid, levels_, {0, 0})) return met;
  return on_grid.to < walk.to ? march(walk.between(on_grid.to, farthest_m)) : std::nullopt;
}

std::optional<double> GroundRays::meet_in_block(const Walk& walk, int level,
                                                glm::ivec2 block) const {
  const double lowest_m = std::min(walk.z(walk.from), walk.z(walk.to));
  if (lowest_m > static_cast<double>(highest(level, block))) return std::nullopt;
  if (level == 0) return meet_in_cell(walk, block);
  struct Child {
    Walk walk;
    glm::ivec2 block;
  };
  std::array<Child, 4> children;
  std::size_t count = 0;
  const int side = 1 << (level - 1);
  for (int k = 0; k < 4; ++k) {
    const glm::ivec2 child = 2 * block + glm::ivec2(k & 1, k >> 1), low = child * side;
    if (low.x >= cells_.x || low.y >= cells_.y) continue;
    if (lowest_m > static_cast<double>(highest(level - 1, child))) continue;
    const Walk part = walk.over(low, glm::min(low + side, cells_));
    if (part.empty()) continue;
    std::size_t at = count++;  // in the order in which the ray comes to them
    for (; at > 0 && part.from < children[at - 1].walk.from; --at) children[at] = children[at - 1];
    children[at] = {part, child};
  }
  for (std::size_t i = 0; i < count; ++i)
    if (const auto met = meet_in_block(children[i].walk, level - 1, children[i].block)) return met;
  return std::nullopt;
}

// With t = s - from and the place (u, v) = (u0, v0) + t (du, dv) in the cell, the height
// h00 + a u + b v + c u v makes the gap over it a square of t.
std::optional<double> GroundRays::meet_in_cell(const Walk& walk, glm::ivec2 cell) const {
  const float* const south = &ground_->height_m[ground_->grid.index(cell.x, cell.y)];
  const float* const north = south + ground_->grid.samples_x;
  const auto h00 = static_cast<double>(south[0]), h10 = static_cast<double>(south[1]);
  const auto h01 = static_cast<double>(north[0]), h11 = static_cast<double>(north[1]);
  const double a = h10 - h00, b = h01 - h00, c = (h11 - h01) - a;
  const glm::dvec2 p = walk.at + walk.from * walk.per_m - glm::dvec2(cell), d = walk.per_m;
  const double gap = walk.z(walk.from) - (h00 + a * p.x + b * p.y + c * p.x * p.y);
  if (gap <= 0.0) return walk.from;
  const double rate = walk.along.z - (a * d.x + b * d.y + c * (p.x * d.y + p.y * d.x));
  const auto t = first_root(-c * d.x * d.y, rate, gap, walk.to - walk.from);
  if (!t) return std::nullopt;
  return walk.from + *t;
}

// Beyond the grid, where heights have no form that a root is known of.
std::optional<double> GroundRays::march(const Walk& walk) const {
  if (walk.empty()) return std::nullopt;
  const auto is_above = [&](double s) {
    return walk.z(s) > height_at(*ground_, glm::dvec2(walk.origin + s * walk.along));
  };
  const double step = 0.5 / std::max(glm::length(walk.per_m), 1e-6);
  double above = walk.from, below = walk.from;
  if (!is_above(above)) return above;
  do {
    if (below >= walk.to) return std::nullopt;
    above = below;
    below = std::min(above + step, walk.to);
  } while (is_above(below));
  while (below - above > 1e-7) {
    const double middle = 0.5 * (above + below);
    (is_above(middle) ? above : below) = middle;
  }
  return below;
}

}  // namespace swell::terrain
