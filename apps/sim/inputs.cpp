#include "apps/sim/inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "apps/shared/program.h"

namespace swell::apps {
namespace {

constexpr std::size_t kMostEvents = 65536;
constexpr std::int64_t kSecond_ns = 1'000'000'000, kLatest_ns = kSecond_ns << 31;
constexpr std::int64_t kJump_ns = 10 * kSecond_ns;
constexpr double kFarthest_m = 1e6;  // as in rigs
constexpr std::chrono::milliseconds kLookUp{50}, kPatience{500};

bool is_time(std::int64_t t_ns) { return t_ns >= 0 && t_ns < kLatest_ns; }

// What is wrong with a pose; empty: nothing.
std::string pose_fault(const StampedPose& pose) {
  if (!is_time(pose.stamp_ns))
    return fmt::format("a pose, got the stamp {} ns, allowed 0 to 2^31 s", pose.stamp_ns);
  for (int i = 0; i < 3; ++i)
    if (!(std::abs(pose.position_m[i]) <= kFarthest_m))
      return fmt::format("a pose, got a position with {}, allowed -1e6 to 1e6 m",
                         pose.position_m[i]);
  const double length = glm::length(pose.orientation);
  if (!(std::abs(length - 1.0) <= 0.01))
    return fmt::format("a pose, got a quaternion of length {}, allowed 1", length);
  return "";
}

}  // namespace

void Inputs::put_clock(const InputOrigin& from, std::int64_t t_ns) {
  if (!is_time(t_ns)) {
    tell(from, fmt::format("a clock, got {} ns, allowed 0 to 2^31 s", t_ns));
    return;
  }
  put({std::string(from.topic), "", {.stamp_ns = t_ns}});
}

void Inputs::put_pose(const InputOrigin& from, std::string_view frame, const StampedPose& pose) {
  if (std::ranges::count(frames_, frame) == 0) {
    tell(from,
         fmt::format("a pose, got the body \"{}\", allowed bodies of the rig with pose = "
                     "\"input\"{}{}",
                     frame.substr(0, 100), frames_.empty() ? "" : ": ", fmt::join(frames_, ", ")));
    return;
  }
  if (const std::string fault = pose_fault(pose); !fault.empty()) {
    tell(from, fault);
    return;
  }
  StampedPose normal = pose;
  normal.orientation = glm::normalize(pose.orientation);
  put({std::string(from.topic), std::string(frame), normal});
}

void Inputs::put_disturbance(const InputOrigin& from, const StampedDisturbance& disturbance) {
  if (!is_time(disturbance.stamp_ns))
    tell(from, fmt::format("a disturbance, got the stamp {} ns, allowed 0 to 2^31 s",
                           disturbance.stamp_ns));
  else
    put({"", "", {}, disturbance});
}

void Inputs::refuse(const InputOrigin& from, const std::string& what) { tell(from, what); }

void Inputs::begin() {
  const std::lock_guard lock(mutex_);
  ++open_;
}

void Inputs::end() {
  const std::lock_guard lock(mutex_);
  --open_;
  has_come_.notify_all();
}

void Inputs::stop() {
  const std::lock_guard lock(mutex_);
  is_stopped_ = true;
  has_room_.notify_all();
}

void Inputs::put(Event event) {
  std::unique_lock lock(mutex_);
  has_room_.wait(lock, [&] { return events_.size() < kMostEvents || is_stopped_; });
  if (is_stopped_) return;
  events_.push_back(std::move(event));
  has_come_.notify_one();
}

bool Inputs::take(Event& event) {
  if (events_.empty()) return false;
  event = std::move(events_.front());
  events_.pop_front();
  has_room_.notify_all();
  return true;
}

// The next one that shows another time, and what came before it; none at the end.
std::optional<Inputs::Event> Inputs::take_clock(std::vector<Event>& before, Lock& lock,
                                                FunctionRef<bool()> is_stopped) {
  for (Event event; !is_stopped();) {
    if (!take(event)) {
      if (open_ == 0) return std::nullopt;
      has_come_.wait_for(lock, kLookUp);
    } else if (!event.is_clock()) {
      before.push_back(std::move(event));
    } else if (event.stamp_ns() != clock_ns_) {
      return event;
    }
  }
  return std::nullopt;
}

// Takes what comes after a clock, while a body that was late has no pose of its time.
void Inputs::await_late(const Moment& moment, InputPoses& poses, Lock& lock,
                        FunctionRef<bool()> is_stopped) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  const auto has_come = [&](const std::string& frame) { return poses.reaches(frame, moment); };
  while (!std::ranges::all_of(late_frames_, has_come) && !is_stopped() &&
         std::chrono::steady_clock::now() < end) {
    if (events_.empty()) {
      if (open_ == 0) return;
      has_come_.wait_for(lock, kLookUp);
      continue;
    }
    if (events_.front().is_clock() && events_.front().stamp_ns() != moment.t_ns) return;
    Event event;
    take(event);
    if (!event.is_clock()) keep(event, poses);
  }
}

