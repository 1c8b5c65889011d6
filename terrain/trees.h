// Where trees and reeds stand on the land, and how large they are.
//
// A stand has points of a Poisson tile all over the terrain's square, of which those are kept whose
// rank is below the density at their place: fewer trees are a part of more trees, and which ones
// there are depends on nothing but the description, the land and the water's lines.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "math/enum_table.h"
#include "math/parallel.h"
#include "terrain/height_grid.h"

namespace swell::terrain {

enum class TreeSpecies : std::uint8_t {
  kConifer,
  kBroadleaf,
  kReed,
  kMixed,  // of a stand: conifers and broad-leaved trees
};
inline constexpr auto kTreeSpeciesNames = enum_words<TreeSpecies>({
    {TreeSpecies::kConifer, "conifer"},
    {TreeSpecies::kBroadleaf, "broadleaf"},
    {TreeSpecies::kReed, "reed"},
    {TreeSpecies::kMixed, "mixed"},
});
inline constexpr auto kTreeSpecies = static_cast<std::size_t>(TreeSpecies::kMixed);  // of one tree
static_assert(kTreeSpecies + 1 == kEnumerators<TreeSpecies>);

enum class TreePlace : std::uint8_t {
  kLand,   // wherever the ground allows
  kBanks,  // along rivers
};
inline constexpr auto kTreePlaceNames =
    enum_words<TreePlace>({{TreePlace::kLand, "land"}, {TreePlace::kBanks, "banks"}});

// Trees of one kind, over the terrain's square.
struct TreeStand {
  TreeSpecies species = TreeSpecies::kMixed;
  TreePlace place = TreePlace::kLand;
  double density_per_m2 = 0.01;            // where they stand densest
  std::filesystem::path density_map = {};  // a picture over the square; empty: everywhere alike
  double clumping = 0.5;                   // [0, 1]: how much of the land is left as clearings
  double bank_width_m = 12.0;              // of banks, from the water's line
  bool lake_shores = false;                // banks: along lakes and the sea as well
  glm::dvec2 height_m{8.0, 15.0};          // of the smallest and the tallest
  glm::dvec2 ground_m{2.0, 1500.0};        // above the sea: the lowest and highest ground
  double steepest = 0.7;                   // slope of the ground
  std::uint64_t seed = 1;                  // another number, other trees

  bool operator==(const TreeStand&) const = default;
};

// Distances [m] from lines of water, over 0 on land, below on water, as grids of `height_m`; null:
// there is no such water.
struct WaterLines {
  const HeightGrid* rivers = nullptr;
  const HeightGrid* still = nullptr;  // lakes and the sea
};

// The distance from ground at or below the sea's level, at most kWaterLineSamples a side; 0 on
// water. Right to a sample's spacing.
inline constexpr int kWaterLineSamples = 1025;
HeightGrid distance_from_sea(const HeightGrid& terrain);

struct Tree {
  glm::vec3 foot{0.0f};  // from Trees::origin [m]
  float height_m = 10.0f, radius_m = 3.0f;
  float rank = 0.0f;  // [0, 1): a part of all trees evenly thinned out has ranks below a bound
  TreeSpecies species = TreeSpecies::kConifer;
  std::uint32_t random = 0;  // 24 bits: of its looks
  static constexpr bool kPlainBytes = true;
};

// A square piece of land with its trees.
struct TreeCell {
  std::uint32_t first = 0, count = 0;  // in order of their ranks
  glm::vec3 middle{0.0f};              // of a ball around them, from Trees::origin
  float radius_m = 0.0f;
  float tallest_m = 0.0f;
  static constexpr bool kPlainBytes = true;
};

struct Trees {
  glm::dvec3 origin{0.0};
  std::vector<Tree> trees;  // cell after cell
  std::vector<TreeCell> cells;

  auto fields() { return std::tie(origin, trees, cells); }
  bool empty() const { return trees.empty(); }
};

// These bound all stands together: trees, and places looked at.
inline constexpr std::size_t kMostTrees = 1'000'000;
inline constexpr double kMostTreePlaces = 2e7;

// Plants the trees of all stands: the same bits with any workers; 0.1 us a place. Throws
// TerrainError for too many trees or places, texture::FileError for a map that cannot be read.
Trees plant_trees(std::span<const TreeStand> stands, const HeightGrid& terrain,
                  const WaterLines& lines, Workers& workers);

}  // namespace swell::terrain
