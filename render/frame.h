// Drawing a frame: the library's main entry.
//
//   swell::Workers workers(2);
//   swell::render::World world(swell::scene::load_scene("open_ocean.toml"));
//   swell::render::Workspace workspace;
//   swell::render::Target target;
//   swell::ocean::SeaFrame sea;
//   const auto view = world_view(world, t_s, 1280, 720, sea, workers);  // world_view.h
//   swell::render::render_frame(world, view, t_s, {}, workspace, target, workers);
//   // target.rgba: 1280 * 720 pixels, R in the low byte
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "math/parallel.h"
#include "math/view.h"
#include "render/frame/options.h"
#include "render/frame/stages.h"
#include "render/frame/target.h"
#include "render/world/world.h"

namespace swell::render {

struct FrameStatistics {
  std::array<double, kStages> stage_ms{};
  double frame_ms = 0.0;
  int water_triangles = 0, terrain_triangles = 0;
  int object_triangles = 0;  // of those that the view may show
  int splits = 0, merges = 0;
  bool lod_stopped = false;          // at one of the bounds, with work left
  std::uint64_t visible_pixels = 0;  // pixels that show water, terrain or an object
  // Of these, surface shader runs and those filled in between them.
  std::uint64_t shaded_pixels = 0, interpolated_pixels = 0;
};

struct FrameState;  // workspace.h

// Everything that is reused from frame to frame: a cache, never an input. One frame at a time. One
// that was moved from: as a World.
class Workspace {
 public:
  Workspace();
  ~Workspace();
  Workspace(Workspace&&) noexcept;
  Workspace& operator=(Workspace&&) noexcept;

  FrameState& state();
  const FrameState& state() const;
  // The trace is that of the last frame; it is empty unless trace_enabled was set before that
  // frame.
  bool trace_enabled = false;
  std::vector<TraceEvent> trace;

 private:
  std::unique_ptr<FrameState> state_;
};

// Draws the world at time t_s; a wide view (View::projection) by several perspective ones, whose
// statistics add up. The picture depends on (world, view, t_s, options) alone: any
// worker count, SIMD target, tile size and history give the same bits. Aborts with a message where
// the view has no size in [1, 8192] x [1, 8192], is not finite, its axes are no unit vectors or its
// fisheye is not one to one,
// where t_s is not finite, and where an option lies outside its range.
FrameStatistics render_frame(const World& world, const View& view, double t_s,
                             const FrameOptions& options, Workspace& workspace, Target& target,
                             Workers& workers);

// One of several views of the same time.
struct FrameRequest {
  View view;
  FrameOptions options = {};
  Target* target = nullptr;  // its own
};

struct MomentState;  // workspace.h

// A Workspace for several views at once.
class Workspaces {
 public:
  Workspaces();
  ~Workspaces();
  Workspaces(Workspaces&&) noexcept;
  Workspaces& operator=(Workspaces&&) noexcept;

  MomentState& prepare(int threads);

 private:
  std::unique_ptr<MomentState> state_;
};

// Draws several views of the world at one time, each with the bits that render_frame() gives it.
// They share the sea, and each is drawn by one thread where there are views for all: many small
// ones take far less time than one after the other. Aborts as render_frame() does, and where the
// requests differ in `without` or `disturbances` or bound the triangulation. Returns a frame's
// statistics for each.
std::vector<FrameStatistics> render_many(const World& world, std::span<const FrameRequest> requests,
                                         double t_s, Workspaces& workspaces, Workers& workers);

// XXH3-64 of the picture's RGB bytes, row by row.
std::uint64_t picture_hash(const Target& target);

}  // namespace swell::render
