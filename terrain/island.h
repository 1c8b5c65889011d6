// Islands from noise: hills, a gentle beach, a shallow lagoon, a reef, the deep floor.
#pragma once

#include <span>
#include <vector>

#include "terrain/terrain.h"
#include "texture/perlin.h"

namespace swell::terrain {

inline constexpr int kIslandSamples = 1025;

// An island of island_radius_m, island_height_m and floor_depth_m (the first and third over 0).
class Island {
 public:
  Island(const TerrainDescription& description, std::uint64_t seed);

  // Half the side of a square around it, at whose border and beyond there is only floor.
  double half_size_m() const { return profile_.half_size; }
  // Heights at places x, y from its middle, all in metres; exactly -floor_depth_m where there is
  // only floor.
  std::vector<float> row_m(std::span<const double> x_m, double y_m) const;

 private:
  // Its measures, all in metres. Widths are counted from the shore line.
  struct Profile {
    double radius;
    double beach_slope;
    double beach_width;  // inland, until the hills have begun
    double hill_height;
    double lagoon_depth;  // of its sandy floor
    double lagoon_width;  // to the reef
    double reef_rise;     // of the reef above the lagoon's floor
    double drop_width;    // of the slope from the reef down to the floor
    double floor_depth;
    double half_size;
  };

  static Profile make_profile(const TerrainDescription& description);
  // Here and below places are in radii.
  std::vector<double> shore_distances(std::span<const double> x, double y) const;
  double hills(glm::dvec2 q, double inland) const;
  double land_height(glm::dvec2 q, double inland) const;
  double sea_floor_height(glm::dvec2 q, double offshore) const;

  Profile profile_;
  texture::PerlinNoise noise_;
};

// The side of an island's square in metres.
double island_size_m(const TerrainDescription& description);

// The terrain's heights from island_radius_m, island_height_m, floor_depth_m and seed. The border
// is exactly -floor_depth_m. lowest_m and highest_m are not set.
HeightGrid build_island(const TerrainDescription& description, Workers& workers);

inline constexpr int kArchipelagoSamples = 2049;

// Builds the heights of `islands` islands likewise, on a square of archipelago_size_m: the largest
// is as described, the others down to a fifth of it. They keep a lagoon's width apart; those that
// find no room are left out.
HeightGrid build_archipelago(const TerrainDescription& description, Workers& workers);

}  // namespace swell::terrain
