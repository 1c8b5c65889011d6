#include "apps/sim/costs.h"

#include <fmt/format.h>

#include <algorithm>

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

}  // namespace

void Cost::add(double ms) {
  ++count;
  sum_ms += ms;
  most_ms = std::max(most_ms, ms);
}

std::string cost_table(const Simulation& simulation, const Costs& costs) {
  std::string text = fmt::format("{:<16} {:<13} {:>8} {:>9} {:>9} {:>7}\n", "name", "kind", "times",
                                 "mean ms", "most ms", "% time");
  for (std::size_t n = 0; n < costs.sources.size(); ++n)
    text += cost_row(simulation.sources[n].name, simulation.sources[n].kind, costs.sources[n],
                     costs.duration_s);
  text += cost_row("output", "messages", costs.output, costs.duration_s);
  text += fmt::format("{} s in {:.2f} s: {:.2f} of real time\n", costs.duration_s, costs.wall_s,
                      costs.duration_s / costs.wall_s);
  if (!costs.late_ms.empty()) {
    const Spread late = spread(costs.late_ms);
    text +=
        fmt::format("after their stamps: 99 % of messages within {:.1f} ms, all within {:.1f} ms\n",
                    late.p99, late.max);
  }
  return text;
}

}  // namespace swell::apps
