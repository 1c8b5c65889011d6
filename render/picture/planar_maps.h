// Stage 5: the pictures that water looks into, mirrored and refracted, where visible water can.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "render/materials/list.h"
#include "render/picture/shown_rows.h"
#include "render/tile/shading.h"
#include "render/view/render_view.h"
#include "render/view/visibility.h"

namespace swell::render {

struct StageRun;
struct ThreadScratch;
using ScratchList = std::span<const std::unique_ptr<ThreadScratch>>;  // one a thread

struct PlanarTarget {
  RenderView view;
  texture::RgbaImage image;
  std::vector<std::uint8_t> wanted;       // per tile: water can look into it
  std::vector<std::uint8_t> written;      // per tile: holds anything but zeros
  std::vector<RowRange> tile_rows;        // find_tile_rows() has them
  std::vector<std::uint32_t> shown_rows;  // PlanarMap has them
  ViewShading shading;
};

struct PlanarMaps {
  PlanarTarget reflection, refraction;
  std::vector<TilePlanarMaps> of_tile;  // what the window's tiles see of them
};

// What rivers and lakes mirror, of each level of RiverMesh::mirrors().
struct RiverMirrors {
  std::array<PlanarTarget, kMostRiverMirrors> targets;
  std::vector<RiverImage> images;  // of those that are drawn
};

// The window's camera for pictures of `scale` times its size each way.
View planar_camera(const View& window, double scale);

// Draws what the window's water can see. The vertices of both views are mapped; inputs.reflection
// and inputs.refraction are set where there is anything to see.
void draw_planar_maps(const Meshes& meshes, const RenderView& window,
                      const VisibilityBuffer& visibility, ScratchList scratch,
                      MaterialInputs& inputs, PlanarMaps& images, const StageRun& run);

// Draws what the window's rivers and lakes mirror, where they show; the vertices are mapped.
// inputs.river_images has what there is to see of it, which `mirrors` keeps.
void draw_river_mirrors(const Meshes& meshes, const RenderView& window,
                        const VisibilityBuffer& visibility, ScratchList scratch,
                        MaterialInputs& inputs, RiverMirrors& mirrors, const StageRun& run);

}  // namespace swell::render
