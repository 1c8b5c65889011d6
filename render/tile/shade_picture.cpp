#include "render/tile/shade_picture.h"

namespace swell::render {

void shade_picture(const PictureInputs& in, ScratchList scratch, std::vector<int>& shaded,
                   Target& target, const StageRun& run) {
  const VisibilityBuffer& visibility = in.visibility;
  const auto tiles = static_cast<std::size_t>(visibility.grid.count());
  shaded.assign(tiles, 0);
  run.for_each(tiles, [&](std::size_t index, int thread) {
    const auto tile = static_cast<int>(index);
    ShadeScratch& memory = scratch[thread]->shade;
    const std::span<const EdgeFragment> fragments = in.edges.of_tile[index];
    if (visibility.covered[tile] <= 0 && fragments.empty())
      shade_sky_tile(in.shading, tile, memory, target.rgba, target.linear);
    else
      shaded[index] = shade_tile(in.shading,
                                 {tile, visibility.depth_of(tile), visibility.primitive_of(tile),
                                  fragments, in.lookups[index]},
                                 memory, target.rgba, target.linear);
    if (in.wireframe && visibility.covered[tile] > 0) draw_wireframe(in, tile, target);
  });
}

}  // namespace swell::render
