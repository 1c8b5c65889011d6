#include "apps/shared/trace.h"

#include "apps/shared/json.h"

namespace swell::apps {
namespace {

Json complete_event(std::string_view name, double start_us, double length_us, int track) {
  return {{"name", name},     {"cat", "frame"}, {"ph", "X"},   {"ts", start_us},
          {"dur", length_us}, {"pid", 1},       {"tid", track}};
}

int track_of(const render::TraceEvent& event) {
  return event.thread < 0 ? 1000 + static_cast<int>(event.stage) : 1 + event.thread;
}

}  // namespace

void Trace::add_frame(int frame, double start_us, double length_us,
                      std::span<const render::TraceEvent> events) {
  frames_.push_back({frame, start_us, length_us, {events.begin(), events.end()}});
}

void Trace::add_counter(std::string_view name, double time_us, double value) {
  counters_.push_back({std::string(name), time_us, value});
}

std::string Trace::json() const {
  Json events = Json::array();
  for (const Frame& frame : frames_) {
    Json whole = complete_event("frame", frame.start_us, frame.length_us, 0);
    whole["args"] = {{"frame", frame.number}};
    events.push_back(std::move(whole));
    for (const render::TraceEvent& e : frame.events)
      events.push_back(complete_event(stage_name(e.stage), frame.start_us + e.start_us,
                                      e.end_us - e.start_us, track_of(e)));
  }
  for (const Counter& c : counters_)
    events.push_back({{"name", c.name},
                      {"cat", "governor"},
                      {"ph", "C"},
                      {"ts", c.time_us},
                      {"pid", 1},
                      {"args", {{"value", c.value}}}});
  return Json{{"displayTimeUnit", "ms"}, {"traceEvents", std::move(events)}}.dump() + "\n";
}

}  // namespace swell::apps
