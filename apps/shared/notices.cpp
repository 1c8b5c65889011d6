#include "apps/shared/notices.h"

#include <fmt/core.h>

#include <cstdio>
#include <stdexcept>

#include "render/measure/eye_place.h"
#include "scene/coast.h"
#include "scene/file/scene_choices.h"
#include "scene/settings.h"

namespace swell::apps {

scene::Scene load_scene(const SceneChoice& choice) {
  scene::Scene scene = scene::load_scene(choice.path, choice.settings);
  if (const std::string work = scene::slow_coast_text(scene); !work.empty())
    fmt::print(stderr, "note: {}; that takes a while\n", work);
  return scene;
}

void check_perspective(const scene::Scene& scene, std::string_view what) {
  if (scene.camera.projection != ProjectionKind::kPerspective)
    throw std::runtime_error(
        fmt::format("camera.projection, got \"{}\", allowed for {} \"perspective\"",
                    scene::ProjectionName::words[scene.camera.projection], what));
}

void EyeWarning::look(int frame, const render::World& world, const View& view,
                      const render::Workspace& workspace) {
  if (was_given_) return;
  const render::EyeReport eye = find_eye(world, workspace, view.eye_world);
  if (eye.place != render::EyePlace::kGround) return;
  was_given_ = true;
  fmt::print(
      stderr,
      "warning: frame {}: the camera is inside the ground, at {:.2f} m where the ground is at "
      "{:.2f} m; what it sees from there is not drawn right\n",
      frame, view.eye_world.z, eye.surface_m);
}

}  // namespace swell::apps
