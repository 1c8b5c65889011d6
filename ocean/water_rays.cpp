#include "ocean/water_rays.h"

#include <algorithm>
#include <array>

#include "math/check.h"
#include "math/parallel.h"
#include "ocean/open_sea/patch_bounds.h"
#include "ocean/spectrum/point_chunk.h"
#include "ocean/wakes/wakes.h"
#include "ocean/water_sources.h"

namespace swell::ocean {
namespace {

constexpr double kExact_m = 1e-5;
// Steps are longer than what is known to be free by this factor where the two ends' free lengths
// meet: they always do below 2 over level water, and where it rises to the ray by a third of the
// steepest slope below 1.5.
// Source: Keinert et al., Enhanced Sphere Tracing, 2014 (over-relaxation).
constexpr double kRelaxed = 1.5;

// How fast the gap over the surface may close along a ray, as FrameBounds has its details, without
// and with the wakes.
struct Closing {
  static constexpr std::size_t kMost = FrameBounds::kMostDetails + 2;
  std::size_t count = 0;
  std::array<double, kMost> rest_m, ahead_m, back_m;  // twice the rest; a metre of gap is so free

  void add(FrameBounds::Detail detail, glm::dvec3 along) {
    const double tilt = detail.steepest * glm::length(glm::dvec2(along));
    rest_m[count] = 2.0 * detail.rest_m;
    ahead_m[count] = 1.0 / std::max(tilt - along.z, 1e-9);
    back_m[count] = 1.0 / std::max(tilt + along.z, 1e-9);
    ++count;
  }
  // How far from a place with this gap over it the surface does not reach the ray.
  double free_ahead(double gap_m) const { return free(gap_m, ahead_m); }
  double free_back(double gap_m) const { return free(gap_m, back_m); }

