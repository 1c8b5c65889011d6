#include "scene/implicit_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "math/elementary.h"
#include "math/stop.h"

namespace swell::scene {
namespace {

double cube_of_positive(double q) { return q > 0.0 ? q * q * q : 0.0; }

// Returns the interval that q + g s + k s^2 takes for s in [-1, 1].
Interval bounds_along(double q, double g, double k) {
  Interval range{std::min(q + g + k, q - g + k), std::max(q + g + k, q - g + k)};
  if (std::abs(g) < 2.0 * std::abs(k)) {
    const double turn = q - 0.25 * g * g / k;
    range = {std::min(range.low, turn), std::max(range.high, turn)};
  }
  return range;
}

// A part's points lie within this of the implicit surface's origin along each axis [m].
constexpr double kFarthest_m = 1000.0;

struct Cell {
  glm::dvec3 middle, half;
  Spans spans() const {
    return {glm::dvec3(half.x, 0.0, 0.0), glm::dvec3(0.0, half.y, 0.0),
            glm::dvec3(0.0, 0.0, half.z)};
  }
};

// The cells, side^3 of a cell, that are wanted and that the part may reach into.
template <class Wanted, class Visit>
void for_cells(const ImplicitPart& part, const Cell& cell, int side, const Wanted& wanted,
               const Visit& visit) {
  const glm::dvec3 half = cell.half / static_cast<double>(side);
  for (int k = 0; k < side; ++k)
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i) {
        const glm::dvec3 at = glm::dvec3(2 * i + 1 - side, 2 * j + 1 - side, 2 * k + 1 - side);
        const Cell inner{cell.middle + at * half, half};
        if (wanted(inner) && may_hold(part, inner.middle, inner.spans())) visit(inner);
      }
}

template <class Visit>
void for_cells(const ImplicitPart& part, const Cell& cell, int side, const Visit& visit) {
  for_cells(
      part, cell, side, [](const Cell&) { return true; }, visit);
}

// The same cells where wanted(cell) holds for a cell if it does for a part of it: whole blocks of
// cells are left out.
template <class Wanted, class Visit>
void for_cells_of_blocks(const ImplicitPart& part, const Cell& cell, int side, const Wanted& wanted,
                         const Visit& visit) {
  const glm::dvec3 half = cell.half / static_cast<double>(side);
  const auto look = [&](const auto& self, glm::ivec3 first, int count) -> void {
    const glm::dvec3 at(2 * first + count - side);
    const Cell block{cell.middle + at * half, static_cast<double>(count) * half};
    if (!wanted(block) || !may_hold(part, block.middle, block.spans())) return;
    if (count == 1) return visit(block);
    const int step = count % 2 == 0 ? count / 2 : count / 3;
    for (int k = 0; k < count; k += step)
      for (int j = 0; j < count; j += step)
        for (int i = 0; i < count; i += step) self(self, first + glm::ivec3(i, j, k), step);
  };
  look(look, glm::ivec3(0), side);
}

// Depth first, so that the search ends soon where there is an inside.
bool find_inside(ImplicitPart& part, const Cell& cell, int depth, int& cells_left) {
  if (value(part, cell.middle) >= 0.0) {
    part.inside = cell.middle;
    return true;
  }
  if (depth == 0 || cells_left <= 0) return false;
  bool found = false;
  for_cells(part, cell, 2, [&](const Cell& inner) {
    --cells_left;
    found = found || find_inside(part, inner, depth - 1, cells_left);
  });
  return found;
}

// The mean of its points, where that is one of them.
void take_middle(ImplicitPart& part, const Cell& box) {
  constexpr int kSide = 12;
  glm::dvec3 sum(0.0);
  double count = 0.0;
  for_cells(
      part, box, kSide, [&](const Cell& inner) { return value(part, inner.middle) >= 0.0; },
      [&](const Cell& inner) { sum += inner.middle, count += 1.0; });
  part.is_hollow = count > 0.0 && value(part, sum / count) < 0.0;
  if (count > 0.0 && !part.is_hollow) part.inside = sum / count;
}

glm::dmat3 negative_matrix(const Quadric& f) {
  return {-f.xx, -f.xy, -f.xz, -f.xy, -f.yy, -f.yz, -f.xz, -f.yz, -f.zz};
}

// Whether a quadric falls in every direction, or at least rises in none.
bool falls(const Quadric& f, double at_least) {
  const glm::dmat3 n = negative_matrix(f);
  const double a = n[0][0], b = n[1][1], c = n[2][2];
  const double ab = a * b - n[0][1] * n[0][1], ac = a * c - n[0][2] * n[0][2],
               bc = b * c - n[1][2] * n[1][2];
  const double size = std::max({std::abs(a), std::abs(b), std::abs(c)});
  const double edge = at_least * size;
  return a >= edge && b >= edge && c >= edge && ab >= edge * size && ac >= edge * size &&
         bc >= edge * size && glm::determinant(n) >= edge * size * size;
}

constexpr double kDefinite = 1e-12;

// The most of a quadric: infinite unless it falls in every direction.
double most_of(const Quadric& f) {
  if (!falls(f, kDefinite)) return std::numeric_limits<double>::infinity();
  return f.c + glm::dot(f.b, glm::inverse(negative_matrix(f)) * f.b);
}

// What perturbations add at most.
double most_added(const ImplicitTerm& term) {
  double most = 0.0;
  for (const Perturbation& r : term.perturbations)
    if (r.factor > 0.0) most += r.factor * cube_of_positive(most_of(r.quadric));
  return most;
}

// Cuts the box to that of the ellipsoid where f + added is at least 0, if it is one.
void cut_to(const Quadric& f, double added, glm::dvec3& low, glm::dvec3& high) {
  const double most = most_of(f) + added;
  if (!std::isfinite(most)) return;
  const glm::dmat3 inverse = glm::inverse(negative_matrix(f));
  const glm::dvec3 middle = inverse * f.b;
  const glm::dvec3 diagonal(inverse[0][0], inverse[1][1], inverse[2][2]);
  const glm::dvec3 half =
      (1.0 + 1e-6) * glm::sqrt(glm::max(diagonal * most, glm::dvec3(0.0))) + 1e-9;
  low = glm::max(low, middle - half);
  high = glm::min(high, middle + half);
}

// A box from closed forms: of each term that is an ellipsoid, and of the sum of those that rise
// nowhere, which is at least 0 where they all are: a cylinder's side and its ends.
Cell first_box(const ImplicitPart& part) {
  glm::dvec3 low(-kFarthest_m), high(kFarthest_m);
  Quadric sum;
  double sum_added = 0.0;
  for (const ImplicitTerm& term : part.terms) {
    const double added = most_added(term);
    const Quadric& f = term.quadric;
    cut_to(f, added, low, high);
    if (!falls(f, -kDefinite) || !std::isfinite(added)) continue;
    sum.xx += f.xx, sum.yy += f.yy, sum.zz += f.zz;
    sum.xy += f.xy, sum.xz += f.xz, sum.yz += f.yz;
    sum.b += f.b, sum.c += f.c, sum_added += added;
  }
  cut_to(sum, sum_added, low, high);
  if (!(low.x < high.x && low.y < high.y && low.z < high.z))
    throw std::runtime_error("a part without an inside");
  return {0.5 * (low + high), 0.5 * (high - low)};
}

// What a turning part sweeps.
Cell swept(const ImplicitPart& part) {
  const glm::dvec3 middle = 0.5 * (part.low + part.high), half = 0.5 * (part.high - part.low);
  if (part.turns_per_s == 0.0) return {middle, half};
  const glm::dvec3 from_hub = middle - part.hub;
  const double along = glm::dot(from_hub, part.axis);
  const double half_along = glm::dot(half, glm::abs(part.axis));
  const double radius = glm::length(from_hub - along * part.axis) + glm::length(half);
  const glm::dvec3 across = glm::sqrt(glm::max(1.0 - part.axis * part.axis, glm::dvec3(0.0)));
  return {part.hub + along * part.axis, half_along * glm::abs(part.axis) + radius * across};
}

}  // namespace

