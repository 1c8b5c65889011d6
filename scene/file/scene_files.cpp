#include "scene/file/scene_files.h"

#include "texture/square_frames.h"

namespace swell::scene {

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
      for (int frame = 0; frame < scene.ripples.frames; ++frame)
        add(texture::path_of_frame(path, frame));
  for (const FloatingObject& object : scene.objects)
    if (object.kind == ObjectKind::kMesh && !object.file.empty())
      files.push_back({object.file, true, object.up});
    else
      add(object.file);
  return files;
}

}  // namespace swell::scene