 private:
  double free(double gap_m, const std::array<double, kMost>& per_m) const {
    double most = 0.0;
    for (std::size_t k = 0; k < count; ++k) most = std::max(most, (gap_m - rest_m[k]) * per_m[k]);
    return most;
  }
};

// A ray on its way: [above_m, tried_m] and the gaps over the surface at its ends. It marches until
// the far end is under the surface, and then divides what is between.
struct Way {
  std::size_t ray;
  double above_m, above_gap_m;
  double above_free_m;  // ahead
  double tried_m;
  double under_m = 0.0, under_gap_m = 0.0;
  double weight_above = 1.0, weight_under = 1.0;
  int divisions = 0;
  bool is_first = true, is_relaxed = false, divides = false, is_done = false;
};

double least_step_m(double s) { return 0.02 + 2e-4 * s; }

void step(Way& way, double factor, const AirRays& rays) {
  const double least_m = least_step_m(way.above_m);
  const double step_m = std::max(factor * way.above_free_m, least_m);
  way.is_relaxed = step_m > std::max(way.above_free_m, least_m);
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

void march_on(Way& way, double gap_m, const Closing& closing, const AirRays& rays) {
  if (gap_m <= 0.0) {
    if (way.is_relaxed) return step(way, 1.0, rays);
    way.under_m = way.tried_m;
    way.under_gap_m = gap_m;
    way.divides = true;
    return;
  }
  const bool leaves_room = way.tried_m - closing.free_back(gap_m) > way.above_m + way.above_free_m;
  if (way.is_relaxed && leaves_room) return step(way, 1.0, rays);
  way.above_m = way.tried_m;
  way.above_gap_m = gap_m;
  way.above_free_m = closing.free_ahead(gap_m);
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
void go_on(Way& way, double gap_m, const Closing& closing, const AirRays& rays,
           std::span<double> met_m) {
  if (way.is_first) {
    way.is_first = false;
    way.above_gap_m = gap_m;
    way.above_free_m = closing.free_ahead(gap_m);
    way.is_done = gap_m <= 0.0 || way.above_m >= rays.farthest_m[way.ray];
    if (gap_m <= 0.0) met_m[way.ray] = way.above_m;
    return step(way, kRelaxed, rays);
  }
  if (way.divides)
    divide_on(way, gap_m);
  else
    march_on(way, gap_m, closing, rays);
  if (!way.divides || way.is_done) return;
  way.is_done = way.under_m - way.above_m <= kExact_m;
  if (way.is_done) met_m[way.ray] = way.under_m;
  divide(way);
}

// Where a ray comes below a height.
double entry_m(double z, double rise, double height_m) {
  return z <= height_m ? 0.0 : rise < 0.0 ? (height_m - z) / rise : HUGE_VAL;
}

// Adds the highest and the steepest of what each wake has where a ray goes from a to b.
void add_wakes(const FrameBounds& bounds, glm::dvec2 a, glm::dvec2 b, double& height_m,
               double& slope) {
  constexpr int kSquares = FrameBounds::Wake::kSquares;
  for (const FrameBounds::Wake& wake : bounds.wakes) {
    const glm::dvec2 low = (glm::min(a, b) - wake.corner_m) / wake.square_m;
    const glm::dvec2 high = (glm::max(a, b) - wake.corner_m) / wake.square_m;
    if (!(high.x >= 0.0 && high.y >= 0.0 && low.x <= kSquares && low.y <= kSquares)) continue;
    const glm::ivec2 first(glm::max(low, 0.0)), last(glm::min(high, kSquares - 1.0));
    FrameBounds::Square most;
    for (int j = first.y; j <= last.y; ++j)
      for (int i = first.x; i <= last.x; ++i) {
        const auto& square = wake.squares[static_cast<std::size_t>(j * kSquares + i)];
        most.height_m = std::max(most.height_m, square.height_m);
        most.slope = std::max(most.slope, square.slope);
      }
    height_m += most.height_m;
    slope += most.slope;
  }
}

// Where the ray comes into the heights that the surface has; nothing where it does not.
bool begin(const FrameBounds& bounds, const AirRays& rays, std::size_t ray, Way& way,
           Closing& closing) {
  const glm::dvec3 origin = rays.origin_world[ray], along = rays.along[ray];
  double highest_m = bounds.highest_m, wakes_m = 0.0, wakes_slope = 0.0;
  for (const FrameBounds::Wake& wake : bounds.wakes) highest_m += wake.height_m;
  const double from_m = entry_m(origin.z, along.z, highest_m);
  // Below all water it has met some.
  const double to_m = std::min(rays.farthest_m[ray],
                               along.z < 0.0 ? (bounds.lowest_m - origin.z) / along.z : HUGE_VAL);
  if (!(from_m <= rays.farthest_m[ray])) return false;
  add_wakes(bounds, glm::dvec2(origin + from_m * along), glm::dvec2(origin + to_m * along), wakes_m,
            wakes_slope);
  const double begin_m = entry_m(origin.z, along.z, bounds.highest_m + wakes_m);
  if (!(begin_m <= rays.farthest_m[ray])) return false;
  closing.count = 0;
  for (const FrameBounds::Detail& detail : bounds.details)
    closing.add({detail.rest_m, detail.steepest + wakes_slope}, along);
  if (wakes_m > 0.0)
    for (const FrameBounds::Detail& detail : {bounds.details.front(), bounds.details.back()})
      closing.add({detail.rest_m + wakes_m, detail.steepest}, along);
  way = {};
  way.ray = ray;
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
  std::array<Closing, kPointChunk> closing;  // by ray
  std::size_t count = 0;
  for (std::size_t i = first; i < end; ++i) {
    met_m[i] = HUGE_VAL;
    if (begin(bounds, rays, i, ways[count], closing[i - first])) ++count;
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
      Way& way = ways[k];
      go_on(way, at(way).z - static_cast<double>(height_m[k]), closing[way.ray - first], rays,
            met_m);
      if (!way.is_done) ways[kept++] = way;
    }
    count = kept;
  }
  if (bounds.banks) leave_out_banks(water, *bounds.banks, rays, first, end, met_m);
}

// ---- Bounds

// Of the patches and the sines, the gentlest for their height first.
std::vector<HeightBounds> bounds_of_waves(const SeaFrame& frame) {
  std::vector<HeightBounds> waves = {bounds_of_sines(frame)};
  for (const PatchFrame& patch : frame.patches) waves.push_back(bounds_of_patch(patch));
  std::erase_if(waves, [](const HeightBounds& some) { return some.height_m == 0.0; });
  std::ranges::sort(waves, [](const HeightBounds& a, const HeightBounds& b) {
    return a.slope * b.height_m < b.slope * a.height_m;
  });
  return waves;
}

// All waves, then without the steepest ones, the last time without any. `fading`: what is steep
// besides.
void add_details(std::span<const HeightBounds> waves, double steepest, double fading,
                 FrameBounds& bounds) {
  double rest_m = 0.0;
  for (std::size_t left = waves.size();; --left) {
    double slope = 0.0;
    for (const HeightBounds& some : waves.first(left)) slope += some.slope;
    if (bounds.details.size() + 1 < FrameBounds::kMostDetails || left == 0)
      bounds.details.push_back({rest_m, std::min(slope, steepest) + fading});
    if (left == 0) return;
    rest_m += waves[left - 1].height_m;
  }
}

// The slope of the weight that wakes fade with: in water shallower than half a metre, at the edge.
double wake_fading_per_m(const WaterParts& water, const GroundSlopes& ground) {
  constexpr double kShallow_m = 0.5;
  const glm::dvec2 rim_m = kEdgePart * water.area.limits_m();
  const double of_edge = 3.0 / std::min(rim_m.x, rim_m.y);
  return water.land ? of_edge + ground.all / kShallow_m : of_edge;
}

FrameBounds::Wake bounds_by_squares(const WakeWindow& window, double fading_per_m) {
  constexpr int kSquares = FrameBounds::Wake::kSquares, kSamples = kWakeSamples / kSquares;
  FrameBounds::Wake wake;
  wake.corner_m = window.corner_m;
  wake.square_m = window.length_m / kSquares;
  for (int n = 0; n < kSquares * kSquares; ++n) {
    const glm::ivec2 low = kSamples * glm::ivec2(n % kSquares, n / kSquares);
    const WakeBounds of_square =
        bounds_of_wake(window, low, glm::min(low + kSamples, kWakeSamples - 1));
    const auto height_m = static_cast<double>(of_square.height_m);
    const auto slope = static_cast<double>(of_square.slope);
    wake.squares[static_cast<std::size_t>(n)] = {height_m,
                                                 slope + std::min(slope, fading_per_m * height_m)};
    wake.height_m = std::max(wake.height_m, height_m);
  }
  return wake;
}

}  // namespace

FrameBounds frame_bounds(const WaterParts& water, const SeaFrame& frame,
                         const GroundSlopes& ground) {
  WaterParts calm = water;
  calm.wakes = {};
  const WaterBounds of_calm = WaterBody(calm).bounds();
  const std::vector<HeightBounds> waves = bounds_of_waves(frame);
  double waves_m = 0.0;
  for (const HeightBounds& some : waves) waves_m += some.height_m;
  const double always_m = water.sea->height_bound_m();
  const double unused_m = std::max(always_m - waves_m, 0.0);
  FrameBounds bounds;
  bounds.highest_m = static_cast<double>(of_calm.highest_m) - unused_m + 1e-3;
  bounds.lowest_m = -static_cast<double>(of_calm.height_m) + unused_m - 1e-3;
  // What fades is as high as the waves are now, on ground as steep as it is.
  const double part = always_m > 0.0 ? std::min(waves_m / always_m, 1.0) : 1.0;
  double fading = of_calm.steepest - water.sea->slope_bound();
  if (water.land && !water.inland)
    fading -= (1.0 - part * std::min(ground.shallow, 1.0)) * shallow_steepness(*water.sea);
  if (water.shelter)
    fading -= (1.0 - part) * static_cast<double>(water.shelter->slope_per_m) * always_m;
  add_details(waves, water.sea->slope_bound(), fading, bounds);
  if (water.inland) {
    bounds.banks = water.land;
    for (FrameBounds::Detail& detail : bounds.details)
      detail.steepest = std::max(detail.steepest, ground.all);
  }
  for (std::size_t w = 0; w < frame.wakes.count; ++w) {
    need_wake(frame.wakes, w, WakeFields::kHeights);
    const WakeWindow& window = frame.wakes.windows[w];
    bounds.wakes.push_back(bounds_by_squares(window, wake_fading_per_m(water, ground)));
    bounds.lowest_m -= bounds.wakes.back().height_m;
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
