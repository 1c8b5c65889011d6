// The land and the sea floor: what their per-pixel code (terrain-inl.h) reads.
#pragma once

#include <glm/glm.hpp>

#include "render/materials/canopy.h"
#include "render/materials/checker.h"
#include "render/materials/ground_albedo.h"
#include "render/materials/land.h"
#include "render/packets/slope_layer.h"
#include "render/tile/inputs.h"

namespace swell::render {

// The thin sheets of water that waves send up the beach.
struct Swash {
  float reach_m = 0.0f;  // height on the beach that sheets reach; 0: none
  float cycles = 0.0f;   // time, in turns of the sheets' coming and going
  // Their lag along the shore: cycles by x, by y, under the eye.
  glm::vec3 lag_a{0.0f}, lag_b{0.0f};
  glm::vec3 lag_c{0.0f};  // of the lobes of their edges, likewise
};

struct Terrain {
  static constexpr SurfaceKind kSurface = SurfaceKind::kTerrain;

  SlopeLayer slopes, slopes_around;  // of the terrain's square; of that with its apron
  GroundAlbedo albedo;
  SlopeLayer detail;
  Land land;
  SlopeLayer sun;  // LandShadow::ground; no map: lit everywhere
  Checker checker;
  Canopy canopy;
  Swash swash;
};

void fill(const MaterialInputs& in, const RenderView& view, Terrain& terrain);

}  // namespace swell::render
