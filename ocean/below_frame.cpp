#include "ocean/below_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "math/check.h"
#include "math/elementary.h"
#include "ocean/open_sea/sea_state.h"
#include "ocean/spectrum/point_chunk.h"
#include "ocean/wakes/wakes.h"

namespace swell::ocean {
namespace {

void size_modes(glm::dvec2 length_m, int size, double gravity_mps2, SurfaceModes& modes) {
  if (modes.plan.size != size) modes.plan = make_fft_plan(size);
  modes.length_m = length_m;
  modes.gravity_mps2 = gravity_mps2;
  for (SurfaceModes::Field& field : modes.fields) field.is_made = false;
}

// A patch's mean is of second order in its waves and decays twice as fast.
void set_patch_waves(const Sea::State& state, std::size_t p, SurfaceModes& modes) {
  modes.omega2.clear();
  if (p >= state.patches.size()) {
    const MapWaves& waves = state.maps[p - state.patches.size()];
    modes.mean_rad_m = static_cast<float>(2.0 * waves.wave_number_rad_m());
    return;
  }
  const PatchWaves& waves = state.patches[p];
  const double mean_k = waves.variance_m2 > 0.0 ? waves.variance_k_m / waves.variance_m2 : 1.0;
  modes.mean_rad_m = static_cast<float>(2.0 * mean_k);
  // Waves of a sea that loops have frequencies of their own.
  if (state.description.loop_s == 0.0) return;
  modes.omega2.resize(waves.turns_per_s.size());
  for (int j = 0; j < waves.size; ++j)
    for (int i = 0; i < waves.size; ++i) {
      const double omega = kTwoPi * waves.turns_per_s[wave_position(i, j, waves.size)];
      const double k = glm::length(wave_vector(i, j, waves.size, waves.length_m));
      modes.omega2[static_cast<std::size_t>(j) * waves.size + i] =
          static_cast<float>(omega > 0.0 ? omega * omega : state.description.gravity_mps2 * k);
    }
}

double floor_of(const SurfaceModes& modes) {
  return modes.depth_m > 0.0f ? static_cast<double>(modes.depth_m) : HUGE_VAL;
}

// ---- The fields of the surface

const SeaFrame& surface_of(const BelowFrame& below, MotionField field) {
  if (field == kHead) return *below.surface;
  SWELL_CHECK(below.velocity != nullptr, "velocities below a surface without");
  const std::array<const SeaFrame*, 3> velocity = {&below.velocity->x, &below.velocity->y,
                                                   &below.velocity->z};
  return *velocity[field - kVelocityX];
}

const SeaFrame& field_at(const BelowFrame& below, std::size_t rung, MotionField field) {
  const bool is_surface = rung == 0 && surface_field(field) == field;
  return is_surface ? surface_of(below, field) : below.rungs[rung].field[field];
}

// ---- Making fields

// A square of samples: a patch, or the window of a wake, as frames of the surface and those of a
// rung have it.
struct Square {
  bool is_window;
  std::size_t in_surface, in_rung;
};

template <class Frame>
auto& samples_of(Frame& frame, bool is_window, std::size_t index) {
  return is_window ? frame.wakes.windows[index].height_m : frame.patches[index].height_m;
}

struct TransformBelow {
  MotionField a;
  std::optional<MotionField> b;
};
constexpr std::array<TransformBelow, kTransformsBelow> kTransforms = {{
    {kVelocityX, kVelocityY},
    {kVelocityZ, std::nullopt},
    {kAccelerationX, kAccelerationY},
    {kAccelerationZ, kHead},
}};

// Those of the transforms that are wanted.
struct Wanted {
  std::array<std::size_t, kTransformsBelow> transform{};
  std::size_t count = 0;

