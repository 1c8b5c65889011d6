// What the last frame shows at a place of its picture.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "lod/envelope.h"
#include "render/frame.h"
#include "scene/objects.h"

namespace swell::render {

enum class Shown : std::uint8_t { kWater, kLand, kObject };

struct Pick {
  Shown what = Shown::kWater;
  glm::dvec3 p_world{0.0};      // on the drawn triangle, in the flat world
  double distance_m = 0.0;      // from the eye
  double model_height_m = 0.0;  // of the ground at that x, y if land is shown, else of the water
  glm::dvec2 slope{0.0};        // dz/dx and dz/dy of the same
  std::size_t object = 0;       // its index in Scene::objects
  scene::ObjectKind object_kind = scene::ObjectKind::kBuoy;
  int triangle = 0, level = 0;  // of the drawn mesh, or of the object's, whose level is 0
};

// Kept from pick to pick, so that it allocates nothing.
struct PickScratch {
  lod::Envelopes envelopes;
};

// The water, land or floating object that window point (x_px, y_px) of the last frame shows, by a
// ray through what it was drawn with; nothing where it shows the sky. What is mirrored, or seen
// through the water, is water. at_px is finite (checked: NaN aborts with a message). `world`,
// `view` and `workspace` are of that frame. 0.2 ms for 30,000 triangles, nearly all of it for the
// envelopes.
std::optional<Pick> pick(const World& world, const View& view, const Workspace& workspace,
                         glm::vec2 at_px, PickScratch& scratch);

}  // namespace swell::render
