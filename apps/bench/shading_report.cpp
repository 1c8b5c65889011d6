#include "apps/bench/shading_report.h"

#include <fmt/core.h>

#include "apps/shared/report.h"
#include "math/check.h"

namespace swell::apps {
namespace {

PixelCost pixel_cost(std::span<const ShadedFrame> frames, ShadedTile::Shows shows,
                     double clock_ghz) {
  PixelCost cost;
  double us = 0.0, pixels = 0.0;
  for (std::size_t i = 0; i < frames.front().size(); ++i) {
    std::vector<double> tile_us;
    for (const ShadedFrame& frame : frames)
      if (frame[i].shows == shows) tile_us.push_back(frame[i].us);
    if (2 * tile_us.size() <= frames.size()) continue;
    ++cost.tiles;
    us += spread(std::move(tile_us)).median;
    pixels += frames.front()[i].pixels;
  }
  if (cost.tiles == 0) return cost;
  cost.ns = us * 1e3 / pixels;
  cost.cycles = cost.ns * clock_ghz;
  return cost;
}

std::string cost_text(const char* name, const PixelCost& cost, const ShadingReport& report) {
  if (cost.tiles == 0) return fmt::format("{}: no tile shows it alone\n", name);
  return fmt::format(
      "{} {:.1f} cycles a pixel at {:.2f} GHz, {:.2f} ns (median of {} frames; {} tiles)\n", name,
      cost.cycles, report.clock_ghz, cost.ns, report.frames, cost.tiles);
}

Json cost_json(const PixelCost& cost) {
  if (cost.tiles == 0) return nullptr;
  return {{"tiles", cost.tiles}, {"ns_a_pixel", cost.ns}, {"cycles_a_pixel", cost.cycles}};
}

}  // namespace

ShadingReport report_shading(std::span<const ShadedFrame> frames, double clock_ghz) {
  SWELL_CHECK(!frames.empty() && clock_ghz > 0.0, "frames={} clock_ghz={}", frames.size(),
              clock_ghz);
  for (const ShadedFrame& frame : frames)
    SWELL_CHECK(frame.size() == frames.front().size(), "tiles={} and {}", frames.front().size(),
                frame.size());
  const auto cost = [&](ShadedTile::Shows shows) { return pixel_cost(frames, shows, clock_ghz); };
  return {static_cast<int>(frames.size()), clock_ghz, cost(ShadedTile::Shows::kWater),
          cost(ShadedTile::Shows::kSky)};
}

std::string shading_text(const ShadingReport& report) {
  return cost_text("water", report.water, report) + cost_text("sky", report.sky, report) +
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
