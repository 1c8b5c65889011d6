#include "render/tile/shade_picture.h"

namespace swell::render {
namespace {

void label_tile(const PictureInputs& in, int tile, const ShadedLabels& shaded, Labels& labels) {
  LabelTile pixels{.number = tile};
  if (in.visibility.covered[tile] > 0)
    pixels = {tile, in.visibility.depth_of(tile), in.visibility.primitive_of(tile),
              in.labels->tables.from_shading ? &shaded : nullptr};
  fill_label_tile(*in.labels, pixels, labels);
}

}  // namespace

void shade_picture(const PictureInputs& in, ScratchList scratch, std::vector<int>& shaded,
                   Target& target, const StageRun& run) {
  const VisibilityBuffer& visibility = in.visibility;
  const auto tiles = static_cast<std::size_t>(visibility.grid.count());
  shaded.assign(tiles, 0);
  run.for_each(tiles, [&](std::size_t index, int thread) {
    const auto tile = static_cast<int>(index);
    ShadeScratch& memory = scratch[thread]->shade;
    ShadedLabels& shaded_labels = scratch[thread]->labels;
    find_edges(in.meshes.objects, in.window, visibility, tile, scratch[thread]->edges, in.edges);
    const bool labels_shading = in.labels && in.labels->tables.from_shading;
    const std::span<const EdgeFragment> fragments = in.edges.of_tile[index];
    if (visibility.covered[tile] <= 0 && fragments.empty())
      shade_sky_tile(in.shading, tile, memory, target.rgba, target.linear);
    else
      shaded[index] =
          shade_tile(in.shading,
                     {tile, visibility.depth_of(tile), visibility.primitive_of(tile), fragments,
                      in.lookups[index]},
                     memory, target.rgba, target.linear, labels_shading ? &shaded_labels : nullptr);
    if (in.labels) label_tile(in, tile, shaded_labels, target.labels);
    if (in.wireframe && visibility.covered[tile] > 0) draw_wireframe(in, tile, target);
  });
}

}  // namespace swell::render
