#include "render/materials/tree.h"

#include <algorithm>
#include <cmath>

#include "render/view/render_view.h"
#include "render/view/trees_drawn.h"
#include "render/world/forest.h"
#include "render/world/world_state.h"

namespace swell::render {
namespace {

constexpr double kFoliagePeriod_m = 3.0;
constexpr float kFoliageSlope = 0.6f;  // standard deviation

}  // namespace

void fill(const MaterialInputs& in, const RenderView& view, Tree& tree) {
  tree.primitives = {};
  if (!in.world.forest || !in.trees) return;
  const TreeDraws& draws = in.trees->drawn_in(view.kind);
  tree.primitives = draws.primitives;
  tree.drawn = draws.trees;
  for (std::size_t i = 0; i < tree.species.size(); ++i) {
    const TreeLook look = tree_look(static_cast<terrain::TreeSpecies>(i));
    tree.species[i] = {look.bark, look.translucency, look.rise, look.taper};
  }
  const float gain =
      kFoliageSlope / std::sqrt(std::max(in.world.textures.bump->lost_variance.back(), 1e-12f));
  tree.foliage = make_layer(*in.world.textures.bump, kFoliagePeriod_m, gain, glm::dvec2(0.0), {});
}

}  // namespace swell::render
