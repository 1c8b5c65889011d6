// What several tests of scene files share.
#pragma once

#include <string>

#include "scene/scene.h"

namespace swell::scene {

// what() of the SceneError that the text causes under the name "test.toml"; empty if it parses.
std::string error_of(const std::string& text);

// Every field of two scenes that differs, one a line, compared bit by bit.
std::string differences(const Scene& a, const Scene& b);

}  // namespace swell::scene
