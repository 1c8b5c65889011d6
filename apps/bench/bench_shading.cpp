// swell-bench shading: CPU cycles that a pixel of water or sky takes, on one thread.
#include <algorithm>
#include <memory>

#include "apps/bench/bench.h"
#include "apps/bench/cpu_clock.h"
#include "apps/bench/frame_run.h"
#include "apps/bench/shading_report.h"
#include "math/check.h"
#include "render/workspace.h"
#include "render/world_view.h"

namespace swell::apps {
namespace {

constexpr int kClocksAFrame = 4;

// What the tiles of the last frame show, and how long shading each took. One thread takes them in
// their order, so that its pieces of the stage in the trace are the tiles.
ShadedFrame shaded_tiles(const render::Workspace& workspace) {
  const render::FrameState& frame = workspace.state();
  const render::VisibilityBuffer& visibility = frame.visibility;
  ShadedFrame tiles;
  for (const render::TraceEvent& piece : workspace.trace) {
    if (piece.stage != render::Stage::kShade || piece.thread < 0) continue;
    const std::size_t i = tiles.size();
    const raster::PixelBox box =
        raster::tile_box(frame.window.viewport(), visibility.grid, static_cast<int>(i));
    ShadedTile& tile = tiles.emplace_back();
    tile.pixels = box.width_px * box.height_px;
    tile.us = piece.end_us - piece.start_us;
    if (visibility.water_pixels[i] == tile.pixels) tile.shows = ShadedTile::Shows::kWater;
    if (visibility.covered[i] <= 0) tile.shows = ShadedTile::Shows::kSky;
  }
  SWELL_CHECK(tiles.size() == static_cast<std::size_t>(visibility.grid.count()), "pieces={}",
              tiles.size());
  return tiles;
}

ShadingReport measure_shading(const FrameRun& run, const render::World& world) {
  Workers one_thread(1);
  render::Workspace workspace;
  workspace.trace_enabled = true;
  render::Target target;
  ocean::SeaFrame camera_sea;
  std::vector<ShadedFrame> frames;
  double clock_ghz = 0.0;
  for (int k = -kWarmUp; k < run.frames; ++k) {
    const double t_s = k / kFramesPerSecond;
    const PictureSize size = run.setup.size;
    const View view =
        render::world_view(world, t_s, size.width_px, size.height_px, camera_sea, one_thread);
    render::render_frame(world, view, t_s, run.setup.frame, workspace, target, one_thread);
    for (int n = 0; n < kClocksAFrame; ++n) clock_ghz = std::max(clock_ghz, measure_clock_ghz());
    if (k >= 0) frames.push_back(shaded_tiles(workspace));
  }
  return report_shading(frames, clock_ghz);
}

void run_shading_bench(const FrameRun& run) {
  const render::World world = begin_run(run);
  stay_on_this_cpu();
  const ShadingReport report = measure_shading(run, world);
  report_run(run, world, "one thread", shading_text(report), shading_json(report));
}

}  // namespace

BenchMode add_bench_shading(CommandLine& program) {
  const auto run = std::make_shared<FrameRun>();
  run->setup.frame.edge_samples = 0;
  CommandLine line = program.add_mode(
      "shading",
      "CPU cycles a pixel that one thread takes to shade tiles that show water or sky alone. Its "
      "time counts in cycles of the clock that was measured between the frames. --threads is for "
      "what is made before the first frame; edge samples are off");
  add_frame_run(line, "Frames to measure; frame k is at k / 60 s", *run);
  return {line, [run] { run_shading_bench(*run); }};
}

}  // namespace swell::apps
