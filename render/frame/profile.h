// Times of a frame's stages.
#pragma once

#include <array>
#include <chrono>
#include <mutex>
#include <source_location>
#include <vector>

#include "math/parallel.h"
#include "render/frame/stages.h"

namespace swell::render {

// Collects stage times of one frame, and single spans of work if a trace is wanted.
class Profile {
 public:
  using Clock = std::chrono::steady_clock;

  void begin_frame(bool trace_enabled) {
    start_ = Clock::now();
    trace_enabled_ = trace_enabled;
    stage_ms_.fill(0.0);
    trace_.clear();
  }
  double now_us() const {
    return std::chrono::duration<double, std::micro>(Clock::now() - start_).count();
  }
  void add(Stage stage, int thread, double start_us, double end_us, bool whole_stage) {
    if (whole_stage) stage_ms_[static_cast<std::size_t>(stage)] += (end_us - start_us) * 1e-3;
    if (!trace_enabled_) return;
    const std::lock_guard lock(mutex_);
    trace_.push_back({stage, thread, start_us, end_us});
  }
  const auto& stage_ms() const { return stage_ms_; }
  std::vector<TraceEvent>& trace() { return trace_; }
  bool trace_enabled() const { return trace_enabled_; }

 private:
  Clock::time_point start_;
  bool trace_enabled_ = false;
  std::array<double, kStages> stage_ms_{};
  std::mutex mutex_;
  std::vector<TraceEvent> trace_;
};

// Times its scope as one whole stage.
class StageScope {
 public:
  StageScope(Profile& profile, Stage stage)
      : profile_(profile), stage_(stage), start_us_(profile.now_us()) {}
  ~StageScope() { profile_.add(stage_, -1, start_us_, profile_.now_us(), true); }
  StageScope(const StageScope&) = delete;
  StageScope& operator=(const StageScope&) = delete;

 private:
  Profile& profile_;
  Stage stage_;
  double start_us_;
};

// Times one thread's piece of a stage, for the trace only.
class WorkScope {
 public:
  WorkScope(Profile& profile, Stage stage, int slot)
      : profile_(profile.trace_enabled() ? &profile : nullptr),
        stage_(stage),
        slot_(slot),
        start_us_(profile_ ? profile.now_us() : 0.0) {}
  ~WorkScope() {
    if (profile_) profile_->add(stage_, slot_, start_us_, profile_->now_us(), false);
  }
  WorkScope(const WorkScope&) = delete;
  WorkScope& operator=(const WorkScope&) = delete;

 private:
  Profile* profile_;
  Stage stage_;
  int slot_;
  double start_us_;
};

// What a stage works with: threads, and its row of the profile.
struct StageRun {
  Workers& workers;
  Profile& profile;
  Stage stage;

  // Calls body(i, thread) for all i below count.
  template <class Body>
  void for_each(std::size_t count, const Body& body,
                const std::source_location& caller = std::source_location::current()) const {
    const auto timed = [&](std::size_t i, int thread) {
      const WorkScope work(profile, stage, thread);
      body(i, thread);
    };
    workers.for_each(count, timed, caller);
  }
};

}  // namespace swell::render
