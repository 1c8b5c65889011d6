// Recipes of data sets, and what is drawn of them.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "fuzz/expect.h"
#include "fuzz/scratch_parent.h"
#include "scene/file/recipe.h"
#include "scene/scene_error.h"
#include "scene/settings.h"

namespace swell::fuzz {
namespace {

constexpr std::string_view kScene = R"(
wind.speed_mps = 5
[camera]
eye_m = [0, 0, 3]
[[object]]
kind = "buoy"
position_m = [10, 20]
)";

// The folder that recipes are read in, which has a scene.
const ScratchFolder& folder() {
  static const ScratchFolder made(scratch_parent());
  static const auto scene = made.write("s.toml", kScene);
  return made;
}

void draw_samples(const scene::Recipe& recipe) {
  for (const int sample : {0, 1, recipe.count - 1}) {
    const scene::SampleDraw draw = scene::draw_sample(recipe, sample);
    try {
      scene::load_scene(recipe.scene, draw.settings);
    } catch (const scene::SceneError&) {  // values that do not go together
    }
  }
}

void read_recipe(std::span<const char> bytes) {
  const std::filesystem::path file =
      folder().write("recipe.toml", std::string_view(bytes.begin(), bytes.end()));
  try {
    draw_samples(scene::load_recipe(file));
  } catch (const scene::SceneError& error) {
    expect(std::string_view(error.what()).find('\n') == std::string_view::npos,
           "what a recipe is refused with is one line");
  }
}

}  // namespace
}  // namespace swell::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  swell::fuzz::read_recipe({reinterpret_cast<const char*>(data), size});
  return 0;
}
