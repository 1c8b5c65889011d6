#include "ocean/open_sea/whitecaps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "math/elementary.h"
#include "math/random.h"
#include "math/smoothstep.h"
#include "math/stop.h"
#include "ocean/open_sea/sea_state.h"
#include "ocean/open_sea/whitecap_steps.h"

namespace swell::ocean {
namespace {

constexpr double kStep_s = 0.25;  // crests pass less than two texels meanwhile
// How long whole foam lasts on the longest patch and on the other; a quarter of it is left after
// half of that. Bubbles decay by 1 / e in 3.85 s (Monahan 1971).
constexpr double kLongLife_s = 8.0, kShortLife_s = 5.0;
constexpr double kOnTrains = 1.5;  // C's gain in B'
// In wave numbers of the spectrum's peak: waves that break are between these.
constexpr double kLongest = 6.0, kShortest = 20.0;

// ---- Breaking

// What turns h(k) into B(k): re + i im.
struct Gain {
  double re, im;
};

Gain gain_at(glm::dvec2 k_rad_m, glm::dvec2 travel, double peak_rad_m) {
  const double k = glm::length(k_rad_m), peaks = k / peak_rad_m;
  // Waves across the wind count less, so that breaking crests are longer than they are wide.
  const double cos_wind = glm::dot(k_rad_m, travel) / k;
  const double kept =
      cos_wind * cos_wind /
      ((1.0 + kLongest / peaks) * std::sqrt(1.0 + peaks * peaks / (kShortest * kShortest)));
  // cos(a) |k| h - sin(a) dh/ds along the waves: behind a crest by the phase a it is k h.
  return {kept * k * cos(kBirthsAhead_rad),
          -kept * glm::dot(k_rad_m, travel) * sin(kBirthsAhead_rad)};
}

// B's waves on a grid of `size` points a side, not scaled; waves too short for it are left out.
PatchWaves breaking_waves(const PatchWaves& from, const WaveSystem& wind, int size) {
  PatchWaves to;
  to.length_m = from.length_m;
  to.size = size;
  to.reach = std::min(from.reach, size / 2 - 1);
  const std::size_t points = static_cast<std::size_t>(size) * size;
  for (auto* table : {&to.cos_re, &to.sin_re, &to.cos_im, &to.sin_im}) table->resize(points);
  to.turns_per_s.resize(points);
  for (int j = 0; j < size; ++j)
    to.k_rad_m.push_back(static_cast<float>(wave_vector(0, j, size, to.length_m).y));

  const double omega = 2.0 * kPi * wind.peak_hz;
  const double peak_rad_m = omega * omega / wind.gravity_mps2;
  const auto index = [](int count, int n) { return (count + n) % n; };
  for (int y = -to.reach; y <= to.reach; ++y) {
    for (int x = -to.reach; x <= to.reach; ++x) {
      const std::size_t a = wave_position(index(x, from.size), index(y, from.size), from.size);
      const std::size_t b = wave_position(index(x, size), index(y, size), size);
      if (from.turns_per_s[a] == 0.0) continue;
      const double dk = 2.0 * kPi / from.length_m;
      const Gain g = gain_at(dk * glm::dvec2(x, y), wind.travel, peak_rad_m);
      const auto turn = [&](float re, float im, float& to_re, float& to_im) {
        to_re = static_cast<float>(g.re * static_cast<double>(re) - g.im * static_cast<double>(im));
        to_im = static_cast<float>(g.re * static_cast<double>(im) + g.im * static_cast<double>(re));
        // A field's variance is the sum of |h(k)|^2, in the mean over time half of these squares.
        to.variance_m2 += 0.5 * (static_cast<double>(to_re) * static_cast<double>(to_re) +
                                 static_cast<double>(to_im) * static_cast<double>(to_im));
      };
      turn(from.cos_re[a], from.cos_im[a], to.cos_re[b], to.cos_im[b]);
      turn(from.sin_re[a], from.sin_im[a], to.sin_re[b], to.sin_im[b]);
      to.turns_per_s[b] = from.turns_per_s[a];
    }
  }
  return to;
}

void scale_waves(float factor, PatchWaves& waves) {
  for (auto* table : {&waves.cos_re, &waves.sin_re, &waves.cos_im, &waves.sin_im})
    for (float& x : *table) x *= factor;
}

// ---- Thresholds

// The distribution of a field: normal, of this deviation about each of these means alike.
struct Births {
  double deviation = 1.0;
  std::vector<double> mean = {0.0};
};

// B over a minute, on a coarse grid, that thresholds are tried on.
class Trials {
 public:
  static constexpr int kGrid = 64, kSteps = 192, kBirthsEvery = 4;

