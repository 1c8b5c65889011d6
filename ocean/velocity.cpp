#include "ocean/velocity.h"

#include <algorithm>
#include <array>

#include "math/check.h"
#include "math/elementary.h"
#include "ocean/open_sea/patch_transforms.h"
#include "ocean/open_sea/sea_state.h"
#include "ocean/spectrum/patch_waves.h"
#include "ocean/spectrum/point_chunk.h"
#include "ocean/wakes/wakes.h"

namespace swell::ocean {
namespace {

void size_component(const SeaFrame& frame, SeaFrame& component) {
  component.t_s = frame.t_s;
  component.patches.resize(frame.patches.size());
  for (std::size_t p = 0; p < frame.patches.size(); ++p) {
    component.patches[p].length_m = frame.patches[p].length_m;
    component.patches[p].resolution = frame.patches[p].resolution;
    component.patches[p].tiling = frame.patches[p].tiling;
    component.patches[p].height_m.resize(frame.patches[p].height_m.size());
  }
}

void synthesize(const Sea::State& state, double t_s, const SeaFrame& frame, VelocityFrame& velocity,
                Workers& workers) {
  const std::size_t patches = state.patches.size();
  std::array<PatchFields, kMaxPatches> fields;
  for (std::size_t p = 0; p < patches; ++p)
    fields[p] = {velocity.x.patches[p].height_m.data(), velocity.y.patches[p].height_m.data(),
                 velocity.z.patches[p].height_m.data()};
  transform_patches(state, t_s, {fill_drift, fill_rising}, {fields.data(), patches},
                    velocity.z.fft_planes, workers);
  for (std::size_t p = 0; p < patches; ++p) {
    if (frame.patches[p].displaced_x_m.empty()) continue;
    sharpen_velocities(state.crests[p], frame.patches[p],
                       {velocity.x.patches[p].height_m, velocity.y.patches[p].height_m,
                        velocity.z.patches[p].height_m},
                       velocity.z.linear, workers);
  }
}

// A sin(theta), theta falling at omega, moves the water by A omega (to sin(theta), -cos(theta)).
void add_sines(const Sea::State& state, const SeaFrame& frame, VelocityFrame& velocity) {
  velocity.x.sines = velocity.y.sines = velocity.z.sines = frame.sines;
  for (std::size_t i = 0; i < frame.sines.size(); ++i) {
    const SineFrame& sine = frame.sines[i];
    const double speed_mps = sine.amplitude_m * 2.0 * kPi * state.sines[i].turns_per_s;
    const glm::dvec2 to = sine.cycles_per_m / glm::length(sine.cycles_per_m);
    const double drift_mps = state.sines[i].drift * speed_mps;
    velocity.x.sines[i].amplitude_m = drift_mps * to.x;
    velocity.y.sines[i].amplitude_m = drift_mps * to.y;
    velocity.z.sines[i].amplitude_m = speed_mps;
    velocity.z.sines[i].cycles += sine.cycles < 0.25 ? 0.75 : -0.25;
  }
}

}  // namespace

void advance_velocity(const Sea& sea, const SeaFrame& frame, VelocityFrame& velocity,
                      Workers& workers) {
  const ScopedFloatEnvironment ieee;
  const Sea::State& state = sea.state();
  SWELL_CHECK(frame.patches.size() == state.patches.size() + state.maps.size(), "patches={}",
              frame.patches.size());
  SWELL_CHECK(frame.sines.size() == state.sines.size(), "sines={}", frame.sines.size());
  for (SeaFrame* component : {&velocity.x, &velocity.y, &velocity.z})
    size_component(frame, *component);
  const double t_wave_s = wave_time_s(state.description, frame.t_s);
  if (!state.patches.empty()) synthesize(state, t_wave_s, frame, velocity, workers);
  for (std::size_t m = 0; m < state.maps.size(); ++m) {
    const std::size_t p = state.patches.size() + m;
    sample_map_velocities(state.maps[m], t_wave_s, velocity.x.patches[p], velocity.y.patches[p],
                          velocity.z.patches[p], velocity.z.fft_planes, workers);
  }
  add_sines(state, frame, velocity);
  advance_wake_velocity(frame.wakes, WakeField::kDriftX, velocity.x.wakes, workers);
  advance_wake_velocity(frame.wakes, WakeField::kDriftY, velocity.y.wakes, workers);
  advance_wake_velocity(frame.wakes, WakeField::kRise, velocity.z.wakes, workers);
}

void sample_velocities(const VelocityFrame& velocity, std::span<const glm::dvec2> p_world,
                       std::span<glm::vec3> velocity_mps) {
  SWELL_CHECK(p_world.size() == velocity_mps.size(), "{} points, {} velocities", p_world.size(),
              velocity_mps.size());
  for (std::size_t first = 0; first < p_world.size(); first += kPointChunk) {
    const std::size_t count = std::min(kPointChunk, p_world.size() - first);
    const auto p = p_world.subspan(first, count);
    std::array<float, kPointChunk> x, y, z;
    sample_heights(velocity.x, p, std::span(x).first(count));
    sample_heights(velocity.y, p, std::span(y).first(count));
    sample_heights(velocity.z, p, std::span(z).first(count));
    for (std::size_t i = 0; i < count; ++i) velocity_mps[first + i] = {x[i], y[i], z[i]};
  }
}

}  // namespace swell::ocean
