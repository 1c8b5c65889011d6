// Rigs of sensors.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "fuzz/expect.h"
#include "scene/file/rig.h"
#include "scene/scene_error.h"

namespace swell::fuzz {
namespace {

void read_rig(std::string_view text) {
  try {
    const scene::Rig rig = scene::parse_rig(text, "rig.toml", {});
    for (const scene::RigBody& body : rig.bodies)
      expect(!body.mount.empty() || body.position_m || body.is_input || !body.path.empty(),
             "a body has a pose");
    for (const scene::Sensor& sensor : rig.sensors)
      expect(sensor.rate_hz > 0.0 && sensor.width_px > 0 && sensor.distortion.size() == 5,
             "a sensor has its values");
  } catch (const scene::SceneError& error) {
    expect(std::string_view(error.what()).find('\n') == std::string_view::npos,
           "what a rig is refused with is one line");
  }
}

}  // namespace
}  // namespace swell::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  swell::fuzz::read_rig({reinterpret_cast<const char*>(data), size});
  return 0;
}
