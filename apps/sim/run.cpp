#include "apps/sim/run.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "apps/sim/message_queue.h"

namespace swell::apps {
namespace {

using Clock = Pace::Clock;

constexpr std::chrono::milliseconds kLongestSleep{50};
constexpr std::int64_t kLookAhead_ns = 1'000'000'000;  // for poses

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
        is_stopped_(is_stopped),
        start_(Clock::now() + std::chrono::nanoseconds(settings.ahead_ns)),
        queue_(outputs,
               settings.realtime ? std::optional(Pace{start_, settings.first_ns}) : std::nullopt,
               settings.measure, simulation.sources.size()) {
    costs_.sources.resize(simulation.sources.size());
  }

  Costs run() {
    if (settings_.is_clock_input)
      follow_inputs();
    else
      follow_own_clock();
    for (MessageOutput* output : outputs_) output->finish();
    costs_.given = queue_.given();
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
      std::optional<std::int64_t> begun_ns;  // a moment that has begun is published whole
      for (Schedule::Due due; schedule.next(due, tick.t_ns);) {
        if (due.stamp_ns != begun_ns && is_stopped_()) break;
        begun_ns = due.stamp_ns;
        publish(due);
      }
      costs_.duration_s = before_s + Moment{tick.t_ns - first_ns}.t_s();
      if (schedule.ends_at(tick.t_ns)) break;
    }
    queue_.finish(false);
  }

  void follow_own_clock() {
    const std::int64_t first_ns = settings_.first_ns;
    Schedule schedule(simulation_.sources, settings_.duration_s, first_ns);
    bool has_begun = false;
    for (Schedule::Due due; schedule.next(due);) {
      if (settings_.realtime) sleep_until(due.stamp_ns - settings_.ahead_ns);
      if (is_stopped_()) break;
      inputs_.take_all(poses_, {due.stamp_ns + kLookAhead_ns});
      if (!std::exchange(has_begun, true)) tell_waiting({due.stamp_ns});
      publish(due);
    }
    const bool is_stopped = is_stopped_();
    queue_.finish(is_stopped);
    costs_.duration_s =
        is_stopped ? Moment{queue_.given().last_stamp_ns - first_ns}.t_s() : settings_.duration_s;
  }

  void sleep_until(std::int64_t stamp_ns) const {
    const Clock::time_point moment = Pace{start_, settings_.first_ns}.time_of(stamp_ns);
    for (auto now = Clock::now(); now < moment && !is_stopped_(); now = Clock::now())
      std::this_thread::sleep_for(std::min<Clock::duration>(moment - now, kLongestSleep));
  }

  void tell_waiting(const Moment& moment) {
    for (const std::string& frame : inputs_.frames())
      if (!poses_.at(frame, moment)) inputs_.tell_waiting(frame);
  }

  void publish(const Schedule::Due& due) {
    const Clock::time_point begin = Clock::now();
    const auto emit = [&](std::size_t topic, msg::Message message) {
      made_.push_back({due.source, topic, due.stamp_ns, std::move(message)});
    };
    simulation_.sources[due.source].publish({due.stamp_ns}, emit);
    costs_.sources[due.source].add(ms_since(begin));
    for (QueuedMessage& message : made_) queue_.put(std::move(message));
    made_.clear();
  }

  const Simulation& simulation_;
  RunSettings settings_;
  std::span<MessageOutput* const> outputs_;
  Inputs& inputs_;
  InputPoses& poses_;
  FunctionRef<bool()> is_stopped_;
  Clock::time_point start_;
  MessageQueue queue_;
  std::vector<QueuedMessage> made_;  // of one source at one stamp
  Costs costs_;
};

}  // namespace

Costs run_simulation(const Simulation& simulation, const RunSettings& settings,
                     std::span<MessageOutput* const> outputs, Inputs& inputs, InputPoses& poses,
                     FunctionRef<bool()> is_stopped) {
  return Run(simulation, settings, outputs, inputs, poses, is_stopped).run();
}

}  // namespace swell::apps
