// The shapes of a scene's objects.
#pragma once

#include <memory>
#include <vector>

#include "scene/scene.h"
#include "shapes/mesh_file.h"

namespace swell::render {

class PartMaker;

// A shape with its levels of detail, finest first. Worlds share those of files.
using ObjectShape = std::shared_ptr<const shapes::MeshOfFile>;

// The shapes of a scene's objects.
struct ObjectMeshes {
  std::vector<ObjectShape> of_object;
  std::vector<std::vector<shapes::MeshPart>>
      parts;  // of each object's finest level, at its draught
};

// Gives objects of files their sizes; `parts`: of the scene. Throws SceneError for a file that
// cannot be drawn.
ObjectMeshes build_object_meshes(scene::Scene& scene, PartMaker& parts);

}  // namespace swell::render
