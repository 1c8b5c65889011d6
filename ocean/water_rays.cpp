#include "ocean/water_rays.h"

#include <algorithm>
#include <array>

#include "math/check.h"
#include "math/parallel.h"
#include "ocean/spectrum/point_chunk.h"
#include "ocean/wakes/wakes.h"

namespace swell::ocean {
namespace {

constexpr double kExact_m = 1e-5;
// Steps are longer than what is known to be free by this factor where the two ends' free lengths
// meet: half as many of them where the gap closes slowly.
// Source: Keinert et al., Enhanced Sphere Tracing, 2014 (over-relaxation).
constexpr double kRelaxed = 1.8;

// A ray on its way: [above_m, tried_m] and the gaps over the surface at its ends. It marches until
// the far end is under the surface, and then divides what is between.
struct Way {
  std::size_t ray;
  double closing, closing_back;  // of the gap a metre at most, ahead and back
  double above_m, above_gap_m;
  double tried_m;
  double under_m = 0.0, under_gap_m = 0.0;
  double weight_above = 1.0, weight_under = 1.0;
  int divisions = 0;
  bool is_first = true, is_relaxed = false, divides = false, is_done = false;
};

double least_step_m(double s) { return 0.02 + 2e-4 * s; }

void step(Way& way, double factor, const AirRays& rays) {
  const double free_m = way.above_gap_m / way.closing;
  const double least_m = least_step_m(way.above_m);
  const double step_m = std::max(factor * free_m, least_m);
  way.is_relaxed = step_m > std::max(free_m, least_m);
  way.tried_m = std::min(way.above_m + step_m, rays.farthest_m[way.ray]);
}

// Between the ends by a straight line, with one end's gap halved when the other one stays: the
// Illinois method; every fourth time in the middle.
void divide(Way& way) {
  const double a = way.weight_above * way.above_gap_m, b = -way.weight_under * way.under_gap_m;
  const double length = way.under_m - way.above_m;
  const double part = ++way.divisions % 4 == 0 ? 0.5 : a / (a + b);
  const double inset = std::min(0.5 * length, 0.4 * kExact_m);
  way.tried_m = way.above_m + std::clamp(part * length, inset, length - inset);
}

void march_on(Way& way, double gap_m, const AirRays& rays) {
  if (gap_m <= 0.0) {
    if (way.is_relaxed) return step(way, 1.0, rays);
    way.under_m = way.tried_m;
    way.under_gap_m = gap_m;
    way.divides = true;
    return;
  }
  const bool leaves_room =
      way.tried_m - gap_m / way.closing_back > way.above_m + way.above_gap_m / way.closing;
  if (way.is_relaxed && leaves_room) return step(way, 1.0, rays);
  way.above_m = way.tried_m;
  way.above_gap_m = gap_m;
  way.is_done = way.tried_m >= rays.farthest_m[way.ray];
  step(way, kRelaxed, rays);
}

void divide_on(Way& way, double gap_m) {
  if (gap_m > 0.0) {
    way.weight_under *= 0.5;
    way.weight_above = 1.0;
    way.above_m = way.tried_m;
    way.above_gap_m = gap_m;
  } else {
    way.weight_above *= 0.5;
    way.weight_under = 1.0;
    way.under_m = way.tried_m;
    way.under_gap_m = gap_m;
  }
}

// Takes the gap at tried_m, and says where to look next, or is done. `met_m` is then set.
void go_on(Way& way, double gap_m, const AirRays& rays, std::span<double> met_m) {
  if (way.is_first) {
    way.is_first = false;
    way.above_gap_m = gap_m;
    way.is_done = gap_m <= 0.0 || way.above_m >= rays.farthest_m[way.ray];
    if (gap_m <= 0.0) met_m[way.ray] = way.above_m;
    return step(way, kRelaxed, rays);
  }
  if (way.divides)
    divide_on(way, gap_m);
  else
    march_on(way, gap_m, rays);
  if (!way.divides || way.is_done) return;
  way.is_done = way.under_m - way.above_m <= kExact_m;
  if (way.is_done) met_m[way.ray] = way.under_m;
  divide(way);
}

// Where a ray comes below a height.
double entry_m(double z, double rise, double height_m) {
  return z <= height_m ? 0.0 : rise < 0.0 ? (height_m - z) / rise : HUGE_VAL;
}

bool passes_over(glm::dvec3 origin, glm::dvec3 along, double first_m, double last_m,
                 const FrameBounds::Wake& wake) {
  const glm::dvec2 a(origin + first_m * along), b(origin + last_m * along);
  for (int k = 0; k < 2; ++k)
    if (std::max(a[k], b[k]) < wake.low[k] || std::min(a[k], b[k]) > wake.high[k]) return false;
  return true;
}

// Where the ray comes into the heights that the surface has; nothing where it does not.
bool begin(const FrameBounds& bounds, const AirRays& rays, std::size_t ray, Way& way) {
  const glm::dvec3 origin = rays.origin_world[ray], along = rays.along[ray];
  double highest_m = bounds.highest_m, steepest = bounds.steepest;
  for (const FrameBounds::Wake& wake : bounds.wakes) highest_m += wake.height_m;
  const double from_m = entry_m(origin.z, along.z, highest_m);
  if (!(from_m <= rays.farthest_m[ray])) return false;
  for (const FrameBounds::Wake& wake : bounds.wakes) {
    if (passes_over(origin, along, from_m, rays.farthest_m[ray], wake))
      steepest += 2.0 * wake.slope;
    else
      highest_m -= wake.height_m;
  }
  const double begin_m = entry_m(origin.z, along.z, highest_m);
  if (!(begin_m <= rays.farthest_m[ray])) return false;
  const double tilt = steepest * glm::length(glm::dvec2(along));
  way = {};
  way.ray = ray;
  way.closing = std::max(tilt - along.z, 1e-9);
  way.closing_back = std::max(tilt + along.z, 1e-9);
  way.above_m = way.tried_m = begin_m;
  return true;
}

// Takes back what rays have met where the ground is higher than the water.
void leave_out_banks(const WaterSurface& water, const terrain::HeightGrid& ground,
                     const AirRays& rays, std::size_t first, std::size_t end,
                     std::span<double> met_m) {
  std::array<glm::dvec2, kPointChunk> p;
  std::array<float, kPointChunk> height_m, ground_m;
  for (std::size_t i = first; i < end; ++i)
    p[i - first] =
        glm::dvec2(rays.origin_world[i] + std::min(met_m[i], rays.farthest_m[i]) * rays.along[i]);
  const auto places = std::span(p).first(end - first);
  water.heights(places, std::span(height_m).first(end - first));
  terrain::sample_heights(ground, places, std::span(ground_m).first(end - first));
  for (std::size_t i = first; i < end; ++i)
    if (ground_m[i - first] > height_m[i - first]) met_m[i] = HUGE_VAL;
}

void meet_some(const WaterSurface& water, const FrameBounds& bounds, const AirRays& rays,
               std::size_t first, std::size_t end, std::span<double> met_m) {
  std::array<Way, kPointChunk> ways;
  std::size_t count = 0;
  for (std::size_t i = first; i < end; ++i) {
    met_m[i] = HUGE_VAL;
    if (begin(bounds, rays, i, ways[count])) ++count;
  }
  std::array<glm::dvec2, kPointChunk> p;
  std::array<float, kPointChunk> height_m, ground_m;
  const auto at = [&](const Way& way) {
    return rays.origin_world[way.ray] + way.tried_m * rays.along[way.ray];
  };
  while (count > 0) {
    for (std::size_t k = 0; k < count; ++k) p[k] = glm::dvec2(at(ways[k]));
    water.heights(std::span(p).first(count), std::span(height_m).first(count));
    if (bounds.banks) {
      terrain::sample_heights(*bounds.banks, std::span(p).first(count),
                              std::span(ground_m).first(count));
      for (std::size_t k = 0; k < count; ++k) height_m[k] = std::max(height_m[k], ground_m[k]);
    }
    std::size_t kept = 0;
    for (std::size_t k = 0; k < count; ++k) {
      Way way = ways[k];
      go_on(way, at(way).z - static_cast<double>(height_m[k]), rays, met_m);
      if (!way.is_done) ways[kept++] = way;
    }
    count = kept;
  }
  if (bounds.banks) leave_out_banks(water, *bounds.banks, rays, first, end, met_m);
}

}  // namespace

FrameBounds frame_bounds(const WaterParts& water, const SeaFrame& frame,
                         const GroundSlopes& ground) {
  WaterParts calm = water;
  calm.wakes = {};
  const WaterBounds of_calm = WaterBody(calm).bounds();
  FrameBounds bounds;
  bounds.highest_m = static_cast<double>(of_calm.highest_m) + 1e-3;
  bounds.lowest_m = -static_cast<double>(of_calm.height_m) - 1e-3;
  bounds.steepest = of_calm.steepest;
  if (water.inland) {
    bounds.banks = water.land;
    bounds.steepest = std::max(bounds.steepest, ground.all);
  } else if (water.land) {
    bounds.steepest -= (1.0 - std::min(ground.shallow, 1.0)) * shallow_steepness(*water.sea);
  }
  for (const WakeWindow& window : frame.wakes.shown()) {
    const WakeBounds wake = bounds_of_wake(window);
    bounds.wakes.push_back({window.corner_m, window.corner_m + window.length_m,
                            static_cast<double>(wake.height_m), static_cast<double>(wake.slope)});
    bounds.lowest_m -= static_cast<double>(wake.height_m);
  }
  return bounds;
}

void meet_water(const WaterSurface& water, const FrameBounds& bounds, const AirRays& rays,
                std::span<double> met_m) {
  const std::size_t count = met_m.size();
  SWELL_CHECK(rays.origin_world.size() == count && rays.along.size() == count &&
                  rays.farthest_m.size() == count,
              "{} origins, {} directions, {} lengths, {} places", rays.origin_world.size(),
              rays.along.size(), rays.farthest_m.size(), count);
  const ScopedFloatEnvironment ieee;
  for (std::size_t first = 0; first < count; first += kPointChunk)
    meet_some(water, bounds, rays, first, std::min(count, first + kPointChunk), met_m);
}

}  // namespace swell::ocean
