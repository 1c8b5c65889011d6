// The files that a scene's keys name, besides its own.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace swell::scene {

struct SceneFile {
  std::string path;
  bool is_mesh = false;  // which may have further files; shapes/run_importer.h reads them all
  UpAxis up = {};        // of a mesh
  bool operator==(const SceneFile&) const = default;
};

// All files that a world of the scene opens, those of meshes aside, in an order that the scene
// alone decides. Every key of kind kPath is among them.
std::vector<SceneFile> files_of(const Scene& scene);

}  // namespace swell::scene
