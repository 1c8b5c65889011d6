// The panel's sections about the scene.
#pragma once

#include <span>

#include "apps/view/scene_choice.h"

namespace swell::view {

// Between Gui::begin_frame and end_frame, in a window. `scene` is the one that was loaded; each is
// true if it has changed the choice.
bool draw_sea(const scene::Scene& scene, const EnumTable<WaveModel, const char*>& wave_names,
              SceneChoice& choice);
bool draw_light_and_air(const scene::Scene& scene, SceneChoice& choice);
bool draw_land(const scene::Scene& scene, SceneChoice& choice);

}  // namespace swell::view
