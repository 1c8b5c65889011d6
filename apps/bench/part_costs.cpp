#include "apps/bench/part_costs.h"

#include <fmt/core.h>

#include "apps/bench/frame_run.h"
#include "apps/shared/cpu_name.h"
#include "apps/shared/notices.h"
#include "apps/shared/report.h"
#include "math/simd_target.h"
#include "render/world_view.h"

namespace swell::apps {
namespace {

// The frame's options, and what they come to.
struct Variant {
  std::string_view left_out;  // empty: nothing
  render::FrameOptions options;
  render::Workspace workspace = {};
  render::Target target = {};
  std::vector<double> frame_ms = {};
};

std::vector<Variant> make_variants(const render::FrameOptions& whole) {
  std::vector<Variant> variants;
  variants.push_back({"", whole});
  for (std::size_t i = 0; i < render::kPartCount; ++i) {
    const auto part = static_cast<render::Part>(i);
    if (whole.without.has(part)) continue;
    render::FrameOptions options = whole;
    options.without.add(part);
    variants.push_back({render::part_name(part), options});
  }
  return variants;
}

PartCost cost_of(const Variant& whole, const Variant& without) {
  std::vector<double> saved_ms;
  for (std::size_t k = 0; k < whole.frame_ms.size(); ++k)
    saved_ms.push_back(whole.frame_ms[k] - without.frame_ms[k]);
  return {without.left_out, spread(saved_ms).median,
          render::picture_hash(whole.target) != render::picture_hash(without.target)};
}

}  // namespace

PartReport measure_parts(const FrameSetup& setup, const render::World& world, int warm_up,
                         int frames) {
  Workers workers(setup.threads);
  ocean::SeaFrame camera_sea;
  std::vector<Variant> variants = make_variants(setup.frame);
  for (int k = -warm_up; k < frames; ++k) {
    const double t_s = k / kFramesPerSecond;
    const View view = render::world_view(world, t_s, setup.size.width_px, setup.size.height_px,
                                         camera_sea, workers);
    for (Variant& v : variants) {
      const render::FrameStatistics statistics =
          render::render_frame(world, view, t_s, v.options, v.workspace, v.target, workers);
      if (k >= 0) v.frame_ms.push_back(statistics.frame_ms);
    }
  }
  PartReport report{
      world.scene().name, setup.size, setup.threads, spread(variants[0].frame_ms).median, {}};
  for (std::size_t i = 1; i < variants.size(); ++i)
    report.costs.push_back(cost_of(variants[0], variants[i]));
  return report;
}

std::string parts_text(const PartReport& report) {
  std::string text =
      fmt::format("{} {}x{}, {} threads, {} on {}: {:.3f} ms a frame (median)\n", report.scene,
                  report.size.width_px, report.size.height_px, report.threads,
                  simd_target_name(current_simd_target()), cpu_name(), report.frame_ms);
  text += fmt::format("{:<12} {:>9} {:>9}\n", "part", "ms", "% of it");
  for (const PartCost& cost : report.costs)
    text += fmt::format("{:<12} {:>9.3f} {:>9.1f}{}\n", cost.part, cost.ms,
                        100.0 * cost.ms / report.frame_ms,
                        cost.changes_picture ? "" : "  (not in this picture)");
  return text;
}

Json parts_json(const PartReport& report) {
  Json json = {{"scene", report.scene},     {"size", {report.size.width_px, report.size.height_px}},
               {"threads", report.threads}, {"simd", simd_target_name(current_simd_target())},
               {"cpu", cpu_name()},         {"frame_ms", report.frame_ms},
               {"parts_ms", Json::object()}};
  for (const PartCost& cost : report.costs) json["parts_ms"][std::string(cost.part)] = cost.ms;
  return json;
}

}  // namespace swell::apps
