// The coast waves of a scene: trains over its terrain.
#pragma once

#include <optional>

#include "math/parallel.h"
#include "ocean/coast.h"
#include "scene/scene.h"
#include "scene/terrain.h"

namespace swell::scene {

// Works out the phases of the scene's wave trains over its terrain, with 1 to 256
// threads, the same bits with any: 0.1 to 1 second. Nothing for scenes without terrain, without
// wind or with coast.model = "none".
std::optional<ocean::CoastSea> build_coast(const Scene& scene, const Terrain* terrain,
                                           int threads = available_cpus());

}  // namespace swell::scene
