#include "terrain/apron.h"

#include <algorithm>
#include <cmath>

#include "math/smoothstep.h"

namespace swell::terrain {
namespace {

constexpr double kDeep_m = 60.0, kDeepPart = 0.15;  // of the side
constexpr double kGoesOnPart = 0.6;                 // of the apron

// A smooth wave of period 1 in [-1, 1] at a tenth of a sine's cost: water's vertices ask for
// depths.
double wave(double turns) {
  const double x = turns - std::floor(turns), hump = x * (1.0 - x);
  return 32.0 * hump * hump - 1.0;
}

// Bays and points, in [0.56, 1]: waves of three lengths, bent by one another. q: in aprons' widths.
double bays(glm::dvec2 q) {
  const double bend = wave(0.37 * q.x - 0.49 * q.y + 0.06);
  const double waves = wave(0.59 * q.x + 0.30 * q.y + 0.22 * bend + 0.21) +
                       0.6 * wave(-0.46 * q.x + 1.07 * q.y + 0.27 * bend) +
                       0.4 * wave(1.64 * q.x - 1.29 * q.y - 0.33 * bend);
  return 0.78 + 0.22 / 2.0 * waves;
}

// Where the ground sinks from and where it is all floor, as parts of the apron.
struct Slope {
  double from, to;
};

// q: from the map's middle, outside the map. A square's corners are further from its middle than
// its sides: beyond them the ground sinks at once, before the sides later, so that it ends about
// round.
Slope slope_at(glm::dvec2 q, double bays) {
  const double xx = q.x * q.x, yy = q.y * q.y, rr = xx + yy;
  const double sin2 = 4.0 * xx * yy / (rr * rr);  // of twice the azimuth, squared
  const double side = 1.0 - sin2 * sin2;          // 1 before a side's middle, 0 at a corner
  const double from = 0.36 * side * bays;
  return {from, from + (0.38 + 0.22 * side) * bays};
}

// What mirrors the height `inner` in the border's height, between the floor and the top.
double turned(double border, double inner, double floor, double top) {
  const double rise = border - inner;
  const double room = rise > 0.0 ? top - border : border - floor;
  if (rise == 0.0 || room <= 0.0) return border;
  return border + rise * room / (std::abs(rise) + room);
}

// The map turned about its border, at p, and further out the border's height; `near` is the
// border's point nearest to p, `part` of the apron away.
double goes_on(const HeightGrid& map, glm::dvec2 p, glm::dvec2 near, double part) {
  const double floor = map.apron.floor_m, top = std::max<double>(map.highest_m, floor);
  const glm::dvec2 inner = near + near - p;
  const auto along_x = [&](double y) {
    const double border = height_at(map, {near.x, y});
    return p.x == near.x ? border : turned(border, height_at(map, {inner.x, y}), floor, top);
  };
  const double border = along_x(near.y);
  const double ground = p.y == near.y ? border : turned(border, along_x(inner.y), floor, top);
  const double level = height_at(map, near);
  return ground + (level - ground) * smoothstep(0.0, kGoesOnPart, part);
}

}  // namespace

Apron make_apron(const HeightGrid& map) {
  const double side_m = map.grid.size_m();
  const double deep_m = std::min(kDeep_m, kDeepPart * side_m);
  return {0.5 * side_m, std::min(-deep_m, static_cast<double>(map.lowest_m))};
}

Grid square_with_apron(const HeightGrid& map) {
  const Grid& grid = map.grid;
  if (map.apron.width_m == 0.0) return grid;
  const int around = 2 * (grid.samples_x - 1) + 1;
  return {grid.min_world - map.apron.width_m, grid.spacing_m, around, around};
}

double height_on_apron(const HeightGrid& map, glm::dvec2 p_world) {
  const Apron& apron = map.apron;
  const glm::dvec2 low = map.grid.min_world, high = low + map.grid.extent_m();
  const glm::dvec2 near = glm::clamp(p_world, low, high);
  const double part = glm::distance(p_world, near) / apron.width_m;
  if (!(part < 1.0)) return apron.floor_m;  // NaN as well
  const Slope slope = slope_at(p_world - 0.5 * (low + high), bays((p_world - low) / apron.width_m));
  if (part >= slope.to) return apron.floor_m;
  const double ground = goes_on(map, p_world, near, part);
  const double down = std::max(part - slope.from, 0.0) / (slope.to - slope.from);
  return ground + (apron.floor_m - ground) * smooth_blend(down * down);
}

}  // namespace swell::terrain
