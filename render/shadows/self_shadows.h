// Stage 3: what objects throw on themselves.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>

#include "render/frame/profile.h"
#include "render/shadows/object_shadows.h"

namespace swell::render {

struct ObjectGeometry;
struct WorldState;

// Finds the SunDepths of the objects that look large enough, for their instances in all views. The
// axes of `objects.shadows` are those of the frame. 0.1 ms for an object that fills the window.
void find_self_shadows(const WorldState& world, const ShadowOptions& options, const View& view,
                       ObjectGeometry& objects, const StageRun& run);

// Raises the points of a map, side rows of them, to what they see of a triangle; its corners are
// numbers of points right and up of the first, and metres towards the sun.
void add_triangle(const std::array<glm::vec3, 3>& corner, int side, std::span<float> depth_m);

}  // namespace swell::render
