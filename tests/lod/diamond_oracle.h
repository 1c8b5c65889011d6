// The target triangulation from its definition: all diamonds of a small lattice, sorted by the
// documented order, cut at the budget. Shares no code with lod/; the lattice's structure comes from
// the coordinates' trailing zeros, the priorities from the formula in lod/priority.h.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "lod/roam.h"

namespace swell::lod::oracle {

using Point = std::pair<int, int>;

struct OracleDiamond {
  Point centre;
  int level;
  int half;  // the largest power of two that divides both coordinates
  std::vector<Point> parents;
  // Bounds of dz/dx, dz/dy and z [z_unit_m] in it and its descendants: set by bound_relief().
  float x_least = 0.0f, x_most = 0.0f, y_least = 0.0f, y_most = 0.0f;
  float z_unit_m = 0.0f, z_least = 0.0f, z_most = 0.0f;
};

inline OracleDiamond make_diamond(int bits, int x, int y) {
  const int n = 1 << bits;
  int half = 1;
  while (x % (2 * half) == 0 && y % (2 * half) == 0) half *= 2;
  const bool x_odd = x / half % 2 != 0, y_odd = y / half % 2 != 0;
  OracleDiamond d;
  d.centre = {x, y}, d.level = 0, d.half = half;
  for (int size = n; size > 2 * half; size /= 2) d.level += 2;
  std::vector<Point> candidates;
  if (x_odd && y_odd) {
    // A square. The parents are the corners that are not the ends of the common base.
    for (const Point& p : {Point{x - half, y - half}, Point{x + half, y - half},
                           Point{x - half, y + half}, Point{x + half, y + half}})
      if ((p.first / (2 * half) + p.second / (2 * half)) % 2 != 0) candidates.push_back(p);
    if (d.level == 0) candidates.clear();
  } else {
    ++d.level;
    candidates = x_odd ? std::vector<Point>{{x, y - half}, {x, y + half}}
                       : std::vector<Point>{{x - half, y}, {x + half, y}};
  }
  for (const Point& p : candidates)
    if (p.first >= 0 && p.second >= 0 && p.first <= n && p.second <= n) d.parents.push_back(p);
  return d;
}

// Every lattice point but the corners.
inline std::vector<OracleDiamond> all_diamonds(int bits) {
  const int n = 1 << bits;
  std::vector<OracleDiamond> diamonds;
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x)
      if ((x != 0 && x != n) || (y != 0 && y != n)) diamonds.push_back(make_diamond(bits, x, y));
  return diamonds;
}

// Bounds the slopes and heights of a grid of heights with one sample a lattice point, in the cells
// (8 half sizes wide at even levels, 4 at odd ones) that hold the diamond and its descendants:
// slopes in 127ths of the steepest, heights in 32767ths of the highest.
inline void bound_relief(std::vector<OracleDiamond>& diamonds, int bits, double step_m,
                         const std::vector<float>& height_m) {
  const int n = 1 << bits;
  const auto rise = [&](int x, int y, int x2, int y2) {
    return (height_m[static_cast<std::size_t>(y2 * (n + 1) + x2)] -
            height_m[static_cast<std::size_t>(y * (n + 1) + x)]) *
           static_cast<float>(1.0 / step_m);
  };
  float steepest = 0.0f;
  for (int a = 0; a <= n; ++a)
    for (int b = 0; b < n; ++b)
      steepest =
          std::max({steepest, std::abs(rise(b, a, b + 1, a)), std::abs(rise(a, b, a, b + 1))});
  float highest = 0.0f;
  for (const float z : height_m) highest = std::max(highest, std::abs(z));
  const float unit = std::max(steepest / 127.0f, 1e-9f);
  const float z_unit = std::max(highest / 32767.0f, 1e-9f);
  for (OracleDiamond& d : diamonds) {
    const int reach = d.level % 2 == 0 ? 3 * d.half : 2 * d.half;
    const int cell = std::min(n, (d.level % 2 == 0 ? 8 : 4) * d.half);
    const auto begin = [&](int centre) { return std::max(0, centre - reach) / cell * cell; };
    const auto end = [&](int centre) {
      return (std::min(n, centre + reach) + cell - 1) / cell * cell;
    };
    const auto [cx, cy] = d.centre;
    float z_least = HUGE_VALF, z_most = -HUGE_VALF;
    float x_least = HUGE_VALF, x_most = -HUGE_VALF, y_least = HUGE_VALF, y_most = -HUGE_VALF;
    for (int y = begin(cy); y <= end(cy); ++y) {
      for (int x = begin(cx); x <= end(cx); ++x) {
        const float z = height_m[static_cast<std::size_t>(y * (n + 1) + x)];
        z_least = std::min(z_least, z), z_most = std::max(z_most, z);
        if (x < end(cx)) {
          x_least = std::min(x_least, rise(x, y, x + 1, y));
          x_most = std::max(x_most, rise(x, y, x + 1, y));
        }
        if (y < end(cy)) {
          y_least = std::min(y_least, rise(x, y, x, y + 1));
          y_most = std::max(y_most, rise(x, y, x, y + 1));
        }
      }
    }
    d.x_least = std::floor(x_least / unit) * unit, d.x_most = std::ceil(x_most / unit) * unit;
    d.z_unit_m = z_unit;
    d.z_least = std::floor(z_least / z_unit), d.z_most = std::ceil(z_most / z_unit);
    d.y_least = std::floor(y_least / unit) * unit, d.y_most = std::ceil(y_most / unit) * unit;
  }
}

