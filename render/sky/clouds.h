// A layer of clouds, drawn into the sky behind everything else.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "render/frame/parts.h"
#include "render/packets/slope_layer.h"
#include "render/sky/sky_maps.h"

namespace swell::sky {
struct SkyLight;
}

namespace swell::render {

struct WorldState;

// Optical depth of clouds at one deviation of the noise over the threshold; with its square.
inline constexpr float kCloudDepth = 1.3f;

// light: exposed. ambient: mean radiance of the clear sky.
CloudLight make_cloud_light(const sky::SkyLight& light, glm::vec3 ambient, float cover);

// Noise that repeats, of mean 0, and how much less of it there is towards the light.
void build_cloud_map(std::uint64_t seed, glm::vec3 to_light, Workers& workers,
                     texture::PackedMap2& map, float& variance);

// As seen at one time.
struct Clouds {
  bool any = false;       // over the eye
  bool is_below = false;  // seen from above
  static constexpr std::size_t kLayers = 3;
  std::array<SlopeLayer, kLayers> layers;  // values, not slopes
  // How much denser they are in some regions, in deviations. From below nobody sees so far; from
  // above the layers alone would repeat.
  SlopeLayer regions;
  float inv_deviation = 1.0f;
  float height_m = 1.0f;  // over the eye; negative below it
  float shown = 1.0f;     // less from next to the layer, nothing from within
  CloudLight light;
};

// How much an eye sees of the clouds over it, in [0, 1].
float part_under_clouds(double height_m);

// What drifts with the wind is a function of t_s.
Clouds make_clouds(const WorldState& world, double t_s, glm::dvec3 eye, PartSet without);

}  // namespace swell::render
