#include "ocean/open_sea/map_sets.h"

#include <array>
#include <cmath>

#include "math/check.h"
#include "math/elementary.h"
#include "math/random.h"

namespace swell::ocean {
namespace {

struct SetFigures {
  double longest_m;  // side of the longest layer
  double hs_m;       // of all layers
  double spreading;
  double wind_mps;
};

// Hs and length after the spectrum of a young sea of this wind; rivers and lakes are short of
// water for it.
SetFigures figures_of(MapSet set) {
  switch (set) {
    case MapSet::kRiver:
      return {17.0, 0.05, 1.0, 3.0};
    case MapSet::kLake:
      return {44.0, 0.17, 2.0, 4.5};
    case MapSet::kCoast:
      return {240.0, 0.9, 4.0, 6.5};
    case MapSet::kOcean:
      return {480.0, 2.0, 4.0, 9.0};
    case MapSet::kNone:
      break;
  }
  SWELL_CHECK(false, "set={}", static_cast<int>(set));
}

// Sides of the layers, in the longest one's: their ratios are quadratic irrationals, so that no two
// layers ever repeat themselves together exactly. And their parts of the variance, which fall as
// those of a sea's shorter waves do.
constexpr std::array<double, kMapSetLayers> kRelativeSide = {1.0,      0.618034, 0.414214, 0.267949,
                                                             0.171573, 0.118034, 0.071797};
constexpr std::array<double, kMapSetLayers> kEnergyPart = {0.76, 0.085, 0.05, 0.04,
                                                           0.03, 0.02,  0.015};

}  // namespace

double wind_of_set_mps(MapSet set) { return figures_of(set).wind_mps; }

MapRecipe recipe_of_set(MapSet set, double wind_from_rad, std::uint64_t seed) {
  MapRecipe recipe;
  recipe.to_rad = wind_from_rad + kPi;
  recipe.spreading = figures_of(set).spreading;
  recipe.seed = seed;
  return recipe;
}

std::vector<MapLayer> layers_of_set(MapSet set, std::uint64_t seed) {
  constexpr std::uint64_t kStream = 0x6d617073;  // apart from the waves' random numbers
  const SetFigures figures = figures_of(set);
  std::vector<MapLayer> layers(kMapSetLayers);
  for (std::size_t i = 0; i < kMapSetLayers; ++i) {
    const auto random = [&](std::uint64_t n) { return random_uniform(seed ^ kStream, 3 * i + n); };
    layers[i].length_m = glm::dvec2(kRelativeSide[i] * figures.longest_m);
    layers[i].hs_m = std::sqrt(kEnergyPart[i]) * figures.hs_m;
    layers[i].offset_m = layers[i].length_m * glm::dvec2(random(0), random(1));
    layers[i].offset_s = 1000.0 * random(2);
  }
  return layers;
}

}  // namespace swell::ocean
