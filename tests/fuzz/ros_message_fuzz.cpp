// Inputs of swell-sim: clocks and poses as messages of ROS 2 (first byte c, p), and these and
// disturbances as lines of JSON (any other).
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string_view>

#include "apps/sim/inputs.h"
#include "apps/sim/json_inputs.h"
#include "apps/sim/ros_inputs.h"
#include "fuzz/expect.h"

namespace swell::fuzz {
namespace {

void read_input(std::uint8_t kind, std::span<const std::uint8_t> bytes) {
  apps::Inputs inputs({"boat"});
  if (kind == 'c')
    apps::take_clock_message(bytes, {"/clock"}, inputs);
  else if (kind == 'p')
    apps::take_pose_message(bytes, "boat", {"/boat/pose"}, inputs);
  else
    apps::take_json_line({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, {"lines", 1},
                         inputs);
  inputs.put_clock({"/clock"}, 2'000'000'000'000'000'000);  // behind the pose, if there is one
  apps::InputPoses poses;
  for (apps::Inputs::Tick tick; inputs.next_tick(tick, poses, [] { return false; });) {
    for (const ocean::Disturbance& made : inputs.disturbances().at({tick.t_ns}))
      expect(std::isfinite(made.position_m.x + made.position_m.y) &&
                 std::abs(made.height_m) <= 10.0 && made.radius_m >= 0.02,
             "a disturbance is one that scenes may have");
    const auto pose = poses.at("boat", {tick.t_ns});
    if (!pose) continue;
    for (int i = 0; i < 3; ++i) {
      expect(glm::abs(pose->position_m[i]) <= 1e6, "a pose is near");
      expect(glm::abs(glm::length(pose->axes[i]) - 1.0) < 1e-9, "axes are of length 1");
    }
  }
}

}  // namespace
}  // namespace swell::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 0) swell::fuzz::read_input(data[0], {data + 1, size - 1});
  return 0;
}
