// The sources of the water, as ocean/water.h lists them: what each adds to heights, slopes,
// velocities and to the motion below the surface, and the room that it takes.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "ocean/below/motion.h"
#include "ocean/spectrum/point_chunk.h"
#include "ocean/water.h"

namespace swell::ocean {

using Points = std::span<const glm::dvec2>;  // at most kPointChunk
using Room = std::span<float>;

// 1 inside the area, falling to 0 over the last tenth of it.
inline constexpr double kEdgePart = 0.1;
float edge(const SeaArea& area, glm::dvec2 p_world);

// The trains of a coast.
struct TrainWaves {
  const WaterParts& water;

  double time_s(double t_s) const;
  // What the edge and inland water leave of the trains.
  float weight_at(glm::dvec2 p_world) const;
  void take_room(Points p, Room room) const;
  void add_heights(const SeaFrame& frame, Points p, Room room, std::span<float> height_m) const;
  void add_slopes(const SeaFrame& frame, Points p, Room room, std::span<glm::vec2> slope) const;
  void add_velocities(const VelocityFrame& velocity, Points p, Room room,
                      std::span<glm::vec3> velocity_mps) const;
  void add_motions(const BelowFrame& below, const PointsBelow& points, Room room,
                   std::span<Motion> motion) const;
};

// Fronts of surf.
struct FrontWaves {
  const WaterParts& water;

  // Points that the fronts lift, in order.
  struct Lifted {
    FrontSamples at;
    std::array<std::size_t, kPointChunk> place;
    std::array<float, kPointChunk> depth_m, height_m;
    std::array<glm::vec2, kPointChunk> part_slope;

    // z of the n-th, over the mean level.
    float height(std::size_t n) const { return height_m[n] * (at.lift[n] - kFrontMean); }
    // Where its front runs to: a unit vector, 0 where there is none.
    glm::vec2 ashore(std::size_t n) const;
  };

  void take_room(Points p, Room room) const;
  // Takes the room, too.
  void lift(double t_s, Points p, Room room, Lifted& lifted) const;
  void add_heights(const SeaFrame& frame, Points p, Room room, std::span<float> height_m) const;
  void add_slopes(const SeaFrame& frame, Points p, Room room, std::span<glm::vec2> slope) const;
  // Up exactly the heights' rate; along, as long waves in water of that depth: z sqrt(g / depth).
  void add_velocities(const VelocityFrame& velocity, Points p, Room room,
                      std::span<glm::vec3> velocity_mps) const;
  void add_motions(const BelowFrame& below, const PointsBelow& points, Room room,
                   std::span<Motion> motion) const;
};

// The sea: patches and sines.
struct SeaWaves {
  const WaterParts& water;
  float wave_height_m;                     // significant
  std::size_t longest_patches = SIZE_MAX;  // that heights have
  bool inland_too = false;                 // waves that rivers and lakes have, too

  // room times how much of the waves the land, the edge and the depth let through: the weight of
  // the waves.
  void weigh(const SeaFrame& frame, Points p, Room room) const;
  // room times what the edge and the depth let through.
  void fade(Points p, Room room) const;
  float weight_at(const SeaFrame& frame, glm::dvec2 p_world) const;
  glm::vec2 weight_slope(const SeaFrame& frame, glm::dvec2 p) const;

  // Places where the weight is 0 cost nothing.
  void add_heights(const SeaFrame& frame, Points p, Room room, std::span<float> height_m) const;
  // The waves' own slopes by their weight, and their height by the weight's slope.
  void add_slopes(const SeaFrame& frame, Points p, Room room, std::span<glm::vec2> slope) const;
  void add_velocities(const VelocityFrame& velocity, Points p, Room room,
                      std::span<glm::vec3> velocity_mps) const;
  void add_motions(const BelowFrame& below, const PointsBelow& points, Room room,
                   std::span<Motion> motion) const;
};

// Wakes. They fade with the sea's edge and, like its waves, in shallow water: of half a metre.
struct WakeWaves {
  const WaterParts& water;

  void weigh(Points p, Room weight) const;
  void take_room(Points, Room) const {}
  void add_heights(const SeaFrame& frame, Points p, Room, std::span<float> height_m) const;
  // The weight's own slope is left out.
  void add_slopes(const SeaFrame& frame, Points p, Room, std::span<glm::vec2> slope) const;
  void add_velocities(const VelocityFrame& velocity, Points p, Room,
                      std::span<glm::vec3> velocity_mps) const;
  void add_motions(const BelowFrame& below, const PointsBelow& points, Room,
                   std::span<Motion> motion) const;
};

// The levels of rivers and lakes, under the waves.
struct InlandLevels {
  const WaterParts& water;

  // Nothing on dry land.
  std::optional<InlandSample> at(glm::dvec2 p) const;
  void add_heights(Points p, std::span<float> height_m) const;
  void add_slopes(Points p, std::span<glm::vec2> slope) const;
  void add_velocities(Points p, std::span<glm::vec3> velocity_mps) const;
  // The current: the same on the whole depth.
  void add_motions(Points p, std::span<Motion> motion) const;
};

// Calls body(source) for each source, in the order in which they take their room.
template <class Body>
void for_each_source(const WaterParts& water, const SeaWaves& sea, Body body) {
  if (water.coast) body(TrainWaves{water});
  if (water.fronts) body(FrontWaves{water});
  body(sea);
  body(WakeWaves{water});
}

// Fills `sums`, one for each point, chunk by chunk: add(source, first, room, sums) adds a source to
// those from the first on.
template <class T, class Add>
void add_up(const WaterParts& water, const SeaWaves& sea, std::span<T> sums, Add add) {
  for (std::size_t first = 0; first < sums.size(); first += kPointChunk) {
    const auto some = sums.subspan(first, std::min(kPointChunk, sums.size() - first));
    std::ranges::fill(some, T{});
    std::array<float, kPointChunk> storage;
    const Room room = std::span(storage).first(some.size());
    std::ranges::fill(room, 1.0f);
    for_each_source(water, sea, [&](const auto& source) { add(source, first, room, some); });
  }
}

}  // namespace swell::ocean
