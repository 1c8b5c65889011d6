#include "ocean/open_sea/sea.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <stdexcept>

#include "math/check.h"
#include "math/elementary.h"
#include "math/random.h"
#include "ocean/open_sea/patch_transforms.h"
#include "ocean/open_sea/sea_state.h"
#include "ocean/spectrum/dispersion.h"
#include "ocean/spectrum/fft.h"
#include "ocean/spectrum/require.h"
#include "ocean/spectrum/sea_scale.h"

namespace swell::ocean {
namespace {

void check_systems(const SeaDescription& sea) {
  require(sea.wind_speed_mps, 0.0, 60.0, "wind_speed_mps");
  if (sea.fetch_km) require(*sea.fetch_km, 0.01, 10000.0, "fetch_km");
  if (sea.hs_m) require(*sea.hs_m, 0.0, 30.0, "hs_m");
  if (sea.tp_s) require(*sea.tp_s, 0.5, 40.0, "tp_s");
  if (sea.gamma) require(*sea.gamma, 1.0, 20.0, "gamma");
  if (sea.swells.size() > kMaxSwells) {
    throw std::invalid_argument(
        fmt::format("swells: got {}, allowed at most {}", sea.swells.size(), kMaxSwells));
  }
  for (const Swell& swell : sea.swells) {
    require(swell.hs_m, 0.0, 30.0, "swells.hs_m");
    require(swell.tp_s, 1.0, 40.0, "swells.tp_s");
    require(swell.from_rad, -1e6, 1e6, "swells.from_rad");
    require(swell.gamma, 1.0, 20.0, "swells.gamma");
    require(swell.spread_rad, 0.01, 1.05, "swells.spread_rad");
  }
}

void check_spectrum(const SeaDescription& sea) {
  check_systems(sea);
  require(sea.wind_from_rad, -1e6, 1e6, "wind_from_rad");
  require(sea.amplitude_scale, 0.0, 4.0, "amplitude_scale");
  require(sea.gravity_mps2, 0.1, 100.0, "gravity_mps2");
  require(sea.whitecaps, 0.0, 10.0, "whitecaps");
  require(sea.choppiness, 0.0, 1.0, "choppiness");
  if (sea.loop_s != 0.0) require(sea.loop_s, 1.0, 1e5, "loop_s (or 0)");
  if (sea.resolution < kMinFftSize || sea.resolution > kMaxFftSize ||
      !std::has_single_bit(static_cast<unsigned>(sea.resolution))) {
    throw std::invalid_argument(fmt::format("resolution: got {}, allowed powers of two in [{}, {}]",
                                            sea.resolution, kMinFftSize, kMaxFftSize));
  }
  if (sea.patch_lengths_m.empty() || sea.patch_lengths_m.size() > kMaxPatches) {
    throw std::invalid_argument(fmt::format("patch_lengths_m: got {} lengths, allowed [1, {}]",
                                            sea.patch_lengths_m.size(), kMaxPatches));
  }
  if (sea.sines.size() > kMaxSines) {
    throw std::invalid_argument(
        fmt::format("sines: got {} waves, allowed at most {}", sea.sines.size(), kMaxSines));
  }
  double longest = 1e6;
  for (const double length : sea.patch_lengths_m) {
    require(length, 0.01, longest, "patch_lengths_m (longest first)");
    longest = length;
  }
}

void check_sine(const SineWave& sine) {
  require(sine.amplitude_m, -1000.0, 1000.0, "sines.amplitude_m");
  require(sine.wavelength_m, 1e-3, 1e6, "sines.wavelength_m");
  require(sine.to_rad, -1e6, 1e6, "sines.to_rad");
  require(sine.phase_rad, -1e6, 1e6, "sines.phase_rad");
  if (sine.period_s != 0.0) require(sine.period_s, 1e-3, 1e6, "sines.period_s (or 0)");
}

SineTrain make_sine_train(const SineWave& sine, const SeaDescription& sea) {
  const SinCos to = sin_cos_turns(sine.to_rad / kTwoPi);
  SineTrain train;
  train.at_start.cycles_per_m = {to.sin / sine.wavelength_m, to.cos / sine.wavelength_m};
  train.at_start.cycles = sine.phase_rad / kTwoPi;
  train.at_start.amplitude_m = sine.amplitude_m;
  const double turns_per_s =
      sine.period_s > 0.0 ? 1.0 / sine.period_s
                          : deep_water_omega(kTwoPi / sine.wavelength_m, sea.gravity_mps2) / kTwoPi;
  train.turns_per_s = looping_frequency(turns_per_s, sea.loop_s);
  return train;
}

// Stokes's wave of second order has beside A sin(theta) another, -k A^2 / 2 cos(2 theta): so much
// of A. No more than keeps troughs round.
double second_order_part(const SineWave& sine, double choppiness) {
  const double k_rad_m = kTwoPi / sine.wavelength_m;
  return choppiness * std::min(0.5 * k_rad_m * std::abs(sine.amplitude_m), 0.25);
}

SineTrain sharpen_sine(const SineTrain& train, double part) {
  SineTrain twice;
  twice.at_start.cycles_per_m = 2.0 * train.at_start.cycles_per_m;
  twice.at_start.cycles = 2.0 * train.at_start.cycles - 0.25;
  twice.at_start.amplitude_m = part * std::abs(train.at_start.amplitude_m);
  twice.turns_per_s = 2.0 * train.turns_per_s;
  twice.drift = 0.5;  // k A^2 omega cos^2(theta) less its mean
  return twice;
}

// Patch p's waves start where those of the next longer one end. All but the last end half a wave
// count short of size/4, so that their shortest waves have four samples; the last one's end half
// a wave count short of its Nyquist wave number.
WaveBand band_of_patch(const SeaDescription& sea, std::size_t patch) {
  const auto end = [&](std::size_t p) {
    const int counts = p + 1 < sea.patch_lengths_m.size() ? sea.resolution / 4 : sea.resolution / 2;
    return kTwoPi / sea.patch_lengths_m[p] * (counts - 0.5);
  };
  double low = 0.0;
  for (std::size_t p = 0; p < patch; ++p) low = std::max(low, end(p));
  return {low, end(patch)};
}

WaveSystem wind_waves(const SeaDescription& sea) {
  const double wind = sea.wind_speed_mps, from = sea.wind_from_rad, g = sea.gravity_mps2;
  if (sea.fetch_km)
    return make_fetch_sea(wind, from, g, 1e3 * *sea.fetch_km, sea.gamma.value_or(3.3));
  WaveSystem system = make_wind_sea(wind, from, g);
  system.gamma = sea.gamma.value_or(1.0);
  if (sea.tp_s)
    system.peak_hz = 1.0 / *sea.tp_s;
  else if (sea.hs_m)
    system.peak_hz = make_wind_sea(wind_of_developed_height(*sea.hs_m, g), from, g).peak_hz;
  return sea.hs_m ? with_height(system, *sea.hs_m) : system;
}

WaveSystem swell_waves(const Swell& swell, double gravity_mps2) {
  WaveSystem system = make_wind_sea(0.0, swell.from_rad, gravity_mps2);
  system.peak_hz = 1.0 / swell.tp_s;
  system.gamma = swell.gamma;
  // The variance of |cos(theta / 2)|^(2p) is about 2 / (p + 1) where it is narrow.
  system.spreading = std::max(2.0 / (swell.spread_rad * swell.spread_rad) - 1.0, 0.5);
  return with_height(system, swell.hs_m);
}

void make_spectrum_waves(Sea::State& state) {
  const SeaDescription& sea = state.description;
  const std::vector<WaveSystem> systems = wave_systems(sea);
  if (systems.empty()) return;
  state.plan = make_fft_plan(sea.resolution);
  for (std::size_t p = 0; p < sea.patch_lengths_m.size(); ++p) {
    state.patches.push_back(make_patch_waves(systems, band_of_patch(sea, p), sea.patch_lengths_m[p],
                                             sea.resolution, sea.amplitude_scale, sea.seed,
                                             static_cast<int>(p)));
    PatchWaves& waves = state.patches.back();
    state.spectrum_variance_m2 += waves.variance_m2;
    const bool is_last_of_several = p > 0 && p + 1 == sea.patch_lengths_m.size();
    state.crests.push_back(make_crests(waves, is_last_of_several ? 0.0 : sea.choppiness));
    for (double& turns_per_s : waves.turns_per_s) {
      if (turns_per_s > 0.0) turns_per_s = looping_frequency(turns_per_s, sea.loop_s);
    }
  }
}

void make_maps(Sea::State& state) {
  const std::size_t layers = count_map_layers(state.description);
  const std::size_t most = kMaxPatches - state.patches.size();
  if (layers > most)
    throw std::invalid_argument(
        fmt::format("maps: got {} layers beside {} patches of the spectrum, allowed at most {}",
                    layers, state.patches.size(), most));
  state.maps = make_map_waves(state.description);
}

void size_map_patches(const Sea::State& state, std::vector<PatchFrame>& patches) {
  for (std::size_t m = 0; m < state.maps.size(); ++m) {
    const MapWaves& waves = state.maps[m];
    PatchFrame& patch = patches[state.patches.size() + m];
    patch.length_m = waves.length_m;
    patch.resolution = waves.map->size;
    patch.slope_variance = static_cast<float>(waves.slope_variance);
    patch.tiling = tiling_of_patch(state.description, state.patches.size() + m);
    for (auto* field : {&patch.height_m, &patch.slope_x, &patch.slope_y})
      field->resize(waves.map->frame_samples());
    const bool is_packed = state.description.map_heights == MapHeights::kPacked;
    patch.height_quads.resize(is_packed ? waves.map->frame_samples() : 0);
    patch.height_step_m = packed_step_m(waves);
  }
}

void size_patches(const Sea::State& state, bool sharp_crests, std::vector<PatchFrame>& patches) {
  patches.resize(state.patches.size() + state.maps.size());
  size_map_patches(state, patches);
  for (std::size_t p = 0; p < state.patches.size(); ++p) {
    const PatchWaves& waves = state.patches[p];
    const std::size_t samples = static_cast<std::size_t>(waves.size) * waves.size;
    patches[p].length_m = glm::dvec2(waves.length_m);
    patches[p].resolution = waves.size;
    patches[p].slope_variance = static_cast<float>(waves.slope_variance);
    patches[p].tiling = tiling_of_patch(state.description, p);
    for (auto* field : {&patches[p].height_m, &patches[p].slope_x, &patches[p].slope_y}) {
      field->resize(samples);
    }
    const bool is_sharp = sharp_crests && state.crests[p].choppiness > 0.0f;
    for (auto* field : {&patches[p].displaced_x_m, &patches[p].displaced_y_m})
      field->resize(is_sharp ? samples : 0);
  }
}

void synthesize_patches(const Sea::State& state, double t_s, SeaFrame& frame, Workers& workers) {
  constexpr std::size_t kLinearFields = 5;
  const std::size_t count = state.patches.size();
  const auto samples = static_cast<std::size_t>(state.plan.size) * state.plan.size;
  const auto is_sharp = [&](std::size_t p) { return !frame.patches[p].displaced_x_m.empty(); };
  std::array<PatchFields, kMaxPatches> fields;
  std::array<LinearWaves, kMaxPatches> linear;
  bool any_sharp = false;
  for (std::size_t p = 0; p < count; ++p) any_sharp = any_sharp || is_sharp(p);
  if (any_sharp) frame.linear.resize(kLinearFields * count * samples);
  for (std::size_t p = 0; p < count; ++p) {
    PatchFrame& patch = frame.patches[p];
    fields[p] = {patch.slope_x.data(), patch.slope_y.data(), patch.height_m.data()};
    if (!is_sharp(p)) continue;
    float* const at = frame.linear.data() + kLinearFields * p * samples;
    fields[p] = {at, at + samples, at + 2 * samples, at + 3 * samples, at + 4 * samples};
    linear[p] = {fields[p].third, fields[p].first, fields[p].second, fields[p].displacement_x,
                 fields[p].displacement_y};
  }
  transform_patches(state, t_s, {fill_slopes, fill_heights}, {fields.data(), count},
                    frame.fft_planes, workers);
  for (std::size_t p = 0; p < count; ++p)
    if (is_sharp(p)) sharpen_crests(state.crests[p], linear[p], frame.patches[p], workers);
}

}  // namespace

std::vector<WaveSystem> wave_systems(const SeaDescription& sea) {
  std::vector<WaveSystem> systems;
  if (sea.spectrum) systems.push_back(wind_waves(sea));
  for (const Swell& swell : sea.swells) systems.push_back(swell_waves(swell, sea.gravity_mps2));
  std::erase_if(systems, [](const WaveSystem& s) { return s.peak_hz == 0.0 || s.alpha == 0.0; });
  return systems;
}

double Sea::State::height_bound_m(std::size_t first_patch) const {
  constexpr double kDeviations = 6.0;
  double variance_m2 = 0.0, crests_m = 0.0;
  for (std::size_t p = first_patch; p < patches.size(); ++p) {
    variance_m2 += patches[p].variance_m2;
    const double squares_m2 = kDeviations * kDeviations * patches[p].variance_m2;
    crests_m += 0.5 * static_cast<double>(crests[p].rise_per_m) * squares_m2 +
                std::abs(static_cast<double>(crests[p].mean_m));
  }
  double maps_m = 0.0;
  const std::size_t first_map = std::max(first_patch, patches.size()) - patches.size();
  for (std::size_t m = first_map; m < maps.size(); ++m) maps_m += maps[m].peak_m();
  return kDeviations * std::sqrt(variance_m2) + crests_m + maps_m;
}

Sea::Sea(const SeaDescription& description) : state_(std::make_unique<State>()) {
  const ScopedFloatEnvironment ieee;
  check_spectrum(description);
  for (const SineWave& sine : description.sines) check_sine(sine);
  state_->description = description;
  make_spectrum_waves(*state_);
  make_maps(*state_);
  for (const SineWave& sine : description.sines) {
    state_->sines.push_back(make_sine_train(sine, description));
  }
  if (description.choppiness > 0.0) {
    for (std::size_t i = 0; i < description.sines.size(); ++i) {
      const double part = second_order_part(description.sines[i], description.choppiness);
      state_->sines.push_back(sharpen_sine(state_->sines[i], part));
    }
  }
}

Sea::~Sea() = default;
Sea::Sea(Sea&&) noexcept = default;
Sea& Sea::operator=(Sea&&) noexcept = default;

const SeaDescription& Sea::description() const { return state_->description; }

double Sea::height_bound_m() const {
  double bound = state_->height_bound_m(0);
  for (const SineWave& sine : state_->description.sines)
    bound += std::abs(sine.amplitude_m) *
             (1.0 + second_order_part(sine, state_->description.choppiness));
  return bound;
}

double Sea::slope_bound() const {
  double variance = 0.0;
  std::size_t patch = 0;
  const auto add = [&](const auto& waves, double length_m) {
    variance += waves.slope_variance;
    if (!tiling_of_patch(state_->description, patch++).on) return;
    const double blend_per_m = kTileBlendSlope / length_m;
    variance += waves.variance_m2 * blend_per_m * blend_per_m;
  };
  for (const PatchWaves& waves : state_->patches) add(waves, waves.length_m);
  for (const MapWaves& waves : state_->maps)
    add(waves, std::min(waves.length_m.x, waves.length_m.y));
  double bound = 6.0 * std::sqrt(variance);
  for (const SineWave& sine : state_->description.sines)
    bound += std::abs(sine.amplitude_m) * kTwoPi / sine.wavelength_m *
             (1.0 + 2.0 * second_order_part(sine, state_->description.choppiness));
  return bound;
}

double Sea::short_wave_bound_m(std::size_t longest_patches) const {
  return state_->height_bound_m(longest_patches);
}

double Sea::significant_height_m() const {
  double variance = state_->spectrum_variance_m2;
  for (const MapWaves& waves : state_->maps) variance += waves.variance_m2;
  for (const SineWave& sine : state_->description.sines) {
    variance += 0.5 * sine.amplitude_m * sine.amplitude_m;
  }
  return 4.0 * std::sqrt(variance);
}

double Sea::mean_wavelength_m() const {
  double variance = 0.0, variance_k = 0.0;
  for (const PatchWaves& waves : state_->patches) {
    variance += waves.variance_m2;
    variance_k += waves.variance_k_m;
  }
  for (const MapWaves& waves : state_->maps) {
    variance += waves.variance_m2;
    variance_k += waves.variance_m2 * waves.wave_number_rad_m();
  }
  for (const SineWave& sine : state_->description.sines) {
    const double square = 0.5 * sine.amplitude_m * sine.amplitude_m;
    variance += square;
    variance_k += square * kTwoPi / sine.wavelength_m;
  }
  return variance > 0.0 ? kTwoPi * variance / variance_k : 0.0;
}

PatchTiling tiling_of_patch(const SeaDescription& sea, std::size_t patch) {
  constexpr std::uint64_t kStream = 0x74696c6573;  // apart from the waves' random numbers
  if (!sea.tiling || patch >= kTiledPatches) return {};
  return {true, static_cast<std::uint32_t>(random_bits(sea.seed ^ kStream, patch))};
}

double looping_frequency(double turns_per_s, double loop_s) {
  if (loop_s == 0.0) return turns_per_s;
  return std::max(1.0, std::nearbyint(turns_per_s * loop_s)) / loop_s;
}

double wave_time_s(const SeaDescription& sea, double t_s) {
  // Beyond 2^53 s the fractions of a turn are arbitrary, but products must stay finite.
  if (sea.loop_s == 0.0) return std::fmod(t_s, 0x1p100);
  // fmod is exact. So is the sum if t_s plus some number of loops is a positive double: both have
  // no digits below those of loop_s.
  const double rest_s = std::fmod(t_s, sea.loop_s);
  return rest_s < 0.0 ? rest_s + sea.loop_s : rest_s;
}

void advance(const Sea& sea, double t_s, SeaFrame& frame, Workers& workers, bool sharp_crests) {
  const ScopedFloatEnvironment ieee;
  SWELL_CHECK(std::isfinite(t_s), "t_s={}", t_s);
  const Sea::State& state = sea.state();
  frame.t_s = t_s;
  const double t_wave_s = wave_time_s(state.description, t_s);
  size_patches(state, sharp_crests, frame.patches);
  if (!state.patches.empty()) synthesize_patches(state, t_wave_s, frame, workers);
  sample_maps(state.maps, t_wave_s, std::span(frame.patches).subspan(state.patches.size()),
              workers);

  frame.sines.resize(state.sines.size());
  for (std::size_t i = 0; i < frame.sines.size(); ++i) {
    frame.sines[i] = state.sines[i].at_start;
    const double cycles = frame.sines[i].cycles - state.sines[i].turns_per_s * t_wave_s;
    const double fraction = cycles - std::floor(cycles);
    frame.sines[i].cycles = fraction < 1.0 ? fraction : 0.0;  // -1e-20 + 1 rounds up
  }
}

}  // namespace swell::ocean
