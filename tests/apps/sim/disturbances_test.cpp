// What disturbs the water from outside: as lines, by its stamps, and for all that see the water.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "apps/messages/cdr.h"
#include "apps/sim/json_inputs.h"
#include "apps/sim/run.h"
#include "apps/sim/sensors.h"
#include "apps/sim/sim_world.h"
#include "render/world/world.h"

namespace swell::apps {
namespace {

constexpr std::int64_t kTick_ns = 100'000'000;
constexpr const char* kDropLine =
    R"({"disturbance": {"kind": "drop", "position_m": [2, 3], "height_m": 0.4}, )"
    R"("stamp_ns": 300000000})";

std::string said_of(const std::string& line) {
  Inputs inputs({});
  testing::internal::CaptureStderr();
  take_json_line(line, {"lines.jsonl", 7}, inputs);
  return testing::internal::GetCapturedStderr();
}

TEST(DisturbanceLines, ThatAreDamagedAreToldOfInOneLine) {
  const std::string begin = "warning: lines.jsonl:7: ", end = "; left out, as are more like it\n";
  EXPECT_EQ(said_of(kDropLine), "");
  EXPECT_EQ(said_of(R"({"disturbance": {"kind": "drop", "radius_m": 100}, "stamp_ns": 0})"),
            begin + "disturbance[0].radius_m, got 100, allowed 0.02 to 50 m" + end);
  EXPECT_EQ(said_of(R"({"disturbance": {"kind": "hull", "path_m": [[0, 0], [9, 0]]},)"
                    R"( "stamp_ns": 0})"),
            begin + "disturbance.kind, got \"hull\", allowed drop, footstep or rotor" + end);
  EXPECT_EQ(said_of(R"({"disturbance": {"kind": "rotor"}, "stamp_ns": -1})"),
            begin + "a disturbance, got the stamp -1 ns, allowed 0 to 2^31 s" + end);
  const std::string deep(30'000, '['), shut(30'000, ']');
  for (const std::string& line :
       {std::string(R"({"disturbance": {"kind": "drop"}})"),
        std::string(R"({"disturbance": {"kind": "drop", "t_s": 4}, "stamp_ns": 0})"),
        std::string(R"({"disturbance": 4, "stamp_ns": 0})"),
        R"({"disturbance": {"kind": )" + deep + shut + R"(}, "stamp_ns": 0})",
        std::string(R"({"disturbance": {"kind": "drop"}, "stamp_ns": 1.5})")})
    EXPECT_TRUE(said_of(line).starts_with(begin + "got another line, allowed {\"clock_ns\""))
        << line;
  for (const std::string& line :
       {std::string(R"({"disturbance": {"kind": "splash"}, "stamp_ns": 0})"),
        std::string(R"({"disturbance": {"kind": "drop", "x": 1}, "stamp_ns": 0})"),
        std::string(R"({"disturbance": {"kind": "drop", "height_m": "a"}, "stamp_ns": 0})")}) {
    const std::string said = said_of(line);
    EXPECT_TRUE(said.starts_with(begin)) << said;
    EXPECT_EQ(std::ranges::count(said, '\n'), 1) << said;
  }
}

TEST(InputDisturbances, AreThereFromTheirStampsOnUpToTheHorizon) {
  InputDisturbances kept;
  kept.add({2'000'000'000, {}});
  kept.set_horizon({1'000'000'000});
  EXPECT_TRUE(kept.at({5'000'000'000}).empty());
  kept.set_horizon({3'000'000'000});
  EXPECT_TRUE(kept.at({1'999'999'999}).empty());
  ASSERT_EQ(kept.at({2'000'000'000}).size(), 1u);
  EXPECT_EQ(kept.at({2'000'000'000})[0].t_s, 2.0);
  kept.set_horizon({603'000'000'000});  // ten minutes later its waves have left
  EXPECT_TRUE(kept.at({603'000'000'000}).empty());
  for (int n = 0; n < 1000; ++n) kept.add({603'000'000'000 + n, {}});
  kept.set_horizon({604'000'000'000});
  EXPECT_EQ(kept.at({604'000'000'000}).size(), 256u);
}

constexpr const char* kQuietSea = "[sky]\nmodel = \"gradient\"\n[sea]\nresolution = 32\n";
constexpr const char* kWatchers = R"(
[[wave_probe]]
name = "probe"
position_m = [2.5, 3.5, 0]
rate_hz = 10
[[camera]]
name = "eye"
position_m = [0, 0, 2]
rpy_deg = [0, 20, 56]
width_px = 64
height_px = 48
rate_hz = 10
[[lidar]]
name = "lidar"
position_m = [0, 0, 2]
pattern = "grid"
columns = 8
rows = 8
rpy_deg = [0, 30, 56]
rate_hz = 10
)";

// The bytes of each topic's messages, by stamps.
class BytesByTopic : public MessageOutput {
 public:
  explicit BytesByTopic(const Simulation& simulation) : simulation_(simulation) {}
  void write(std::size_t topic, std::int64_t stamp_ns, const msg::Message& message) override {
    bytes[simulation_.topics[topic].name][stamp_ns] = cdr_bytes(message);
    if (const auto* point = std::get_if<msg::PointStamped>(&message))
      height_m[stamp_ns] = point->point.z;
  }
  void finish() override {}

  std::map<std::string, std::map<std::int64_t, std::vector<std::uint8_t>>> bytes;
  std::map<std::int64_t, double> height_m;

 private:
  const Simulation& simulation_;
};

struct Watched {
  std::map<std::string, std::map<std::int64_t, std::vector<std::uint8_t>>> bytes;
  std::map<std::int64_t, double> height_m;
  std::vector<double> asked_m;  // of the water with the drop, at the probe's stamps
};

// In lock-step up to 0.6 s, with the lines before the clocks of their times.
Watched watch(const std::map<int, std::string>& line_at_tick, int threads = 1) {
  const scene::Rig rig = scene::parse_rig(kWatchers, "rig.toml", {});
  const render::World world(scene::parse_scene(kQuietSea, "scene.toml"), threads);
  Workers workers(threads);
  InputPoses poses;
  Inputs inputs({});
  SimWorld sim_world(world, rig, workers, &poses, &inputs.disturbances());
  const Simulation simulation = make_simulation(sim_world);
  for (int tick = 0; tick <= 6; ++tick) {
    if (line_at_tick.contains(tick)) take_json_line(line_at_tick.at(tick), {"lines", 1}, inputs);
    inputs.put_clock({"lines", 2}, tick * kTick_ns);
  }
  BytesByTopic kept(simulation);
  MessageOutput* output = &kept;
  run_simulation(simulation, {.duration_s = 10.0, .is_clock_input = true}, {&output, 1}, inputs,
                 poses, [] { return false; });
  Watched watched{kept.bytes, kept.height_m, {}};
  ocean::Disturbance drop;
  drop.position_m = {2.0, 3.0}, drop.height_m = 0.4, drop.t_s = 0.3;
  ocean::SeaFrame sea;
  for (int tick = 0; tick <= 6; ++tick)
    watched.asked_m.push_back(static_cast<double>(
        world.water().at(0.1 * tick, sea, workers, {&drop, 1}).height({2.5, 3.5})));
  return watched;
}

TEST(InputDisturbances, AreSeenByAllThatSeeTheWaterFromTheirStampsOn) {
  const Watched calm = watch({}), disturbed = watch({{2, kDropLine}});
  for (const char* topic : {"/probe", "/eye/image_raw", "/lidar/points"}) {
    const auto &before = calm.bytes.at(topic), &after = disturbed.bytes.at(topic);
    ASSERT_EQ(before.size(), 7u) << topic;
    for (int tick = 0; tick <= 6; ++tick)
      EXPECT_EQ(before.at(tick * kTick_ns) == after.at(tick * kTick_ns), tick < 3)
          << topic << " " << tick;
  }
  for (int tick = 0; tick <= 6; ++tick)
    EXPECT_EQ(disturbed.height_m.at(tick * kTick_ns),
              disturbed.asked_m[static_cast<std::size_t>(tick)])
        << tick;
}

TEST(InputDisturbances, OfTheSameLinesAreTheSameOnAnyThreads) {
  const Watched one = watch({{2, kDropLine}}), two = watch({{3, kDropLine}}, 2);
  EXPECT_EQ(one.bytes, two.bytes);
}

}  // namespace
}  // namespace swell::apps
