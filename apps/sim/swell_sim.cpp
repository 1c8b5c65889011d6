// swell-sim: runs the sensors of a rig in a scene.
#include <fmt/core.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <memory>
#include <vector>

#include "apps/gazebo/gazebo_output.h"
#include "apps/mcap/mcap_output.h"
#include "apps/shared/options.h"
#include "apps/shared/output_file.h"
#include "apps/shared/program.h"
#include "apps/sim/costs.h"
#include "apps/sim/json_inputs.h"
#include "apps/sim/ros_inputs.h"
#include "apps/sim/run.h"
#include "apps/sim/sensors.h"
#include "apps/sim/sim_options.h"
#include "apps/sim/sim_world.h"
#include "apps/sim/transport.h"
#include "render/world/world.h"

namespace swell::apps {
namespace {

std::atomic<bool> is_signalled = false;

// From now on they end a run in order; a second one ends the program, and one that is ignored
// (nohup) stays so.
void take_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const auto end = [](int number) {
      is_signalled = true;
      std::signal(number, SIG_DFL);
    };
    if (std::signal(signal, end) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
}

std::vector<std::string> input_frames(const scene::Rig& rig) {
  std::vector<std::string> frames;
  for (const scene::RigBody& body : rig.bodies)
    if (body.is_input) frames.push_back(body.frame);
  return frames;
}

// A rig's body whose pose comes from outside, while nothing can.
void check_inputs(const SimOptions& options, const scene::Rig& rig) {
  for (std::size_t n = 0; n < rig.bodies.size(); ++n)
    if (rig.bodies[n].is_input && !options.takes_inputs())
      scene::refuse_key(
          rig, fmt::format("body[{}].pose", n),
          "got \"input\" without --inputs, --dds on or --gazebo on, allowed with one");
}

// Longer than all sensors of one moment take.
constexpr std::int64_t kAhead_ns = 200'000'000;

std::int64_t system_clock_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

std::vector<std::unique_ptr<Transport>> open_transports(const SimOptions& options) {
  std::vector<std::unique_ptr<Transport>> transports;
  if (options.dds) transports.push_back(open_dds(options.run.is_clock_input));
  if (options.gazebo) transports.push_back(open_gazebo(options.gazebo_poses));
  return transports;
}

void run(const SimOptions& options) {
  if (options.rig_keys) {
    fmt::print("{}{}{}{}{}", scene::rig_keys_text(), kClocksText, kJsonInputsText, kRosInputsText,
               kGazeboText);
    return;
  }
  select_simd(options.simd);
  // Before the world is made:
  if (!options.record.empty()) check_output_place(options.record);
  const std::vector<std::unique_ptr<Transport>> transports = open_transports(options);
  scene::Rig rig = scene::load_rig(options.rig, options.rig_settings);
  check_inputs(options, rig);
  if (options.run.is_clock_input || options.is_system_clock)
    rig.clock_hz = 0.0;  // another publishes it, or nobody
  scene::Scene scene = load_scene(options.scene);
  scene::check_mounts(rig, scene);
  const render::World world(std::move(scene), options.threads);
  Workers workers(options.threads);
  Inputs inputs(input_frames(rig));
  InputPoses poses;
  SimWorld sim_world(world, rig, workers, &poses, &inputs.disturbances());
  const Simulation simulation = make_simulation(sim_world);

  std::vector<std::unique_ptr<MessageOutput>> outputs;
  if (!options.record.empty())
    outputs.push_back(std::make_unique<McapOutput>(options.record, simulation.topics));
  std::vector<std::unique_ptr<InputSource>> sources;
  if (!options.inputs.empty())
    sources.push_back(std::make_unique<JsonInputs>(options.inputs, inputs));
  const bool hears =
      options.inputs.empty() && (options.run.is_clock_input || !inputs.frames().empty());
  for (const auto& transport : transports) {
    outputs.push_back(transport->output(simulation.topics, world.water()));
    if (hears) sources.push_back(transport->source(options.run.is_clock_input, inputs));
    std::fputs(fmt::format("note: {}\n", transport->audience()).c_str(), stderr);
  }

  take_signals();
  std::vector<MessageOutput*> all_outputs;
  for (const auto& output : outputs) all_outputs.push_back(output.get());
  RunSettings settings = options.run;
  if (sources.empty()) settings.ahead_ns = kAhead_ns;
  if (options.is_system_clock) settings.first_ns = system_clock_ns() + settings.ahead_ns;
  const Costs costs = run_simulation(simulation, settings, all_outputs, inputs, poses,
                                     [] { return is_signalled.load(); });
  if (options.run.measure) fmt::print("{}", cost_table(simulation, costs));
  if (!options.record.empty())
    fmt::print("{}: {} messages of {} topics, {} s\n", options.record, costs.given.cost.count,
               simulation.topics.size(), costs.duration_s);
}

}  // namespace
}  // namespace swell::apps

int main(int argc, char** argv) {
  return swell::apps::run_program([&] {
    const auto options = swell::apps::parse_sim_options(argc, argv);
    if (options) swell::apps::run(*options);
  });
}
