// The water's own texture: its colour from place to place. Source: Ma, Zhu, Gong, 2006.
#pragma once

#include <glm/vec3.hpp>

#include "render/packets/slope_layer.h"

namespace swell::scene {
struct Scene;
}

namespace swell::render {

struct WorldState;

struct WaterTexture {
  TintMaps maps;
  glm::vec3 mean{0.0f};  // what takes the place of scene::WaterOptics::body_colour
};

// Of the scene's picture. Throws scene::SceneError for a file that is none.
WaterTexture build_water_texture(const scene::Scene& scene);

// The linear radiance factor of deep water in the mean, of a world drawn with or without the
// sequence of its ripples, whose details tint it.
glm::vec3 mean_water_colour(const WorldState& world, bool has_sequence);

}  // namespace swell::render
