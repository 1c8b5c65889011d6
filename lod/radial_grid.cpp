#include "lod/radial_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "lod/plane.h"
#include "math/check.h"
#include "math/earth.h"
#include "math/elementary.h"

namespace swell::lod {
namespace {

constexpr double kLeastDomain_m = 131072.0, kMostDomain_m = 16.0 * kLeastDomain_m;
constexpr int kDomainBits = 30;
constexpr double kBeyondHorizon = 1.1;    // for waves that stand behind it
constexpr double kSquareCells_m = 100.0;  // where cells are as wide as they are deep
// More would bring vertices near the middle within a few lattice steps of each other.
constexpr int kMostColumns = 2048, kMostRings = 16384;

double root4(double x) { return std::sqrt(std::sqrt(x)); }

// Where the last ring lies.
double last_ring_m(const View& view) {
  const double eye_m = std::max(view.eye_world.z, 0.0);
  const double horizon_m = kBeyondHorizon * std::sqrt(2.0 * kEffectiveEarthRadius_m * eye_m);
  return std::clamp(horizon_m, kRadialLast_m, 0.49 * kMostDomain_m);
}

double domain_size_m(const View& view) {
  double size_m = kLeastDomain_m;
  while (0.49 * size_m < last_ring_m(view)) size_m *= 2.0;
  return size_m;
}

// The directions around the vertical that a view can see, in turns counter-clockwise from east.
struct Sector {
  double first, size;  // size in (0, 1]
};

// A view that holds the zenith or the nadir sees every direction; any other sees the wedge between
// its corners, which all lie less than half a turn from its middle.
Sector sector_in_view(const View& view) {
  constexpr float kSlack = 1.001f;
  for (const float side : {1.0f, -1.0f}) {
    const float depth = side * view.forward.z * kSlack;
    const float x = view.right.z - view.tan_middle_x * view.forward.z;  // from the window's middle
    const float y = view.up.z - view.tan_middle_y * view.forward.z;
    if (depth > 0.0f && std::abs(x) <= view.tan_half_x * depth &&
        std::abs(y) <= view.tan_half_y * depth)
      return {0.0, 1.0};
  }
  constexpr double kMargin = 1e-7;
  const glm::vec3 to_middle =
      view.forward + view.right * view.tan_middle_x + view.up * view.tan_middle_y;
  const glm::dvec2 ahead(to_middle);
  double low = 0.0, high = 0.0;
  for (const float x : {-view.tan_half_x, view.tan_half_x}) {
    for (const float y : {-view.tan_half_y, view.tan_half_y}) {
      const glm::dvec2 corner(to_middle + view.right * x + view.up * y);
      const double turns =
          atan2(ahead.x * corner.y - ahead.y * corner.x, glm::dot(ahead, corner)) / (2.0 * kPi);
      low = std::min(low, turns), high = std::max(high, turns);
    }
  }
  const double middle = atan2(ahead.y, ahead.x) / (2.0 * kPi);
  return {middle + low - kMargin, std::min(high - low + 2.0 * kMargin, 1.0)};
}

// The number of the first ring outside 2 r_0.
int first_ring_kept(const RadialLayout& layout) {
  const double share = layout.first_m / (layout.last_m - layout.first_m);
  return std::max(1, static_cast<int>(std::ceil(root4(share) * (layout.rings - 1))));
}

struct GridWriter {
  RadialLayout layout;
  glm::dvec2 centre;  // in lattice steps
  double steps_per_m;
  Mesh& mesh;

  double radius_m(int ring) const {
    const double share = static_cast<double>(ring) / (layout.rings - 1);
    const double square = share * share;
    return layout.first_m + (layout.last_m - layout.first_m) * (square * square);
  }
  int ring_number(int kept) const { return kept == 0 ? 0 : layout.first_ring + kept - 1; }

  void write_column_vertices(int column, glm::ivec2* out) const {
    const SinCos angle = sin_cos_turns(static_cast<double>(column % layout.columns) /
                                       static_cast<double>(layout.columns));
    const glm::dvec2 direction = steps_per_m * glm::dvec2(angle.cos, angle.sin);
    for (int k = 0; k < layout.rings_kept(); ++k) {
      const glm::dvec2 p = centre + radius_m(ring_number(k)) * direction;
      out[k] = {static_cast<int>(std::nearbyint(p.x)), static_cast<int>(std::nearbyint(p.y))};
    }
  }

  // The column between the vertices from `right` and those from `left` on.
  void write_column(std::uint32_t right, std::uint32_t left, std::size_t triangle) const {
    std::uint32_t* out = &mesh.indices[3 * triangle];
    const auto write = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      out[0] = a, out[1] = b, out[2] = c;
      out += 3;
    };
    write(0, right, left);
    for (int k = 0; k + 1 < layout.rings_kept(); ++k, ++right, ++left) {
      write(left, right, right + 1);
      write(right + 1, left + 1, left);
    }
  }

