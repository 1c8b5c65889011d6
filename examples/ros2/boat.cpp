// The boat: floats on the water that swell-sim's wave probes tell of, in lock-step.
//   boat [SECONDS]     10; ends when the clock has shown them
// Each step gives the boat's pose and then the time, waits for the water at the hull's six points
// at this time, and goes on by the physics of hull.h. Nothing depends on how fast anything runs.
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "hull.h"
#include "topics.h"

namespace {

using SteadyClock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr std::int64_t kStep_ns = 10'000'000;  // the probes' rate in boat.toml is 100 Hz
constexpr double kStep_s = 1e-9 * kStep_ns;

class Boat {
 public:
  Boat()
      : clock_(node_, "/clock", rosgraph_msgs_msg_dds__Clock__desc),
        pose_(node_, "/base_link/pose", geometry_msgs_msg_dds__PoseStamped__desc) {
    for (std::size_t n = 0; n < kColumnCount; ++n)
      probes_.emplace_back(node_, "/hull_" + std::to_string(n),
                           geometry_msgs_msg_dds__PointStamped__desc);
    hull_.y_m = -60.0;
    hull_.yaw_rad = 1.4;
    hull_.speed_mps = 1.0;
  }

  // Until swell-sim is there, and knows this program too.
  void wait_for_sim() const {
    const auto end = SteadyClock::now() + std::chrono::seconds(60);
    while (!is_found()) {
      if (SteadyClock::now() > end) throw std::runtime_error("found no swell-sim for a minute");
      std::this_thread::sleep_for(milliseconds(10));
    }
    std::this_thread::sleep_for(milliseconds(1000));
  }

  void run(double seconds) {
    const auto begin = SteadyClock::now();
    const std::int64_t steps = std::llround(seconds / kStep_s);
    for (std::int64_t k = 0; k <= steps; ++k) {
      const std::array<double, kColumnCount> water_z_m = ask_water(k * kStep_ns);
      if (k % 100 == 0)
        std::printf("t %3lld s: heave %+.2f m, roll %+5.1f deg, pitch %+5.1f deg\n",
                    static_cast<long long>(k / 100), hull_.z_m, degrees(hull_.roll_rad),
                    degrees(hull_.pitch_rad));
      hull_.step(water_z_m, kStep_s);
    }
    const std::chrono::duration<double> took = SteadyClock::now() - begin;
    std::printf("%.0f s in %.1f s\n", seconds, took.count());
  }

 private:
  static double degrees(double rad) { return rad * 180.0 / 3.14159265358979; }

  bool is_found() const {
    for (const auto& probe : probes_)
      if (!probe.has_writer()) return false;
    return clock_.has_reader() && pose_.has_reader();
  }

  // Gives pose and time, and waits for the answers of this time. swell-sim hears with best effort:
  // what is lost is said again.
  std::array<double, kColumnCount> ask_water(std::int64_t t_ns) {
    std::array<std::optional<double>, kColumnCount> heights;
    const auto end = SteadyClock::now() + std::chrono::seconds(60);
    for (auto said = SteadyClock::time_point(); !is_whole(heights);) {
      const auto now = SteadyClock::now();
      if (now > end) throw std::runtime_error("no water from swell-sim for a minute");
      if (now - said > milliseconds(500)) {
        say(t_ns);
        said = now;
      }
      if (!take_heights(t_ns, heights)) std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
    std::array<double, kColumnCount> water_z_m{};
    for (std::size_t n = 0; n < kColumnCount; ++n) water_z_m[n] = *heights[n];
    return water_z_m;
  }

  void say(std::int64_t t_ns) {
    char frame[] = "map";
    const Quaternion q = hull_.orientation();
    PoseStamped pose{};
    pose.header = {time_of(t_ns), frame};
    pose.pose = {{hull_.x_m, hull_.y_m, hull_.z_m}, {q.x, q.y, q.z, q.w}};
    pose_.write(pose);
    clock_.write({time_of(t_ns)});
  }

  bool take_heights(std::int64_t t_ns, std::array<std::optional<double>, kColumnCount>& heights) {
    bool has_come = false;
    for (std::size_t n = 0; n < kColumnCount; ++n)
      has_come |= probes_[n].take([&](const PointStamped& water) {
        if (ns_of(water.header.stamp) != t_ns) return;
        const Hull::Place at = hull_.foot(n);
        if (std::hypot(water.point.x - at.x_m, water.point.y - at.y_m) > 1e-6)
          throw std::runtime_error("/hull_" + std::to_string(n) +
                                   ": not at its point of hull.h; do boat.toml and hull.h agree?");
        heights[n] = water.point.z;
      });
    return has_come;
  }

  static bool is_whole(const std::array<std::optional<double>, kColumnCount>& heights) {
    for (const auto& height : heights)
      if (!height) return false;
    return true;
  }

  Participant node_;
  Writer<Clock> clock_;
  Writer<PoseStamped> pose_;
  std::vector<Reader<PointStamped>> probes_;
  Hull hull_;
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
