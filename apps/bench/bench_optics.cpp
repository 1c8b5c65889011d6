// swell-bench optics: a paper's table of frames/s without water and with it, made again.
#include <fmt/core.h>

#include <memory>

#include "apps/bench/bench.h"
#include "apps/bench/frame_run.h"
#include "apps/bench/optics_table.h"
#include "apps/shared/notices.h"

namespace swell::apps {
namespace {

OpticsRow measure_row(const FrameRun& run, const render::World& world, int triangles,
                      Workers& workers) {
  const std::optional<StillScene> still = make_still_scene(world, run.setup, triangles, workers);
  if (!still)
    throw OptionError(
        fmt::format("command line: --scene, got '{}', allowed a scene whose land and objects can "
                    "have {} triangles",
                    run.setup.scene.path, triangles));
  return measure_water(*still, run.frames, workers);
}

void run_optics_bench(const FrameRun& run) {
  const render::World world = begin_run(run);
  Workers workers(run.setup.threads);
  std::vector<OpticsRow> rows;
  for (const PaperRow& row : kPaperRows)
    rows.push_back(measure_row(run, world, row.triangles, workers));
  const int threads = run.setup.threads;
  report_run(run, world, fmt::format("{} thread{}", threads, threads == 1 ? "" : "s"),
             optics_text(rows),
             {{"threads", threads}, {"frames", run.frames}, {"rows", optics_json(rows)}});
}

}  // namespace

BenchMode add_bench_optics(CommandLine& program) {
  const auto run = std::make_shared<FrameRun>();
  CommandLine line = program.add_mode(
      "optics",
      "Frames/s without water and with water of two triangles, in scenes of 13912, 27824 and 41736 "
      "triangles of land and objects, beside those of a paper. All stands still but the water; one "
      "object is left out where that is needed for the number");
  add_required_frame_setup(line, run->setup);
  add_without_option(line, run->setup.frame.without);
  add_integer(line, "--frames", run->frames, 1, 10000, "Frames to measure of each, by turns");
  add_json_option(line, run->json);
  return {line, [run] { run_optics_bench(*run); }};
}

}  // namespace swell::apps
