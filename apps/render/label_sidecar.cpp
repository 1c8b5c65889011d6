#include "apps/render/label_sidecar.h"

#include <fmt/core.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <filesystem>
#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "apps/shared/json.h"
#include "apps/shared/program.h"
#include "apps/shared/version.h"
#include "math/elementary.h"
#include "render/labels/classes.h"
#include "scene/file/scene_choices.h"

namespace swell::apps {
namespace {

// What the picture's pixels see, in the optical frame.
Json lens_json(const View& view, const Intrinsics& pinhole) {
  const Projection& projection = view.projection;
  const Intrinsics& k = projection.is_wide() ? projection.k : pinhole;
  Json json;
  if (projection.is_wide()) json["projection"] = scene::ProjectionName::words[projection.kind];
  if (projection.kind == ProjectionKind::kFisheye) {
    json["fisheye_k"] = projection.bend;
    json["fisheye_fov_deg"] = 2.0 * projection.half_fov_rad / kRadPerDeg;
  }
  if (projection.kind != ProjectionKind::kEquirectangular)
    json["intrinsics"] = {{"fx", k.fx},
                          {"fy", k.fy},
                          {"cx", k.cx},
                          {"cy", k.cy},
                          {"first_pixel_centre_px", {0.5, 0.5}}};
  return json;
}

Json camera_json(const View& view) {
  const OpticalPose pose = camera_pose(view);
  const glm::dquat& q = pose.world_from_optical;
  const glm::dvec3& eye = pose.eye_world;
  const glm::dmat3 axes = glm::mat3_cast(q);  // columns: right, down, ahead
  Json matrix = Json::array();
  for (glm::length_t row = 0; row < 3; ++row)
    matrix.push_back({axes[0][row], axes[1][row], axes[2][row], eye[row]});
  matrix.push_back({0.0, 0.0, 0.0, 1.0});
  Json json = lens_json(view, pose.k);
  json["near_m"] = view.near_m;
  json["pose"] = {{"eye_m", {eye.x, eye.y, eye.z}},
                  {"quaternion_wxyz", {q.w, q.x, q.y, q.z}},
                  {"world_from_optical", matrix}};
  return json;
}

Json channels_json(render::LabelSet labels) {
  Json json = Json::array();
  for (const render::LabelInfo& info : render::label_table()) {
    if (!labels.has(info.label)) continue;
    const std::vector<std::string> planes(info.planes.begin(),
                                          info.planes.begin() + info.plane_count());
    json.push_back({{"name", info.name},
                    {"planes", planes},
                    {"type", info.is_integer ? "uint32" : "float32"},
                    {"unit", info.unit},
                    {"meaning", info.meaning},
                    {"sky", info.of_sky}});
  }
  return json;
}

Json classes_json(std::span<const std::string> names) {
  Json json = Json::array();
  for (std::size_t i = 0; i < names.size(); ++i) json.push_back({{"id", i}, {"name", names[i]}});
  return json;
}

Json objects_json(const scene::Scene& scene, std::span<const std::string> class_names) {
  const auto row = [&](std::size_t id, std::string_view name, std::uint32_t klass,
                       std::string_view kind) {
    return Json{{"id", id},
                {"name", name},
                {"class", klass},
                {"class_name", class_names[klass]},
                {"kind", kind}};
  };
  Json json = {row(render::kSkyId, "sky", render::kSkyClass, "sky"),
               row(render::kWaterId, "sea", render::kWaterClass, "water"),
               row(render::kLandId, "land", render::kTerrainClass, "terrain")};
  const std::vector<std::uint32_t> classes = render::object_classes(scene);
  for (std::size_t n = 0; n < scene.objects.size(); ++n) {
    const scene::FloatingObject& object = scene.objects[n];
    json.push_back(row(render::kFirstObjectId + n, object.name, classes[n],
                       scene::kObjectKindNames[object.kind]));
  }
  return json;
}

}  // namespace

std::string label_sidecar(const SidecarFrame& frame, const View& view, const scene::Scene& scene,
                          const std::string& scene_path, render::LabelSet labels,
                          std::span<const std::string> command_line) {
  const std::vector<std::string> names = render::class_names(scene);
  Json json;
  json["program"] = "swell-render";
  json["version"] = version();
  json["command_line"] = command_line;
  json["scene"] = {{"file", std::filesystem::path(scene_path).filename().string()},
                   {"name", scene.name},
                   {"xxh3", scene_hash_text(scene)}};
  json["frame"] = frame.frame;
  json["t_s"] = frame.t_s;
  json["fps"] = frame.fps;
  json["size"] = {view.width_px, view.height_px};
  json["labels_file"] = frame.labels_file;
  json["picture_file"] = frame.picture_file.empty() ? Json() : Json(frame.picture_file);
  json["picture_xxh3"] = fmt::format("{:016x}", frame.hash);
  json.update(camera_json(view));
  json["channels"] = channels_json(labels);
  json["classes"] = classes_json(names);
  json["objects"] = objects_json(scene, names);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string scene_hash_text(const scene::Scene& scene) {
  const std::string text = scene::dump_scene(scene);
  return fmt::format("{:016x}", XXH3_64bits(text.data(), text.size()));
}

}  // namespace swell::apps