  Trials(const Whitecaps& whitecaps, std::span<const PatchWaves> coarse, Workers& workers) {
    const FftPlan plan = make_fft_plan(kGrid);
    std::array<const PatchWaves*, kMostFoamPatches> waves{};
    for (std::size_t p = 0; p < coarse.size(); ++p) waves[p] = &coarse[p];
    for (std::vector<float>& fields : fields_) fields.resize(kSteps * kPoints);
    std::vector<float> planes;
    for (int n = 0; n < kSteps; ++n)
      break_waves(whitecaps, plan, {waves.data(), coarse.size()}, n, {field(0, n), field(1, n)},
                  planes, workers);
  }

  // The threshold with which the mean of patch p's foam is its cover.
  float find_threshold(std::size_t p, const FoamPatch& patch) const {
    return find_threshold(fields_[p], {}, patch);
  }

  // That of B', from the first patch's B; C's phases are those of as many places as the grid has.
  float find_threshold_on_trains(const Whitecaps& whitecaps) const {
    constexpr std::uint64_t kSeed = 1;
    const TrainSquare& trains = *whitecaps.trains;
    const TrainFoam& foam = whitecaps.on_trains;
    std::vector<std::uint16_t> phase;
    for (std::size_t k = 0; k < trains.period_s.size() * kPoints; ++k)
      phase.push_back(static_cast<std::uint16_t>(random_bits(kSeed, k)));
    std::vector<float> on_trains = fields_[0], c(kPoints);
    for (int step = 0; step < kSteps; ++step) {
      check_stop();
      add_crests(trains, phase, time_of_step(whitecaps, step), c);
      const auto b = std::span(on_trains).subspan(static_cast<std::size_t>(step) * kPoints);
      for (std::size_t i = 0; i < kPoints; ++i) b[i] = foam.scale * (b[i] + foam.gain * c[i]);
    }
    Births births{static_cast<double>(foam.scale), {}};
    for (std::size_t i = 0; i < kPoints; i += kMeansEvery)
      births.mean.push_back(static_cast<double>(foam.scale * foam.gain * c[i]));
    return find_threshold(on_trains, births, whitecaps.patches.front());
  }

 private:
  std::span<float> field(std::size_t p, int step) {
    return std::span(fields_[p]).subspan(static_cast<std::size_t>(step) * kPoints, kPoints);
  }

  static float find_threshold(std::span<const float> fields, const Births& births,
                              const FoamPatch& patch) {
    float low = -1.0f, high = 5.0f;
    for (int n = 0; n < 9; ++n) {
      const float middle = 0.5f * (low + high);
      (mean_foam(fields, births, middle, patch) > patch.cover ? low : high) = middle;
    }
    return 0.5f * (low + high);
  }

  static constexpr std::size_t kPoints = static_cast<std::size_t>(kGrid) * kGrid;
  static constexpr std::size_t kMeansEvery = 16;

