// The motion of the water below the surface: what each source adds to it.
#include <algorithm>
#include <array>
#include <cmath>

#include "math/check.h"
#include "math/elementary.h"
#include "ocean/below_frame.h"
#include "ocean/coast/coast_velocity.h"
#include "ocean/water_sources.h"

namespace swell::ocean {
namespace {

// Adds the motions of a source by their weights.
void add_weighted(std::span<const Motion> own, std::span<const float> weight,
                  std::span<Motion> motion) {
  for (std::size_t i = 0; i < motion.size(); ++i)
    for (std::size_t f = 0; f < kMotionFields; ++f) motion[i][f] += own[i][f] * weight[i];
}

}  // namespace

void TrainWaves::add_motions(const BelowFrame& below, const PointsBelow& points, Room room,
                             std::span<Motion> motion) const {
  std::array<Motion, kPointChunk> own;
  std::array<float, kPointChunk> weight;
  const std::size_t count = points.p_world.size();
  sample_coast_motions(*water.coast, time_s(below.surface->t_s), points,
                       std::span(own).first(count));
  for (std::size_t i = 0; i < count; ++i) weight[i] = weight_at(points.p_world[i]);
  add_weighted(own, weight, motion);
  take_room(points.p_world, room);
}

// Long waves: the same along on the whole depth, and the head; upward the rate of the surface, less
// and less down to the ground. Upward accelerations are not counted.
void FrontWaves::add_motions(const BelowFrame& below, const PointsBelow& points, Room room,
                             std::span<Motion> motion) const {
  if (!below.surface->has_fronts) return;
  Lifted lifted;
  lift(below.surface->t_s, points.p_world, room, lifted);
  const SeaDescription& sea = water.sea->description();
  const auto gravity = static_cast<float>(sea.gravity_mps2);
  const auto turns_per_s = static_cast<float>(front_turns_per_s(water.fronts->zone, sea));
  for (std::size_t n = 0; n < lifted.at.count; ++n) {
    const std::size_t i = lifted.place[n];
    const float rising_mps = lifted.height_m[n] * lifted.at.rate[n] * turns_per_s;
    const float per_m = std::sqrt(gravity / lifted.depth_m[n]);
    const glm::vec2 velocity = lifted.height(n) * per_m * lifted.ashore(n);
    const glm::vec2 acceleration = rising_mps * per_m * lifted.ashore(n);
    const float depth_m = points.depth_m[i];
    const float over_ground = depth_m > 0.0f ? 1.0f - points.below_m[i] / depth_m : 1.0f;
    motion[i][kVelocityX] += velocity.x;
    motion[i][kVelocityY] += velocity.y;
    motion[i][kVelocityZ] += rising_mps * over_ground;
    motion[i][kAccelerationX] += acceleration.x;
    motion[i][kAccelerationY] += acceleration.y;
    motion[i][kHead] += lifted.height(n);
  }
}

void SeaWaves::add_motions(const BelowFrame& below, const PointsBelow& points, Room room,
                           std::span<Motion> motion) const {
  std::array<Motion, kPointChunk> own{};
  weigh(*below.surface, points.p_world, room);
  add_sea_below(below, points, std::span(own).first(points.p_world.size()));
  add_weighted(own, room, motion);
}

void WakeWaves::add_motions(const BelowFrame& below, const PointsBelow& points, Room,
                            std::span<Motion> motion) const {
  if (below.windows.empty()) return;
  std::array<Motion, kPointChunk> own{};
  std::array<float, kPointChunk> weight;
  const std::size_t count = points.p_world.size();
  add_wakes_below(below, points, std::span(own).first(count));
  weigh(points.p_world, std::span(weight).first(count));
  add_weighted(own, weight, motion);
}

void InlandLevels::add_motions(Points p, std::span<Motion> motion) const {
  if (!water.inland) return;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (const auto sample = at(p[i])) {
      motion[i][kVelocityX] += sample->east_mps;
      motion[i][kVelocityY] += sample->north_mps;
    }
}

void WaterBody::motions(const BelowFrame& below, const PointsBelow& points,
                        std::span<Motion> motion) const {
  SWELL_CHECK(points.p_world.size() == motion.size(), "{} points, {} motions",
              points.p_world.size(), motion.size());
  add_up(parts_, {parts_, wave_height_m_}, motion,
         [&](const auto& source, std::size_t first, Room room, std::span<Motion> some) {
           source.add_motions(below, points.part(first, some.size()), room, some);
         });
  InlandLevels{parts_}.add_motions(points.p_world, motion);
}

void WaterBody::find_columns(const SeaFrame& frame, std::span<const glm::dvec2> p_world,
                             std::span<WaterColumn> column) const {
  SWELL_CHECK(p_world.size() == column.size(), "{} points, {} columns", p_world.size(),
              column.size());
  const InlandLevels inland{parts_};
  std::array<float, kPointChunk> surface, ground;
  for (std::size_t first = 0; first < p_world.size(); first += kPointChunk) {
    const auto p = p_world.subspan(first, std::min(kPointChunk, p_world.size() - first));
    heights(frame, p, std::span(surface).first(p.size()));
    if (parts_.land) terrain::sample_heights(*parts_.land, p, std::span(ground).first(p.size()));
    for (std::size_t i = 0; i < p.size(); ++i) {
      const auto sample = inland.at(p[i]);
      column[first + i] = {surface[i], sample ? sample->level_m : 0.0f,
                           parts_.land ? ground[i] : -kInfinity<float>};
    }
  }
}

}  // namespace swell::ocean
