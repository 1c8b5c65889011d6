// The water's surface: what its per-pixel code (water-inl.h) reads.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "ocean/spectrum/limits.h"
#include "render/packets/slope_layer.h"
#include "render/tile/inputs.h"
#include "render/water/foam.h"
#include "render/water/glitter.h"
#include "render/water/near_shore.h"
#include "render/water/wakes.h"
#include "render/water/whitecaps.h"

namespace swell::render {

// The sea's patches and two layers of ripples.
inline constexpr int kMaxSlopeLayers = static_cast<int>(ocean::kMaxPatches) + 2;

// A sine wave's slopes: amplitude_slope * cos(2 pi (cycles_per_m . p_rel + cycles)).
struct SineLayer {
  float kx = 0.0f, ky = 0.0f;  // cycles per metre
  float cycles = 0.0f;         // under the eye
  float slope_x = 0.0f, slope_y = 0.0f;
  float wavelength_log2 = 0.0f;
};

// Wave trains near a coast. Not periodic: they hold within their square.
struct CoastTrains {
  bool on = false;
  SlopeLayer slopes;
  SlopeLayer surf;  // what the longest waves of the sea cede to them, and their foam
  // Their whitecaps and CoastWhitecaps::short_part, both twice less 1; no map: no whitecaps.
  SlopeLayer whitecaps;
};

// What light does at the water.
struct WaterOptics {
  glm::vec3 mirrored_sea{0.0f};      // radiance of the deep sea where waves mirror it
  float mirrored_floor_part = 0.0f;  // how much a floor's light adds to it
  float reflection_weight = -1.0f;   // of what it mirrors; below 0: Fresnel's
  float refraction_weight = 1.0f;    // of the refraction image against the water's own light
  float wave_horizon = 0.0f;         // sine of the elevation at which half of the rays meet a wave
  glm::vec3 glitter_light{0.0f};     // of the sun, in its image
  glm::vec3 crest_glow{0.0f};        // added where light shines through crests
  float inv_crest_height = 0.0f;
  float inv_wave_reach = 0.0f;  // of the vertices, per metre
};

// The images that the water looks into, and how slopes displace the lookups.
struct WaterImages {
  PlanarMap reflection, refraction;
  Distortion distortion;
  float max_distortion_px = 0.0f;  // bound of the displacement, each way
  float max_turn = 0.0f;  // of a wide picture's face, seen from below: the same, as tangent
  glm::vec2 view_right{1, 0}, view_ahead{0, 1};  // of a level camera: horizontal unit vectors
};

struct Water {
  static constexpr SurfaceKind kSurface = SurfaceKind::kWater;

  std::array<SlopeLayer, kMaxSlopeLayers> layers;  // patches, longest first, then ripples
  int layer_count = 0;
  int long_layer_count = 0;  // the first so many are of the sea's long waves
  std::array<SineLayer, ocean::kMaxSineTrains> sines;
  int sine_count = 0;
  int first_ripples = 0;        // the layer from which on noise bends the coordinates
  TintLayer bump_detail;        // of the paper's lighting, or none
  TintLayer texture;            // the water's own, or none
  SlopeLayer uv_noise;          // values in [-1, 1], not slopes
  float short_variance = 0.0f;  // slope variance of the layers after the long ones
  float visible_slopes = 1.0f;  // 1, or 0: all slopes of rough water are seen, also the hidden ones
  float least_cos = 0.0f;  // of normals to the eye, which are tilted to have it; 0: they are not
  float base_variance = 0.0f;  // slope variance of ripples too fine for any map
  bool submerged = false;      // the eye sees the surface from below
  CoastTrains trains;
  NearShore near_shore;
  bool knows_land() const { return trains.on || near_shore.map.map != nullptr; }
  SlopeLayer foam_lace, hull_foam_lace;
  FoamLight foam_light;
  Whitecaps whitecaps;
  Wakes wakes;
  Glitter glitter;
  WaterOptics optics;
  WaterImages images;
};

// How far slopes may displace a lookup, each way.
float max_distortion_px(const View& window);

void fill(const MaterialInputs& in, const RenderView& view, Water& water);

}  // namespace swell::render
