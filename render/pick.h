// What the last frame shows at a place of its picture.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "lod/envelope.h"
#include "render/frame.h"

namespace swell::render {

struct Pick {
  bool is_water = true;         // else land
  glm::dvec3 p_world{0.0};      // on the drawn triangle
  double distance_m = 0.0;      // from the eye
  double model_height_m = 0.0;  // of the water's surface or the ground at that x, y
  glm::dvec2 slope{0.0};        // dz/dx and dz/dy of the same
  int triangle = 0, level = 0;  // of the drawn mesh
};

// Kept from pick to pick, so that it allocates nothing.
struct PickScratch {
  lod::Envelopes envelopes;
};

// The water or land that window point (x_px, y_px) of the last frame shows, by a ray through its
// mesh; nothing where it shows the sky. Objects are looked through. `world`, `view` and `workspace`
// are of that frame. 0.2 ms for 30,000 triangles, nearly all of it for the envelopes.
std::optional<Pick> pick(const World& world, const View& view, const Workspace& workspace,
                         glm::vec2 at_px, PickScratch& scratch);

}  // namespace swell::render
