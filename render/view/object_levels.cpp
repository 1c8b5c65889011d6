#include "render/view/object_levels.h"

#include <algorithm>
#include <cmath>

#include "render/view/objects_drawn.h"
#include "render/world/world_state.h"
#include "shapes/implicit_mesh.h"

namespace swell::render {

float most_px_per_m(glm::vec3 p_rel, float radius_m, const View& view) {
  const float distance_m = std::sqrt(glm::dot(p_rel, p_rel));
  const float px_at_1_m = 0.5f * static_cast<float>(view.height_px) / view.tan_half_y;
  // A flat picture stretches what lies aside by the square of 1 / cosine.
  const glm::vec2 corner(std::abs(view.tan_middle_x) + view.tan_half_x,
                         std::abs(view.tan_middle_y) + view.tan_half_y);
  const float most = 1.0f + glm::dot(corner, corner);
  const float ahead_m = glm::dot(p_rel, view.forward);
  const float stretch = ahead_m > 0.0f ? distance_m * distance_m / (ahead_m * ahead_m) : most;
  return px_at_1_m * std::min(stretch, most) / std::max(distance_m - radius_m, view.near_m);
}

float drawn_size_px(const scene::FloatingObject& object, glm::vec3 p_rel, const View& view) {
  const float distance_m = std::sqrt(glm::dot(p_rel, p_rel));
  const float px_at_1_m = 0.5f * static_cast<float>(view.height_px) / view.tan_half_y;
  if (scene::kObjectKinds[object.kind].is_compact)
    return px_at_1_m * static_cast<float>(object.size_m.z) / std::max(distance_m, view.near_m);
  // Its nearest point.
  const auto size_m =
      static_cast<float>(std::max({object.size_m.x, object.size_m.y, object.size_m.z}));
  return px_at_1_m * size_m / std::max(distance_m - 0.5f * size_m, view.near_m);
}

const shapes::ObjectMesh& coarsest_mesh(const WorldState& world, std::size_t object,
                                        float error_m) {
  const std::vector<shapes::ObjectMesh>& levels = world.objects.of_object[object]->levels;
  const glm::dvec3 size_m = world.scene.objects[object].size_m;
  const auto largest_m = static_cast<float>(std::max({size_m.x, size_m.y, size_m.z}));
  std::size_t level = levels.size() - 1;
  while (level > 0 && levels[level].error * largest_m > error_m) --level;
  return levels[level];
}

const shapes::ObjectMesh& outline_mesh(const WorldState& world, const ObjectGeometry& objects,
                                       std::size_t object, float error_m) {
  const shapes::MeshOfFile& shape = *world.objects.of_object[object];
  if (!shape.implicit || shape.implicit->moving.empty())
    return coarsest_mesh(world, object, error_m);
  const auto at = std::ranges::find(objects.implicit_of, &shape.implicit->implicit);
  return objects.stand_ins[static_cast<std::size_t>(at - objects.implicit_of.begin())];
}

}  // namespace swell::render
