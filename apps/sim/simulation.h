// What publishes messages, and when.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "apps/messages/message_output.h"
#include "math/parallel.h"

namespace swell::apps {

// When a message is of: the time that it is stamped with. In seconds it is the scene's.
struct Moment {
  std::int64_t t_ns = 0;

  double t_s() const { return static_cast<double>(t_ns) / 1e9; }
  msg::Time stamp() const { return msg::Time::of_ns(t_ns); }
};

using Emit = FunctionRef<void(std::size_t topic, msg::Message message)>;
using Publish = std::function<void(const Moment& moment, const Emit& emit)>;

// Something that publishes: a sensor, a body's pose, the clock.
struct Source {
  std::string name;
  std::string_view kind;
  double rate_hz = 0.0;  // 0: once, at the beginning
  Publish publish;
};

struct Simulation {
  std::vector<Topic> topics;
  std::vector<Source> sources;  // of those that are due at once the first one publishes first

  // The number of a topic, which is added if it is not there.
  std::size_t topic(const std::string& name, std::string_view type, bool is_kept = false);
};

// The time that message k of a source is stamped with, to the nearest nanosecond.
std::int64_t stamp_ns(std::int64_t k, double rate_hz);

// Which source is due next: all messages with stamps from `first_ns` on and below a duration
// later, in the order of stamps. What is published once is due at first_ns.
class Schedule {
 public:
  struct Due {
    std::size_t source = 0;
    std::int64_t stamp_ns = 0;
  };

  Schedule(const std::vector<Source>& sources, double duration_s, std::int64_t first_ns = 0);

  // False at the end, and where nothing more is due up to `last_ns`.
  bool next(Due& due, std::int64_t last_ns = std::numeric_limits<std::int64_t>::max());

  // Whether all before this time is all there is.
  bool ends_at(std::int64_t t_ns) const { return t_ns >= end_ns_; }

 private:
  struct Line {
    double rate_hz;
    std::int64_t k, stamp_ns;
  };
  std::vector<Line> lines_;
  std::int64_t end_ns_;
};

}  // namespace swell::apps