// (distance / size)^2 in lattice steps with its factors, or infinity if outside the view.
inline float badness(const AdaptRequest& r, const Domain& domain, const OracleDiamond& d) {
  const int n = 1 << domain.lattice_bits;
  const double step_m = domain.size_m / n;
  const double far = std::pow(2.0, 28.0);
  const auto steps = [&](double m) { return std::max(-far, std::min(far, m / step_m)); };
  struct Range {
    float low, high;
    float distance() const { return low > 0.0f ? low : high < 0.0f ? -high : 0.0f; }
    float most_times(float least, float most) const {
      return std::max(std::max(least * low, least * high), std::max(most * low, most * high));
    }
  };
  const int reach = d.level % 2 == 0 ? 3 * d.half : 2 * d.half;
  const auto axis = [&](int centre, double eye_m, double min_m) {
    const double eye = steps(eye_m - min_m), whole = std::floor(eye);
    const auto rel = [&](int p) {
      return static_cast<float>(p - static_cast<int>(whole)) - static_cast<float>(eye - whole);
    };
    return Range{rel(std::max(0, centre - reach)), rel(std::min(n, centre + reach))};
  };
  const glm::dvec3 eye = r.view.eye_world;
  const Range x = axis(d.centre.first, eye.x, domain.min_world.x);
  const Range y = axis(d.centre.second, eye.y, domain.min_world.y);
  const Range z{static_cast<float>(steps(r.min_height_m - eye.z)),
                static_cast<float>(steps(r.max_height_m - eye.z))};

  const auto drop = static_cast<float>(step_m / (2.0 * r.earth_radius_m));
  const auto horizon = [&](double above_m) { return std::sqrt(2.0 * r.earth_radius_m * above_m); };
  View wide = r.view;
  wide.tan_half_x += r.frustum_margin;
  wide.tan_half_y += r.frustum_margin;
  for (const glm::vec4& p : frustum_planes(wide)) {
    // The corner furthest inside.
    const float a = p.x * (p.x > 0.0f ? x.high : x.low);
    const float b = p.y * (p.y > 0.0f ? y.high : y.low);
    // A round earth may have sunk as far as at the box's furthest corner.
    const float far_x = std::max(-x.low, x.high), far_y = std::max(-y.low, y.high);
    const float sunk = (far_x * far_x + far_y * far_y) * drop;
    const float c = sunk * std::max(-p.z, 0.0f) + p.z * (p.z > 0.0f ? z.high : z.low);
    if (a + b + c < 0.0f) return HUGE_VALF;
  }
  const PriorityFactors& f = r.factors;
  const auto z_unit = static_cast<float>(d.z_unit_m / step_m);
  const auto eye_z = static_cast<float>(steps(eye.z));
  const Range height = r.relief ? Range{d.z_least * z_unit - eye_z, d.z_most * z_unit - eye_z} : z;
  const float distance2 = x.distance() * x.distance() + y.distance() * y.distance() +
                          height.distance() * height.distance();
  const bool is_round = std::isfinite(r.earth_radius_m);
  if (is_round) {
    const double lowest_m = r.min_height_m, highest_m = r.max_height_m;
    const double horizon_steps =
        (horizon(std::max(eye.z - lowest_m, 0.0)) + horizon(highest_m - lowest_m)) / step_m;
    if (x.distance() * x.distance() + y.distance() * y.distance() >
        static_cast<float>(horizon_steps * horizon_steps))
      return HUGE_VALF;
  }
  float k = distance2;
  if (r.priority == Priority::kProjectedSize) {
    const double largest = domain.size_m / std::max(r.largest_size_m, step_m);
    float size2 = std::max(std::ldexp(1.0f, d.level), static_cast<float>(largest * largest));
    if (is_round) {
      // The width at which waves are missed by 16 times what a triangle of the domain's size cuts
      // off the earth, over that size.
      const double slope = std::max(static_cast<double>(r.max_slope), 0.02);
      const double width = 16.0 * domain.size_m / (4.0 * r.earth_radius_m * slope);
      size2 = std::min(size2, std::ldexp(static_cast<float>(1.0 / (width * width)), 2 * d.level));
    }
    k *= size2;
  }

  // The normal (-sx, -sy, 1) against the direction to the eye, for all slopes and places.
  if (std::max({f.back_facing, f.flat, f.off_silhouette, f.sunken}) > 1.0f) {
    const float most = r.max_slope;
    const float x0 = r.relief ? d.x_least : -most, x1 = r.relief ? d.x_most : most;
    const float y0 = r.relief ? d.y_least : -most, y1 = r.relief ? d.y_most : most;
    const bool back = x.most_times(x0, x1) + y.most_times(y0, y1) < height.low;
    const bool front = x.most_times(-x1, -x0) + y.most_times(-y1, -y0) < -height.high;
    const float spread = std::min(1.0f, std::max(x1 - x0, y1 - y0) / 0.5f);
    const float flat = 1.0f + (f.flat - 1.0f) * (1.0f - spread);
    k *= (back ? f.back_facing * f.back_facing : 1.0f) *
         (back || front ? f.off_silhouette * f.off_silhouette : 1.0f) *
         (height.high < -eye_z ? f.sunken * f.sunken : 1.0f) * (flat * flat);
  }

  // Haze: to the 16th power by squaring.
  if (std::isfinite(f.haze_distance_m)) {
    const auto per_step = static_cast<float>(1.0 / (8.0 * (f.haze_distance_m / step_m)));
    float q = 1.0f + std::min(std::sqrt(distance2) * per_step, 2.0f);
    for (int i = 0; i < 4; ++i) q *= q;
    k *= q;
  }

  // Nearer under focuses, down to diamonds of a quarter of their radius.
  const bool focused = std::ranges::any_of(r.focuses, [&](const Focus& focus) {
    const float dx = axis(d.centre.first, focus.centre_m.x, domain.min_world.x).distance();
    const float dy = axis(d.centre.second, focus.centre_m.y, domain.min_world.y).distance();
    const auto radius = static_cast<float>(steps(focus.radius_m));
    const double width_m = domain.size_m / std::sqrt(std::pow(2.0, d.level));
    return dx * dx + dy * dy <= radius * radius && width_m > focus.radius_m / 4.0;
  });
  if (focused) k *= 1.0f / (f.focus_nearer * f.focus_nearer);
  return k;
}