  // The mean of a patch's foam, with a field for each step. A minute knows well how much foam
  // becomes of what is born, but not how often the rare waves come that break: that is known of the
  // normal distribution.
  static double mean_foam(std::span<const float> fields, const Births& distribution,
                          float threshold, const FoamPatch& patch) {
    const int life = steps_of_life(patch);
    std::vector<std::uint8_t> codes(kPoints, 0), born(kPoints, 0);
    double foam = 0.0, births = 0.0;
    for (int n = 0; n < kSteps; ++n) {
      check_stop();
      const auto field = fields.subspan(static_cast<std::size_t>(n) * kPoints, kPoints);
      age_foam(field, threshold, patch.decay, codes);
      if (n >= life) foam += mean_of(codes) / (kSteps - life);  // earlier ones know their beginning
      if (n % kBirthsEvery != 0) continue;
      age_foam(field, threshold, kFullCode, born);
      births += mean_of(born) * kBirthsEvery / kSteps;
    }
    return births > 0.0 ? foam / births * mean_births(distribution, threshold) : 0.0;
  }

  static double mean_of(std::span<const std::uint8_t> codes) {
    std::uint32_t squares = 0;  // foam_of_code() of each, times 255^2
    for (const std::uint32_t code : codes) squares += code * code;
    return squares / (static_cast<double>(codes.size()) * kFullCode * kFullCode);
  }

  // The mean of foam that is born.
  static double mean_births(const Births& births, double threshold) {
    constexpr int kParts = 64;
    constexpr double kWidth = 5.0 / kParts;
    double sum = 0.0;
    for (const double mean : births.mean)
      for (int n = 0; n < kParts; ++n) {
        const double excess = (n + 0.5) * kWidth;
        const double b = (threshold + excess - mean) / births.deviation;
        const double born = std::min(excess / kFullExcess, 1.0);
        sum += born * born * exp(-0.5 * b * b) * kWidth;
      }
    return sum /
           (std::sqrt(2.0 * kPi) * births.deviation * static_cast<double>(births.mean.size()));
  }

