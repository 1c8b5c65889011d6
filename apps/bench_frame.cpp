// swell-bench frame: whole frames of a scene against the frame budget.
#include <fmt/format.h>
#include <sys/resource.h>

#include <cstdio>
#include <memory>

#include "apps/bench.h"
#include "apps/options.h"
#include "apps/picture_file.h"
#include "apps/report.h"
#include "apps/trace.h"
#include "math/simd_target.h"
#include "render/frame.h"

namespace swell::apps {
namespace {

constexpr double kFramesPerSecond = 60.0;  // frame k shows time k / 60

struct FrameBench {
  FrameSetup setup;
  int frames = 120, warm_up = 5;
  double budget_ms = 17.0;
  std::string json, trace;
};

struct Samples {
  std::vector<double> frame_ms;
  std::array<std::vector<double>, static_cast<std::size_t>(render::Stage::kCount)> stage_ms;
  render::FrameStatistics last;
  std::uint64_t hash = 0;
};

rusage resource_usage() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage;
}

// Draws frames -warm_up to frames - 1 and keeps the numbers of those from 0 on.
Samples measure(const FrameBench& bench, const render::World& world, Trace& trace) {
  Workers workers(bench.setup.threads);
  render::Workspace workspace;
  workspace.trace_enabled = !bench.trace.empty();
  render::Target target;
  Samples samples;
  const Stopwatch run;
  for (int k = -bench.warm_up; k < bench.frames; ++k) {
    const double t_s = k / kFramesPerSecond;
    const double start_ms = run.elapsed_ms();
    const View view = scene::camera_view(world.scene().camera, t_s, bench.setup.size.width_px,
                                         bench.setup.size.height_px);
    samples.last =
        render::render_frame(world, view, t_s, bench.setup.frame, workspace, target, workers);
    const double frame_ms = run.elapsed_ms() - start_ms;
    if (k < 0) continue;
    samples.frame_ms.push_back(frame_ms);
    for (std::size_t i = 0; i < samples.stage_ms.size(); ++i)
      samples.stage_ms[i].push_back(samples.last.stage_ms[i]);
    if (workspace.trace_enabled)
      trace.add_frame(k, start_ms * 1e3, frame_ms * 1e3, workspace.trace);
  }
  samples.hash = render::picture_hash(target);
  return samples;
}

FrameReport summarize(const FrameBench& bench, const render::World& world, const Samples& samples) {
  FrameReport report;
  report.scene = world.scene().name;
  report.width_px = bench.setup.size.width_px;
  report.height_px = bench.setup.size.height_px;
  report.frames = bench.frames;
  report.threads = bench.setup.threads;
  report.simd = simd_target_name(current_simd_target());
  report.budget_ms = bench.budget_ms;
  report.frame_ms = spread(samples.frame_ms);
  for (const double ms : samples.frame_ms) report.over_budget += ms > bench.budget_ms;
  for (std::size_t i = 0; i < samples.stage_ms.size(); ++i)
    report.stage_ms[i] = spread(samples.stage_ms[i]);
  report.last = samples.last;
  report.hash = samples.hash;
  report.peak_rss_mb = static_cast<double>(resource_usage().ru_maxrss) / 1024.0;
  return report;
}

void run_frame_bench(const FrameBench& bench) {
  select_simd(bench.setup.simd);
  check_text_place(bench.json);
  check_text_place(bench.trace);
  const render::World world(scene::load_scene(bench.setup.scene_path));
  Trace trace;
  const auto switches_before = resource_usage().ru_nivcsw;
  const Samples samples = measure(bench, world, trace);
  FrameReport report = summarize(bench, world, samples);
  report.involuntary_switches = resource_usage().ru_nivcsw - switches_before;

  if (bench.json != "-") fmt::print("{}", stage_table(report));
  if (!bench.json.empty()) write_text(bench.json, frame_json(report).dump(2) + "\n");
  if (!bench.trace.empty()) write_text(bench.trace, trace.json());
}

}  // namespace

Subcommand add_bench_frame(CLI::App& app) {
  const auto bench = std::make_shared<FrameBench>();
  CLI::App* sub = app.add_subcommand("frame", "Whole frames of a scene; frame k is at k / 60 s");
  add_frame_setup(*sub, bench->setup);
  add_quality_options(*sub, bench->setup.frame);
  add_integer(*sub, "--frames", bench->frames, 1, 1000000, "Frames to measure");
  add_integer(*sub, "--warmup", bench->warm_up, 0, 10000, "Frames to draw before them");
  add_number(*sub, "--budget-ms", bench->budget_ms, 1e-3, 1e6, "Time that a frame may take");
  sub->add_option("--json", bench->json, "Write the numbers as JSON; - is standard output")
      ->type_name("FILE");
  sub->add_option("--trace", bench->trace, "Write a Chrome trace of the measured frames")
      ->type_name("FILE");
  return {sub, [bench] { run_frame_bench(*bench); }};
}

}  // namespace swell::apps
