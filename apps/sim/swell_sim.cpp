// swell-sim: runs the sensors of a rig in a scene.
#include <fmt/core.h>

#include <chrono>
#include <memory>
#include <thread>

#include "apps/mcap/mcap_output.h"
#include "apps/shared/options.h"
#include "apps/shared/output_file.h"
#include "apps/shared/program.h"
#include "apps/sim/costs.h"
#include "apps/sim/sensors.h"
#include "apps/sim/sim_options.h"
#include "apps/sim/sim_world.h"
#include "render/world/world.h"

namespace swell::apps {
namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// Publishes all messages in the order of their stamps; without an output they are only made.
Costs run_schedule(const SimOptions& options, const Simulation& simulation, MessageOutput* output) {
  Costs costs;
  costs.sources.resize(simulation.sources.size());
  costs.duration_s = options.duration_s;
  Schedule schedule(simulation.sources, options.duration_s);
  const Clock::time_point start = Clock::now();
  for (Schedule::Due due; schedule.next(due);) {
    const Clock::time_point stamp = start + std::chrono::nanoseconds(due.stamp_ns);
    if (options.realtime) std::this_thread::sleep_until(stamp);
    const double output_before_ms = costs.output.sum_ms;
    const Clock::time_point begin = Clock::now();
    const auto emit = [&](std::size_t topic, const msg::Message& message) {
      if (!output) return;
      const Clock::time_point given = Clock::now();
      output->write(topic, due.stamp_ns, message);
      costs.output.add(ms_since(given));
    };
    simulation.sources[due.source].publish({due.stamp_ns}, emit);
    costs.sources[due.source].add(ms_since(begin) - (costs.output.sum_ms - output_before_ms));
    if (options.realtime) costs.late_ms.push_back(ms_since(stamp));
  }
  if (output) output->finish();
  costs.wall_s = ms_since(start) / 1e3;
  return costs;
}

void run(const SimOptions& options) {
  if (options.rig_keys) {
    fmt::print("{}", scene::rig_keys_text());
    return;
  }
  select_simd(options.simd);
  if (!options.record.empty()) check_output_place(options.record);  // before the world is made
  const scene::Rig rig = scene::load_rig(options.rig, options.rig_settings);
  scene::Scene scene = load_scene(options.scene);
  scene::check_mounts(rig, scene);
  const render::World world(std::move(scene), options.threads);
  Workers workers(options.threads);
  SimWorld sim_world(world, rig, workers);
  const Simulation simulation = make_simulation(sim_world);
  std::unique_ptr<MessageOutput> output;
  if (!options.record.empty())
    output = std::make_unique<McapOutput>(options.record, simulation.topics);
  const Costs costs = run_schedule(options, simulation, output.get());
  if (options.measure) fmt::print("{}", cost_table(simulation, costs));
  if (output)
    fmt::print("{}: {} messages of {} topics, {} s\n", options.record, costs.output.count,
               simulation.topics.size(), options.duration_s);
}

}  // namespace
}  // namespace swell::apps

int main(int argc, char** argv) {
  return swell::apps::run_program([&] {
    const auto options = swell::apps::parse_sim_options(argc, argv);
    if (options) swell::apps::run(*options);
  });
}
