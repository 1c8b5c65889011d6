#include "apps/view/scene_choice.h"

#include <utility>

namespace swell::view {

SceneChoice scene_choice(const scene::Scene& scene) {
  return {wave_choice(scene), air_choice(scene), scene.coast.model, scene.detail};
}

scene::Scene with_choice(scene::Scene scene, const SceneChoice& choice) {
  scene = with_air(with_waves(std::move(scene), choice.waves), choice.air);
  scene.coast.model = choice.coast;
  scene.detail = choice.detail;
  return scene;
}

}  // namespace swell::view