  std::span<const std::size_t> all() const { return {transform.data(), count}; }
  template <class Visit>
  void for_each_field(const Visit& visit) const {
    for (const std::size_t n : all()) {
      visit(kTransforms[n].a);
      if (kTransforms[n].b) visit(*kTransforms[n].b);
    }
  }
};

// Carries fields of a square down to a rung.
void carry_down(const Square& square, std::size_t rung, const Wanted& wanted, BelowFrame& below,
                Workers& workers) {
  SurfaceModes& modes = (square.is_window ? below.windows : below.patches)[square.in_surface];
  const auto samples = [&](MotionField field) -> std::vector<float>& {
    return samples_of(below.rungs[rung].field[field], square.is_window, square.in_rung);
  };
  wanted.for_each_field([&](MotionField field) {
    const MotionField from = surface_field(field);
    const auto& surface = samples_of(surface_of(below, from), square.is_window, square.in_surface);
    if (!modes.fields[from].is_made) find_modes(surface, from, below.planes, modes, workers);
    samples(field).resize(surface.size());
  });
  std::array<FftOutput, kTransformsBelow> outputs;
  for (std::size_t n = 0; n < wanted.count; ++n) {
    const TransformBelow& transform = kTransforms[wanted.transform[n]];
    outputs[n] = {samples(transform.a).data(),
                  transform.b ? samples(*transform.b).data() : nullptr};
  }
  const double below_m = rung_depth_m(rung, floor_of(modes));
  const auto fill = [&](int n, int column0, float* re, float* im) {
    const TransformBelow& transform = kTransforms[wanted.transform[static_cast<std::size_t>(n)]];
    return fill_below(modes, below_m, transform.a, transform.b, column0, re, im);
  };
  inverse_fft_2d(modes.plan, fill, {outputs.data(), wanted.count}, below.planes, workers);
}

// The field's sines: A sin(theta), theta falling at omega, has the rate -omega A cos(theta).
void set_sines(const BelowFrame& below, double below_m, MotionField field, SeaFrame& frame) {
  const std::vector<SineTrain>& trains = below.sea->state().sines;
  frame.sines = surface_of(below, field < kAccelerationX ? field : kHead).sines;
  for (std::size_t i = 0; i < frame.sines.size(); ++i) {
    SineFrame& sine = frame.sines[i];
    const double omega = kTwoPi * trains[i].turns_per_s;
    const double per_m = glm::length(sine.cycles_per_m);
    if (field == kAccelerationZ) sine.amplitude_m *= -omega * omega;
    if (field == kAccelerationX || field == kAccelerationY) {
      const double to =
          (field == kAccelerationX ? sine.cycles_per_m.x : sine.cycles_per_m.y) / per_m;
      sine.amplitude_m *= -omega * omega * trains[i].drift * to;
      sine.cycles += sine.cycles < 0.75 ? 0.25 : -0.75;
    }
    sine.amplitude_m *= exp(-kTwoPi * per_m * below_m);
  }
}

// The patches and the sines at a rung. Patches that are not felt there are left out.
void make_patches(std::size_t rung, const Wanted& wanted, BelowFrame& below, Workers& workers) {
  const double below_m = rung_depth_m(rung);
  RungBelow& to = below.rungs[rung];
  wanted.for_each_field([&](MotionField field) {
    set_sines(below, below_m, field, to.field[field]);
    to.field[field].patches.resize(below.patches.size());
  });
  std::size_t felt = 0;
  for (std::size_t p = 0; p < below.patches.size(); ++p) {
    const PatchFrame& surface = below.surface->patches[p];
    const double longest_m = std::max(surface.length_m.x, surface.length_m.y);
    if (kTwoPi / longest_m * below_m > kLeastDecay) continue;
    wanted.for_each_field([&](MotionField field) {
      PatchFrame& patch = to.field[field].patches[felt];
      patch.length_m = surface.length_m;
      patch.resolution = surface.resolution;
      patch.tiling = surface.tiling;
    });
    carry_down({false, p, felt++}, rung, wanted, below, workers);
  }
  wanted.for_each_field([&](MotionField field) { to.field[field].patches.resize(felt); });
  for (const std::size_t n : wanted.all()) to.has_patches[n] = true;
}

// A wake's window at a rung.
void make_window(std::size_t window, std::size_t rung, const Wanted& wanted, BelowFrame& below,
                 Workers& workers) {
  RungBelow& to = below.rungs[rung];
  wanted.for_each_field([&](MotionField field) {
    std::vector<WakeWindow>& windows = to.field[field].wakes.windows;
    if (windows.size() < below.windows.size()) windows.resize(below.windows.size());
    windows[window].corner_m = below.surface->wakes.windows[window].corner_m;
    windows[window].length_m = below.surface->wakes.windows[window].length_m;
  });
  carry_down({true, window, window}, rung, wanted, below, workers);
  for (const std::size_t n : wanted.all()) to.has_window[window][n] = true;
}

// The transforms that parts of a motion need at a rung and that have not been made. At the surface
// there are some fields already.
Wanted wanted_at(std::size_t rung, MotionParts parts,
                 const std::array<bool, kTransformsBelow>& is_made) {
  const auto is_wanted = [&](MotionField field) {
    return parts.has(field) && (rung > 0 || surface_field(field) != field);
  };
  Wanted wanted;
  for (std::size_t n = 0; n < kTransformsBelow; ++n) {
    const TransformBelow& transform = kTransforms[n];
    const bool is_needed = is_wanted(transform.a) || (transform.b && is_wanted(*transform.b));
    if (is_needed && !is_made[n]) wanted.transform[wanted.count++] = n;
  }
  return wanted;
}

bool is_anywhere(glm::dvec2) { return true; }

// The rungs around points that count.
template <class Counts>
std::array<bool, kRungs> rungs_around(const PointsBelow& points, double floor_m,
                                      const Counts& counts) {
  std::array<bool, kRungs> is_near{};
  for (std::size_t i = 0; i < points.p_world.size(); ++i) {
    if (!counts(points.p_world[i])) continue;
    const RungWeights weights = rung_weights(static_cast<double>(points.below_m[i]), floor_m);
    for (std::size_t n = 0; n < 4; ++n)
      if (weights.weight[n] != 0.0f) is_near[weights.first + n] = true;
  }
  return is_near;
}

// ---- Sampling

// Adds what sample(frame, points, values) finds in the fields of the rungs around each point that
// counts.
template <class Counts, class Sample>
void add_rungs(const BelowFrame& below, const PointsBelow& points, double floor_m,
               const Counts& counts, std::span<Motion> motion, const Sample& sample) {
  const std::size_t count = points.p_world.size();
  SWELL_CHECK(count <= kPointChunk && motion.size() == count, "{} points, {} motions", count,
              motion.size());
  std::array<RungWeights, kPointChunk> weights;
  std::size_t low = kRungs, high = 0;
  for (std::size_t i = 0; i < count; ++i) {
    weights[i] = {};
    if (!counts(points.p_world[i])) continue;
    weights[i] = rung_weights(static_cast<double>(points.below_m[i]), floor_m);
    low = std::min(low, weights[i].first);
    high = std::max(high, weights[i].first + 4);
  }
  for (std::size_t rung = low; rung < high; ++rung) {
    std::array<glm::dvec2, kPointChunk> p;
    std::array<std::size_t, kPointChunk> place;
    std::array<float, kPointChunk> weight, value;
    std::size_t near = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t n = rung - weights[i].first;  // wraps below the first
      if (n >= 4 || weights[i].weight[n] == 0.0f) continue;
      p[near] = points.p_world[i];
      weight[near] = weights[i].weight[n];
      place[near++] = i;
    }
    if (near == 0) continue;
    for (std::size_t f = 0; f < kMotionFields; ++f) {
      const auto field = static_cast<MotionField>(f);
      if (!points.parts.has(field)) continue;
      sample(field_at(below, rung, field), std::span<const glm::dvec2>(p.data(), near),
             std::span(value).first(near));
      for (std::size_t k = 0; k < near; ++k) motion[place[k]][f] += weight[k] * value[k];
    }
  }
}

}  // namespace

