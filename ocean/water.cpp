#include "ocean/water.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/check.h"
#include "ocean/coast/coast_velocity.h"
#include "ocean/open_sea/sea_state.h"
#include "ocean/spectrum/point_chunk.h"
#include "ocean/wakes/wakes.h"

namespace swell::ocean {
namespace {

constexpr double kEdgePart = 0.1;  // of the area, over which waves fade

using Points = std::span<const glm::dvec2>;  // at most kPointChunk
using Room = std::span<float>;

// 1 inside the area, falling to 0 over its last tenth.
float edge(const SeaArea& area, glm::dvec2 p_world) {
  if (area.is_endless()) return 1.0f;
  const glm::dvec2 size_m = area.limits_m();
  const glm::dvec2 inside = 0.5 * size_m - glm::abs(p_world - area.centre_m);
  const glm::dvec2 rim = kEdgePart * size_m;
  if (inside.x >= rim.x && inside.y >= rim.y) return 1.0f;
  const glm::dvec2 t = glm::clamp(inside / rim, 0.0, 1.0);
  // Two smooth_blend(), multiplied from left to right: another order may give other bits.
  return static_cast<float>(t.x * t.x * (3.0 - 2.0 * t.x) * t.y * t.y * (3.0 - 2.0 * t.y));
}

// The sea's part in the surface: 0 in rivers and lakes.
float sea_share(const WaterParts& water, glm::dvec2 p_world) {
  return water.inland ? water.inland->sea_share(p_world) : 1.0f;
}

// Adds the slopes of a source's heights, with their fading, by differences.
template <class Source>
void slopes_by_differences(const Source& source, const SeaFrame& frame, Points p,
                           std::span<glm::vec2> slope) {
  constexpr double kStep_m = 0.05;
  const glm::dvec2 dx(0.5 * kStep_m, 0.0), dy(0.0, 0.5 * kStep_m);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const std::array<glm::dvec2, 4> at = {p[i] + dx, p[i] - dx, p[i] + dy, p[i] - dy};
    std::array<float, 4> z{}, room_unused{};
    source.add_heights(frame, at, room_unused, z);
    slope[i] += glm::vec2(z[0] - z[1], z[2] - z[3]) / static_cast<float>(kStep_m);
  }
}

// ---- The trains of a coast

struct TrainWaves {
  const WaterParts& water;

  double time_s(double t_s) const { return wave_time_s(water.sea->description(), t_s); }

  void take_room(Points p, Room room) const {
    std::array<float, kPointChunk> share;
    sample_coast_share(*water.coast, p, std::span(share).first(p.size()));
    for (std::size_t i = 0; i < p.size(); ++i) room[i] *= spectrum_weight(share[i]);
  }

  void add_heights(const SeaFrame& frame, Points p, Room room, std::span<float> height_m) const {
    std::array<float, kPointChunk> z, share;
    sample_coast(*water.coast, time_s(frame.t_s), p, std::span(z).first(p.size()),
                 std::span(share).first(p.size()));
    for (std::size_t i = 0; i < p.size(); ++i) {
      height_m[i] += z[i] * edge(water.area, p[i]) * sea_share(water, p[i]);
      room[i] *= spectrum_weight(share[i]);
    }
  }

  void add_slopes(const SeaFrame& frame, Points p, Room room, std::span<glm::vec2> slope) const {
    slopes_by_differences(*this, frame, p, slope);
    take_room(p, room);
  }

