// Scene files in TOML and JSON, and settings for them: the text up to a line "--set", then a
// setting a line. What is taken is a scene without a fault, which its dump says again.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/expect.h"
#include "scene/check_scene.h"
#include "scene/scene_error.h"
#include "scene/settings.h"

namespace swell::fuzz {
namespace {

constexpr std::string_view kSettingsBegin = "\n--set\n";

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    lines.emplace_back(text.substr(0, end));
    text.remove_prefix(end == text.npos ? text.size() : end + 1);
  }
  return lines;
}

// Whether one of its numbers or texts may be written in another way.
void check_dump(const scene::Scene& scene) {
  const std::string text = scene::dump_scene(scene);
  const scene::Scene again = scene::parse_scene(text, "/scene.toml");
  expect(scene::dump_scene(again) == text, "a scene's dump makes the same scene");
}

void read_scene(std::string_view input) {
  const std::size_t end = input.find(kSettingsBegin);
  const std::string_view text = input.substr(0, end);
  const std::vector<std::string> settings =
      end == input.npos ? std::vector<std::string>()
                        : lines_of(input.substr(end + kSettingsBegin.size()));
  scene::Scene scene;
  try {
    scene = scene::parse_scene(text, "/scene.toml", settings);
  } catch (const scene::SceneError& error) {
    expect(std::string_view(error.what()).find('\n') == std::string_view::npos,
           "what a scene is refused with is one line");
    return;
  }
  expect(!scene::find_fault(scene), "a scene that is taken has no fault");
  check_dump(scene);
}

}  // namespace
}  // namespace swell::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  swell::fuzz::read_scene({reinterpret_cast<const char*>(data), size});
  return 0;
}
