// swell-sim's command line.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/shared/notices.h"
#include "apps/sim/run.h"
#include "math/parallel.h"

namespace swell::apps {

struct SimOptions {
  SceneChoice scene;
  std::string rig;  // file
  std::vector<std::string> rig_settings;
  std::string record;  // file; empty: none
  std::string inputs;  // file, "-" or empty: none
  bool dds = false, gazebo = false;
  std::string gazebo_poses;  // topic
  bool is_system_clock = false;
  RunSettings run;
  bool rig_keys = false;
  int threads = available_cpus();
  std::string simd;

  bool has_transport() const { return dds || gazebo; }
  bool takes_inputs() const { return !inputs.empty() || has_transport(); }
};

// What --rig-keys says of the clocks.
inline constexpr std::string_view kClocksText = R"(
--clock own: stamps begin at 0. --clock system: stamps are UTC, as those of a ROS 2 node without
simulated time, in real time; the scene's time is the stamp, so that what happens once in a scene is
long past; there is no /clock.
)";

// Nothing if --help or --version was asked for. Throws OptionError.
std::optional<SimOptions> parse_sim_options(int argc, char** argv);

}  // namespace swell::apps