  void add_velocities(const VelocityFrame& velocity, Points p, Room room,
                      std::span<glm::vec3> velocity_mps) const {
    std::array<glm::vec3, kPointChunk> v;
    sample_coast_velocities(*water.coast, time_s(velocity.z.t_s), p, std::span(v).first(p.size()));
    for (std::size_t i = 0; i < p.size(); ++i)
      velocity_mps[i] += edge(water.area, p[i]) * sea_share(water, p[i]) * v[i];
    take_room(p, room);
  }
};

// ---- Fronts of surf

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
  };

  void take_room(Points p, Room room) const {
    for (std::size_t i = 0; i < p.size(); ++i)
      room[i] *= spectrum_weight(place_in_fronts(*water.fronts, p[i]).at.share);
  }

  // Takes the room, too.
  void lift(double t_s, Points p, Room room, Lifted& lifted) const {
    const glm::dvec2 origin = water.fronts->grid.min_world;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const FrontPlace place = place_in_fronts(*water.fronts, p[i]);
      if (place.at.share <= 0.0f) continue;
      room[i] *= spectrum_weight(place.at.share);
      const auto depth_m = -static_cast<float>(terrain::height_at(*water.land, p[i]));
      const float height_m = front_height_m(place.at, depth_m);
      if (height_m <= 0.0f) continue;
      const std::size_t n = lifted.at.count++;
      lifted.at.x[n] = static_cast<float>(p[i].x - origin.x);
      lifted.at.y[n] = static_cast<float>(p[i].y - origin.y);
      lifted.at.part[n] = place.at.part;
      lifted.place[n] = i;
      lifted.depth_m[n] = depth_m;
      lifted.height_m[n] = height_m * edge(water.area, p[i]) * sea_share(water, p[i]);
      lifted.part_slope[n] = place.part_slope;
    }
    if (lifted.at.count == 0) return;
    const SeaDescription& sea = water.sea->description();
    sample_front_function(make_front_clock(water.fronts->zone, sea, t_s, origin), lifted.at);
  }

  void add_heights(const SeaFrame& frame, Points p, Room room, std::span<float> height_m) const {
    if (!frame.has_fronts) return;
    Lifted lifted;
    lift(frame.t_s, p, room, lifted);
    for (std::size_t n = 0; n < lifted.at.count; ++n) height_m[lifted.place[n]] += lifted.height(n);
  }

  void add_slopes(const SeaFrame& frame, Points p, Room room, std::span<glm::vec2> slope) const {
    if (!frame.has_fronts) return;
    slopes_by_differences(*this, frame, p, slope);
    take_room(p, room);
  }

  // Up exactly the heights' rate; along, as long waves in water of that depth: z sqrt(g / depth).
  void add_velocities(const VelocityFrame& velocity, Points p, Room room,
                      std::span<glm::vec3> velocity_mps) const {
    Lifted lifted;
    lift(velocity.z.t_s, p, room, lifted);
    const SeaDescription& sea = water.sea->description();
    const auto gravity = static_cast<float>(sea.gravity_mps2);
    const auto turns_per_s = static_cast<float>(front_turns_per_s(water.fronts->zone, sea));
    for (std::size_t n = 0; n < lifted.at.count; ++n) {
      const glm::vec2 seaward = lifted.part_slope[n];
      const float steep = glm::length(seaward);
      const glm::vec2 ashore = steep > 0.0f ? -seaward / steep : glm::vec2(0.0f);
      const float along_mps = lifted.height(n) * std::sqrt(gravity / lifted.depth_m[n]);
      velocity_mps[lifted.place[n]] +=
          glm::vec3(along_mps * ashore, lifted.height_m[n] * lifted.at.rate[n] * turns_per_s);
    }
  }
};

// ---- The sea: patches and sines

struct SeaWaves {
  const WaterParts& water;
  float wave_height_m;                     // significant
  std::size_t longest_patches = SIZE_MAX;  // that heights have
  bool inland_too = false;                 // waves that rivers and lakes have, too

  // room times how much of the waves the land, the edge and the depth let through: the weight of
  // the waves.
  void weigh(const SeaFrame& frame, Points p, Room room) const {
    if (water.shelter && frame.sheltered) apply_shelter(*water.shelter, p, room);
    fade(p, room);
  }

  // room times what the edge and the depth let through.
  void fade(Points p, Room room) const {
    if (!water.land) {
      for (std::size_t i = 0; i < p.size(); ++i) room[i] *= edge(water.area, p[i]);
      return;
    }
    std::array<float, kPointChunk> ground;
    terrain::sample_heights(*water.land, p, std::span(ground).first(p.size()));
    for (std::size_t i = 0; i < p.size(); ++i) {
      const auto inland = water.inland ? water.inland->at(p[i]) : std::nullopt;
      const float depth = std::max(inland ? inland->depth_m : -ground[i], 0.0f);
      room[i] *= edge(water.area, p[i]) * std::min(1.0f, depth / (0.2f + wave_height_m));
      if (inland && !inland_too) room[i] *= inland->sea_share;
    }
  }

  float weight_at(const SeaFrame& frame, glm::dvec2 p_world) const {
    float weight = 1.0f;
    if (water.coast) TrainWaves{water}.take_room({&p_world, 1}, {&weight, 1});
    if (water.fronts && frame.has_fronts) FrontWaves{water}.take_room({&p_world, 1}, {&weight, 1});
    weigh(frame, {&p_world, 1}, {&weight, 1});
    return weight;
  }

