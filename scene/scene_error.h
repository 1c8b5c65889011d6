// What scenes are refused with.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace swell::scene {

// What is wrong with a scene: what() is one line, 'FILE:LINE: column N: what, got what, allowed
// what' (without the places that are not known).
class SceneError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The text for a message, with "..." in place of its middle if it has more bytes than this: so that
// what is said after it, the allowed values, is not cut off. UTF-8 characters stay whole.
std::string shortened(std::string_view text, std::size_t most_bytes = 160);

}  // namespace swell::scene