  std::array<std::vector<float>, kMostFoamPatches> fields_;
};

// The steps of a sea that repeats are a whole number in its loop.
void set_steps(double loop_s, Whitecaps& whitecaps) {
  whitecaps.step_s = kStep_s;
  if (loop_s == 0.0) return;
  whitecaps.steps_in_loop = std::max(1, static_cast<int>(std::nearbyint(loop_s / kStep_s)));
  whitecaps.step_s = loop_s / whitecaps.steps_in_loop;
}

// Which patches have foam. Those whose waves break more have more of it, and lie over each other
// without regard: what the longer ones leave free times what the shorter ones do is what the wind
// leaves free.
void add_patches(const Sea& sea, const WaveSystem& wind, double cover, Whitecaps& whitecaps,
                 std::vector<PatchWaves>& coarse) {
  const std::vector<PatchWaves>& patches = sea.state().patches;
  const std::size_t most = std::clamp<std::size_t>(patches.size() - 1, 1, kMostFoamPatches);
  const double longest_decay = kFullCode * whitecaps.step_s / kLongLife_s;
  double variance = 0.0;
  for (std::size_t p = 0; p < most; ++p) {
    FoamPatch patch;
    patch.length_m = patches[p].length_m;
    patch.breaking = breaking_waves(patches[p], wind, kFoamMapSize);
    if (patch.breaking.variance_m2 == 0.0) continue;
    variance += patch.breaking.variance_m2;
    const double decay = p == 0 ? longest_decay : longest_decay * (kLongLife_s / kShortLife_s);
    patch.decay = std::clamp(static_cast<int>(std::nearbyint(decay)), 1, kFullCode);
    coarse.push_back(breaking_waves(patches[p], wind, Trials::kGrid));
    whitecaps.patches.push_back(std::move(patch));
  }
  for (FoamPatch& patch : whitecaps.patches)
    patch.cover = 1.0 - pow(1.0 - cover, patch.breaking.variance_m2 / variance);
}

// How the square of trains lies in the longest patch.
TrainFoam lay_square(const TrainSquare& trains, double length_m) {
  TrainFoam foam;
  foam.gain = static_cast<float>(kOnTrains);
  foam.scale = static_cast<float>(1.0 / std::sqrt(1.0 + kOnTrains * kOnTrains));
  const auto lay = [&](double from_m, std::vector<std::uint8_t>& texel, std::vector<float>& past) {
    for (int i = 0; i < kFoamMapSize; ++i) {
      const double periods = (from_m + i * trains.size_m / kFoamMapSize) / length_m;
      const double texels = (periods - std::floor(periods)) * kFoamMapSize;
      texel.push_back(static_cast<std::uint8_t>(std::min(texels, kFoamMapSize - 1.0)));
      past.push_back(static_cast<float>(texels - texel.back()));
    }
  };
  lay(trains.min_world.x, foam.column, foam.past_column);
  lay(trains.min_world.y, foam.row, foam.past_row);
  return foam;
}

}  // namespace

double whitecap_cover(double wind_speed_mps) {
  constexpr double kOnset_mps = 3.7, kWhole_mps = 5.0, kHigh_mps = 20.0, kMost = 0.3;
  const double at = std::min(wind_speed_mps, kHigh_mps);
  const double law = at > 0.0 ? 3.84e-6 * pow(at, 3.41) : 0.0;
  const double part = smoothstep(kOnset_mps, kWhole_mps, at);
  if (wind_speed_mps <= kHigh_mps) return part * law;
  // The law's rise goes on, and fades as cover nears its most.
  const double rise = 3.41 * law / kHigh_mps, rest = kMost - law;
  return kMost - rest * exp(-(wind_speed_mps - kHigh_mps) * rise / rest);
}

Whitecaps make_whitecaps(const Sea& sea, Workers& workers,
                         std::shared_ptr<const TrainSquare> trains) {
  const ScopedFloatEnvironment ieee;
  Whitecaps whitecaps;
  const SeaDescription& description = sea.description();
  whitecaps.sea = description;
  set_steps(description.loop_s, whitecaps);
  const double cover =
      std::min(description.whitecaps * whitecap_cover(description.wind_speed_mps), 0.95);
  const std::vector<WaveSystem> systems = wave_systems(description);  // the wind's own first
  if (cover <= 0.0 || !description.spectrum || systems.empty()) return whitecaps;
  whitecaps.plan = make_fft_plan(kFoamMapSize);
  std::vector<PatchWaves> coarse;
  add_patches(sea, systems.front(), cover, whitecaps, coarse);
  if (coarse.empty()) return whitecaps;
  // 0.7 for each standard deviation of the height, Hs / 4.
  whitecaps.crest_per_m = static_cast<float>(2.8 / sea.significant_height_m());
  for (PatchWaves& waves : coarse)
    scale_waves(static_cast<float>(1.0 / std::sqrt(waves.variance_m2)), waves);
  if (trains) whitecaps.on_trains = lay_square(*trains, whitecaps.patches.front().length_m);
  whitecaps.trains = std::move(trains);
  const Trials trials(whitecaps, coarse, workers);
  // Waves made lower break less; waves made higher than any wind's are no whiter for it.
  const double height = std::min(description.amplitude_scale, 1.0);
  const std::size_t patches = whitecaps.patches.size();
  workers.for_each(patches + (whitecaps.trains ? 1 : 0), [&](std::size_t p, int) {
    if (p == patches) {
      whitecaps.on_trains.threshold = trials.find_threshold_on_trains(whitecaps);
      return;
    }
    FoamPatch& patch = whitecaps.patches[p];
    patch.threshold = trials.find_threshold(p, patch);
    scale_waves(static_cast<float>(height / std::sqrt(patch.breaking.variance_m2)), patch.breaking);
  });
  whitecaps.on_trains.gain *= static_cast<float>(height);
  return whitecaps;
}

}  // namespace swell::ocean
