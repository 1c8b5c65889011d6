#include "render/frame.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <numeric>

#include "math/check.h"
#include "render/frame_state.h"

namespace swell::render {
namespace {

// Sizes what depends on the picture and the thread count; after the first frame this does nothing.
void prepare(Frame& frame, Target& target) {
  const std::size_t pixels = static_cast<std::size_t>(frame.view.width_px) * frame.view.height_px;
  target.width_px = frame.view.width_px;
  target.height_px = frame.view.height_px;
  target.rgba.resize(pixels);
  target.linear.resize(frame.options.keep_linear ? 3 * pixels : 0);
  while (frame.ws.scratch.size() < static_cast<std::size_t>(frame.workers.thread_count()))
    frame.ws.scratch.push_back(std::make_unique<ThreadScratch>());
}

FrameStatistics statistics_of(const Workspace::State& ws) {
  FrameStatistics s;
  s.stage_ms = ws.profile.stage_ms();
  s.frame_ms = ws.profile.now_us() * 1e-3;
  s.water_triangles = ws.water.statistics.triangles;
  s.terrain_triangles = ws.land.statistics.triangles;
  s.splits = ws.water.statistics.splits + ws.land.statistics.splits;
  s.merges = ws.water.statistics.merges + ws.land.statistics.merges;
  for (const int covered : ws.visibility.covered)
    s.visible_pixels += static_cast<std::uint64_t>(std::max(covered, 0));
  for (const int shaded : ws.shaded) s.shaded_pixels += static_cast<std::uint64_t>(shaded);
  return s;
}

}  // namespace

std::string_view stage_name(Stage stage) {
  constexpr std::string_view kNames[] = {"sea",        "triangulate", "displace",
                                         "visibility", "lookups",     "shade"};
  return kNames[static_cast<std::size_t>(stage)];
}

FrameStatistics render_frame(const World& world, const View& view, double t_s,
                             const FrameOptions& options, Workspace& workspace, Target& target,
                             Workers& workers) {
  SWELL_CHECK(view.width_px <= raster::kMaxViewport && view.height_px <= raster::kMaxViewport,
              "size={}x{}", view.width_px, view.height_px);
  const ScopedFloatEnvironment ieee;
  Workspace::State& ws = workspace.state();
  Frame frame{world.state(), view, t_s, options, ws, workers};
  ws.profile.begin_frame(workspace.trace_enabled);
  prepare(frame, target);

  workers.run_both(
      [&] {
        const StageScope stage(ws.profile, Stage::kSea);
        advance_sea(frame);
      },
      [&] {
        const StageScope stage(ws.profile, Stage::kTriangulate);
        triangulate(frame);
      });
  {
    const StageScope stage(ws.profile, Stage::kDisplace);
    displace(frame);
  }
  {
    const StageScope stage(ws.profile, Stage::kVisibility);
    find_visible(frame);
  }
  {
    const StageScope stage(ws.profile, Stage::kLookups);
    draw_lookup_images(frame);
  }
  {
    const StageScope stage(ws.profile, Stage::kShade);
    shade_pixels(frame, target);
  }
  workspace.trace = ws.profile.trace();
  return statistics_of(ws);
}

Workspace::Workspace() : state_(std::make_unique<State>()) {}
Workspace::~Workspace() = default;
Workspace::Workspace(Workspace&&) noexcept = default;
Workspace& Workspace::operator=(Workspace&&) noexcept = default;

std::uint64_t picture_hash(const Target& target) {
  std::vector<std::uint8_t> rgb;
  rgb.reserve(target.rgba.size() * 3);
  for (const std::uint32_t p : target.rgba)
    for (int c = 0; c < 3; ++c) rgb.push_back(static_cast<std::uint8_t>(p >> (8 * c)));
  return XXH3_64bits(rgb.data(), rgb.size());
}

}  // namespace swell::render