void begin_below(const Sea& sea, const SeaFrame& surface, const VelocityFrame* velocity,
                 BelowFrame& below) {
  below.sea = &sea;
  below.surface = &surface;
  below.velocity = velocity;
  const double gravity_mps2 = sea.description().gravity_mps2;
  below.patches.resize(surface.patches.size());
  for (std::size_t p = 0; p < below.patches.size(); ++p) {
    size_modes(surface.patches[p].length_m, surface.patches[p].resolution, gravity_mps2,
               below.patches[p]);
    set_patch_waves(sea.state(), p, below.patches[p]);
  }
  below.windows.resize(surface.wakes.count);
  for (std::size_t w = 0; w < below.windows.size(); ++w) {
    const WakeWindow& window = surface.wakes.windows[w];
    size_modes(glm::dvec2(window.length_m), kWakeSamples, gravity_mps2, below.windows[w]);
    below.windows[w].depth_m = window.depth_m;
    below.windows[w].mean_rad_m = static_cast<float>(2.0 * kTwoPi / window.length_m);
  }
  below.rungs.resize(kRungs);
  for (RungBelow& rung : below.rungs) {
    rung.has_patches.fill(false);
    for (auto& window : rung.has_window) window.fill(false);
  }
}

void make_below(const PointsBelow& points, BelowFrame& below, Workers& workers) {
  const auto near_sea = rungs_around(points, HUGE_VAL, is_anywhere);
  for (std::size_t rung = 0; rung < kRungs; ++rung) {
    if (!near_sea[rung]) continue;
    const Wanted wanted = wanted_at(rung, points.parts, below.rungs[rung].has_patches);
    if (wanted.count > 0) make_patches(rung, wanted, below, workers);
  }
  for (std::size_t w = 0; w < below.windows.size(); ++w) {
    const WakeWindow& window = below.surface->wakes.windows[w];
    const auto near = rungs_around(points, floor_of(below.windows[w]),
                                   [&](glm::dvec2 p) { return is_inside(window, p); });
    for (std::size_t rung = 0; rung < kRungs; ++rung) {
      if (!near[rung]) continue;
      need_wake(below.surface->wakes, w, WakeFields::kHeights);
      const Wanted wanted = wanted_at(rung, points.parts, below.rungs[rung].has_window[w]);
      if (wanted.count > 0) make_window(w, rung, wanted, below, workers);
    }
  }
}

void add_sea_below(const BelowFrame& below, const PointsBelow& points, std::span<Motion> motion) {
  add_rungs(below, points, HUGE_VAL, is_anywhere, motion,
            [](const SeaFrame& frame, std::span<const glm::dvec2> p, std::span<float> value) {
              sample_heights(frame, p, value);
            });
}

void add_wakes_below(const BelowFrame& below, const PointsBelow& points, std::span<Motion> motion) {
  for (std::size_t w = 0; w < below.windows.size(); ++w) {
    const WakeWindow& window = below.surface->wakes.windows[w];
    add_rungs(
        below, points, floor_of(below.windows[w]),
        [&](glm::dvec2 p) { return is_inside(window, p); }, motion,
        [&](const SeaFrame& frame, std::span<const glm::dvec2> p, std::span<float> value) {
          std::ranges::fill(value, 0.0f);
          add_window_heights(frame.wakes.windows[w], p, value);
        });
  }
}

}  // namespace swell::ocean
