#include "apps/sim/sim_options.h"

#include "apps/shared/options.h"

namespace swell::apps {
namespace {

void check_together(const SimOptions& options) {
  if (options.rig_keys) return;
  if (options.scene.path.empty())
    throw OptionError("command line: --scene, got none, allowed --scene FILE");
  if (options.rig.empty()) throw OptionError("command line: --rig, got none, allowed --rig FILE");
  if (options.record.empty() && !options.measure)
    throw OptionError("command line: got nothing to do, allowed --record or --measure");
}

}  // namespace

std::optional<SimOptions> parse_sim_options(int argc, char** argv) {
  SimOptions options;
  CommandLine line("swell-sim", "Runs the sensors of a rig in a scene.");
  add_scene_options(line, options.scene);
  line.add_text("--rig", "FILE", options.rig, "Bodies and sensors (TOML; --rig-keys)");
  line.add_texts("--rig-set", "KEY=VALUE", options.rig_settings, "As --set, of the rig");
  line.add_flag("--rig-keys", options.rig_keys, "Print the keys of rigs");
  line.add_text("--record", "FILE", options.record, "Write ROS 2 messages: .mcap");
  add_number(line, "--duration", options.duration_s, 1e-3, 1e6, "Seconds, from 0 on");
  line.add_flag("--realtime", options.realtime, "Wait for each stamp");
  line.add_flag("--measure", options.measure, "Print what each sensor costs");
  add_machine_options(line, options.threads, options.simd);
  if (!line.parse(argc, argv)) return std::nullopt;
  check_together(options);
  return options;
}

}  // namespace swell::apps
