// The mesh of a file, ready to be drawn.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "shapes/object_mesh.h"

namespace swell::shapes {

struct DrawnImplicit;
struct FlatMesh;

struct MeshOfFile {
  std::vector<ObjectMesh> levels;  // finest first
  // The corners of its box in units of the file: right, ahead, up.
  glm::dvec3 low{0.0}, high{0.0};
  // What is drawn, if the file has an implicit surface; the levels stand for it where that does not
  // show.
  std::shared_ptr<const DrawnImplicit> implicit;
};

// Reads the file in another process (shapes/run_importer.h). Throws std::runtime_error in one line
// that begins with what was found. A million triangles take 3 s.
MeshOfFile load_mesh(const std::string& file, scene::UpAxis up);

// Makes the mesh from what the importer has written (shapes/flat_mesh.h).
MeshOfFile mesh_of(const FlatMesh& flat);

// Gives an object of kind kMesh or kImplicit its file's size, draught and middle. Throws
// std::runtime_error if it is larger or smaller than objects may be.
void fit_object(const MeshOfFile& mesh, scene::FloatingObject& object);

}  // namespace swell::shapes
