// swell-bench frame: whole frames of a scene against the frame budget.
#include <fmt/core.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <span>

#include "apps/bench/bench.h"
#include "apps/bench/compare_programs.h"
#include "apps/bench/frame_run.h"
#include "apps/bench/part_costs.h"
#include "apps/bench/run_comparison.h"
#include "apps/shared/cpu_name.h"
#include "apps/shared/notices.h"
#include "apps/shared/options.h"
#include "apps/shared/picture_file.h"
#include "apps/shared/report.h"
#include "apps/shared/trace.h"
#include "math/simd_target.h"
#include "render/frame.h"
#include "render/quality/governor.h"
#include "render/world_view.h"

namespace swell::apps {
namespace {

struct FrameBench {
  FrameSetup setup;
  int frames = 120, warm_up = 5;
  double budget_ms = 17.0;
  bool govern = false;
  std::string json, trace;
  std::string compare;  // the old program, or empty
  int runs = 7;
  bool parts = false;
};

// What a frame was drawn with and how many triangles it had.
struct Quality {
  int triangles = 0;
  double lookup_scale = 0.0, picture_scale = 0.0;
};

struct Samples {
  double first_frame_ms = 0.0;
  std::vector<double> frame_ms;
  std::vector<Quality> quality;
  int step_changes = 0;
  std::array<std::vector<double>, render::kStages> stage_ms;
  render::FrameStatistics last;
  std::uint64_t hash = 0;
};

rusage resource_usage() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage;
}

void add_counters(const Quality& quality, double time_us, Trace& trace) {
  trace.add_counter("triangles", time_us, quality.triangles);
  trace.add_counter("lookup_scale", time_us, quality.lookup_scale);
  trace.add_counter("picture_scale", time_us, quality.picture_scale);
}

// Draws frames -warm_up to frames - 1 and keeps the numbers of those from 0 on.
Samples measure_frames(const FrameBench& bench, const render::World& world, Trace& trace) {
  Workers workers(bench.setup.threads);
  render::Workspace workspace;
  workspace.trace_enabled = !bench.trace.empty();
  render::Target target;
  ocean::SeaFrame camera_sea;
  const render::FrameOptions full = render::with_scene_defaults(bench.setup.frame, world.scene());
  render::Governor governor({.budget_ms = bench.budget_ms}, full);
  Samples samples;
  EyeWarning warning;
  const Stopwatch run;
  for (int k = -bench.warm_up; k < bench.frames; ++k) {
    const double t_s = k / kFramesPerSecond;
    const double start_ms = run.elapsed_ms();
    const View view = render::world_view(world, t_s, bench.setup.size.width_px,
                                         bench.setup.size.height_px, camera_sea, workers);
    const render::FrameOptions options = bench.govern ? governor.options() : full;
    samples.last = render::render_frame(world, view, t_s, options, workspace, target, workers);
    if (bench.govern) governor.next(samples.last);
    const double frame_ms = run.elapsed_ms() - start_ms;
    if (k == -bench.warm_up) samples.first_frame_ms = frame_ms;
    if (k < 0) continue;
    warning.look(k, world, view, workspace);
    samples.quality.push_back({samples.last.water_triangles + samples.last.terrain_triangles,
                               options.lookup_scale, options.picture_scale});
    samples.frame_ms.push_back(frame_ms);
    for (std::size_t i = 0; i < samples.stage_ms.size(); ++i)
      samples.stage_ms[i].push_back(samples.last.stage_ms[i]);
    if (!workspace.trace_enabled) continue;
    trace.add_frame(k, start_ms * 1e3, frame_ms * 1e3, workspace.trace);
    if (bench.govern) add_counters(samples.quality.back(), start_ms * 1e3, trace);
  }
  samples.step_changes = governor.report().step_changes;
  samples.hash = render::picture_hash(target);
  return samples;
}

// Summarizes the frames after the first second (60 frames), or all if there are no more. The step
// changes are those of the whole run.
GovernedReport summarize_governed(const FrameBench& bench, const Samples& samples) {
  constexpr std::size_t kFirstSecond = 60;
  const std::size_t frames = samples.frame_ms.size();
  const std::size_t first = frames > kFirstSecond ? kFirstSecond : 0;
  GovernedReport report;
  int within = 0;
  for (std::size_t k = first; k < frames; ++k) {
    const Quality& q = samples.quality[k];
    const double before = samples.quality[k > 0 ? k - 1 : 0].triangles;
    within += samples.frame_ms[k] <= 1.1 * bench.budget_ms;
    report.largest_change =
        std::max(report.largest_change, std::abs(q.triangles - before) / before);
  }
  const auto from = samples.quality.begin() + static_cast<std::ptrdiff_t>(first);
  const auto range = [&](auto member, auto& least, auto& most) {
    const auto [low, high] =
        std::ranges::minmax(std::span(from, samples.quality.end()), {}, member);
    least = std::invoke(member, low), most = std::invoke(member, high);
  };
  range(&Quality::triangles, report.least_triangles, report.most_triangles);
  range(&Quality::lookup_scale, report.least_lookup_scale, report.most_lookup_scale);
  range(&Quality::picture_scale, report.least_picture_scale, report.most_picture_scale);
  report.share_within = static_cast<double>(within) / static_cast<double>(frames - first);
  report.step_changes = samples.step_changes;
  return report;
}

FrameReport summarize(const FrameBench& bench, const render::World& world, const Samples& samples) {
  FrameReport report;
  report.scene = world.scene().name;
  report.width_px = bench.setup.size.width_px;
  report.height_px = bench.setup.size.height_px;
  report.frames = bench.frames;
  report.threads = bench.setup.threads;
  report.cpu = cpu_name();
  report.simd = simd_target_name(current_simd_target());
  report.budget_ms = bench.budget_ms;
  report.first_frame_ms = samples.first_frame_ms;
  report.frame_ms = spread(samples.frame_ms);
  for (const double ms : samples.frame_ms) report.over_budget += ms > bench.budget_ms;
  for (std::size_t i = 0; i < samples.stage_ms.size(); ++i)
    report.stage_ms[i] = spread(samples.stage_ms[i]);
  report.last = samples.last;
  report.hash = samples.hash;
  if (bench.govern) report.governed = summarize_governed(bench, samples);
  report.peak_rss_mb = static_cast<double>(resource_usage().ru_maxrss) / 1024.0;
  return report;
}

void run_frame_bench(const FrameBench& bench) {
  select_simd(bench.setup.simd);
  check_text_place(bench.json);
  check_text_place(bench.trace);
  check_labels_scale(bench.setup.frame.labels, bench.setup.frame);
  if (bench.govern && !bench.setup.frame.labels.empty())
    throw OptionError("command line: --govern, got it with labels, allowed without them");
  scene::Scene scene = load_scene(bench.setup.scene);
  const Stopwatch making;
  const render::World world(std::move(scene), bench.setup.threads);
  const double world_ms = making.elapsed_ms();
  Trace trace;
  const auto switches_before = resource_usage().ru_nivcsw;
  const Samples samples = measure_frames(bench, world, trace);
  FrameReport report = summarize(bench, world, samples);
  report.world_ms = world_ms;
  report.involuntary_switches = resource_usage().ru_nivcsw - switches_before;

  if (bench.json != "-") fmt::print("{}", stage_table(report));
  if (!bench.json.empty()) write_text(bench.json, frame_json(report));
  if (!bench.trace.empty()) write_text(bench.trace, trace.json());
}

void run_parts(const FrameBench& bench) {
  select_simd(bench.setup.simd);
  check_text_place(bench.json);
  const render::World world(load_scene(bench.setup.scene), bench.setup.threads);
  const PartReport report = measure_parts(bench.setup, world, bench.warm_up, bench.frames);
  if (bench.json != "-") fmt::print("{}", parts_text(report));
  if (!bench.json.empty()) write_text(bench.json, parts_json(report).dump(2) + "\n");
}

void run_comparison(const FrameBench& bench, const CommandLine& line) {
  check_text_place(bench.json);
  compare_programs({.old_program = bench.compare,
                    .arguments = line.arguments_without({"--compare", "--runs", "--json"}),
                    .pairs = bench.runs,
                    .json = bench.json});
}

}  // namespace

