// What comes into a simulation from outside: the clock, poses of bodies, and what disturbs the
// water. Transports put it in
// from threads of their own; the loop takes it out in the order in which it came, so that a run
// depends on this order and on what came alone.
//
//   Inputs inputs({"base_link"});
//   JsonInputs lines("boat.jsonl", inputs);  // or another InputSource
//   for (Inputs::Tick tick; inputs.next_tick(tick, poses, is_stopped);)
//     ... publish all that is due up to tick.t_ns
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "apps/sim/input_disturbances.h"
#include "apps/sim/input_poses.h"
#include "math/parallel.h"

namespace swell::apps {

// Where something came from, for what is said of it: a topic, or a file with the line.
struct InputOrigin {
  std::string_view topic;
  std::int64_t line = 0;  // 0: none
};

class Inputs {
 public:
  // The frames of bodies whose poses come from outside.
  explicit Inputs(std::vector<std::string> frames) : frames_(std::move(frames)) {}
  Inputs(const Inputs&) = delete;
  Inputs& operator=(const Inputs&) = delete;

  const std::vector<std::string>& frames() const { return frames_; }

  // ---- For transports: any number of threads. What is not right is left out and told of in one
  // line 'warning: TOPIC: ...' on standard error, the first time for each topic.

  // The time, from 0 to 2^31 s.
  void put_clock(const InputOrigin& from, std::int64_t t_ns);

  // Of a body's frame in "map": at most 1e6 m along each axis, with an orientation of length 1 to
  // within 1 %, stamped from 0 to 2^31 s. Put those of a time before the clock of that time, or
  // next_tick() has to wait for them.
  void put_pose(const InputOrigin& from, std::string_view frame, const StampedPose& pose);

  // A drop, a footstep or a rotor, stamped as poses are, with values that scenes allow. Put those
  // of a time before the clock of that time.
  void put_disturbance(const InputOrigin& from, const StampedDisturbance& disturbance);

  // Says what is wrong with something that could not be read.
  void refuse(const InputOrigin& from, const std::string& what);

  // Something may come until as many ends have been told of as beginnings. Where 65536 things wait
  // the put functions wait for the loop, at most until stop().
  void begin();
  void end();
  void stop();

  // ---- For the loop, one thread.

  struct Tick {
    std::int64_t t_ns = 0;
    bool is_start = false;  // the first one, or after a jump
  };

  // Waits for the next time that the clock shows and adds the poses and disturbances that came
  // before it, up to which they are looked at. A clock that goes back, or ahead by more than 10 s,
  // starts again there as simulators do at a reset: what came before is forgotten, what came since
  // stays if it is of this time or before. One line says so the first time. False at the end of all
  // inputs, and once is_stopped() holds, which is asked every 50 ms.
  // A pose that comes after the clock of its time is missing in what is of that time; one line says
  // so the first time. From then on a time waits for a pose of this body: until one of this time or
  // later has come or the clock has gone on, at most half a second.
  bool next_tick(Tick& tick, InputPoses& poses, FunctionRef<bool()> is_stopped);

  // Adds what has come, up to the horizon, for a loop with a clock of its own.
  void take_all(InputPoses& poses, const Moment& horizon);

  // Those that were taken.
  const InputDisturbances& disturbances() const { return disturbances_; }

  // Says once for each body that what is on it waits for its first pose.
  void tell_waiting(std::string_view frame);

 private:
  struct Event {
    std::string topic;  // of a clock or a pose
    std::string frame;  // of a pose
    StampedPose pose;   // without a frame: the clock's time
    std::optional<StampedDisturbance> disturbance = {};

    bool is_clock() const { return frame.empty() && !disturbance; }
    std::int64_t stamp_ns() const { return disturbance ? disturbance->stamp_ns : pose.stamp_ns; }
  };

  using Lock = std::unique_lock<std::mutex>;

  void put(Event event);
  bool keep(const Event& event, InputPoses& poses);  // it is no clock; false: it was there
  // With the mutex held:
  bool take(Event& event);
  std::optional<Event> take_clock(std::vector<Event>& before, Lock& lock,
                                  FunctionRef<bool()> is_stopped);
  void await_late(const Moment& moment, InputPoses& poses, Lock& lock,
                  FunctionRef<bool()> is_stopped);
  void find_late(const Event& event);
  void tell(const InputOrigin& from, const std::string& text);
  void tell_once(const std::string& key, const std::string& line);

  std::vector<std::string> frames_;
  std::mutex mutex_;
  std::condition_variable has_come_, has_room_;
  std::deque<Event> events_;
  int open_ = 0;
  bool is_stopped_ = false;
  std::mutex told_mutex_;
  std::set<std::string> told_;
  // The loop's:
  std::optional<std::int64_t> clock_ns_;
  std::set<std::string> late_frames_;  // whose poses came after their clock
  InputDisturbances disturbances_;
};

// A transport that puts into Inputs from a thread of its own, from its making to its end.
class InputSource {
 public:
  virtual ~InputSource() = default;
};

}  // namespace swell::apps
