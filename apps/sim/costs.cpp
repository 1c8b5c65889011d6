#include "apps/sim/costs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/shared/report.h"

namespace swell::apps {
namespace {

// The share is of a second of the simulation.
std::string cost_row(std::string_view name, std::string_view kind, const Cost& cost,
                     double duration_s) {
  return fmt::format("{:<16} {:<13} {:>8} {:>9.3f} {:>9.3f} {:>7.1f}\n", name, kind, cost.count,
                     cost.count > 0 ? cost.sum_ms / cost.count : 0.0, cost.most_ms,
                     0.1 * cost.sum_ms / duration_s);
}

// What real time asks for.
constexpr double kMostLate_ms = 50.0, kMostSlow = 1e-3;

std::string real_time_lines(const Simulation& simulation, const GivenMessages& given) {
  const Spread late = spread({given.late_ms.begin(), given.late_ms.end()});
  const auto over =
      std::ranges::count_if(given.late_ms, [](float ms) { return ms > kMostLate_ms; });
  std::int64_t skipped = 0;
  double slow = 0.0;  // that of the source whose mean period is off by most
  for (std::size_t n = 0; n < given.sources.size(); ++n) {
    const double rate_hz = simulation.sources[n].rate_hz;
    skipped += given.sources[n].skipped(rate_hz);
    const double own = given.sources[n].slow(rate_hz);
    if (std::abs(own) > std::abs(slow)) slow = own;
  }
  const bool is_held = skipped == 0 && std::abs(slow) <= kMostSlow && late.p99 <= kMostLate_ms;
  return fmt::format(
      "after their stamps: 99 % of messages within {:.1f} ms, all within {:.1f} ms, {:.2f} % over "
      "{} ms\nstamps skipped: {}; mean periods off by {:+.3f} % at most\nreal time was {}\n",
      late.p99, late.max,
      100.0 * static_cast<double>(over) / static_cast<double>(given.late_ms.size()), kMostLate_ms,
      skipped, 100.0 * slow, is_held ? "held" : "not held");
}

}  // namespace

void Cost::add(double ms) {
  ++count;
  sum_ms += ms;
  most_ms = std::max(most_ms, ms);
}

void GivenStamps::add(std::int64_t stamp_ns, double given_s) {
  if (count > 0 && stamp_ns == last_ns) return;  // another message of the stamp
  if (count++ == 0) first_ns = stamp_ns, first_s = given_s;
  last_ns = stamp_ns, last_s = given_s;
}

std::int64_t GivenStamps::skipped(double rate_hz) const {
  if (count == 0) return 0;
  return std::llround(static_cast<double>(last_ns - first_ns) / 1e9 * rate_hz) + 1 - count;
}

double GivenStamps::slow(double rate_hz) const {
  if (count < 2 || rate_hz == 0.0) return 0.0;
  return (last_s - first_s) * rate_hz / static_cast<double>(count - 1) - 1.0;
}

std::string cost_table(const Simulation& simulation, const Costs& costs) {
  std::string text = fmt::format("{:<16} {:<13} {:>8} {:>9} {:>9} {:>7}\n", "name", "kind", "times",
                                 "mean ms", "most ms", "% time");
  for (std::size_t n = 0; n < costs.sources.size(); ++n)
    text += cost_row(simulation.sources[n].name, simulation.sources[n].kind, costs.sources[n],
                     costs.duration_s);
  text += cost_row("output", "messages", costs.given.cost, costs.duration_s);
  text += fmt::format("{} s in {:.2f} s: {:.2f} of real time\n", costs.duration_s, costs.wall_s,
                      costs.duration_s / costs.wall_s);
  if (!costs.given.late_ms.empty()) text += real_time_lines(simulation, costs.given);
  return text;
}

}  // namespace swell::apps
