// The shapes of a world's objects.
#include "render/world/object_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "render/world/part_maker.h"
#include "scene/file/implicit_file.h"
#include "scene/file/parameters.h"
#include "scene/scene_error.h"
#include "shapes/implicit_mesh.h"

namespace swell::render {
namespace {

shapes::MeshOfFile built_in(const scene::FloatingObject& object) {
  shapes::MeshOfFile shape;
  for (const int segments : shapes::kLevelSegments)
    shape.levels.push_back(shapes::make_object_mesh(object.kind, object.top_mark, segments));
  return shape;
}

[[noreturn]] void fail(const scene::Scene& scene, std::size_t n, const std::string& fault) {
  const scene::FloatingObject& object = scene.objects[n];
  const std::string& place = object.file_place.empty() ? scene.name : object.file_place;
  const bool says_what_is_allowed = fault.find("allowed") != std::string::npos;
  throw scene::SceneError(scene::one_line(fmt::format(
      "{}: object[{}].file, got {}{}", place.empty() ? "scene" : place, n,
      scene::shortened(fault, 300), says_what_is_allowed ? "" : ", allowed a readable mesh file")));
}

shapes::MeshOfFile shape_of(const scene::Scene& scene, std::size_t n) {
  const scene::FloatingObject& object = scene.objects[n];
  if (!scene::kObjectKinds[object.kind].is_of_file) return built_in(object);
  try {
    if (object.kind == scene::ObjectKind::kImplicit)
      return shapes::with_meshes(scene::load_implicit(object.file));
    return shapes::load_mesh(object.file, object.up);
  } catch (const scene::SceneError&) {
    throw;
  } catch (const std::runtime_error& error) {
    fail(scene, n, error.what());
  }
}

}  // namespace

ObjectMeshes build_object_meshes(scene::Scene& scene, PartMaker& parts) {
  ObjectMeshes result;
  for (std::size_t n = 0; n < scene.objects.size(); ++n) {
    scene::FloatingObject& object = scene.objects[n];
    const ValueBytes inputs =
        ValueBytes().add(object.kind).add(object.top_mark).add(object.file).add(object.up);
    ObjectShape shape = parts.share("shape", inputs, [&] { return shape_of(scene, n); });
    if (scene::kObjectKinds[object.kind].is_of_file) {
      try {
        shapes::fit_object(*shape, object);
      } catch (const std::runtime_error& error) {
        fail(scene, n, error.what());
      }
    }
    result.parts.push_back(shapes::mesh_parts(object, shape->levels.front()));
    result.of_object.push_back(std::move(shape));
  }
  return result;
}

}  // namespace swell::render
