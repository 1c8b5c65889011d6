// A rig in a world, for a second.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <variant>

#include "apps/sim/sensors.h"
#include "apps/sim/sim_world.h"
#include "apps/sim/simulation.h"
#include "render/world/world.h"
#include "scene/scene.h"

namespace swell::apps {

inline constexpr const char* kStillSea = R"(
[sky]
model = "gradient"
[wind]
speed_mps = 0
[sea]
resolution = 32
[[object]]
kind = "sphere"
name = "ball"
position_m = [30, 40]
)";

// The last message of each topic of one second of the rig.
inline std::map<std::string, msg::Message> last_messages(const std::string& rig_text,
                                                         const char* scene_text = kStillSea) {
  const scene::Rig rig = scene::parse_rig(rig_text, "rig.toml", {});
  const render::World world(scene::parse_scene(scene_text, "scene.toml"), 1);
  Workers workers(1);
  SimWorld sim_world(world, rig, workers);
  const Simulation simulation = make_simulation(sim_world);
  std::map<std::string, msg::Message> last;
  Schedule schedule(simulation.sources, 1.0);
  for (Schedule::Due due; schedule.next(due);)
    simulation.sources[due.source].publish(
        {due.stamp_ns}, [&](std::size_t topic, const msg::Message& message) {
          EXPECT_TRUE(std::visit([&](const auto& m) { return m.kType; }, message) ==
                      simulation.topics[topic].type);
          last[simulation.topics[topic].name] = message;
        });
  return last;
}

}  // namespace swell::apps
