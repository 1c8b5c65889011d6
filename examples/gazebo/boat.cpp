// The boat: floats on the water that swell-sim's service /water/heights tells of, in lock-step.
//   boat [SECONDS]     10; ends when the clock has shown them
// Each step gives the boat's pose and then the time, waits until swell-sim has published all of
// this time, asks for the water at the hull's six points and goes on by the physics of hull.h.
// Nothing depends on how fast anything runs.
//
// A server of Gazebo would do the physics by DART (libignition-physics). The six columns of hull.h
// are fewer lines than loading that plugin, a world of SDF for the mass, and the forces on its
// link.
#include <array>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "hull.h"
#include "transport.h"

namespace {

using SteadyClock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr std::int64_t kStep_ns = 10'000'000;  // the probe's rate in boat.toml is 100 Hz
constexpr double kStep_s = 1e-9 * kStep_ns;
constexpr unsigned kPatience_ms = 60'000;

class Boat {
 public:
  Boat()
      : clock_(node_.Advertise<msgs::Clock>("/clock")),
        pose_(node_.Advertise<msgs::Pose>("/model/base_link/pose")) {
    hull_.y_m = -60.0;
    hull_.yaw_rad = 1.4;
    hull_.speed_mps = 1.0;
    node_.Subscribe("/bow_wave", &Boat::hear, this);
  }

  // Until swell-sim is there, and knows this program too.
  void wait_for_sim() {
    const auto end = SteadyClock::now() + milliseconds(kPatience_ms);
    std::vector<transport::ServicePublisher> services;
    while (!clock_.HasConnections() || !pose_.HasConnections() ||
           !node_.ServiceInfo("/water/heights", services)) {
      if (SteadyClock::now() > end) throw std::runtime_error("found no swell-sim for a minute");
      std::this_thread::sleep_for(milliseconds(10));
    }
    std::this_thread::sleep_for(milliseconds(1000));
  }

  void run(double seconds) {
    const auto begin = SteadyClock::now();
    const std::int64_t steps = std::llround(seconds / kStep_s);
    for (std::int64_t k = 0; k <= steps; ++k) {
      say(k * kStep_ns);
      wait_for_answer(k * kStep_ns);
      if (k % 100 == 0)
        std::printf("t %3lld s: heave %+.2f m, roll %+5.1f deg, pitch %+5.1f deg\n",
                    static_cast<long long>(k / 100), hull_.z_m, degrees(hull_.roll_rad),
                    degrees(hull_.pitch_rad));
      hull_.step(ask_water(k * kStep_ns), kStep_s);
    }
    const std::chrono::duration<double> took = SteadyClock::now() - begin;
    std::printf("%.0f s in %.1f s\n", seconds, took.count());
  }

 private:
  static double degrees(double rad) { return rad * 180.0 / 3.14159265358979; }

  void say(std::int64_t t_ns) {
    const Quaternion q = hull_.orientation();
    msgs::Pose pose;
    set_time(t_ns, pose.mutable_header()->mutable_stamp());
    pose.set_name("base_link");
    pose.mutable_position()->set_x(hull_.x_m);
    pose.mutable_position()->set_y(hull_.y_m);
    pose.mutable_position()->set_z(hull_.z_m);
    pose.mutable_orientation()->set_x(q.x);
    pose.mutable_orientation()->set_y(q.y);
    pose.mutable_orientation()->set_z(q.z);
    pose.mutable_orientation()->set_w(q.w);
    pose_.Publish(pose);
    msgs::Clock clock;
    set_time(t_ns, clock.mutable_sim());
    clock_.Publish(clock);
  }

  // The bow's probe is the last sensor of boat.toml: of a time it comes when all has been
  // published.
  void hear(const msgs::Vector3d& wave) {
    const std::lock_guard<std::mutex> lock(mutex_);
    answered_ns_ = ns_of(wave.header().stamp());
    has_come_.notify_one();
  }

  void wait_for_answer(std::int64_t t_ns) {
    std::unique_lock<std::mutex> lock(mutex_);
    if (!has_come_.wait_for(lock, milliseconds(kPatience_ms), [&] { return answered_ns_ >= t_ns; }))
      throw std::runtime_error("no answer of swell-sim for a minute");
  }

  std::array<double, kColumnCount> ask_water(std::int64_t t_ns) {
    msgs::Pose_V feet, water;
    set_time(t_ns, feet.mutable_header()->mutable_stamp());
    for (std::size_t n = 0; n < kColumnCount; ++n) {
      const Hull::Place at = hull_.foot(n);
      msgs::Vector3d& position = *feet.add_pose()->mutable_position();
      position.set_x(at.x_m);
      position.set_y(at.y_m);
    }
    bool is_answered = false;
    if (!node_.Request("/water/heights", feet, kPatience_ms, water, is_answered) || !is_answered)
      throw std::runtime_error("/water/heights gave no answer");
    std::array<double, kColumnCount> water_z_m{};
    for (std::size_t n = 0; n < kColumnCount; ++n)
      water_z_m[n] = water.pose(static_cast<int>(n)).position().z();
    return water_z_m;
  }

  std::mutex mutex_;
  std::condition_variable has_come_;
  std::int64_t answered_ns_ = -1;
  Hull hull_;
  transport::Node node_;  // ends first: its handlers use the others
  transport::Node::Publisher clock_, pose_;
};

}  // namespace

int main(int argc, char** argv) {
  try {
    Boat boat;
    boat.wait_for_sim();
    boat.run(argc > 1 ? std::stod(argv[1]) : 10.0);
    return 0;
  } catch (const std::exception& fault) {
    return std::fprintf(stderr, "boat: %s\n", fault.what()), 1;
  }
}
