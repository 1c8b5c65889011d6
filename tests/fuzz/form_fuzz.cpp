// Files of implicit surfaces, and the boxes that are found of their parts.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "fuzz/expect.h"
#include "scene/file/implicit_file.h"
#include "scene/scene_error.h"

namespace swell::fuzz {
namespace {

bool is_box(glm::dvec3 low, glm::dvec3 high) {
  for (int i = 0; i < 3; ++i)
    if (!(std::isfinite(low[i]) && std::isfinite(high[i]) && low[i] <= high[i])) return false;
  return true;
}

void read_implicit(std::string_view text) {
  scene::ImplicitSurface implicit;
  try {
    implicit = scene::parse_implicit(text, "form.toml");
  } catch (const scene::SceneError& error) {
    expect(std::string_view(error.what()).find('\n') == std::string_view::npos,
           "what a form is refused with is one line");
    return;
  }
  expect(!implicit.parts.empty(), "a form that is taken has a part");
  expect(is_box(implicit.low, implicit.high), "a form has a box");
  for (const scene::ImplicitPart& part : implicit.parts) {
    expect(is_box(part.low, part.high), "a part has a box");
    expect(scene::value(part, part.inside) >= 0.0, "a part's point lies inside");
  }
}

}  // namespace
}  // namespace swell::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  swell::fuzz::read_implicit({reinterpret_cast<const char*>(data), size});
  return 0;
}
