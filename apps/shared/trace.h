// A run as a Chrome trace (chrome://tracing, ui.perfetto.dev): one bar a stage and thread.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "render/frame.h"

namespace swell::apps {

class Trace {
 public:
  // Adds one frame: its start since the run's start, its length, its stages.
  void add_frame(int frame, double start_us, double length_us,
                 std::span<const render::TraceEvent> events);

  // Adds a number that changes over the run ("ph": "C"): a graph above the bars.
  void add_counter(std::string_view name, double time_us, double value);

  // The trace-event JSON: complete events ("ph": "X"), microseconds. Tracks (tid): 0 the frames,
  // 1 + slot the work of one thread, 1000 + stage a stage from its start to its end (thread < 0).
  std::string json() const;

 private:
  struct Frame {
    int number;
    double start_us, length_us;
    std::vector<render::TraceEvent> events;
  };
  struct Counter {
    std::string name;
    double time_us, value;
  };
  std::vector<Frame> frames_;
  std::vector<Counter> counters_;
};

}  // namespace swell::apps
