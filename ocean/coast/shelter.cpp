#include "ocean/coast/shelter.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/check.h"
#include "math/elementary.h"
#include "math/smoothstep.h"
#include "math/stop.h"

namespace swell::ocean {
namespace {

// The grid's rim over which shelter ends, as a part of its side.
constexpr double kRimPart = 0.08;

double wavelength_m(double gravity_mps2, double period_s) {
  return gravity_mps2 * period_s * period_s / kTwoPi;
}

// Directions by equal energies; the parts of energy below their frequencies by the golden ratio, so
// that both are spread evenly.
void add_system(const WaveSystem& system, double wind_mps, std::vector<Beam>& beams) {
  constexpr double kGolden = 0.6180339887498949;
  const double energy = variance_below(system, HUGE_VAL) / kSystemBeams;
  if (!(energy > 0.0)) return;
  for (int n = 0; n < kSystemBeams; ++n) {
    const double turns = (n + 0.5) * kGolden;
    const double part = 0.02 + 0.96 * (turns - std::floor(turns));
    const double f_over_peak = frequency_of_energy(system, part);
    const double angle =
        angle_of_energy(spreading_of(system, f_over_peak), (n + 0.5) / kSystemBeams);
    const double period_s = 1.0 / (f_over_peak * system.peak_hz);
    beams.push_back({{glm::normalize(turned(system.travel, angle)),
                      wavelength_m(system.gravity_mps2, period_s)},
                     energy,
                     wind_mps});
  }
}

// Energy of waves that a wind raises over a fetch, of those that it raises over an endless one:
// m0 g^2 / U^4 = 1.6e-7 g F / U^2 of (0.2433 / 4)^2.
float grown_part(float fetch_m, double wind_mps) {
  if (wind_mps == 0.0) return 0.0f;
  constexpr double kGrowth = 1.6e-7 / (0.060825 * 0.060825), kGravity_mps2 = 9.81;
  const auto per_m = static_cast<float>(kGrowth * kGravity_mps2 / (wind_mps * wind_mps));
  return std::min(fetch_m * per_m, 1.0f);
}

terrain::Grid shelter_grid(const terrain::Grid& square) {
  const int cells = std::min(square.samples_x - 1, kShelterCells);
  return {square.min_world, square.size_m() / cells, cells + 1, cells + 1};
}

// 0 on the grid's border, 1 inside its rim.
double inside_rim(const terrain::Grid& grid, int i, int j) {
  const auto part = [&](int k) {
    return std::min(k, grid.samples_x - 1 - k) / (kRimPart * (grid.samples_x - 1));
  };
  return smoothstep(0.0, 1.0, part(i)) * smoothstep(0.0, 1.0, part(j));
}

// Bilinear, on the grid; outside the border's.
float sample(const terrain::Grid& grid, std::span<const float> values, glm::dvec2 p_world) {
  const double last = grid.samples_x - 1;
  const glm::dvec2 at =
      glm::clamp((p_world - grid.min_world) / grid.spacing_m, glm::dvec2(0.0), glm::dvec2(last));
  const int i = std::min(static_cast<int>(at.x), grid.samples_x - 2);
  const int j = std::min(static_cast<int>(at.y), grid.samples_y - 2);
  const auto fx = static_cast<float>(at.x - i), fy = static_cast<float>(at.y - j);
  const float* const low = values.data() + grid.index(i, j);
  const float* const high = low + grid.samples_x;
  const float a = low[0] + fx * (low[1] - low[0]), b = high[0] + fx * (high[1] - high[0]);
  return a + fy * (b - a);
}

// Gives points on land what the water around has left, so that the blend between points is right up
// to the shore: two steps of the mean over neighbours.
void go_on_over_land(const LandMask& mask, const terrain::Grid& grid, std::vector<float>& values) {
  std::vector<std::uint8_t> known(grid.size());
  for (int j = 0; j < grid.samples_y; ++j)
    for (int i = 0; i < grid.samples_x; ++i)
      known[grid.index(i, j)] = is_land(mask, grid.point(i, j)) ? 0 : 1;
  for (int step = 0; step < 2; ++step) {
    const std::vector<std::uint8_t> before = known;
    for (int j = 1; j + 1 < grid.samples_y; ++j)
      for (int i = 1; i + 1 < grid.samples_x; ++i) {
        const std::size_t k = grid.index(i, j);
        if (before[k] != 0) continue;
        float sum = 0.0f;
        int count = 0;
        for (int dj = -1; dj <= 1; ++dj)
          for (int di = -1; di <= 1; ++di) {
            const std::size_t n = grid.index(i + di, j + dj);
            if (before[n] == 0) continue;
            sum += values[n];
            ++count;
          }
        if (count == 0) continue;
        values[k] = sum / static_cast<float>(count);
        known[k] = 1;
      }
  }
}

float steepest_per_m(const terrain::Grid& grid, std::span<const float> values) {
  float x = 0.0f, y = 0.0f;
  for (int j = 0; j < grid.samples_y; ++j)
    for (int i = 0; i < grid.samples_x; ++i) {
      const float v = values[grid.index(i, j)];
      if (i > 0) x = std::max(x, std::abs(v - values[grid.index(i - 1, j)]));
      if (j > 0) y = std::max(y, std::abs(v - values[grid.index(i, j - 1)]));
    }
  return std::sqrt(x * x + y * y) / static_cast<float>(grid.spacing_m);
}

}  // namespace

std::vector<Beam> make_beams(const SeaDescription& sea) {
  std::vector<Beam> beams;
  std::vector<WaveSystem> systems = wave_systems(sea);
  // The wind's comes first, if there is one.
  const bool has_wind = sea.has_wind_waves() && sea.wind_speed_mps > 0.0;
  if (!sea.spectrum && has_wind)
    systems.insert(systems.begin(),
                   make_wind_sea(sea.wind_speed_mps, sea.wind_from_rad, sea.gravity_mps2));
  for (std::size_t n = 0; n < systems.size(); ++n)
    add_system(systems[n], n == 0 && has_wind ? sea.wind_speed_mps : 0.0, beams);
  for (const SineWave& sine : sea.sines)
    if (sine.amplitude_m != 0.0)
      beams.push_back({{{sin(sine.to_rad), cos(sine.to_rad)}, sine.wavelength_m},
                       0.5 * sine.amplitude_m * sine.amplitude_m,
                       0.0});
  double sum = 0.0;
  for (const Beam& beam : beams) sum += beam.energy;
  for (Beam& beam : beams) beam.energy /= sum;
  return beams;
}

Shelter make_shelter(const terrain::ShoreMap& shore, std::span<const Beam> beams,
                     Workers& workers) {
  SWELL_CHECK(!beams.empty(), "beams={}", beams.size());
  Shelter shelter{shelter_grid(shore.grid()), {}, 0.0f};
  const terrain::Grid& grid = shelter.grid;
  const LandMask mask = make_land_mask(shore);
  std::vector<std::vector<float>> of_beam(beams.size());
  workers.for_each(beams.size(), [&](std::size_t n, int) {
    std::vector<float> energy(grid.size()), fetch_m(grid.size());
    march_wave(mask, beams[n].wave, grid, energy, fetch_m);
    for (std::size_t k = 0; k < energy.size(); ++k)
      energy[k] = std::max(energy[k], grown_part(fetch_m[k], beams[n].wind_mps));
    of_beam[n] = std::move(energy);
  });
  shelter.kept.resize(grid.size());
  for (int j = 0; j < grid.samples_y; ++j) {
    check_stop();
    for (int i = 0; i < grid.samples_x; ++i) {
      const std::size_t k = grid.index(i, j);
      double sum = 0.0;
      for (std::size_t n = 0; n < beams.size(); ++n)
        sum += beams[n].energy * static_cast<double>(of_beam[n][k]);
      const double lost = 1.0 - std::min(std::sqrt(sum), 1.0);
      shelter.kept[k] = static_cast<float>(1.0 - lost * inside_rim(grid, i, j));
    }
  }
  go_on_over_land(mask, grid, shelter.kept);
  shelter.slope_per_m = steepest_per_m(grid, shelter.kept);
  return shelter;
}

std::vector<float> shelter_train(const LandMask& mask, const WaveTrain& train,
                                 const terrain::Grid& at) {
  const terrain::Grid grid = shelter_grid(mask.grid);
  std::vector<float> sum(grid.size()), energy(grid.size()), fetch_unused(grid.size());
  const double length_m = wavelength_m(train.gravity_mps2, train.period_s);
  constexpr std::array<double, 3> kTurns = {-kTrainSpread_rad, 0.0, kTrainSpread_rad};
  for (const double angle : kTurns) {
    march_wave(mask, {turned(train.travel, angle), length_m}, grid, energy, fetch_unused);
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += energy[k] / kTurns.size();
  }
  for (float& part : sum) part = std::min(std::sqrt(part), 1.0f);
  go_on_over_land(mask, grid, sum);
  std::vector<float> kept(at.size());
  for (int j = 0; j < at.samples_y; ++j)
    for (int i = 0; i < at.samples_x; ++i) kept[at.index(i, j)] = sample(grid, sum, at.point(i, j));
  return kept;
}

void apply_shelter(const Shelter& shelter, std::span<const glm::dvec2> p_world,
                   std::span<float> kept) {
  SWELL_CHECK(p_world.size() == kept.size(), "{} points, {} parts", p_world.size(), kept.size());
  for (std::size_t i = 0; i < p_world.size(); ++i)
    kept[i] *= sample(shelter.grid, shelter.kept, p_world[i]);
}

}  // namespace swell::ocean
