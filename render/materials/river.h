// Rivers and lakes: what their per-pixel code (river-inl.h) reads.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "render/materials/ground_albedo.h"
#include "render/packets/slope_layer.h"
#include "render/tile/inputs.h"
#include "render/water/foam.h"

namespace swell::ocean {
struct InlandSample;
}

namespace swell::render {

// Ripples are carried by the flow for this long, then begin anew where they began.
inline constexpr double kCarried_s = 1.5;

struct River {
  static constexpr SurfaceKind kSurface = SurfaceKind::kRivers;

  // The lattice of ocean::InlandWater.
  const ocean::InlandSample* samples = nullptr;
  const std::int32_t* block_index = nullptr;
  int blocks_x = 0, blocks_y = 0;
  glm::vec2 corner_rel{0.0f};  // [m]
  float cells_per_m = 1.0f;

  SlopeLayer long_ripples, short_ripples;  // carried; of slope variance 1 together
  SlopeLayer stones;                       // of the bed
  SlopeLayer foam_lace;                    // likewise carried
  float cycles = 0.0f;                     // of kCarried_s that have passed, without whole ones
  float cycle_number = 0.0f;               // whole ones, modulo 4096
  float base_variance = 0.0f;              // slope variance of ripples too fine for any map
  float wind_share = 1.0f;                 // of the sea's ripples
  GroundAlbedo ground;                     // whose sand beds at the sea's level have
  glm::vec3 gravel{0.0f};                  // reflectance of a bed above it
  glm::vec3 sky_light{0.0f};               // what a white bed under no water sends back, of the sky
  glm::vec3 sun_light{0.0f};               // and of a sun that nothing hides

  std::span<const RiverImage> images;  // what it mirrors
  bool submerged = false;              // the eye sees the surface from below
};

void fill(const MaterialInputs& in, const RenderView& view, River& river);

}  // namespace swell::render
