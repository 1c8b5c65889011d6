#include "scene/file/scene_files.h"

#include "scene/file/implicit_file.h"
#include "scene/scene_error.h"
#include "texture/square_frames.h"

namespace swell::scene {
namespace {

// The heights of an implicit surface; none of a file that no world takes.
std::vector<std::string> pictures_of(const FloatingObject& object) {
  if (object.kind != ObjectKind::kImplicit || object.file.empty()) return {};
  try {
    return load_implicit(object.file).pictures;
  } catch (const SceneError&) {
    return {};
  }
}

}  // namespace

std::vector<SceneFile> files_of(const Scene& scene) {
  std::vector<SceneFile> files;
  const auto add = [&](const std::string& path) {
    if (!path.empty()) files.push_back({path});
  };
  if (scene.terrain) {
    add(scene.terrain->height_image.string());
    add(scene.terrain->boundary.string());
  }
  for (const terrain::TreeStand& stand : scene.trees) add(stand.density_map.string());
  for (const auto& layer : scene.sea.maps) add(layer.file);
  add(scene.water.texture);
  for (const std::string& path : {scene.ripples.sequence, scene.ripples.detail})
    if (!path.empty())
      for (const std::string& frame : texture::paths_of_frames(path, scene.ripples.frames))
        add(frame);
  for (const FloatingObject& object : scene.objects)
    if (object.kind == ObjectKind::kMesh && !object.file.empty()) {
      files.push_back({object.file, true, object.up});
    } else {
      add(object.file);
      for (const std::string& picture : pictures_of(object)) add(picture);
    }
  return files;
}

}  // namespace swell::scene
