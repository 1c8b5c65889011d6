#include "render/materials/canopy.h"

#include "math/elementary.h"
#include "render/frame/parts.h"
#include "render/world/forest.h"
#include "render/world/world_state.h"

namespace swell::render {
namespace {

// Between which heights of trees in the picture the land takes their colour.
constexpr double kDrawn_px = 12.0, kColour_px = 4.0;

double log2_of(double x) { return log(x) / log(2.0); }

}  // namespace

Canopy make_canopy(const MaterialInputs& in, const terrain::Grid& square, glm::dvec2 eye) {
  Canopy canopy;
  if (!in.world.forest || in.without.has(Part::kTrees)) return canopy;
  const Forest& forest = *in.world.forest;
  canopy.cover = make_square_map(forest.cover, square.size_m(), eye - square.min_world);
  canopy.crowns = forest.canopy_albedo;
  canopy.near_log2_m = static_cast<float>(log2_of(forest.mean_height_m / kDrawn_px));
  canopy.per_log2 = static_cast<float>(1.0 / log2_of(kDrawn_px / kColour_px));
  return canopy;
}

}  // namespace swell::render