  // Writes the levels of a column's triangles, which are the same in all columns.
  void write_column_levels(std::uint8_t* out) const {
    const auto halvings = [&](double r_m) {
      return std::bit_width(static_cast<unsigned>(layout.last_m / r_m)) - 1;
    };
    *out++ = static_cast<std::uint8_t>(2 * halvings(layout.first_m));
    for (int k = 1; k < layout.rings_kept(); ++k, out += 2)
      out[0] = out[1] = static_cast<std::uint8_t>(2 * halvings(radius_m(ring_number(k))));
  }
};

}  // namespace

Domain radial_domain(const View& view) {
  const double size_m = domain_size_m(view);
  return {glm::floor(glm::dvec2(view.eye_world)) - 0.5 * size_m, size_m, kDomainBits};
}

// Cells are dr = 4 r / i deep and 2 pi r / M wide: equal where i = 2 M / pi.
RadialLayout radial_layout(const View& view, int triangle_budget) {
  SWELL_CHECK(triangle_budget >= kRadialLeastBudget, "triangle_budget={}", triangle_budget);
  const Sector sector = sector_in_view(view);
  RadialLayout layout;
  layout.last_m = last_ring_m(view);
  layout.first_m = kRadialFirst_m * domain_size_m(view) / kLeastDomain_m;
  const double columns_per_ring = 0.5 * kPi * root4(kSquareCells_m / layout.last_m);
  const double rings = std::sqrt(triangle_budget / (2.0 * sector.size * columns_per_ring));

  layout.columns = std::clamp(static_cast<int>(rings * columns_per_ring), 4, kMostColumns);
  // One column more than the sector's share may be cut at both of its sides.
  const int most_seen =
      std::min(layout.columns, static_cast<int>(sector.size * layout.columns) + 2);
  const int most_kept = (triangle_budget / most_seen + 1) / 2;
  layout.rings = std::min(most_kept, kMostRings);
  do layout.first_ring = first_ring_kept(layout);
  while (layout.rings_kept() < most_kept && layout.rings++ < kMostRings);

  const double first = std::floor(sector.first * layout.columns);
  const double last = std::floor((sector.first + sector.size) * layout.columns);
  layout.columns_seen = std::min(static_cast<int>(last - first) + 1, layout.columns);
  const int wrapped = static_cast<int>(first) % layout.columns;
  layout.first_column = wrapped < 0 ? wrapped + layout.columns : wrapped;
  return layout;
}

AdaptStatistics write_radial_grid(const View& view, int triangle_budget, Mesh& mesh) {
  const glm::dvec2 eye(view.eye_world);
  SWELL_CHECK(std::isfinite(eye.x) && std::isfinite(eye.y), "eye=({}, {})", eye.x, eye.y);
  SWELL_CHECK(triangle_budget >= 2, "triangle_budget={}", triangle_budget);
  const Domain domain = radial_domain(view);
  if (triangle_budget < kRadialLeastBudget) {
    write_plane(domain, mesh);
    return {.triangles = 2};
  }

  // Storage: a grid has at most two vertices more than triangles.
  const RadialLayout layout = radial_layout(view, triangle_budget);
  const auto budget = static_cast<std::size_t>(triangle_budget);
  const auto kept = static_cast<std::size_t>(layout.rings_kept());
  const bool whole_turn = layout.columns_seen == layout.columns;
  const int spokes = layout.columns_seen + (whole_turn ? 0 : 1);
  const auto triangles = static_cast<std::size_t>(layout.triangles());
  mesh.lattice.reserve(budget + 2);
  mesh.indices.reserve(3 * budget);
  mesh.level.reserve(budget);
  mesh.lattice.resize(1 + static_cast<std::size_t>(spokes) * kept);
  mesh.indices.resize(3 * triangles);
  mesh.level.resize(triangles);

  // The middle, then spoke by spoke.
  const double steps_per_m = std::ldexp(1.0 / domain.size_m, domain.lattice_bits);
  const GridWriter writer{layout, (eye - domain.min_world) * steps_per_m, steps_per_m, mesh};
  mesh.lattice[0] = {static_cast<int>(std::nearbyint(writer.centre.x)),
                     static_cast<int>(std::nearbyint(writer.centre.y))};
  for (int s = 0; s < spokes; ++s)
    writer.write_column_vertices(layout.first_column + s,
                                 &mesh.lattice[1 + static_cast<std::size_t>(s) * kept]);
  const std::size_t in_column = 2 * kept - 1;
  writer.write_column_levels(mesh.level.data());
  for (std::size_t c = 0; c < static_cast<std::size_t>(layout.columns_seen); ++c) {
    const std::size_t left = (c + 1) % static_cast<std::size_t>(spokes);
    writer.write_column(static_cast<std::uint32_t>(1 + c * kept),
                        static_cast<std::uint32_t>(1 + left * kept), c * in_column);
    if (c > 0) std::copy_n(mesh.level.begin(), in_column, mesh.level.begin() + c * in_column);
  }
  return {.triangles = layout.triangles()};
}

}  // namespace swell::lod