BenchMode add_bench_frame(CommandLine& program) {
  const auto bench = std::make_shared<FrameBench>();
  CommandLine line = program.add_mode("frame", "Whole frames of a scene; frame k is at k / 60 s");
  add_required_frame_setup(line, bench->setup);
  add_quality_options(line, bench->setup.frame);
  add_integer(line, "--frames", bench->frames, 1, 1000000, "Frames to measure");
  add_integer(line, "--warmup", bench->warm_up, 0, 10000, "Frames to draw before them");
  add_number(line, "--budget-ms", bench->budget_ms, 1e-3, 1e6, "Time that a frame may take");
  add_integer(line, "--lod-operations", bench->setup.frame.lod_operations, 1, 1000000,
              "Splits and merges of a surface a frame at most; pictures depend on those before");
  add_integer(line, "--lod-groups", bench->setup.frame.lod_groups, 1, 64,
              "Groups of priorities, one of which is worked out anew in a frame; as above");
  add_labels_option(line, bench->setup.frame.labels, "Fill these labels too, in memory");
  line.add_flag("--govern", bench->govern,
                "Lower triangles and scales as far as the budget takes, as the viewer can");
  add_json_option(line, bench->json);
  line.add_text("--trace", "FILE", bench->trace, "Write a Chrome trace of the measured frames");
  line.add_text("--compare", "PROGRAM", bench->compare,
                "Run an older swell-bench and this one by turns, and exit with 1 where a stage is "
                "slower now, beyond noise and by over 1 % of the frame");
  add_integer(line, "--runs", bench->runs, kFewestPairs, 1000, "Pairs of runs to compare");
  line.need("--runs", "--compare");
  line.add_flag("--parts", bench->parts,
                "Draw each frame also without one part after the other: what do they cost?");
  for (const char* other : {"--govern", "--trace", "--compare"}) line.exclude("--parts", other);
  line.exclude("--compare", "--govern");
  line.exclude("--compare", "--trace");
  return {line, [bench, line] {
            if (bench->parts)
              run_parts(*bench);
            else
              bench->compare.empty() ? run_frame_bench(*bench) : run_comparison(*bench, line);
          }};
}

}  // namespace swell::apps
