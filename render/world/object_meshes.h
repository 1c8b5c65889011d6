// The shapes of a scene's objects.
#pragma once

#include <memory>
#include <vector>

#include "render/world/world.h"
#include "shapes/mesh_file.h"

namespace swell::render {

// A shape with its levels of detail, finest first. Worlds share those of files.
using ObjectShape = std::shared_ptr<const shapes::MeshOfFile>;

// The shapes of a scene's objects.
struct ObjectMeshes {
  std::vector<ObjectShape> of_object;
  std::vector<std::vector<shapes::MeshPart>>
      parts;  // of each object's finest level, at its draught
};

// Gives objects of files their sizes. like: may be null; a world whose files are not read again.
// Throws SceneError for a file that cannot be drawn.
ObjectMeshes build_object_meshes(scene::Scene& scene, const World::State* like);

}  // namespace swell::render
