// swell-sim's command line.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/shared/notices.h"
#include "math/parallel.h"

namespace swell::apps {

struct SimOptions {
  SceneChoice scene;
  std::string rig;  // file
  std::vector<std::string> rig_settings;
  std::string record;  // file; empty: none
  double duration_s = 10.0;
  bool realtime = false, measure = false, rig_keys = false;
  int threads = available_cpus();
  std::string simd;
};

// Nothing if --help or --version was asked for. Throws OptionError.
std::optional<SimOptions> parse_sim_options(int argc, char** argv);

}  // namespace swell::apps
