#include "ocean/inland/river_bed.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "math/smoothstep.h"
#include "math/stop.h"

namespace swell::ocean {
namespace {

constexpr double kBankSlope = 0.12;   // of the shore right at the water
constexpr double kEdgeOfDepth = 0.4;  // depth at the edge, of that in the middle, at most
constexpr double kWidening = 0.5;     // of beds, in cells
constexpr double kSteepest = 0.6;     // of what is cut into hills

void check_ends(const RiverNetwork& network, const terrain::HeightGrid& land) {
  for (std::size_t r = 0; r < network.courses().size(); ++r) {
    const auto& nodes = network.courses()[r].nodes;
    const auto key = [&] { return fmt::format("{}[{}].path_m", kRiverKey, r); };
    for (const CourseNode& node : nodes)
      if (!land.grid.holds(node.p))
        throw RiverError(key(), fmt::format("[{:.0f}, {:.0f}]", node.p.x, node.p.y),
                         "points on the terrain's square");
    const CourseNode& mouth = nodes.back();
    const double ground_m = terrain::height_at(land, mouth.p);
    if (mouth.sea_share > 0.0 && ground_m > 0.0)
      throw RiverError(key(), fmt::format("a last point on land, {:.1f} m above the sea", ground_m),
                       "one in the sea, or `into`");
  }
}

}  // namespace

void dig_beds(const RiverNetwork& network, terrain::HeightGrid& land) {
  check_ends(network, land);
  const terrain::Grid& grid = land.grid;
  // A river narrower than a cell has samples beside it, which have to lie below it.
  const double widening_m = kWidening * grid.spacing_m;
  const glm::dvec2 from = (network.low() - grid.min_world) / grid.spacing_m;
  const glm::dvec2 to = (network.high() - grid.min_world) / grid.spacing_m;
  const auto bound = [](double at, int samples) {
    return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(samples)));
  };
  for (int j = bound(from.y, grid.samples_y); j < bound(to.y + 1.0, grid.samples_y); ++j) {
    check_stop();
    for (int i = bound(from.x, grid.samples_x); i < bound(to.x + 1.0, grid.samples_x); ++i) {
      const std::optional<WaterPlace> water = network.water_near(grid.point(i, j));
      if (!water) continue;
      float& height_m = land.height_m[grid.index(i, j)];
      const auto ground_m = static_cast<double>(height_m);
      const double beyond_m = water->outside_m - widening_m;
      if (water->width_m == 0.0 && !std::isfinite(water->bed_m) && beyond_m <= 0.0)
        continue;  // a lake that is not dug
      // One slope on both sides of the water's edge, so that the edge is as smooth as the slope.
      const double edge_slope = std::min(kBankSlope, kEdgeOfDepth * water->depth_m / widening_m);
      if (beyond_m <= 0.0) {
        const double edge_m = water->level_m + edge_slope * beyond_m;
        height_m = static_cast<float>(std::min({ground_m, water->bed_m, edge_m}));
        continue;
      }
      const double rim_m = water->level_m + edge_slope * std::min(beyond_m, grid.spacing_m) +
                           kBankSlope * std::max(0.0, beyond_m - grid.spacing_m);
      const double rise_m = std::max(0.0, ground_m - rim_m);
      const double bank_m =
          std::min(network.margin_m() - widening_m,
                   std::max({3.0 * grid.spacing_m, 0.5 * water->width_m, rise_m / kSteepest}));
      // Land that lies lower than the river becomes its bank, and holds as far as cells of the
      // water are drawn; where the sea begins there is none.
      const bool is_low = ground_m < rim_m;
      const double held_m = is_low ? 2.0 * grid.spacing_m : 0.0;
      const double passed = smoothstep(held_m, held_m + bank_m, beyond_m);
      double bank = rim_m + (ground_m - rim_m) * passed;
      if (is_low) bank = ground_m + (bank - ground_m) * (1.0 - water->sea_share);
      height_m = static_cast<float>(bank);
    }
  }
  const auto [lowest, highest] = std::ranges::minmax_element(land.height_m);
  land.lowest_m = *lowest;
  land.highest_m = *highest;
}

}  // namespace swell::ocean