  glm::vec2 weight_slope(const SeaFrame& frame, glm::dvec2 p) const {
    constexpr double kStep_m = 0.25;
    const glm::dvec2 dx(0.5 * kStep_m, 0.0), dy(0.0, 0.5 * kStep_m);
    const glm::vec2 difference(weight_at(frame, p + dx) - weight_at(frame, p - dx),
                               weight_at(frame, p + dy) - weight_at(frame, p - dy));
    return difference / static_cast<float>(kStep_m);
  }

  // Places where the weight is 0 cost nothing.
  void add_heights(const SeaFrame& frame, Points p, Room room, std::span<float> height_m) const {
    weigh(frame, p, room);
    std::array<glm::dvec2, kPointChunk> wavy;
    std::array<std::size_t, kPointChunk> place;
    std::size_t count = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      if (room[i] == 0.0f) continue;
      wavy[count] = p[i];
      place[count++] = i;
    }
    std::array<float, kPointChunk> z;
    sample_heights(frame, std::span(wavy).first(count), std::span(z).first(count), longest_patches);
    for (std::size_t k = 0; k < count; ++k) height_m[place[k]] += z[k] * room[place[k]];
  }

  // The waves' own slopes by their weight, and their height by the weight's slope.
  void add_slopes(const SeaFrame& frame, Points p, Room room, std::span<glm::vec2> slope) const {
    weigh(frame, p, room);
    std::array<float, kPointChunk> x, y, z;
    sample_slopes(frame, p, std::span(x).first(p.size()), std::span(y).first(p.size()));
    sample_heights(frame, p, std::span(z).first(p.size()));
    for (std::size_t i = 0; i < p.size(); ++i) {
      glm::vec2 own = room[i] * glm::vec2(x[i], y[i]);
      if (room[i] != 1.0f) own += z[i] * weight_slope(frame, p[i]);
      slope[i] += own;
    }
  }

  void add_velocities(const VelocityFrame& velocity, Points p, Room room,
                      std::span<glm::vec3> velocity_mps) const {
    weigh(velocity.z, p, room);
    std::array<glm::vec3, kPointChunk> v;
    sample_velocities(velocity, p, std::span(v).first(p.size()));
    for (std::size_t i = 0; i < p.size(); ++i) velocity_mps[i] += v[i] * room[i];
  }
};

// ---- Wakes

// They fade with the sea's edge and, like its waves, in shallow water: of half a metre.
struct WakeWaves {
  const WaterParts& water;

  void weigh(Points p, Room weight) const {
    std::ranges::fill(weight, 1.0f);
    SeaWaves{water, 0.3f, SIZE_MAX, true}.fade(p, weight);
  }

  void take_room(Points, Room) const {}

  void add_heights(const SeaFrame& frame, Points p, Room, std::span<float> height_m) const {
    if (frame.wakes.count == 0) return;
    std::array<float, kPointChunk> z{}, weight;
    add_wake_heights(frame.wakes, p, std::span(z).first(p.size()));
    if (std::all_of(z.begin(), z.begin() + p.size(), [](float x) { return x == 0.0f; })) return;
    weigh(p, std::span(weight).first(p.size()));
    for (std::size_t i = 0; i < p.size(); ++i) height_m[i] += z[i] * weight[i];
  }

  // The weight's own slope is left out.
  void add_slopes(const SeaFrame& frame, Points p, Room, std::span<glm::vec2> slope) const {
    if (frame.wakes.count == 0) return;
    std::array<glm::vec2, kPointChunk> own{};
    std::array<float, kPointChunk> weight;
    add_wake_slopes(frame.wakes, p, std::span(own).first(p.size()));
    weigh(p, std::span(weight).first(p.size()));
    for (std::size_t i = 0; i < p.size(); ++i) slope[i] += own[i] * weight[i];
  }

