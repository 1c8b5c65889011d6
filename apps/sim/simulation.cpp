#include "apps/sim/simulation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swell::apps {
namespace {

constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

}  // namespace

std::size_t Simulation::topic(const std::string& name, std::string_view type, bool is_kept) {
  const auto found = std::ranges::find(topics, name, &Topic::name);
  const auto number = static_cast<std::size_t>(found - topics.begin());
  if (found == topics.end()) topics.push_back({name, type, is_kept});
  return number;
}

std::int64_t stamp_ns(std::int64_t k, double rate_hz) {
  // Seconds apart from their parts: of the clocks of systems k has 12 digits.
  const auto number = static_cast<double>(k);
  const double second = std::floor(number / rate_hz);
  const double rest = std::fma(-second, rate_hz, number);
  return static_cast<std::int64_t>(second) * 1'000'000'000 + std::llround(rest * 1e9 / rate_hz);
}

Schedule::Schedule(const std::vector<Source>& sources, double duration_s, std::int64_t first_ns)
    : end_ns_(duration_s < 1e9 ? first_ns + std::llround(duration_s * 1e9) : kNever) {
  for (const Source& source : sources) {
    Line line = {source.rate_hz, 0, first_ns};
    if (source.rate_hz > 0.0) {
      line.k = std::max<std::int64_t>(
          0, std::llround(static_cast<double>(first_ns) / 1e9 * source.rate_hz) - 1);
      while ((line.stamp_ns = stamp_ns(line.k, source.rate_hz)) < first_ns) ++line.k;
    }
    lines_.push_back(line);
  }
}

bool Schedule::next(Due& due, std::int64_t last_ns) {
  const auto line = std::ranges::min_element(lines_, {}, &Line::stamp_ns);
  if (line == lines_.end() || line->stamp_ns >= end_ns_ || line->stamp_ns > last_ns) return false;
  due = {static_cast<std::size_t>(line - lines_.begin()), line->stamp_ns};
  line->stamp_ns = line->rate_hz > 0.0 ? stamp_ns(++line->k, line->rate_hz) : kNever;
  return true;
}

}  // namespace swell::apps
