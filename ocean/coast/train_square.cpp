#include "ocean/coast/train_square.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"
#include "math/smoothstep.h"
#include "ocean/coast/coast_map.h"

namespace swell::ocean {
namespace {

// Where whitecaps are whole: a depth as part of the waves' height, and the least one. In a gale it
// is a quarter of that.
constexpr double kWholeDepth = 1.0 / 8.0, kLeastDepth_m = 0.1, kLessInGale = 0.75;
// How much more of them waves that break all the time leave in a gale, and the depth, as part of
// the waves' height out at sea, where they begin to.
constexpr double kMoreInSurf = 3.0, kSurfDepth = 0.4;
// From Beaufort 6 to 8.
constexpr double kFirstGale_mps = 11.0, kGale_mps = 20.0;

// What there is of whitecaps in water of this depth; in surf more than 1. `breaking`: the part of
// the crests that break.
struct ShallowPart {
  double wet, more;
};
struct Breakers {
  double height_m, gale, surf_width;
};
ShallowPart shallow_part(double depth_m, double breaking, const Breakers& waves) {
  const double whole_m = kWholeDepth * waves.height_m;
  const double in_band_m = depth_m / waves.surf_width;
  const double surf =
      breaking * (1.0 - smoothstep(whole_m, kSurfDepth * waves.height_m, in_band_m));
  const double begin_m = std::max(whole_m * (1.0 - kLessInGale * waves.gale), kLeastDepth_m);
  return {smoothstep(0.0, begin_m, depth_m), 1.0 + kMoreInSurf * waves.gale * surf};
}

// Mean amplitude times wave number in deep water, by train, as weights whose squares add up to 1.
std::vector<float> weights_of(const TrainSea& trains, std::span<const double> amplitude_m) {
  std::vector<double> steepness;
  double squares = 0.0;
  for (std::size_t n = 0; n < trains.period_s.size(); ++n) {
    const double omega = 2.0 * kPi / trains.period_s[n];
    steepness.push_back(amplitude_m[n] * omega * omega / trains.gravity_mps2[n]);
    squares += steepness.back() * steepness.back();
  }
  std::vector<float> weight;
  if (squares > 0.0)
    for (const double s : steepness) weight.push_back(static_cast<float>(s / std::sqrt(squares)));
  return weight;
}

}  // namespace

std::shared_ptr<const TrainSquare> make_train_square(const CoastSea& coast, double wave_height_m,
                                                     double wind_mps, Workers& workers) {
  constexpr std::size_t kSide = kFoamMapSize, kPoints = kSide * kSide;
  const TrainSea& sea = coast.trains;
  const auto trains = static_cast<std::size_t>(sea.trains);
  TrainSquare square;
  square.min_world = sea.grid.min_world;
  square.size_m = sea.grid.size_m();
  square.period_s = sea.period_s;
  square.phase.resize(trains * kPoints);
  square.part.resize(kPoints);
  square.short_part.resize(kPoints);
  std::vector<double> row_sum_m(trains * kSide);  // of amplitudes, by train and row
  const double gale = smoothstep(kFirstGale_mps, kGale_mps, wind_mps);
  workers.for_each(kSide, [&](std::size_t j, int) {
    for (std::size_t i = 0; i < kSide; ++i) {
      const glm::dvec2 p = square.min_world + glm::dvec2(i, j) * (square.size_m / kFoamMapSize);
      const std::size_t at = j * kSide + i;
      const PlaceInTrains place = find_place(sea, p);
      float share = 0.0f;
      sample_coast_share(coast, {&p, 1}, {&share, 1});
      double sum_m = 0.0;
      for (std::size_t n = 0; n < trains; ++n) {
        const TrainAtPlace train = train_at(sea, n, place);
        const float cycles = train.cycles - std::floor(train.cycles);
        square.phase[n * kPoints + at] =
            static_cast<std::uint16_t>(static_cast<std::uint32_t>(cycles * 65536.0f));
        row_sum_m[n * kSide + j] += static_cast<double>(train.amplitude_m);
        sum_m += static_cast<double>(train.amplitude_m);
      }
      const auto depth_m = static_cast<double>(depth_at(sea, place));
      const ShallowPart shallow = shallow_part(depth_m, breaking_part(coast, sum_m, depth_m),
                                               {wave_height_m, gale, coast.surf_width});
      const auto wet = static_cast<float>(shallow.wet);
      const float ceded = 1.0f - spectrum_weight(share);
      square.part[at] = ceded * wet * static_cast<float>(shallow.more);
      square.short_part[at] = 1.0f - ceded * (1.0f - wet);
    }
  });
  std::vector<double> sum_m(trains);
  for (std::size_t k = 0; k < row_sum_m.size(); ++k) sum_m[k / kSide] += row_sum_m[k];
  square.weight = weights_of(sea, sum_m);
  if (square.weight.empty()) return nullptr;
  return std::make_shared<const TrainSquare>(std::move(square));
}

Whitecaps make_whitecaps(const Sea& sea, const CoastSea* coast, Workers& workers) {
  const ScopedFloatEnvironment ieee;
  // Calm seas have none to make it for.
  const SeaDescription& description = sea.description();
  const bool has_foam = whitecap_cover(description.wind_speed_mps) * description.whitecaps > 0.0;
  return make_whitecaps(sea, workers,
                        coast && has_foam ? make_train_square(*coast, sea.significant_height_m(),
                                                              description.wind_speed_mps, workers)
                                          : nullptr);
}

}  // namespace swell::ocean