  void add_velocities(const VelocityFrame& velocity, Points p, Room,
                      std::span<glm::vec3> velocity_mps) const {
    if (velocity.z.wakes.count == 0) return;
    std::array<float, kPointChunk> x{}, y{}, z{}, weight;
    add_wake_heights(velocity.x.wakes, p, std::span(x).first(p.size()));
    add_wake_heights(velocity.y.wakes, p, std::span(y).first(p.size()));
    add_wake_heights(velocity.z.wakes, p, std::span(z).first(p.size()));
    weigh(p, std::span(weight).first(p.size()));
    for (std::size_t i = 0; i < p.size(); ++i)
      velocity_mps[i] += weight[i] * glm::vec3(x[i], y[i], z[i]);
  }
};

// ---- Rivers and lakes

// The levels under the waves.
struct InlandLevels {
  const WaterParts& water;

  // Nothing on dry land.
  std::optional<InlandSample> at(glm::dvec2 p) const {
    if (!water.inland) return std::nullopt;
    std::optional<InlandSample> sample = water.inland->at(p);
    if (sample && static_cast<double>(sample->level_m) <= terrain::height_at(*water.land, p))
      sample.reset();
    return sample;
  }

  void add_heights(Points p, std::span<float> height_m) const {
    constexpr float kUnderRivers_m = 0.5f;
    if (!water.inland) return;
    for (std::size_t i = 0; i < p.size(); ++i) {
      if (!water.sea_alone) {
        if (const auto sample = at(p[i])) height_m[i] += sample->level_m;
      } else {
        height_m[i] -= kUnderRivers_m * (1.0f - water.inland->sea_share(p[i]));
      }
    }
  }

  void add_slopes(Points p, std::span<glm::vec2> slope) const {
    constexpr double kStep_m = 0.25;
    if (!water.inland) return;
    const glm::dvec2 dx(0.5 * kStep_m, 0.0), dy(0.0, 0.5 * kStep_m);
    for (std::size_t i = 0; i < p.size(); ++i) {
      const auto east = at(p[i] + dx), west = at(p[i] - dx), north = at(p[i] + dy),
                 south = at(p[i] - dy);
      if (east && west && north && south)
        slope[i] += glm::vec2(east->level_m - west->level_m, north->level_m - south->level_m) /
                    static_cast<float>(kStep_m);
    }
  }

  void add_velocities(Points p, std::span<glm::vec3> velocity_mps) const {
    if (!water.inland) return;
    for (std::size_t i = 0; i < p.size(); ++i)
      if (const auto sample = at(p[i]))
        velocity_mps[i] += glm::vec3(sample->east_mps, sample->north_mps, 0.0f);
  }
};

// ---- All of them

// Calls body(source) for each source, in the order in which they take their room.
template <class Body>
void for_each_source(const WaterParts& water, const SeaWaves& sea, Body body) {
  if (water.coast) body(TrainWaves{water});
  if (water.fronts) body(FrontWaves{water});
  body(sea);
  body(WakeWaves{water});
}

// steepest: the sea's and the trains' own, and what the fading adds: the edge rises by 1.5 over a
// tenth of the area, shallow water (on sand of slope 1) by 1 over the height of the waves, the sea
// makes room for the trains and runs into the lee of land.
WaterBounds bounds_of(const WaterParts& water) {
  const Sea& sea = *water.sea;
  const CoastSea* coast = water.coast;
  const double sea_m = sea.height_bound_m(), sea_slope = sea.slope_bound();
  const float trains_m = coast ? coast->trains.height_bound_m : 0.0f;
  const float trains_slope = coast ? coast->slope_bound() : 0.0f;
  WaterBounds bounds;
  bounds.height_m = static_cast<float>(sea_m) + trains_m + water.wakes.height_m;
  bounds.slope = static_cast<float>(sea_slope) + trains_slope + water.wakes.slope;
  const double all_m = sea_m + static_cast<double>(trains_m);
  const glm::dvec2 limits_m = water.area.limits_m();
  const double rim_m = kEdgePart * std::min(limits_m.x, limits_m.y);
  bounds.steepest = sea_slope + 2.0 * all_m * 1.5 / rim_m;
  if (water.land) bounds.steepest += shallow_steepness(sea);
  bounds.steepest += 2.0 * static_cast<double>(water.wakes.slope);
  if (water.shelter) bounds.steepest += static_cast<double>(water.shelter->slope_per_m) * sea_m;
  bounds.mean_wavelength_m = sea.mean_wavelength_m();
  if (const SurfFronts* const fronts = water.fronts) {
    bounds.height_m += fronts->height_bound_m;
    bounds.slope += fronts->slope_bound;
    bounds.steepest += static_cast<double>(fronts->slope_bound);
    bounds.steepest += static_cast<double>(fronts->share_slope_per_m) * sea_m;
    bounds.steepest += 2.0 * static_cast<double>(fronts->height_bound_m) * 1.5 / rim_m;
  }
  bounds.highest_m = bounds.height_m;
  if (water.inland) {
    bounds.highest_m += std::max(water.inland->highest_m(), 0.0f);
    bounds.steepest += 0.2;
  }
  if (!coast) return bounds;
  bounds.steepest += static_cast<double>(trains_slope);
  bounds.steepest += static_cast<double>(coast->share_slope_per_m) * sea_m;
  if (bounds.mean_wavelength_m == 0.0)
    bounds.mean_wavelength_m = static_cast<double>(coast->peak_wavelength_m);
  return bounds;
}

