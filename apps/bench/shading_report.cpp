#include "apps/bench/shading_report.h"

#include <fmt/core.h>

#include "apps/shared/report.h"
#include "math/check.h"

namespace swell::apps {
namespace {

PixelCost pixel_cost(std::span<const ShadedFrame> frames, ShadedTile::Shows shows,
                     double clock_ghz) {
  std::vector<double> tiles, ns;
  for (const ShadedFrame& frame : frames) {
    double count = 0.0, pixels = 0.0, us = 0.0;
    for (const ShadedTile& tile : frame)
      if (tile.shows == shows) count += 1.0, pixels += tile.pixels, us += tile.us;
    if (count == 0.0) continue;
    tiles.push_back(count);
    ns.push_back(us * 1e3 / pixels);
  }
  if (ns.empty()) return {};
  const double median_ns = spread(ns).median;
  return {static_cast<int>(ns.size()), spread(tiles).median, median_ns, median_ns * clock_ghz};
}

std::string cost_text(const char* name, const PixelCost& cost, double clock_ghz) {
  if (cost.frames == 0) return fmt::format("{}: no tile shows it alone\n", name);
  return fmt::format(
      "{} {:.1f} cycles a pixel at {:.2f} GHz, {:.2f} ns (median of {} frames with {:.0f} tiles)\n",
      name, cost.cycles, clock_ghz, cost.ns, cost.frames, cost.tiles);
}

Json cost_json(const PixelCost& cost) {
  if (cost.frames == 0) return nullptr;
  return {{"frames", cost.frames},
          {"tiles", cost.tiles},
          {"ns_a_pixel", cost.ns},
          {"cycles_a_pixel", cost.cycles}};
}

}  // namespace

ShadingReport report_shading(std::span<const ShadedFrame> frames, double clock_ghz) {
  SWELL_CHECK(!frames.empty() && clock_ghz > 0.0, "frames={} clock_ghz={}", frames.size(),
              clock_ghz);
  const auto cost = [&](ShadedTile::Shows shows) { return pixel_cost(frames, shows, clock_ghz); };
  return {static_cast<int>(frames.size()), clock_ghz, cost(ShadedTile::Shows::kWater),
          cost(ShadedTile::Shows::kSky)};
}

std::string shading_text(const ShadingReport& report) {
  return cost_text("water", report.water, report.clock_ghz) +
         cost_text("sky", report.sky, report.clock_ghz) +
         "The clock is assumed: the largest that a chain of multiplications, 3 cycles each, showed "
         "between the frames.\n";
}

Json shading_json(const ShadingReport& report) {
  return {{"frames", report.frames},
          {"clock_ghz", report.clock_ghz},
          {"water", cost_json(report.water)},
          {"sky", cost_json(report.sky)}};
}

}  // namespace swell::apps
