// What makes a scene one that can be drawn: every value in the range that docs/look_up/scene.md
// states for its key, and the values in agreement with each other. Scenes from files and scenes
// made in code pass by here.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace swell::scene {

struct SceneFault {
  std::string key;      // as a scene file has it: "camera.path[2].t_s"
  std::string got;      // the value, in the file's unit
  std::string allowed;  // "0.01 to 10 m"
};

// 'KEY, got GOT, allowed ALLOWED'
std::string fault_text(const SceneFault& fault);

// The scene's first fault in the order of docs/look_up/scene.md; none: it can be drawn, if its
// files can be read. 0.3 ms.
std::optional<SceneFault> find_fault(const Scene& scene);

// The part of it that is left to check when every value is in its range: those that do not go
// together.
std::optional<SceneFault> find_disagreement(const Scene& scene);

// The first fault of a list of disturbances, the scene's own or a frame's.
std::optional<SceneFault> find_fault(const std::vector<ocean::Disturbance>& disturbances);

// 'FILE:LINE: column COLUMN' or the setting where the scene has the key, or the table around it;
// the name of a scene that was made in code.
std::string place_of_key(const Scene& scene, const std::string& key);

// Throws SceneError 'PLACE: KEY, got GOT, allowed ALLOWED' of a fault that shows when the scene is
// built.
[[noreturn]] void refuse(const Scene& scene, const SceneFault& fault);
// Throws SceneError likewise of a TerrainError; one of a file's content keeps its text.
[[noreturn]] void refuse(const Scene& scene, const terrain::TerrainError& error);

// Throws SceneError 'NAME: KEY, got GOT, allowed ALLOWED' for the first fault.
void check_scene(const Scene& scene);

}  // namespace swell::scene
