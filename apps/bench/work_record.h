// swell-bench scaling: what one thread did for a frame, as parts that more threads could share.
#pragma once

#include <source_location>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "math/parallel.h"
#include "render/frame.h"

namespace swell::apps {

// A piece of a frame; pieces follow each other, each after all of the one before.
struct WorkPart {
  enum class Kind { kSerial, kLoop, kBoth } kind = Kind::kSerial;
  double start_us = 0.0;        // since the frame's start
  std::vector<double> item_us;  // kSerial: one; kLoop: each body, in the order of their indices
  std::string stage = {};       // or "frame" between stages
  std::string name = {};  // kLoop: the function that runs it; kSerial: which loops it is between
  std::vector<WorkPart> a = {}, b = {};  // kBoth: side by side
};

// A stretch of time that belongs to a stage.
struct StageSpan {
  std::string_view stage;
  double start_us = 0.0, end_us = 0.0;
};

// Builds a frame's parts from the steps of Workers of one thread. Bodies may not use Workers.
class WorkRecorder {
 public:
  void begin(double now_us);
  void add(WorkStep step, std::string_view function, double now_us);

  // The frame's parts; serial ones cut where stages begin and end. Times since begin().
  std::vector<WorkPart> end(double now_us, std::span<const StageSpan> stages);

 private:
  std::vector<WorkPart>& parts() { return open_.empty() ? parts_ : *open_.back(); }
  void add_serial(double now_us);

  std::vector<WorkPart> parts_;
  std::vector<std::vector<WorkPart>*> open_;  // the sides of run_both that are being recorded
  bool in_loop_ = false;
  double frame_us_ = 0.0, before_us_ = 0.0;  // the frame's start, the last step
};

// The whole stages of a frame that was traced.
std::vector<StageSpan> stage_spans(std::span<const render::TraceEvent> trace);

// "find_visible" of "void swell::render::find_visible(const Meshes&, ...)".
std::string short_function_name(std::string_view pretty);

}  // namespace swell::apps
