// Ripples from a looping sequence of bump images: the world's images, and a frame's maps.
// Source: Ma, Zhu, Gong, 2006.
#pragma once

#include <glm/glm.hpp>

#include "math/parallel.h"
#include "render/packets/slope_layer.h"
#include "scene/scene.h"
#include "texture/bump_sequence.h"
#include "texture/packed_map.h"

namespace swell::render {

// The scene's own waves, or its files. Throws SceneError for files that are no sequence.
texture::BumpSequence build_ripple_sequence(const scene::Scene& scene, Workers& workers);

// Where in the loop of the ripples a time is, in [0, 1]. In a sea that loops they have a whole
// number of loops, the nearest one, but at least one.
double ripple_loop_part(const scene::Scene& scene, double t_s);

struct RippleMaps {
  texture::PackedMap2 slopes;
  TintMaps detail;
  texture::BumpFrame frame;  // storage
};

// Fills the maps at t_s; `detail` only if the scene's lighting wants it.
void pack_ripples(const scene::Scene& scene, const texture::BumpSequence& sequence, double t_s,
                  RippleMaps& maps);

}  // namespace swell::render