glm::dmat3 turn_about(glm::dvec3 axis, double turns) {
  const SinCos angle = sin_cos_turns(turns);
  glm::dmat3 m;
  for (int i = 0; i < 3; ++i) {
    glm::dvec3 e(0.0);
    e[i] = 1.0;
    m[i] = angle.cos * e + angle.sin * glm::cross(axis, e) +
           (1.0 - angle.cos) * glm::dot(axis, e) * axis;
  }
  return m;
}

double value(const ImplicitTerm& term, glm::dvec3 p) {
  double f = term.quadric(p);
  for (const Perturbation& r : term.perturbations) f += r.factor * cube_of_positive(r.quadric(p));
  return f;
}

glm::dvec3 gradient(const ImplicitTerm& term, glm::dvec3 p) {
  glm::dvec3 g = term.quadric.gradient(p);
  for (const Perturbation& r : term.perturbations) {
    const double q = std::max(r.quadric(p), 0.0);
    g += 3.0 * r.factor * q * q * r.quadric.gradient(p);
  }
  return g;
}

double value(const ImplicitPart& part, glm::dvec3 p) {
  double least = 1e300;
  for (const ImplicitTerm& term : part.terms) least = std::min(least, value(term, p));
  return part.table ? std::min(least, value(*part.table, p)) : least;
}

