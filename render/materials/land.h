// What the ground above the sea is made of: what its per-pixel code (land-inl.h) reads.
#pragma once

#include <glm/glm.hpp>

#include "render/packets/slope_layer.h"
#include "render/tile/inputs.h"
#include "render/world/ground_cover.h"

namespace swell::render {

// The ground's pattern (Textures::ground) laid over the land.
struct PatternLayer {
  SlopeLayer layer;
  float lost_per_variance = 1.0f;  // what part of it is lost, by the variance that it has lost
  glm::vec2 turn{1.0f, 0.0f};      // cosine and sine of how far it is turned
};

// CoverTraits of a scene's materials; the variation is of each channel.
struct MaterialColour {
  glm::vec3 mean{0.0f}, variation{0.0f};
  float relief = 1.0f;
};

struct Land {
  bool on = false;
  const CoverMaps* ground = nullptr;  // as far as Terrain::map and around go
  const CoverMaps* ground_around = nullptr;
  PatternLayer wide, near, fine;  // one pattern at three sizes
  // Layers of rock: the pattern over height and one way along the ground.
  PatternLayer strata;
  glm::vec2 strata_along{0.0f};
  EnumTable<Cover, MaterialColour> covers;
  float soil_begin_m = 0.0f;  // height at which sand begins to turn to soil
};

// texel_m: of the cover map over the terrain's square.
void fill(const MaterialInputs& in, glm::dvec2 eye, double texel_m, Land& land);

}  // namespace swell::render
