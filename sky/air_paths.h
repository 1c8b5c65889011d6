// Rays through the air: what of the light that is scattered on them arrives at their start. Used by
// scattered_light.cpp, what that is made of, and atmosphere.cpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <vector>

#include "math/parallel.h"
#include "math/smoothstep.h"
#include "sky/atmosphere.h"

namespace swell::sky {

// ---- Tables

// Where a table is read: between entries `first` and the next.
struct Between {
  int first = 0;
  float part = 0.0f;
};

// `place` is held to [0, count - 1].
inline Between between(double place, int count) {
  const double x = std::clamp(place, 0.0, count - 1.000001);
  const int first = static_cast<int>(x);
  return {first, static_cast<float>(x - first)};
}

inline glm::vec3 interpolate(const glm::vec3* table, int columns, Between row, Between column) {
  const glm::vec3* p = table + row.first * columns + column.first;
  const glm::vec3 low = p[0] + column.part * (p[1] - p[0]);
  p += columns;
  const glm::vec3 high = p[0] + column.part * (p[1] - p[0]);
  return low + row.part * (high - low);
}

// Fills Atmosphere::transmittance.
void fill_transmittance(Atmosphere& atmosphere, Workers& workers);

// A height's row in the table of transmittance, and what else of the height a look-up needs.
struct HeightRow {
  Between row;
  double radius_m, nearest_m, inv_span_m, horizon_sine;
};
HeightRow height_row_of(double height_m);

// Where the way to the air's top lies in a row of the table of transmittance.
inline constexpr int kTransmittanceColumns = 128;
inline Between transmittance_column(const HeightRow& at, double sine) {
  const double place = (distance_to_air_top_m(at.radius_m, sine) - at.nearest_m) * at.inv_span_m *
                       (kTransmittanceColumns - 1);
  return between(place, kTransmittanceColumns);
}

// The part of a light's disc that stands over the earth's edge.
inline double part_over_edge(const HeightRow& at, double sine) {
  const double over = sine - at.horizon_sine;
  return over >= kSunRadius_rad ? 1.0 : smoothstep(-kSunRadius_rad, kSunRadius_rad, over);
}

// As the functions of atmosphere.h; the first without regard for the earth.
glm::vec3 transmittance_over_horizon(const Atmosphere& atmosphere, const HeightRow& at,
                                     double sine);
glm::vec3 disc_transmittance(const Atmosphere& atmosphere, const HeightRow& at, double sine);

// Light that was scattered before: rows by height, closest at the sea, columns by the sine of the
// light's elevation, finer about the horizon; at the zenith even in its cosine, as modes of azimuth
// are. Haze is low: its tables have the first rows, up to
// 9 km.
inline constexpr int kSourceHeights = 47, kHazeHeights = 25, kLowSines = 30, kHighSines = 12;
inline constexpr int kSourceSines = kLowSines + kHighSines + 1;
inline constexpr int kPoints = kSourceHeights * kSourceSines,
                     kHazePoints = kHazeHeights * kSourceSines;
inline constexpr double kLowestSine = -0.34, kMiddleSine = 0.17;

double source_height_m(int row);
double source_sine(int column);
Between source_row(double height_m);
inline Between source_column(double sine) {
  if (sine < kMiddleSine)
    return between((sine - kLowestSine) * (kLowSines / (kMiddleSine - kLowestSine)), kSourceSines);
  const double from_zenith = std::sqrt(std::max(1.0 - sine, 0.0) / (1.0 - kMiddleSine));
  return between(kSourceSines - 1 - kHighSines * from_zenith, kSourceSines);
}

// What orders of scattering after the last add, over it: they shrink as it did. In thick haze the
// first few may grow, which says nothing of those that follow.
inline float later_orders(float before, float last) {
  const float ratio = std::clamp(last / std::max(before, 1e-30f), 0.0f, 0.7f);
  return ratio / (1.0f - ratio);
}

// ---- Rays

inline constexpr double kSeaAlbedo = 0.08;

inline double cosine_of(double sine) { return std::sqrt(std::max(1.0 - sine * sine, 0.0)); }

// A piece of a ray: what of the light that is scattered on it arrives at the ray's start.
struct Step {
  HeightRow height;
  Between source;    // its row in the tables of light scattered before
  double up, ahead;  // its zenith, in the start's: along the zenith, and along the ray's azimuth
  glm::vec3 rayleigh, mie;  // times the light there
};

inline bool is_in_haze(const Step& step) { return step.source.first < kHazeHeights - 1; }

struct Path {
  double sine = 0.0;  // of the elevation at which it starts
  std::vector<Step> steps;
  bool meets_sea = false;
  glm::dvec3 left{1.0};  // what of light from its end arrives
  glm::vec3 sea{0.0f};   // the same of light that falls on the sea
  double sea_up = 1.0, sea_ahead = 0.0;
};

Path trace(const Air& air, double height_m, double sine, int step_count);

// The light's direction as a ray's start has it.
struct LightAngles {
  double up, ahead;  // sine of the elevation; the part along the ray's azimuth
};

struct Scattered {
  glm::vec3 rayleigh{0.0f}, mie{0.0f};  // once, but for the phase functions
};
Scattered scatter_once(const Atmosphere& atmosphere, const Path& path, LightAngles light);

// Returns what the path sends on of light that was scattered before. `mean`: its radiance, the mean
// that molecules make of it in the ray's direction; `haze`: that which haze makes. Tables of the
// rows and columns above.
glm::vec3 scatter_again(const glm::vec3* mean, const glm::vec3* haze, const Path& path,
                        LightAngles light);

}  // namespace swell::sky