// The quadric is q + g . s + s^T K s of the spans' factors s. Along the first span, which is the
// longest in rays' cells, its range is exact; the others widen it.
Interval bounds(const Quadric& quadric, glm::dvec3 middle, const Spans& spans) {
  const double q = quadric(middle);
  const glm::dvec3 slope = quadric.gradient(middle);
  const std::array<glm::dvec3, 3> bent = {quadric.times(spans[0]), quadric.times(spans[1]),
                                          quadric.times(spans[2])};
  Interval range = bounds_along(q, glm::dot(slope, spans[0]), glm::dot(spans[0], bent[0]));
  const double mixed = std::abs(glm::dot(spans[0], bent[1])) +
                       std::abs(glm::dot(spans[0], bent[2])) +
                       std::abs(glm::dot(spans[1], bent[2]));
  range.low -= 2.0 * mixed, range.high += 2.0 * mixed;
  for (const std::size_t i : {1u, 2u}) {
    const Interval more = bounds_along(0.0, glm::dot(slope, spans[i]), glm::dot(spans[i], bent[i]));
    range.low += more.low, range.high += more.high;
  }
  // Rounding, of floats, which look for the zeros.
  const double size = std::abs(quadric.c) + std::abs(glm::dot(quadric.b, middle)) + std::abs(q) +
                      std::max(std::abs(range.low), std::abs(range.high));
  range.low -= 1e-6 * size, range.high += 1e-6 * size;
  return range;
}

Interval bounds(const ImplicitTerm& term, glm::dvec3 middle, const Spans& spans) {
  Interval range = bounds(term.quadric, middle, spans);
  for (const Perturbation& r : term.perturbations) {
    const Interval q = bounds(r.quadric, middle, spans);
    const double low = r.factor * cube_of_positive(q.low),
                 high = r.factor * cube_of_positive(q.high);
    range.low += std::min(low, high), range.high += std::max(low, high);
  }
  return range;
}

bool may_hold(const ImplicitPart& part, glm::dvec3 middle, const Spans& spans) {
  return std::ranges::all_of(
             part.terms,
             [&](const ImplicitTerm& term) { return bounds(term, middle, spans).high >= 0.0; }) &&
         !(part.table && most_of(*part.table, middle, spans) < 0.0);
}

// Shrinks the box around what cells of it may hold of the part, until it shrinks no more.
void find_box(ImplicitPart& part) {
  constexpr int kSide = 12, kMostRounds = 24;
  constexpr double kEnough = 0.97;
  Cell box = first_box(part);
  for (int round = 0; round < kMostRounds; ++round) {
    glm::dvec3 low(kFarthest_m), high(-kFarthest_m);
    const auto makes_larger = [&](const Cell& inner) {
      return glm::any(glm::lessThan(inner.middle - inner.half, low)) ||
             glm::any(glm::greaterThan(inner.middle + inner.half, high));
    };
    for_cells_of_blocks(part, box, kSide, makes_larger, [&](const Cell& inner) {
      low = glm::min(low, inner.middle - inner.half);
      high = glm::max(high, inner.middle + inner.half);
    });
    if (!(low.x < high.x)) throw std::runtime_error("a part without an inside");
    const Cell next{0.5 * (low + high), 0.5 * (high - low)};
    const bool done = glm::all(glm::greaterThan(next.half, kEnough * box.half));
    box = next;
    if (done) break;
  }
  const glm::dvec3 reach = glm::abs(box.middle) + box.half;
  if (std::max({reach.x, reach.y, reach.z}) > 0.999 * kFarthest_m)
    throw std::runtime_error(fmt::format("a part that goes on beyond {} m", kFarthest_m));
  int cells_left = 200000;
  if (!find_inside(part, box, 9, cells_left)) throw std::runtime_error("a part without an inside");
  part.low = box.middle - box.half, part.high = box.middle + box.half;
  take_middle(part, box);
}

void find_boxes(ImplicitSurface& implicit) {
  if (implicit.parts.empty()) throw std::runtime_error("a form without parts");
  implicit.low = glm::dvec3(kFarthest_m), implicit.high = glm::dvec3(-kFarthest_m);
  for (ImplicitPart& part : implicit.parts) {
    check_stop();
    if (part.low == part.high) find_box(part);
    const Cell sweep = swept(part);
    implicit.low = glm::min(implicit.low, sweep.middle - sweep.half);
    implicit.high = glm::max(implicit.high, sweep.middle + sweep.half);
  }
}

}  // namespace swell::scene
