// Runs in lock-step with a clock from outside.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "apps/messages/cdr.h"
#include "apps/sim/run.h"
#include "apps/sim/sensors.h"
#include "apps/sim/sim_world.h"
#include "render/world/world.h"
#include "scene/scene_error.h"

namespace swell::apps {
namespace {

constexpr std::int64_t kStep_ns = 1'000'000;  // a millisecond
constexpr InputOrigin kClockTopic{"/here"};

StampedPose boat_pose(std::int64_t stamp_ns, const glm::dvec3& position_m) {
  return {stamp_ns, position_m, {1.0, 0.0, 0.0, 0.0}};
}

constexpr const char* kSea = R"(
[sky]
model = "gradient"
[sea]
resolution = 32
)";
constexpr const char* kSensorsText = R"(
[[pose]]
name = "tip"
body = "boat"
rate_hz = 100
[[odometry]]
name = "odom"
body = "boat"
[[imu]]
name = "imu"
body = "boat"
position_m = [2, 0, 0]
[[wave_probe]]
name = "probe"
body = "boat"
rate_hz = 25
)";

// Messages of a run: the topic, the stamp and the bytes.
class KeptMessages : public MessageOutput {
 public:
  struct Entry {
    std::string topic;
    std::int64_t stamp_ns;
    std::vector<std::uint8_t> bytes;
    bool operator==(const Entry&) const = default;
  };

  explicit KeptMessages(const Simulation& simulation) : simulation_(simulation) {}
  void write(std::size_t topic, std::int64_t stamp_ns, const msg::Message& message) override {
    entries.push_back({simulation_.topics[topic].name, stamp_ns, cdr_bytes(message)});
    last[entries.back().topic] = message;
  }
  void finish() override { is_finished = true; }

  std::vector<Entry> entries;
  std::map<std::string, msg::Message> last;
  bool is_finished = false;

 private:
  const Simulation& simulation_;
};

struct RunOf {
  std::vector<KeptMessages::Entry> entries;
  std::map<std::string, msg::Message> last;
};

template <class Put>
RunOf run_of(const std::string& rig_text, const RunSettings& settings, const Put& put,
             int threads = 1, const std::string& scene_text = kSea) {
  const scene::Rig rig = scene::parse_rig(rig_text, "rig.toml", {});
  const render::World world(scene::parse_scene(scene_text, "scene.toml"), threads);
  Workers workers(threads);
  InputPoses poses;
  SimWorld sim_world(world, rig, workers, &poses);
  const Simulation simulation = make_simulation(sim_world);
  Inputs inputs({"boat"});
  put(inputs);
  KeptMessages kept(simulation);
  MessageOutput* output = &kept;
  run_simulation(simulation, settings, {&output, 1}, inputs, poses, [] { return false; });
  EXPECT_TRUE(kept.is_finished);
  return {kept.entries, kept.last};
}

TEST(LockStep, PublishesWhatAClockOfItsOwnDoes) {
  const std::string rig = std::string(
                              "[[body]]\nframe = \"boat\"\n[[body.path]]\nt_s = 0\n"
                              "[[body.path]]\nt_s = 1\nposition_m = [10, 0, 0]\n") +
                          kSensorsText;
  const RunOf own = run_of(rig, {.duration_s = 0.5}, [](Inputs&) {});
  for (const std::int64_t step : {7 * kStep_ns, 10 * kStep_ns, 250 * kStep_ns}) {
    const RunSettings settings = {.duration_s = 0.5, .is_clock_input = true};
    const RunOf outside = run_of(rig, settings, [&](Inputs& inputs) {
      for (std::int64_t t = 0; t < 1000 * kStep_ns; t += step) inputs.put_clock(kClockTopic, t);
    });
    EXPECT_EQ(own.entries, outside.entries) << step;
  }
}

// A boat that goes east at 3 m/s from its pose at 100 ms on.
template <class Put>
void put_boat(Inputs& inputs, const Put& put_between) {
  for (std::int64_t t = 0; t <= 500 * kStep_ns; t += 10 * kStep_ns) {
    if (t >= 100 * kStep_ns && t % (20 * kStep_ns) == 0)
      inputs.put_pose(kClockTopic, "boat", boat_pose(t, {3.0 * Moment{t}.t_s(), 1, 2}));
    put_between(t);
    inputs.put_clock(kClockTopic, t);
  }
}

