#include "ocean/water_sources.h"

#include <algorithm>
#include <cmath>

#include "ocean/coast/coast_velocity.h"
#include "ocean/open_sea/sea_state.h"
#include "ocean/wakes/wakes.h"

namespace swell::ocean {
namespace {

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

}  // namespace

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

// ---- The trains of a coast

double TrainWaves::time_s(double t_s) const { return wave_time_s(water.sea->description(), t_s); }

float TrainWaves::weight_at(glm::dvec2 p_world) const {
  return edge(water.area, p_world) * sea_share(water, p_world);
}

void TrainWaves::take_room(Points p, Room room) const {
  std::array<float, kPointChunk> share;
  sample_coast_share(*water.coast, p, std::span(share).first(p.size()));
  for (std::size_t i = 0; i < p.size(); ++i) room[i] *= spectrum_weight(share[i]);
}

void TrainWaves::add_heights(const SeaFrame& frame, Points p, Room room,
                             std::span<float> height_m) const {
  std::array<float, kPointChunk> z, share;
  sample_coast(*water.coast, time_s(frame.t_s), p, std::span(z).first(p.size()),
               std::span(share).first(p.size()));
  for (std::size_t i = 0; i < p.size(); ++i) {
    height_m[i] += z[i] * edge(water.area, p[i]) * sea_share(water, p[i]);
    room[i] *= spectrum_weight(share[i]);
  }
}

void TrainWaves::add_slopes(const SeaFrame& frame, Points p, Room room,
                            std::span<glm::vec2> slope) const {
  slopes_by_differences(*this, frame, p, slope);
  take_room(p, room);
}

void TrainWaves::add_velocities(const VelocityFrame& velocity, Points p, Room room,
                                std::span<glm::vec3> velocity_mps) const {
  std::array<glm::vec3, kPointChunk> v;
  sample_coast_velocities(*water.coast, time_s(velocity.z.t_s), p, std::span(v).first(p.size()));
  for (std::size_t i = 0; i < p.size(); ++i) velocity_mps[i] += weight_at(p[i]) * v[i];
  take_room(p, room);
}

// ---- Fronts of surf

glm::vec2 FrontWaves::Lifted::ashore(std::size_t n) const {
  const glm::vec2 seaward = part_slope[n];
  const float steep = glm::length(seaward);
  return steep > 0.0f ? -seaward / steep : glm::vec2(0.0f);
}

void FrontWaves::take_room(Points p, Room room) const {
  for (std::size_t i = 0; i < p.size(); ++i)
    room[i] *= spectrum_weight(place_in_fronts(*water.fronts, p[i]).at.share);
}

void FrontWaves::lift(double t_s, Points p, Room room, Lifted& lifted) const {
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

void FrontWaves::add_heights(const SeaFrame& frame, Points p, Room room,
                             std::span<float> height_m) const {
  if (!frame.has_fronts) return;
  Lifted lifted;
  lift(frame.t_s, p, room, lifted);
  for (std::size_t n = 0; n < lifted.at.count; ++n) height_m[lifted.place[n]] += lifted.height(n);
}

void FrontWaves::add_slopes(const SeaFrame& frame, Points p, Room room,
                            std::span<glm::vec2> slope) const {
  if (!frame.has_fronts) return;
  slopes_by_differences(*this, frame, p, slope);
  take_room(p, room);
}

void FrontWaves::add_velocities(const VelocityFrame& velocity, Points p, Room room,
                                std::span<glm::vec3> velocity_mps) const {
  Lifted lifted;
  lift(velocity.z.t_s, p, room, lifted);
  const SeaDescription& sea = water.sea->description();
  const auto gravity = static_cast<float>(sea.gravity_mps2);
  const auto turns_per_s = static_cast<float>(front_turns_per_s(water.fronts->zone, sea));
  for (std::size_t n = 0; n < lifted.at.count; ++n) {
    const float along_mps = lifted.height(n) * std::sqrt(gravity / lifted.depth_m[n]);
    velocity_mps[lifted.place[n]] += glm::vec3(
        along_mps * lifted.ashore(n), lifted.height_m[n] * lifted.at.rate[n] * turns_per_s);
  }
}

// ---- The sea: patches and sines

void SeaWaves::weigh(const SeaFrame& frame, Points p, Room room) const {
  if (water.shelter && frame.sheltered) apply_shelter(*water.shelter, p, room);
  fade(p, room);
}

void SeaWaves::fade(Points p, Room room) const {
  const glm::dvec2 within_rim_m = (0.5 - kEdgePart) * water.area.limits_m();
  const auto edge_at = [&](glm::dvec2 at) {
    const glm::dvec2 aside_m = glm::abs(at - water.area.centre_m);
    return aside_m.x <= within_rim_m.x && aside_m.y <= within_rim_m.y ? 1.0f : edge(water.area, at);
  };
  if (!water.land) {
    for (std::size_t i = 0; i < p.size(); ++i) room[i] *= edge_at(p[i]);
    return;
  }
  std::array<float, kPointChunk> ground;
  terrain::sample_heights(*water.land, p, std::span(ground).first(p.size()));
  const float fades_m = 0.2f + wave_height_m;
  if (!water.inland) {
    for (std::size_t i = 0; i < p.size(); ++i)
      room[i] *= edge_at(p[i]) * std::min(1.0f, std::max(-ground[i], 0.0f) / fades_m);
    return;
  }
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto inland = water.inland->at(p[i]);
    const float depth = std::max(inland ? inland->depth_m : -ground[i], 0.0f);
    room[i] *= edge_at(p[i]) * std::min(1.0f, depth / fades_m);
    if (inland && !inland_too) room[i] *= inland->sea_share;
  }
}

float SeaWaves::weight_at(const SeaFrame& frame, glm::dvec2 p_world) const {
  float weight = 1.0f;
  if (water.coast) TrainWaves{water}.take_room({&p_world, 1}, {&weight, 1});
  if (water.fronts && frame.has_fronts) FrontWaves{water}.take_room({&p_world, 1}, {&weight, 1});
  weigh(frame, {&p_world, 1}, {&weight, 1});
  return weight;
}

glm::vec2 SeaWaves::weight_slope(const SeaFrame& frame, glm::dvec2 p) const {
  constexpr double kStep_m = 0.25;
  const glm::dvec2 dx(0.5 * kStep_m, 0.0), dy(0.0, 0.5 * kStep_m);
  const glm::vec2 difference(weight_at(frame, p + dx) - weight_at(frame, p - dx),
                             weight_at(frame, p + dy) - weight_at(frame, p - dy));
  return difference / static_cast<float>(kStep_m);
}

void SeaWaves::add_heights(const SeaFrame& frame, Points p, Room room,
                           std::span<float> height_m) const {
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

void SeaWaves::add_slopes(const SeaFrame& frame, Points p, Room room,
                          std::span<glm::vec2> slope) const {
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

void SeaWaves::add_velocities(const VelocityFrame& velocity, Points p, Room room,
                              std::span<glm::vec3> velocity_mps) const {
  weigh(velocity.z, p, room);
  std::array<glm::vec3, kPointChunk> v;
  sample_velocities(velocity, p, std::span(v).first(p.size()));
  for (std::size_t i = 0; i < p.size(); ++i) velocity_mps[i] += v[i] * room[i];
}

// ---- Wakes

void WakeWaves::weigh(Points p, Room weight) const {
  std::ranges::fill(weight, 1.0f);
  SeaWaves{water, 0.3f, SIZE_MAX, true}.fade(p, weight);
}

void WakeWaves::add_heights(const SeaFrame& frame, Points p, Room,
                            std::span<float> height_m) const {
  if (frame.wakes.count == 0) return;
  std::array<float, kPointChunk> z{}, weight;
  add_wake_heights(frame.wakes, p, std::span(z).first(p.size()));
  std::array<glm::dvec2, kPointChunk> wavy;
  std::array<std::size_t, kPointChunk> place;
  std::size_t count = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (z[i] == 0.0f) continue;
    wavy[count] = p[i];
    place[count++] = i;
  }
  weigh(std::span(wavy).first(count), std::span(weight).first(count));
  for (std::size_t k = 0; k < count; ++k) height_m[place[k]] += z[place[k]] * weight[k];
}

void WakeWaves::add_slopes(const SeaFrame& frame, Points p, Room,
                           std::span<glm::vec2> slope) const {
  if (frame.wakes.count == 0) return;
  std::array<glm::vec2, kPointChunk> own{};
  std::array<float, kPointChunk> weight;
  add_wake_slopes(frame.wakes, p, std::span(own).first(p.size()));
  weigh(p, std::span(weight).first(p.size()));
  for (std::size_t i = 0; i < p.size(); ++i) slope[i] += own[i] * weight[i];
}

void WakeWaves::add_velocities(const VelocityFrame& velocity, Points p, Room,
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

// ---- Rivers and lakes

std::optional<InlandSample> InlandLevels::at(glm::dvec2 p) const {
  if (!water.inland) return std::nullopt;
  std::optional<InlandSample> sample = water.inland->at(p);
  if (sample && static_cast<double>(sample->level_m) <= terrain::height_at(*water.land, p))
    sample.reset();
  return sample;
}

void InlandLevels::add_heights(Points p, std::span<float> height_m) const {
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

void InlandLevels::add_slopes(Points p, std::span<glm::vec2> slope) const {
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

void InlandLevels::add_velocities(Points p, std::span<glm::vec3> velocity_mps) const {
  if (!water.inland) return;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (const auto sample = at(p[i]))
      velocity_mps[i] += glm::vec3(sample->east_mps, sample->north_mps, 0.0f);
}

}  // namespace swell::ocean
