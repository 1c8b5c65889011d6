// Stage 3: how large objects look, and with how many triangles each is drawn.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>

namespace swell {
struct View;
namespace scene {
struct FloatingObject;
}
namespace shapes {
struct ObjectMesh;
}
}  // namespace swell

namespace swell::render {

struct ObjectGeometry;
struct WorldState;

// An outline that is drawn lies no further off that of the finest level.
inline constexpr float kMostLevelError_px = 0.5f;

// How many pixels of the view something of 1 m at p_rel, relative to the eye, takes at most; at
// radius_m nearer than p_rel.
float most_px_per_m(glm::vec3 p_rel, float radius_m, const View& view);

// How high or wide an object at p_rel looks, whichever is more.
float drawn_size_px(const scene::FloatingObject& object, glm::vec3 p_rel, const View& view);

// The coarsest level of an object's mesh that lies at most error_m off its finest one.
const shapes::ObjectMesh& coarsest_mesh(const WorldState& world, std::size_t object, float error_m);

// The same for what shadows and picks see of an object in a frame: of an implicit surface whose
// parts move it is the stand-in as they have.
const shapes::ObjectMesh& outline_mesh(const WorldState& world, const ObjectGeometry& objects,
                                       std::size_t object, float error_m);

}  // namespace swell::render