TEST(LockStep, SensorsOfABodyWaitForItsFirstPoseAndThenGoWithIt) {
  const std::string rig =
      "[[body]]\nframe = \"boat\"\npose = \"input\"\n" + std::string(kSensorsText);
  const RunSettings settings = {.duration_s = 10.0, .is_clock_input = true};
  testing::internal::CaptureStderr();
  const RunOf run =
      run_of(rig, settings, [](Inputs& inputs) { put_boat(inputs, [](std::int64_t) {}); });
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "note: body boat: no pose has come yet; what is on it waits\n");
  std::map<std::string, std::vector<std::int64_t>> stamps;
  for (const auto& entry : run.entries) stamps[entry.topic].push_back(entry.stamp_ns / kStep_ns);
  EXPECT_EQ(stamps["/tip"].front(), 100);
  EXPECT_EQ(stamps["/tip"].size(), 41u);
  EXPECT_EQ(stamps["/tf"].size(), 21u);
  EXPECT_EQ(stamps["/probe"].front(), 120);
  EXPECT_EQ(stamps["/odom"].front(), 180);  // two steps of 40 ms later
  EXPECT_EQ(stamps["/imu/data"].front(), 180);
  const auto& tip = std::get<msg::PoseStamped>(run.last.at("/tip")).pose.position;
  EXPECT_NEAR(tip.x, 1.5, 1e-12);
  const auto& odom = std::get<msg::Odometry>(run.last.at("/odom"));
  EXPECT_NEAR(odom.twist.twist.linear.x, 3.0, 1e-9);
  const auto& imu = std::get<msg::Imu>(run.last.at("/imu/data"));
  EXPECT_NEAR(imu.linear_acceleration.x, 0.0, 1e-9);
  EXPECT_NEAR(imu.linear_acceleration.z, 9.81, 1e-9);
}

constexpr const char* kBeamAlongX = R"(
[[lidar]]
name = "lidar"
position_m = [0, 40, 0.3]
pattern = "grid"
columns = 1
rows = 1
fov_x_deg = 0.01
fov_y_deg = 0.01
)";

TEST(LockStep, LidarsMeetAnObjectWhereItsPoseFromOutsideIs) {
  const std::string rig =
      std::string("[[body]]\nframe = \"boat\"\nmount = \"ball\"\npose = \"input\"\n") + kBeamAlongX;
  const std::string scene = std::string(kSea) +
                            "[wind]\nspeed_mps = 0\n[[object]]\nkind = \"sphere\"\n"
                            "name = \"ball\"\nposition_m = [30, 40]\n";
  const auto range_m = [&](double x_m) {
    const RunSettings settings = {.duration_s = 0.05, .is_clock_input = true};
    const RunOf run = run_of(
        rig, settings,
        [&](Inputs& inputs) {
          inputs.put_pose(kClockTopic, "boat", boat_pose(0, {x_m, 40.0, 0.0}));
          inputs.put_clock(kClockTopic, 0);
        },
        1, scene);
    const auto& cloud = std::get<msg::PointCloud2>(run.last.at("/lidar/points"));
    float x;
    std::memcpy(&x, cloud.data.data(), sizeof x);  // the first field
    return static_cast<double>(x);
  };
  const double near_m = range_m(20.0);
  EXPECT_GT(near_m, 15.0);
  EXPECT_LT(near_m, 20.0);
  EXPECT_NEAR(range_m(27.0), near_m + 7.0, 1e-4);
}

TEST(LockStep, LidarsOnABodyFromOutsideHaveNoRollingShutter) {
  const std::string rig = "[[body]]\nframe = \"boat\"\npose = \"input\"\n" +
                          std::string(kBeamAlongX) + "body = \"boat\"\nrolling_shutter = true\n";
  try {
    run_of(rig, {.duration_s = 0.05, .is_clock_input = true}, [](Inputs&) {});
    FAIL() << "taken";
  } catch (const scene::SceneError& error) {
    EXPECT_EQ(
        std::string(error.what()),
        "rig.toml:14: column 19: lidar[0].rolling_shutter, got true on a body whose pose comes "
        "from outside, allowed false: where it will be is not known");
  }
}

TEST(LockStep, OfTheSameInputsIsTheSameWhateverComesTooEarlyAndOnAnyThreads) {
  const std::string rig =
      "[[body]]\nframe = \"boat\"\npose = \"input\"\n" + std::string(kSensorsText);
  const RunSettings settings = {.duration_s = 10.0, .is_clock_input = true};
  const auto plain = [](Inputs& inputs) { put_boat(inputs, [](std::int64_t) {}); };
  // The pose of the next step is there before the clock of this one.
  const auto early = [](Inputs& inputs) {
    put_boat(inputs, [&](std::int64_t t) {
      if (t >= 100 * kStep_ns && t % (20 * kStep_ns) == 0)
        inputs.put_pose(
            kClockTopic, "boat",
            boat_pose(t + 20 * kStep_ns, {3.0 * Moment{t + 20 * kStep_ns}.t_s(), 1, 2}));
    });
  };
  const RunOf first = run_of(rig, settings, plain);
  EXPECT_EQ(first.entries, run_of(rig, settings, plain, 2).entries);
  EXPECT_EQ(first.entries, run_of(rig, settings, early).entries);
}

