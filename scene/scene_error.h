// What scenes are refused with.
#pragma once

#include <stdexcept>

namespace swell::scene {

// What is wrong with a scene: what() is one line, 'FILE:LINE: column N: what, got what, allowed
// what' (without the places that are not known).
class SceneError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace swell::scene
