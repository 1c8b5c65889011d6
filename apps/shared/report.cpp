#include "apps/shared/report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>

#include "apps/shared/json.h"
#include "apps/shared/output_file.h"

namespace swell::apps {
namespace {

double percentile(std::span<const double> sorted, double fraction) {
  const auto rank =
      static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(sorted.size())));
  return sorted[std::clamp<std::size_t>(rank, 1, sorted.size()) - 1];
}

double rounded(double value) { return std::round(value * 1e4) / 1e4; }

std::string table_row(std::string_view name, const Spread& s, double budget_ms) {
  return fmt::format("{:<12} {:>8.3f} {:>8.3f} {:>8.3f} {:>8.3f} {:>8.1f} %\n", name, s.median,
                     s.p95, s.p99, s.max, 100.0 * s.median / budget_ms);
}

Json plain_frame_json(const FrameReport& r) {
  Json stages = Json::object();
  for (std::size_t i = 0; i < r.stage_ms.size(); ++i)
    stages[std::string(stage_name(static_cast<render::Stage>(i)))] = rounded(r.stage_ms[i].median);
  const Spread& f = r.frame_ms;
  return {{"scene", r.scene},
          {"size", {r.width_px, r.height_px}},
          {"frames", r.frames},
          {"threads", r.threads},
          {"simd", r.simd},
          {"budget_ms", r.budget_ms},
          {"frame_ms",
           {{"median", rounded(f.median)},
            {"p95", rounded(f.p95)},
            {"p99", rounded(f.p99)},
            {"max", rounded(f.max)}}},
          {"over_budget", r.over_budget},
          {"stages_ms", stages},
          {"triangles", r.last.water_triangles + r.last.terrain_triangles},
          {"shaded_pixels", r.last.shaded_pixels},
          {"interpolated_pixels", r.last.interpolated_pixels},
          {"visible_pixels", r.last.visible_pixels},
          {"peak_rss_mb", rounded(r.peak_rss_mb)},
          {"hash", fmt::format("{:016x}", r.hash)},
          {"water_triangles", r.last.water_triangles},
          {"terrain_triangles", r.last.terrain_triangles},
          {"involuntary_switches", r.involuntary_switches},
          {"cpu", r.cpu},
          {"world_ms", rounded(r.world_ms)},
          {"first_frame_ms", rounded(r.first_frame_ms)}};
}

Json governed_json(const GovernedReport& g) {
  return {{"share_within", rounded(g.share_within)},
          {"largest_triangle_change", rounded(g.largest_change)},
          {"triangles", {g.least_triangles, g.most_triangles}},
          {"lookup_scale", {rounded(g.least_lookup_scale), rounded(g.most_lookup_scale)}},
          {"picture_scale", {rounded(g.least_picture_scale), rounded(g.most_picture_scale)}},
          {"step_changes", g.step_changes}};
}

std::string governed_text(const GovernedReport& g) {
  return fmt::format(
      "governed, after the first second: {:.2f} % of frames within 1.1 x budget, {} to {} "
      "triangles (at most {:.1f} % from frame to frame), lookup scale {:.3g} to {:.3g}, picture "
      "scale {:.3g} to {:.3g}, {} changes of scale\n",
      100.0 * g.share_within, g.least_triangles, g.most_triangles, 100.0 * g.largest_change,
      g.least_lookup_scale, g.most_lookup_scale, g.least_picture_scale, g.most_picture_scale,
      g.step_changes);
}

}  // namespace

Spread spread(std::vector<double> samples) {
  std::ranges::sort(samples);
  return {percentile(samples, 0.5), percentile(samples, 0.95), percentile(samples, 0.99),
          samples.back()};
}

std::string frame_json(const FrameReport& r) {
  Json json = plain_frame_json(r);
  if (r.governed) json["governed"] = governed_json(*r.governed);
  return json.dump(2) + "\n";
}

std::string stage_table(const FrameReport& r) {
  std::string text = fmt::format("{} {}x{}, {} threads, {}, {} frames on {}\n", r.scene, r.width_px,
                                 r.height_px, r.threads, r.simd, r.frames, r.cpu);
  text += fmt::format("{:<12} {:>8} {:>8} {:>8} {:>8} {:>10}\n", "stage, ms", "median", "p95",
                      "p99", "max", "of budget");
  for (std::size_t i = 0; i < r.stage_ms.size(); ++i)
    text += table_row(stage_name(static_cast<render::Stage>(i)), r.stage_ms[i], r.budget_ms);
  text += table_row("frame", r.frame_ms, r.budget_ms);
  text +=
      fmt::format("budget {} ms: median frame {}, {} of {} frames over\n", r.budget_ms,
                  r.frame_ms.median <= r.budget_ms ? "within" : "OVER", r.over_budget, r.frames);
  text += fmt::format(
      "last frame: {} water and {} terrain triangles, {} pixels shaded of {} "
      "visible, xxh3 {:016x}\n",
      r.last.water_triangles, r.last.terrain_triangles, r.last.shaded_pixels, r.last.visible_pixels,
      r.hash);
  if (r.governed) text += governed_text(*r.governed);
  text += fmt::format("once: making the world {:.1f} ms, the first frame {:.1f} ms\n", r.world_ms,
                      r.first_frame_ms);
  text += fmt::format("peak memory {:.0f} MB, {} involuntary context switches\n", r.peak_rss_mb,
                      r.involuntary_switches);
  return text;
}

void write_text(const std::string& path, const std::string& text) {
  if (path == "-") {
    std::fwrite(text.data(), 1, text.size(), stdout);  // run_program checks the stream
    return;
  }
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(text.data());
  write_output(path, {bytes, text.size()});
}

void check_text_place(const std::string& path) {
  if (!path.empty() && path != "-") check_output_place(path);
}

}  // namespace swell::apps
