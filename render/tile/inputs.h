// What materials are filled from, once a view.
#pragma once

#include <limits>

#include "math/view.h"
#include "render/frame/parts.h"
#include "render/view/surfaces.h"

namespace swell::texture {
struct RgbaImage;
}

namespace swell::render {

struct Light;
struct Media;
struct ObjectGeometry;
struct RenderView;
struct SeaMaps;
struct TreeGeometry;
struct WorldState;

// An off-screen picture that water looks into, at `scale` of the window's size.
struct PlanarMap {
  const texture::RgbaImage* image = nullptr;
  float scale_x = 1.0f, scale_y = 1.0f;
};

// What materials that have triangles of their own place them by.
struct PlaceInputs {
  const WorldState& world;
  double t_s;
  const View& view;  // the window's camera
  PartSet without;
};

struct MaterialInputs {
  const WorldState& world;
  double t_s;
  const SeaMaps& sea;
  const ObjectGeometry& objects;
  const Light& light;
  const Media& media;
  PartSet without;
  PlanarMap reflection = {}, refraction = {};  // once they are drawn
  PlanarMap river_reflection = {};             // what rivers at about this level mirror
  float river_level_m = 0.0f, river_mirror_share = 0.0f;
  // How far out the water's vertices show waves.
  double wave_reach_m = std::numeric_limits<double>::infinity();
  const TreeGeometry* trees = nullptr;  // none: no trees are drawn
};

}  // namespace swell::render