TEST(LockStep, StartsItsSensorsAgainWhereTheClockGoesBack) {
  const std::string rig = "[[wave_probe]]\nname = \"probe\"\nrate_hz = 10\n";
  const RunSettings settings = {.duration_s = 10.0, .is_clock_input = true};
  const RunOf run = run_of(rig, settings, [](Inputs& inputs) {
    for (const std::int64_t t : {1'050, 1'250, 150, 250})
      inputs.put_clock(kClockTopic, t * kStep_ns);
  });
  std::vector<std::int64_t> stamps;
  for (const auto& entry : run.entries)
    if (entry.topic == "/probe") stamps.push_back(entry.stamp_ns / kStep_ns);
  EXPECT_EQ(stamps, (std::vector<std::int64_t>{1'100, 1'200, 200}));
}

TEST(LockStep, ThatIsStoppedHasPublishedItsLastMomentWhole) {
  bool is_stopped = false;
  Simulation simulation;
  std::vector<std::string> made;
  for (const char* name : {"a", "b", "c"})
    simulation.sources.push_back({name, "", 100.0, [&, name](const Moment& moment, const Emit&) {
                                    made.push_back(name + std::to_string(moment.t_ns / kStep_ns));
                                    if (made.back() == "a10") is_stopped = true;
                                  }});
  Inputs inputs({});
  InputPoses poses;
  inputs.put_clock(kClockTopic, 0);
  inputs.put_clock(kClockTopic, 50 * kStep_ns);
  run_simulation(simulation, {.is_clock_input = true}, {}, inputs, poses,
                 [&] { return is_stopped; });
  EXPECT_EQ(made, (std::vector<std::string>{"a0", "b0", "c0", "a10", "b10", "c10"}));
}

TEST(LockStep, AnObjectIsDrawnWhereItsPoseFromOutsideIs) {
  const std::string rig =
      "[[body]]\nframe = \"boat\"\nmount = \"ball\"\npose = \"input\"\n[[camera]]\nname = \"eye\"\n"
      "position_m = [0, 0, 2]\nwidth_px = 64\nheight_px = 64\nid = true\nrate_hz = 10\n";
  const std::string sea =
      std::string(kSea) + "[[object]]\nkind = \"sphere\"\nname = \"ball\"\nposition_m = [0, 500]\n";
  const RunSettings settings = {.duration_s = 10.0, .is_clock_input = true};
  std::vector<double> columns;  // the middle of the ball, along the picture
  for (const double y_m : {2.0, 0.0, -2.0}) {
    const RunOf run = run_of(
        rig, settings,
        [&](Inputs& inputs) {
          inputs.put_pose(kClockTopic, "boat", boat_pose(0, {10.0, y_m, 2.0}));
          inputs.put_clock(kClockTopic, 0);
        },
        1, sea);
    const auto& image = std::get<msg::Image>(run.last.at("/eye/id"));
    const auto id_at = [&](std::size_t pixel) {
      std::int32_t id = 0;
      std::memcpy(&id, image.data.data() + 4 * pixel, sizeof id);
      return id;
    };
    const std::int32_t water = id_at(64 * 64 - 1);
    double sum = 0.0, count = 0.0;
    for (std::size_t pixel = 0; pixel < 64 * 64; ++pixel) {
      if (id_at(pixel) == 0 || id_at(pixel) == water) continue;
      sum += static_cast<double>(pixel % 64) + 0.5;
      count += 1.0;
    }
    ASSERT_GT(count, 5.0) << y_m;
    columns.push_back(sum / count);
  }
  // The focal length is 32 px over the tangent of half of 50 degrees.
  const double px_per_m = 32.0 / std::tan(25.0 * 3.14159265 / 180.0) / 10.0;
  EXPECT_NEAR(columns[0], 32.0 - 2.0 * px_per_m, 1.0);
  EXPECT_NEAR(columns[1], 32.0, 0.5);
  EXPECT_NEAR(columns[2], 32.0 + 2.0 * px_per_m, 1.0);
}

}  // namespace
}  // namespace swell::apps