// The centres of the diamonds that must be split.
inline std::set<Point> target(const AdaptRequest& request, const Domain& domain,
                              const std::vector<OracleDiamond>& diamonds) {
  std::vector<std::tuple<float, int, int, int>> order;  // badness, level, y, x
  for (const OracleDiamond& d : diamonds)
    order.emplace_back(badness(request, domain, d), d.level, d.centre.second, d.centre.first);
  std::sort(order.begin(), order.end());
  const int n = 1 << domain.lattice_bits;
  std::set<Point> split;
  int triangles = 2;
  for (const auto& [key, level, y, x] : order) {
    const int added = x == 0 || y == 0 || x == n || y == n ? 1 : 2;
    if (key == HUGE_VALF || triangles + added > request.triangle_budget) break;
    triangles += added;
    split.insert({x, y});
  }
  return split;
}

// Leaf triangles: corners in ascending order, then the level.
using Leaf = std::tuple<Point, Point, Point, int>;

inline void add_leaves(const std::set<Point>& split, Point a, Point apex, Point b, int level,
                       std::set<Leaf>& leaves) {
  const int sum_x = a.first + b.first, sum_y = a.second + b.second;
  const Point middle{sum_x / 2, sum_y / 2};
  if (sum_x % 2 == 0 && sum_y % 2 == 0 && split.contains(middle)) {
    add_leaves(split, a, middle, apex, level + 1, leaves);
    add_leaves(split, apex, middle, b, level + 1, leaves);
    return;
  }
  std::array<Point, 3> corners{a, apex, b};
  std::sort(corners.begin(), corners.end());
  leaves.emplace(corners[0], corners[1], corners[2], level);
}

inline std::set<Leaf> leaves_of(const std::set<Point>& split, int bits) {
  const int n = 1 << bits;
  std::set<Leaf> leaves;
  add_leaves(split, {0, 0}, {n, 0}, {n, n}, 0, leaves);
  add_leaves(split, {n, n}, {0, n}, {0, 0}, 0, leaves);
  return leaves;
}

inline std::set<Leaf> leaves_of(const Mesh& mesh) {
  std::set<Leaf> leaves;
  for (std::size_t t = 0; t < mesh.level.size(); ++t) {
    std::array<Point, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::ivec2 p = mesh.lattice[mesh.indices[3 * t + k]];
      corners[k] = {p.x, p.y};
    }
    std::sort(corners.begin(), corners.end());
    leaves.emplace(corners[0], corners[1], corners[2], mesh.level[t]);
  }
  return leaves;
}

}  // namespace swell::lod::oracle