// Fills `sums`, one for each point, chunk by chunk: add(source, points, room, sums) adds a source.
template <class T, class Add>
void add_up(const WaterParts& water, const SeaWaves& sea, std::span<const glm::dvec2> p_world,
            std::span<T> sums, Add add) {
  for (std::size_t first = 0; first < p_world.size(); first += kPointChunk) {
    const std::size_t count = std::min(kPointChunk, p_world.size() - first);
    const auto some = sums.subspan(first, count);
    std::ranges::fill(some, T(0.0f));
    std::array<float, kPointChunk> storage;
    const Room room = std::span(storage).first(count);
    std::ranges::fill(room, 1.0f);
    for_each_source(water, sea, [&](const auto& source) {
      add(source, p_world.subspan(first, count), room, some);
    });
  }
}

}  // namespace

double shallow_depth_m(const Sea& sea) { return 0.2 + sea.significant_height_m(); }

double shallow_steepness(const Sea& sea) { return sea.height_bound_m() / shallow_depth_m(sea); }

WaterBody::WaterBody(const WaterParts& parts)
    : parts_(parts),
      bounds_(bounds_of(parts)),
      wave_height_m_(static_cast<float>(parts.sea->significant_height_m())) {}

void WaterBody::heights(const SeaFrame& frame, std::span<const glm::dvec2> p_world,
                        std::span<float> height_m, std::size_t longest_patches) const {
  SWELL_CHECK(p_world.size() == height_m.size(), "{} points, {} heights", p_world.size(),
              height_m.size());
  add_up(parts_, {parts_, wave_height_m_, longest_patches}, p_world, height_m,
         [&](const auto& source, Points p, Room room, std::span<float> z) {
           source.add_heights(frame, p, room, z);
         });
  InlandLevels{parts_}.add_heights(p_world, height_m);
}

void WaterBody::slopes(const SeaFrame& frame, std::span<const glm::dvec2> p_world,
                       std::span<glm::vec2> slope) const {
  SWELL_CHECK(p_world.size() == slope.size(), "{} points, {} slopes", p_world.size(), slope.size());
  add_up(parts_, {parts_, wave_height_m_}, p_world, slope,
         [&](const auto& source, Points p, Room room, std::span<glm::vec2> some) {
           source.add_slopes(frame, p, room, some);
         });
  InlandLevels{parts_}.add_slopes(p_world, slope);
}

void WaterBody::velocities(const VelocityFrame& velocity, std::span<const glm::dvec2> p_world,
                           std::span<glm::vec3> velocity_mps) const {
  SWELL_CHECK(p_world.size() == velocity_mps.size(), "{} points, {} velocities", p_world.size(),
              velocity_mps.size());
  add_up(parts_, {parts_, wave_height_m_}, p_world, velocity_mps,
         [&](const auto& source, Points p, Room room, std::span<glm::vec3> v) {
           source.add_velocities(velocity, p, room, v);
         });
  InlandLevels{parts_}.add_velocities(p_world, velocity_mps);
}

void WaterBody::currents(std::span<const glm::dvec2> p_world,
                         std::span<glm::vec2> current_mps) const {
  SWELL_CHECK(p_world.size() == current_mps.size(), "{} points, {} currents", p_world.size(),
              current_mps.size());
  const InlandLevels inland{parts_};
  for (std::size_t i = 0; i < p_world.size(); ++i) {
    const auto sample = inland.at(p_world[i]);
    current_mps[i] = sample ? glm::vec2(sample->east_mps, sample->north_mps) : glm::vec2(0.0f);
  }
}

}  // namespace swell::ocean
