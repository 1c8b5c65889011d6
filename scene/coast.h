// The coast waves of a scene: trains over its terrain.
#pragma once

#include <optional>

#include "ocean/coast.h"
#include "scene/scene.h"
#include "scene/terrain.h"

namespace swell::scene {

// Works out the phases of the scene's wave trains over its terrain, on every CPU there is: 0.1 to 1
// second. Nothing for scenes without terrain, without wind or with coast.model = "none".
std::optional<ocean::CoastSea> build_coast(const Scene& scene, const Terrain* terrain);

}  // namespace swell::scene
