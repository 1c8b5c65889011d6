// What the panel lets one change of the scene, and the scene that results.
#pragma once

#include "apps/view/air_choice.h"
#include "apps/view/wave_choice.h"
#include "scene/scene.h"

namespace swell::view {

struct SceneChoice {
  WaveChoice waves;
  AirChoice air;
  scene::CoastModel coast = scene::CoastModel::kNone;  // of a scene with land
  scene::Detail detail;  // but for the numbers of triangles, which a frame's options have
};

// What the scene itself says.
SceneChoice scene_choice(const scene::Scene& scene);

// `scene` as chosen; what is not the panel's stays.
scene::Scene with_choice(scene::Scene scene, const SceneChoice& choice);

}  // namespace swell::view
