#include "apps/sim/sim_options.h"

#include <limits>

#include "apps/shared/options.h"

namespace swell::apps {
namespace {

constexpr double kNotGiven_s = 0.0;

// What others follow from the ones that were given.
void complete(SimOptions& options) {
  RunSettings& run = options.run;
  const bool is_endless = run.is_clock_input || options.has_transport();
  if ((options.has_transport() && !run.is_clock_input) || options.is_system_clock)
    run.realtime = true;
  if (run.duration_s == kNotGiven_s)
    run.duration_s = is_endless ? std::numeric_limits<double>::infinity() : 10.0;
}

void check_together(const SimOptions& options) {
  if (options.rig_keys) return;
  if (options.scene.path.empty())
    throw OptionError("command line: --scene, got none, allowed --scene FILE");
  if (options.rig.empty()) throw OptionError("command line: --rig, got none, allowed --rig FILE");
  if (options.record.empty() && !options.run.measure && !options.has_transport())
    throw OptionError(
        "command line: got nothing to do, allowed --record, --dds on, --gazebo on or --measure");
  if (options.run.is_clock_input && !options.takes_inputs())
    throw OptionError(
        "command line: --clock: got input without --inputs, --dds on or --gazebo on, allowed with "
        "one");
  if (options.run.is_clock_input && options.run.realtime)
    throw OptionError("command line: --realtime: got --clock input with it, allowed --clock own");
  if (!options.inputs.empty() && !options.run.is_clock_input && !options.is_system_clock &&
      !options.run.realtime)
    throw OptionError(
        "command line: --inputs: got neither --clock input or system nor --realtime, allowed one "
        "of them");
}

// An option that is one word or, which is true, the other.
CommandLine::Value one_of_two(const std::string& name, const std::string& kind,
                              const std::string& no, const std::string& yes, bool& is_yes,
                              const std::string& help) {
  return {name, kind, no, help, [=, &is_yes](const std::string& text) {
            if (text != no && text != yes)
              throw OptionError("command line: " + name + ": got '" + text + "', allowed " + no +
                                " or " + yes);
            is_yes = text == yes;
          }};
}

void take_clock(const std::string& text, SimOptions& options) {
  if (text != "own" && text != "input" && text != "system")
    throw OptionError("command line: --clock: got '" + text + "', allowed own, input or system");
  options.run.is_clock_input = text == "input";
  options.is_system_clock = text == "system";
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
  options.run.duration_s = kNotGiven_s;
  add_number(line, "--duration", options.run.duration_s, 1e-3, 1e6,
             "Seconds, from 0 on: 10; endless with --clock input, --dds on, --gazebo on");
  line.add_flag("--realtime", options.run.realtime, "Wait for each stamp");
  line.add_value({"--clock", "CLOCK", "own",
                  "own; input: lock-step with /clock or --inputs; system: UTC",
                  [&](const std::string& text) { take_clock(text, options); }});
  line.add_text("--inputs", "FILE", options.inputs,
                "Clock, poses, drops (--rig-keys); - is standard input");
  line.add_value(one_of_two("--dds", "WHETHER", "off", "on", options.dds,
                            "on: ROS 2 topics (--rig-keys); off: no open port"));
  line.add_value(one_of_two("--gazebo", "WHETHER", "off", "on", options.gazebo,
                            "on: Gazebo's transport (--rig-keys); off: no open port"));
  line.add_text("--gazebo-poses", "TOPIC", options.gazebo_poses, "Instead of /model/FRAME/pose");
  line.need("--gazebo-poses", "--gazebo");
  line.add_flag("--measure", options.run.measure, "Print what each sensor costs");
  add_machine_options(line, options.threads, options.simd);
  if (!line.parse(argc, argv)) return std::nullopt;
  check_together(options);
  complete(options);
  return options;
}

}  // namespace swell::apps
