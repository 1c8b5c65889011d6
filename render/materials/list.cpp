#include "render/materials/list.h"

#include <tuple>

#include "render/view/meshes.h"
#include "render/view/render_view.h"

namespace swell::render {
namespace {

template <class M>
void place_surface(const PlaceInputs& in, Meshes& meshes, FrameViews views) {
  meshes.has_material[M::kSurface] = true;
  if constexpr (requires(PlacedSurface & surface) { M::place(in, surface); }) {
    PlacedSurface& surface = meshes.placed[M::kSurface];
    M::place(in, surface);
    resize_vertices(M::kSurface, surface.p_rel.size(), views);
    map_vertices(meshes, M::kSurface, 0, surface.p_rel.size(), views);
  }
}

}  // namespace

void fill_shading(const MaterialInputs& in, const RenderView& view, int tile_size_px,
                  ViewShading& shading) {
  fill_shading(in, view, tile_size_px, static_cast<Shading&>(shading));
  std::apply([&](auto&... material) { (fill(in, view, material), ...); }, shading.materials);
}

void place_surfaces(const PlaceInputs& in, Meshes& meshes, FrameViews views) {
  [&]<class... M>(std::tuple<M...>*) {
    (place_surface<M>(in, meshes, views), ...);
  }(static_cast<Materials*>(nullptr));
}

}  // namespace swell::render
