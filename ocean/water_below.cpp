#include <algorithm>
#include <array>
#include <cmath>

#include "math/check.h"
#include "math/with_ieee.h"
#include "ocean/below_frame.h"
#include "ocean/water_surface.h"

namespace swell::ocean {
namespace {

constexpr std::size_t kPointsAtOnce = 4096;

template <class Body>
void for_chunks(std::size_t count, Workers& workers, const Body& body) {
  workers.for_each((count + kPointsAtOnce - 1) / kPointsAtOnce, [&](std::size_t chunk, int) {
    const std::size_t first = chunk * kPointsAtOnce;
    body(first, std::min(kPointsAtOnce, count - first));
  });
}

MotionPlace place_in(const WaterColumn& column, double z) {
  if (z < static_cast<double>(column.ground_m)) return MotionPlace::kInGround;
  return z > static_cast<double>(column.surface_m) ? MotionPlace::kAbove : MotionPlace::kInWater;
}

float depth_of(const WaterColumn& column) {
  return std::max(column.level_m - column.ground_m, 0.0f);
}

// How far z is below the surface, stretched (ocean/below/motion.h), in [0, depth].
float stretched_m(const WaterColumn& column, double z) {
  const double below_m = std::max(static_cast<double>(column.surface_m) - z, 0.0);
  const auto depth_m = static_cast<double>(depth_of(column));
  if (!(depth_m < HUGE_VAL)) return static_cast<float>(below_m);
  const double wet_m = static_cast<double>(column.surface_m) - static_cast<double>(column.ground_m);
  if (!(wet_m > 0.0)) return 0.0f;
  return static_cast<float>(std::min(below_m * (depth_m / wet_m), depth_m));
}

}  // namespace

void WaterSurface::find_columns(std::span<const glm::dvec3> p_world, BelowFrame& below,
                                Workers& workers) const {
  below.p_world.resize(p_world.size());
  std::ranges::transform(p_world, below.p_world.begin(),
                         [](const glm::dvec3& p) { return glm::dvec2(p); });
  below.column.resize(p_world.size());
  for_chunks(p_world.size(), workers, [&](std::size_t first, std::size_t count) {
    water_.find_columns(*frame_, std::span(below.p_world).subspan(first, count),
                        std::span(below.column).subspan(first, count));
  });
}

void WaterSurface::nearest_motions(std::span<const glm::dvec3> p_world, MotionParts parts,
                                   double density_kg_m3, BelowFrame& below, Workers& workers,
                                   std::span<WaterMotion> motion) const {
  SWELL_CHECK(p_world.size() == motion.size(), "{} points, {} motions", p_world.size(),
              motion.size());
  SWELL_CHECK(below.surface == frame_, "t_s={}, below another surface", frame_->t_s);
  find_columns(p_world, below, workers);
  below.below_m.resize(p_world.size());
  below.depth_m.resize(p_world.size());
  for (std::size_t i = 0; i < p_world.size(); ++i) {
    below.below_m[i] = stretched_m(below.column[i], p_world[i].z);
    below.depth_m[i] = depth_of(below.column[i]);
  }
  const PointsBelow points{below.p_world, below.below_m, below.depth_m, parts};
  make_below(points, below, workers);
  const double pa_m = density_kg_m3 * water_.parts().sea->description().gravity_mps2;
  for_chunks(p_world.size(), workers, [&](std::size_t first, std::size_t count) {
    std::array<Motion, kPointsAtOnce> own;
    water_.motions(below, points.part(first, count), std::span(own).first(count));
    for (std::size_t i = 0; i < count; ++i) {
      const Motion& m = own[i];
      motion[first + i] = {place_in(below.column[first + i], p_world[first + i].z),
                           {m[kVelocityX], m[kVelocityY], m[kVelocityZ]},
                           {m[kAccelerationX], m[kAccelerationY], m[kAccelerationZ]},
                           static_cast<float>(pa_m * static_cast<double>(m[kHead]))};
    }
  });
}

void WaterSurface::motions(std::span<const glm::dvec3> p_world, MotionParts parts,
                           double density_kg_m3, BelowFrame& below, Workers& workers,
                           std::span<WaterMotion> motion) const {
  const ScopedFloatEnvironment ieee;
  nearest_motions(p_world, parts, density_kg_m3, below, workers, motion);
  for (WaterMotion& m : motion)
    if (m.place != MotionPlace::kInWater) m = {m.place, {}, {}, 0.0f};
}

}  // namespace swell::ocean
