// What the importer of mesh files hands over, which a broken or hostile mesh file may have made.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include "fuzz/expect.h"
#include "shapes/flat_mesh.h"
#include "shapes/mesh_file.h"

namespace swell::fuzz {
namespace {

bool is_finite(const shapes::ObjectTriangle& t) {
  const auto all = [](glm::vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  };
  return all(t.flat_normal) && all(t.normal_at_origin) && all(t.normal_along_x) &&
         all(t.normal_along_y) && all(t.normal_along_z);
}

void check_mesh(const shapes::MeshOfFile& mesh) {
  expect(!mesh.levels.empty(), "a mesh has a level");
  for (int i = 0; i < 3; ++i)
    expect(std::isfinite(mesh.low[i]) && mesh.low[i] <= mesh.high[i], "a mesh has a box");
  for (const shapes::ObjectMesh& level : mesh.levels) {
    expect(level.indices.size() == 3 * level.triangles.size(), "a triangle has three indices");
    for (const std::uint32_t index : level.indices)
      expect(index < level.position.size(), "an index has a vertex");
    for (const shapes::ObjectTriangle& triangle : level.triangles)
      expect(is_finite(triangle), "a triangle has finite normals");
  }
}

void read_mesh(std::span<const char> bytes) {
  shapes::FlatMesh flat;
  try {
    flat = shapes::read_flat_mesh(bytes);
  } catch (const std::runtime_error&) {
    return;
  }
  const shapes::MeshOfFile mesh = shapes::mesh_of(flat);
  scene::FloatingObject object;
  try {
    shapes::fit_object(mesh, object);
  } catch (const std::runtime_error&) {
    return;  // larger or smaller than objects may be: a point has no normals
  }
  check_mesh(mesh);
}

}  // namespace
}  // namespace swell::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  swell::fuzz::read_mesh({reinterpret_cast<const char*>(data), size});
  return 0;
}
