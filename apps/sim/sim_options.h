// swell-sim's command line.
#pragma once

#include <optional>
#include <string>
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
  RunSettings run;
  bool rig_keys = false;
  int threads = available_cpus();
  std::string simd;

  bool has_transport() const { return dds || gazebo; }
  bool takes_inputs() const { return !inputs.empty() || has_transport(); }
};

// Nothing if --help or --version was asked for. Throws OptionError.
std::optional<SimOptions> parse_sim_options(int argc, char** argv);

}  // namespace swell::apps
