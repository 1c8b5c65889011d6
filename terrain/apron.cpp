#include "terrain/apron.h"

#include <algorithm>

namespace swell::terrain {
namespace {

constexpr double kDeep_m = 60.0, kDeepPart = 0.15;  // of the side

}  // namespace

Apron make_apron(const HeightGrid& map) {
  const double side_m = map.grid.size_m();
  const double deep_m = std::min(kDeep_m, kDeepPart * side_m);
  return {0.5 * side_m, std::min(-deep_m, static_cast<double>(map.lowest_m))};
}

Grid square_with_apron(const HeightGrid& map) {
  const Grid& grid = map.grid;
  if (map.apron.width_m == 0.0) return grid;
  const int around = 2 * (grid.samples_x - 1) + 1;
  return {grid.min_world - map.apron.width_m, grid.spacing_m, around, around};
}

}  // namespace swell::terrain
