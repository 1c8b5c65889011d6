#include "apps/sim/run.h"

#include <algorithm>
#include <chrono>
#include <thread>

namespace swell::apps {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kLongestSleep{50};
constexpr std::int64_t kAhead_ns = 1'000'000'000;

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

class Run {
 public:
  Run(const Simulation& simulation, const RunSettings& settings,
      std::span<MessageOutput* const> outputs, Inputs& inputs, InputPoses& poses,
      FunctionRef<bool()> is_stopped)
      : simulation_(simulation),
        settings_(settings),
        outputs_(outputs),
        inputs_(inputs),
        poses_(poses),
        is_stopped_(is_stopped) {
    costs_.sources.resize(simulation.sources.size());
  }

  Costs run() {
    if (settings_.is_clock_input)
      follow_inputs();
    else
      follow_own_clock();
    for (MessageOutput* output : outputs_) output->finish();
    costs_.wall_s = ms_since(start_) / 1e3;
    return costs_;
  }

 private:
  void follow_inputs() {
    Schedule schedule({}, 0.0);
    std::int64_t first_ns = 0;
    double before_s = 0.0;  // until the last jump
    for (Inputs::Tick tick; inputs_.next_tick(tick, poses_, is_stopped_);) {
      if (tick.is_start) {
        schedule = Schedule(simulation_.sources, settings_.duration_s, tick.t_ns);
        first_ns = tick.t_ns;
        before_s = costs_.duration_s;
        tell_waiting({tick.t_ns});
      }
      for (Schedule::Due due; !is_stopped_() && schedule.next(due, tick.t_ns);) publish(due);
      costs_.duration_s = before_s + Moment{tick.t_ns - first_ns}.t_s();
      if (schedule.ends_at(tick.t_ns)) break;
    }
  }

  void follow_own_clock() {
    Schedule schedule(simulation_.sources, settings_.duration_s);
    for (Schedule::Due due; schedule.next(due);) {
      if (settings_.realtime) sleep_until(start_ + std::chrono::nanoseconds(due.stamp_ns));
      if (is_stopped_()) break;
      inputs_.take_poses(poses_);
      poses_.set_horizon({due.stamp_ns + kAhead_ns});
      if (due.stamp_ns == 0) tell_waiting({0});
      publish(due);
      costs_.duration_s = Moment{due.stamp_ns}.t_s();
    }
    if (!is_stopped_()) costs_.duration_s = settings_.duration_s;
  }

  void sleep_until(Clock::time_point stamp) const {
    for (auto now = Clock::now(); now < stamp && !is_stopped_(); now = Clock::now())
      std::this_thread::sleep_for(std::min<Clock::duration>(stamp - now, kLongestSleep));
  }

  void tell_waiting(const Moment& moment) {
    for (const std::string& frame : inputs_.frames())
      if (!poses_.at(frame, moment)) inputs_.tell_waiting(frame);
  }

  void publish(const Schedule::Due& due) {
    const double output_before_ms = costs_.output.sum_ms;
    const Clock::time_point begin = Clock::now();
    const auto emit = [&](std::size_t topic, const msg::Message& message) {
      const Clock::time_point given = Clock::now();
      for (MessageOutput* output : outputs_) output->write(topic, due.stamp_ns, message);
      if (!outputs_.empty()) costs_.output.add(ms_since(given));
      if (settings_.realtime && settings_.measure)
        costs_.late_ms.push_back(ms_since(start_ + std::chrono::nanoseconds(due.stamp_ns)));
    };
    simulation_.sources[due.source].publish({due.stamp_ns}, emit);
    costs_.sources[due.source].add(ms_since(begin) - (costs_.output.sum_ms - output_before_ms));
  }

  const Simulation& simulation_;
  RunSettings settings_;
  std::span<MessageOutput* const> outputs_;
  Inputs& inputs_;
  InputPoses& poses_;
  FunctionRef<bool()> is_stopped_;
  Clock::time_point start_ = Clock::now();
  Costs costs_;
};

}  // namespace

Costs run_simulation(const Simulation& simulation, const RunSettings& settings,
                     std::span<MessageOutput* const> outputs, Inputs& inputs, InputPoses& poses,
                     FunctionRef<bool()> is_stopped) {
  return Run(simulation, settings, outputs, inputs, poses, is_stopped).run();
}

}  // namespace swell::apps
