// One step of the whitecaps on a coast's wave trains.
#include <algorithm>
#include <array>
#include <cmath>

#include "math/elementary.h"
#include "ocean/open_sea/whitecap_steps.h"

namespace swell::ocean {
namespace {

constexpr std::size_t kSide = kFoamMapSize;

// Bilinear between the texels of B around a row of the square.
void sample_breaking(const TrainFoam& foam, std::size_t j, std::span<const float> breaking,
                     std::span<float> sampled) {
  const float* const low = breaking.data() + kSide * foam.row[j];
  const float* const high = breaking.data() + kSide * ((foam.row[j] + 1u) % kSide);
  const float past = foam.past_row[j];
  std::array<float, kSide + 1> b;  // between the two rows
  for (std::size_t i = 0; i < kSide; ++i) b[i] = low[i] + past * (high[i] - low[i]);
  b[kSide] = b[0];
  for (std::size_t i = 0; i < kSide; ++i) {
    const std::size_t texel = foam.column[i];
    sampled[i] = b[texel] + foam.past_column[i] * (b[texel + 1] - b[texel]);
  }
}

// sqrt(2) cos(2 pi (k + 1/2) / 256 - ahead): a train's crest, by the high byte of its phase.
constexpr std::size_t kCrestTable = 256;
std::array<float, kCrestTable> make_crest_table() {
  std::array<float, kCrestTable> table;
  for (std::size_t k = 0; k < kCrestTable; ++k) {
    const double turns = (static_cast<double>(k) + 0.5) / kCrestTable;
    table[k] = static_cast<float>(std::sqrt(2.0) * cos(2.0 * kPi * turns - kBirthsAhead_rad));
  }
  return table;
}

// The part of a cycle that has passed, in 2^-16.
std::uint32_t cycles_fx16(double cycles) {
  return static_cast<std::uint32_t>((cycles - std::floor(cycles)) * 65536.0);
}

void add_crests(float weight, std::uint32_t now_fx16, std::span<const std::uint16_t> phase,
                const std::array<float, kCrestTable>& crest, std::span<float> c) {
  for (std::size_t i = 0; i < c.size(); ++i)
    c[i] += weight * crest[((phase[i] - now_fx16) >> 8) % kCrestTable];
}

}  // namespace

void add_crests(const TrainSquare& trains, std::span<const std::uint16_t> phase, double t_s,
                std::span<float> c) {
  const std::array<float, kCrestTable> crest = make_crest_table();
  std::ranges::fill(c, 0.0f);
  for (std::size_t n = 0; n < trains.period_s.size(); ++n)
    add_crests(trains.weight[n], cycles_fx16(t_s / trains.period_s[n]),
               phase.subspan(n * c.size(), c.size()), crest, c);
}

void age_train_foam(const Whitecaps& whitecaps, double step, std::span<const float> breaking,
                    std::span<std::uint8_t> codes, Workers& workers) {
  const TrainSquare& trains = *whitecaps.trains;
  const TrainFoam& foam = whitecaps.on_trains;
  const std::array<float, kCrestTable> crest = make_crest_table();
  const double t_s = time_of_step(whitecaps, step);
  workers.for_each(kSide, [&](std::size_t j, int) {
    const float* const part = trains.part.data() + j * kSide;
    if (std::all_of(part, part + kSide, [](float x) { return x == 0.0f; })) return;
    std::array<float, kSide> b, c{};
    sample_breaking(foam, j, breaking, b);
    for (std::size_t n = 0; n < trains.period_s.size(); ++n)
      add_crests(trains.weight[n], cycles_fx16(t_s / trains.period_s[n]),
                 std::span(trains.phase).subspan((n * kSide + j) * kSide, kSide), crest, c);
    for (std::size_t i = 0; i < kSide; ++i) b[i] = foam.scale * (b[i] + foam.gain * c[i]);
    age_foam(b, foam.threshold, whitecaps.patches.front().decay, codes.subspan(j * kSide, kSide));
  });
}

void smooth_train_foam(std::span<const std::uint8_t> codes, std::span<std::uint16_t> foam,
                       Workers& workers) {
  workers.for_each(kSide, [&](std::size_t j, int) {
    const std::size_t below = j > 0 ? j - 1 : 0, above = std::min(j + 1, kSide - 1);
    std::array<std::uint32_t, kSide + 2> sums;  // down the columns
    for (std::size_t i = 0; i < kSide; ++i) {
      const auto squared = [&](std::size_t row) {
        const std::uint32_t code = codes[row * kSide + i];
        return code * code;
      };
      sums[i + 1] = squared(below) + 2 * squared(j) + squared(above);
    }
    sums.front() = sums[1];
    sums.back() = sums[kSide];
    for (std::size_t i = 0; i < kSide; ++i)
      foam[j * kSide + i] =
          static_cast<std::uint16_t>((sums[i] + 2 * sums[i + 1] + sums[i + 2] + 8) / 16);
  });
}

}  // namespace swell::ocean
