// The keys of [[trees]].
#include "scene/file/parameter_row.h"
#include "scene/file/parameters.h"

namespace swell::scene {
namespace {

using terrain::TreeStand;

struct SpeciesName {
  static constexpr auto words = terrain::kTreeSpeciesNames;
  auto& operator()(auto& stand) const { return stand.species; }
};

struct PlaceName {
  static constexpr auto words = terrain::kTreePlaceNames;
  auto& operator()(auto& stand) const { return stand.place; }
};

#define SWELL_FIELD(PATH) \
  [](auto& stand) -> auto& { return stand.PATH; }

}  // namespace

std::vector<Parameter<TreeStand>> tree_parameters() {
  using TreeRow = Row<TreeStand>;
  return {
      TreeRow::choice("species", SpeciesName{},
                      "what grows: conifers, broad-leaved trees, reed, or the first two mixed"),
      TreeRow::choice("place", PlaceName{}, "all over the land, or along rivers"),
      TreeRow::number("density_per_m2", {0, 10, "1/m^2"}, SWELL_FIELD(density_per_m2),
                      "trees a square metre where they stand densest; two are at least "
                      "0.7 / sqrt(density_per_m2) metres apart. All stands together have at most "
                      "a million trees, at 2e7 places"),
      TreeRow::plain<std::string>(
          "density_map", ParameterKind::kPath, SWELL_FIELD(density_map),
          "picture over the terrain's square, north on top, relative to the scene file: white "
          "as dense as can be, black none; empty: everywhere alike"),
      TreeRow::number("clumping", {0, 1}, SWELL_FIELD(clumping),
                      "how much of the land is left as clearings"),
      TreeRow::number("bank_width_m", {0.5, 500, "m"}, SWELL_FIELD(bank_width_m),
                      "how far from the water's line trees of banks stand"),
      TreeRow::plain<bool>("lake_shores", ParameterKind::kBoolean, SWELL_FIELD(lake_shores),
                           "whether trees of banks stand along lakes and the sea as well"),
      TreeRow::vector("height_m", {0.3, 60, "m"}, SWELL_FIELD(height_m),
                      "height of the smallest and of the tallest"),
      TreeRow::vector("ground_m", {0, 9000, "m"}, SWELL_FIELD(ground_m),
                      "lowest and highest ground that they stand on"),
      TreeRow::number("steepest", {0, 10}, SWELL_FIELD(steepest),
                      "steepest slope of the ground that they stand on, height per distance"),
      TreeRow::integer("seed", ParameterKind::kInteger, {0, 9007199254740992.0}, SWELL_FIELD(seed),
                       "another number, other trees"),
  };
}

#undef SWELL_FIELD

}  // namespace swell::scene