bool Inputs::next_tick(Tick& tick, InputPoses& poses, FunctionRef<bool()> is_stopped) {
  std::vector<Event> come;  // since the last tick
  Lock lock(mutex_);
  const std::optional<Event> clock = take_clock(come, lock, is_stopped);
  if (!clock) return false;
  const std::int64_t t_ns = clock->stamp_ns();
  const bool jumps = clock_ns_ && (t_ns < *clock_ns_ || t_ns - *clock_ns_ > kJump_ns);
  if (jumps) {
    tell_once(clock->topic + " jumps",
              fmt::format("note: {}: jumped from {} s to {} s; starting again there", clock->topic,
                          Moment{*clock_ns_}.t_s(), Moment{t_ns}.t_s()));
    poses.forget_all();
    disturbances_.forget_all();
  }
  for (const Event& event : come) {
    if (jumps && event.stamp_ns() > t_ns) continue;
    if (keep(event, poses) && !jumps) find_late(event);
  }
  await_late({t_ns}, poses, lock, is_stopped);
  poses.set_horizon({t_ns});
  disturbances_.set_horizon({t_ns});
  tick = {t_ns, !clock_ns_ || jumps};
  clock_ns_ = t_ns;
  return true;
}

void Inputs::take_all(InputPoses& poses, const Moment& horizon) {
  const std::lock_guard lock(mutex_);
  for (Event event; take(event);)
    if (!event.is_clock()) keep(event, poses);
  poses.set_horizon(horizon);
  disturbances_.set_horizon(horizon);
}

bool Inputs::keep(const Event& event, InputPoses& poses) {
  if (!event.disturbance) return poses.add(event.frame, event.pose);
  disturbances_.add(*event.disturbance);
  return true;
}

// Of a pose that came after its clock.
void Inputs::find_late(const Event& event) {
  if (event.disturbance || !clock_ns_ || event.pose.stamp_ns > *clock_ns_) return;
  late_frames_.insert(event.frame);
  tell_once(event.topic + " late",
            fmt::format("note: {}: the pose of {} for {} s came after the clock had shown {} s, "
                        "whose messages are without it; from now on they wait for it",
                        event.topic, event.frame, Moment{event.pose.stamp_ns}.t_s(),
                        Moment{*clock_ns_}.t_s()));
}

void Inputs::tell_waiting(std::string_view frame) {
  tell_once(fmt::format("{} waits", frame),
            fmt::format("note: body {}: no pose has come yet; what is on it waits", frame));
}

void Inputs::tell(const InputOrigin& from, const std::string& text) {
  const std::string line = from.line > 0 ? fmt::format(":{}", from.line) : "";
  tell_once(std::string(from.topic), fmt::format("warning: {}{}: {}; left out, as are more like it",
                                                 from.topic, line, text));
}

void Inputs::tell_once(const std::string& key, const std::string& line) {
  {
    const std::lock_guard lock(told_mutex_);
    if (!told_.insert(key).second) return;
  }
  std::fputs((one_line(line) + "\n").c_str(), stderr);
}

}  // namespace swell::apps
