#include "ocean/inland/lake_fill.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "ocean/inland/river_network.h"

namespace swell::ocean {
namespace {

constexpr double kRimTolerance_m = 0.5;  // what banks of a few cells may be lower

std::string lake_key(std::size_t n, const char* name) {
  return fmt::format("{}[{}].{}", kLakeKey, n, name);
}

void check_rim(const Lake& lake, std::size_t number, const terrain::HeightGrid& land) {
  const auto& p = lake.outline_m;
  for (std::size_t n = 0; n < p.size(); ++n) {
    const glm::dvec2 to = p[(n + 1) % p.size()];
    const int steps = std::max(1, static_cast<int>(glm::distance(p[n], to) / land.grid.spacing_m));
    for (int k = 0; k < steps; ++k) {
      const glm::dvec2 at = glm::mix(p[n], to, static_cast<double>(k) / steps);
      const double ground_m = terrain::height_at(land, at);
      if (ground_m < lake.level_m - kRimTolerance_m)
        throw RiverError(lake_key(number, "level_m"),
                         fmt::format("{} above its rim, which is {:.1f} m high at [{:.0f}, {:.0f}]",
                                     lake.level_m, ground_m, at.x, at.y),
                         "a level that the outline's land holds");
    }
  }
}

void fill(const Lake& lake, std::size_t number, const terrain::HeightGrid& land, LakeFill& result) {
  const terrain::Grid& grid = land.grid;
  const glm::dvec2 at = (lake.position_m - grid.min_world) / grid.spacing_m;
  if (!grid.holds(lake.position_m) || terrain::height_at(land, lake.position_m) >= lake.level_m)
    throw RiverError(lake_key(number, "position_m"),
                     fmt::format("[{}, {}], which is dry", lake.position_m.x, lake.position_m.y),
                     fmt::format("a place lower than {} m", lake.level_m));
  std::vector<glm::ivec2> open = {glm::ivec2(at)};
  const auto mark = static_cast<std::uint8_t>(number + 1);
  while (!open.empty()) {
    const glm::ivec2 ij = open.back();
    open.pop_back();
    std::uint8_t& cell = result.lake[grid.index(ij.x, ij.y)];
    if (cell == mark || !(land.height_m[grid.index(ij.x, ij.y)] < lake.level_m)) continue;
    cell = mark;
    if (ij.x == 0 || ij.y == 0 || ij.x == grid.samples_x - 1 || ij.y == grid.samples_y - 1)
      throw RiverError(lake_key(number, "level_m"),
                       fmt::format("{} above its rim: the water runs off the map", lake.level_m),
                       "a level that the land holds");
    const glm::dvec2 p = grid.point(ij.x, ij.y);
    result.low = glm::min(result.low, p - 4.0 * grid.spacing_m);
    result.high = glm::max(result.high, p + 4.0 * grid.spacing_m);
    for (const glm::ivec2& step :
         {glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1), glm::ivec2(0, -1)})
      open.push_back(ij + step);
  }
}

}  // namespace

std::optional<double> LakeFill::level_near(glm::dvec2 p) const {
  if (lake.empty() || !(p.x > low.x && p.y > low.y && p.x < high.x && p.y < high.y))
    return std::nullopt;
  const glm::ivec2 at = glm::ivec2(glm::floor((p - grid.min_world) / grid.spacing_m));
  for (int j = std::max(at.y - 1, 0); j <= std::min(at.y + 2, grid.samples_y - 1); ++j)
    for (int i = std::max(at.x - 1, 0); i <= std::min(at.x + 2, grid.samples_x - 1); ++i)
      if (const std::uint8_t number = lake[grid.index(i, j)]) return level_m[number - 1u];
  return std::nullopt;
}

bool LakeFill::touches(glm::dvec2 corner, double size_m) const {
  if (lake.empty()) return false;
  const double step_m = grid.spacing_m;
  for (double y = 0.0; y <= size_m + step_m; y += step_m)
    for (double x = 0.0; x <= size_m + step_m; x += step_m)
      if (level_near(corner + glm::dvec2(std::min(x, size_m), std::min(y, size_m)))) return true;
  return false;
}

LakeFill fill_lakes(std::span<const Lake> lakes, const terrain::HeightGrid& land) {
  LakeFill result;
  result.grid = land.grid;
  for (const Lake& lake : lakes) result.level_m.push_back(lake.level_m);
  for (std::size_t n = 0; n < lakes.size(); ++n) {
    if (!lakes[n].outline_m.empty()) {
      check_rim(lakes[n], n, land);
      continue;
    }
    if (result.lake.empty()) result.lake.assign(land.grid.size(), 0);
    fill(lakes[n], n, land, result);
  }
  return result;
}

}  // namespace swell::ocean
