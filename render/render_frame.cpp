#include "render/frame.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <cmath>
#include <span>

#include "math/check.h"
#include "math/elementary.h"
#include "math/projection.h"
#include "raster/pass.h"
#include "raster/sample_pattern.h"
#include "render/draw_moment.h"
#include "render/exposure.h"
#include "render/wide_frame.h"
#include "render/workspace.h"
#include "render/world/world_state.h"

namespace swell::render {
namespace {

void check_view(const View& view) {
  SWELL_CHECK(view.width_px >= 1 && view.width_px <= raster::kMaxViewport && view.height_px >= 1 &&
                  view.height_px <= raster::kMaxViewport,
              "size={}x{}", view.width_px, view.height_px);
  const glm::dvec3& eye = view.eye_world;
  SWELL_CHECK(std::isfinite(eye.x) && std::isfinite(eye.y) && std::isfinite(eye.z),
              "eye_world=({}, {}, {})", eye.x, eye.y, eye.z);
  for (const glm::vec3& axis : {view.right, view.up, view.forward})
    SWELL_CHECK(std::abs(glm::length(axis) - 1.0f) < 1e-3f, "axis=({}, {}, {})", axis.x, axis.y,
                axis.z);
  SWELL_CHECK(view.near_m > 0.0f && std::isfinite(view.near_m), "near_m={}", view.near_m);
  SWELL_CHECK(view.tan_half_x > 0.0f && std::isfinite(view.tan_half_x) && view.tan_half_y > 0.0f &&
                  std::isfinite(view.tan_half_y),
              "tan_half={}, {}", view.tan_half_x, view.tan_half_y);
  SWELL_CHECK(std::isfinite(view.tan_middle_x) && std::isfinite(view.tan_middle_y),
              "tan_middle={}, {}", view.tan_middle_x, view.tan_middle_y);
  if (view.projection.kind != ProjectionKind::kFisheye) return;
  const Projection& lens = view.projection;
  SWELL_CHECK(lens.k.fx > 0.0 && std::isfinite(lens.k.fx) && lens.k.fy > 0.0 &&
                  std::isfinite(lens.k.fy) && std::isfinite(lens.k.cx) && std::isfinite(lens.k.cy),
              "fx={} fy={} cx={} cy={}", lens.k.fx, lens.k.fy, lens.k.cx, lens.k.cy);
  SWELL_CHECK(lens.half_fov_rad > 0.0 && lens.half_fov_rad <= kPi &&
                  is_one_to_one(lens.bend, lens.half_fov_rad),
              "half_fov_rad={} k=({}, {}, {}, {})", lens.half_fov_rad, lens.bend[0], lens.bend[1],
              lens.bend[2], lens.bend[3]);
}

// Views that stand for a frame's at another time have its size and projection.
void check_like(const View& other, const char* name, const View& view) {
  check_view(other);
  SWELL_CHECK(other.width_px == view.width_px && other.height_px == view.height_px &&
                  other.projection == view.projection,
              "{} of {}x{}, the frame's of {}x{}, or of another projection", name, other.width_px,
              other.height_px, view.width_px, view.height_px);
}

void check_options(const FrameOptions& o) {
  const auto check_triangles = [](int triangles) {
    SWELL_CHECK(triangles == 0 || (triangles >= 2 && triangles <= kMostTriangles), "triangles={}",
                triangles);
  };
  check_triangles(o.water_triangles);
  check_triangles(o.terrain_triangles);
  check_triangles(o.triangle_capacity);
  SWELL_CHECK(o.lookup_scale == 0.0 || (o.lookup_scale >= 0.01 && o.lookup_scale <= 1.0),
              "lookup_scale={}", o.lookup_scale);
  SWELL_CHECK(o.background_error_px <= 8.0, "background_error_px={}", o.background_error_px);
  SWELL_CHECK(o.picture_scale > 0.0 && o.picture_scale <= 1.0, "picture_scale={}", o.picture_scale);
  SWELL_CHECK(!o.exposure || (*o.exposure > 0.0 && std::isfinite(*o.exposure)), "exposure={}",
              o.exposure.value_or(0.0));
  SWELL_CHECK(o.edge_samples < 0 || raster::is_sample_count(o.edge_samples), "edge_samples={}",
              o.edge_samples);
  SWELL_CHECK(o.lod_operations >= 0 && o.lod_ms >= 0.0 && o.lod_groups >= 1,
              "lod_operations={} lod_ms={} lod_groups={}", o.lod_operations, o.lod_ms,
              o.lod_groups);
  if (!o.clip_plane) return;
  const glm::dvec4& plane = *o.clip_plane;
  const double length2 = glm::dot(glm::dvec3(plane), glm::dvec3(plane));
  SWELL_CHECK(length2 > 0.0 && std::isfinite(length2) && std::isfinite(plane.w),
              "clip_plane=({}, {}, {}, {})", plane.x, plane.y, plane.z, plane.w);
}

void check_labels(const FrameOptions& o, const View& view) {
  if (o.labels.empty()) return;
  SWELL_CHECK(o.picture_scale == 1.0, "labels of picture_scale={}", o.picture_scale);
  SWELL_CHECK(o.next_frame_s > 0.0 && std::isfinite(o.next_frame_s), "next_frame_s={}",
              o.next_frame_s);
  if (o.next_view) check_like(*o.next_view, "next_view", view);
}

void check_arguments(const World& world, const View& view, double t_s,
                     const FrameOptions& options) {
  check_view(view);
  check_options(options);
  check_labels(options, view);
  SWELL_CHECK(std::isfinite(t_s), "t_s={}", t_s);
  SWELL_CHECK(!(options.wireframe && view.projection.is_wide()), "a wireframe of a wide view");
  for (const auto& poses : {options.poses, options.next_poses})
    scene::check_given_poses(poses, world.scene().objects.size());
}

void check_exposed_views(const Exposure& exposure, const View& view, const FrameOptions& options) {
  const std::span<const View> views = options.exposed_views;
  if (views.empty()) return;
  SWELL_CHECK(views.size() == static_cast<std::size_t>(exposure.moments), "{} views of {} moments",
              views.size(), exposure.moments);
  for (const View& exposed : views) check_like(exposed, "a moment's view", view);
}

// Draws moment k of a frame, and with the last one the frame.
FrameStatistics draw_of_exposure(const World& world, const FrameRequest& request, double t_s,
                                 const Exposure& exposure, int k, Workspace& workspace,
                                 Workers& workers) {
  const scene::SensorNoise noise = noise_of(world.scene().camera, request.options);
  if (exposure.moments == 1 && noise.full_well_e == 0.0)
    return draw_moment(world, request, t_s, workspace, workers);
  FrameState& ws = workspace.state();
  const FrameStatistics statistics = draw_moment(world, moment_request(request, k, ws.moment),
                                                 t_s + k * exposure.step_s, workspace, workers);
  add_moment(k, ws.moment, *request.target);
  if (k + 1 == exposure.moments)
    finish_exposure(exposure.moments, noise, t_s, request.options.keep_linear, *request.target,
                    workers);
  return statistics;
}

// The times add up; the rest is that of the last.
void add_statistics(const FrameStatistics& last, FrameStatistics& sum) {
  FrameStatistics all = last;
  for (std::size_t i = 0; i < kStages; ++i) all.stage_ms[i] += sum.stage_ms[i];
  all.frame_ms += sum.frame_ms;
  sum = all;
}

// Adds those of a face of a wide picture.
void add_part(const FrameStatistics& part, FrameStatistics& sum) {
  for (std::size_t i = 0; i < kStages; ++i) sum.stage_ms[i] += part.stage_ms[i];
  sum.frame_ms += part.frame_ms;
  sum.water_triangles += part.water_triangles;
  sum.terrain_triangles += part.terrain_triangles;
  sum.object_triangles += part.object_triangles;
  sum.splits += part.splits;
  sum.merges += part.merges;
  sum.lod_stopped |= part.lod_stopped;
  sum.visible_pixels += part.visible_pixels;
  sum.shaded_pixels += part.shaded_pixels;
  sum.interpolated_pixels += part.interpolated_pixels;
}

// Draws perspective views of one time.
std::vector<FrameStatistics> draw_views(const World& world, std::span<const FrameRequest> requests,
                                        double t_s, const Exposure& exposure, MomentState& ws,
                                        Workers& workers) {
  std::vector<FrameStatistics> statistics(requests.size());
  const FrameOptions& first = requests.front().options;
  // A thread a view needs nobody to wait for; all threads share what is left over.
  const std::size_t threads = ws.workspaces.size();
  const std::size_t side_by_side = requests.size() / threads * threads;
  for (int k = 0; k < exposure.moments; ++k) {
    advance_sea(world.state(), t_s + k * exposure.step_s, first.disturbances, first.without, ws.sea,
                {workers, ws.profile, Stage::kSea});
    const auto draw = [&](std::size_t n, std::size_t slot, Workers& by) {
      Workspace& workspace = ws.workspaces[slot];
      workspace.state().sea = &ws.sea;
      add_statistics(draw_of_exposure(world, requests[n], t_s, exposure, k, workspace, by),
                     statistics[n]);
    };
    workers.for_each(side_by_side, [&](std::size_t n, int slot) {
      draw(n, static_cast<std::size_t>(slot), ws.alone[static_cast<std::size_t>(slot)]);
    });
    for (std::size_t n = side_by_side; n < requests.size(); ++n) draw(n, 0, workers);
  }
  return statistics;
}

// Draws views of which some may be wide: the faces of these beside the others.
std::vector<FrameStatistics> draw_with_wide(const World& world,
                                            std::span<const FrameRequest> requests, double t_s,
                                            const Exposure& exposure, MomentState& ws,
                                            Workers& workers) {
  while (ws.wide.size() < requests.size()) ws.wide.emplace_back();
  std::vector<FrameRequest> drawn;
  std::vector<std::size_t> owner;
  for (std::size_t n = 0; n < requests.size(); ++n) {
    if (requests[n].view.projection.is_wide())
      for (FrameRequest& face : face_requests(world.scene(), requests[n], ws.wide[n], workers))
        drawn.push_back(face);
    else
      drawn.push_back(requests[n]);
    owner.resize(drawn.size(), n);
  }
  const std::vector<FrameStatistics> parts =
      drawn.empty() ? std::vector<FrameStatistics>()
                    : draw_views(world, drawn, t_s, exposure, ws, workers);
  std::vector<FrameStatistics> statistics(requests.size());
  for (std::size_t i = 0; i < parts.size(); ++i) add_part(parts[i], statistics[owner[i]]);
  for (std::size_t n = 0; n < requests.size(); ++n)
    if (requests[n].view.projection.is_wide())
      finish_wide(requests[n], ws.wide[n], noise_of(world.scene().camera, requests[n].options), t_s,
                  workers);
  return statistics;
}

// The workspace has the sea of that time then, as after other frames.
FrameStatistics draw_wide_alone(const World& world, const FrameRequest& request, double t_s,
                                const Exposure& exposure, Workspace& workspace, Workers& workers) {
  FrameState& state = workspace.state();
  if (!state.of_faces) state.of_faces = std::make_unique<Workspaces>();
  MomentState& ws = state.of_faces->prepare(workers.thread_count());
  ws.profile.begin_frame(false);
  state.sea = &ws.sea;
  workspace.trace.clear();
  return draw_with_wide(world, {&request, 1}, t_s, exposure, ws, workers).front();
}

}  // namespace

FrameStatistics render_frame(const World& world, const View& view, double t_s,
                             const FrameOptions& options, Workspace& workspace, Target& target,
                             Workers& workers) {
  check_arguments(world, view, t_s, options);
  const ScopedFloatEnvironment ieee;
  const Exposure exposure = exposure_of(world.scene().camera, options);
  check_exposed_views(exposure, view, options);
  if (view.projection.is_wide())
    return draw_wide_alone(world, {view, options, &target}, t_s, exposure, workspace, workers);
  workspace.state().sea = &workspace.state().own_sea;
  FrameStatistics statistics;
  for (int k = 0; k < exposure.moments; ++k)
    add_statistics(
        draw_of_exposure(world, {view, options, &target}, t_s, exposure, k, workspace, workers),
        statistics);
  return statistics;
}

std::vector<FrameStatistics> render_many(const World& world, std::span<const FrameRequest> requests,
                                         double t_s, Workspaces& workspaces, Workers& workers) {
  if (requests.empty()) return {};
  const ScopedFloatEnvironment ieee;
  const FrameOptions& first = requests.front().options;
  const Exposure exposure = exposure_of(world.scene().camera, first);
  for (const FrameRequest& request : requests) {
    const FrameOptions& o = request.options;
    check_arguments(world, request.view, t_s, o);
    check_exposed_views(exposure, request.view, o);
    SWELL_CHECK(request.target != nullptr, "a request without a target");
    SWELL_CHECK(o.without == first.without && o.disturbances.data() == first.disturbances.data() &&
                    o.disturbances.size() == first.disturbances.size() &&
                    o.wireframe == first.wireframe,
                "requests of several seas");
    SWELL_CHECK(o.lod_operations == 0 && o.lod_ms == 0.0, "lod_operations={} lod_ms={}",
                o.lod_operations, o.lod_ms);
  }
  MomentState& ws = workspaces.prepare(workers.thread_count());
  ws.profile.begin_frame(false);
  return draw_with_wide(world, requests, t_s, exposure, ws, workers);
}

const WorldState& World::state() const {
  SWELL_CHECK(state_, "the World was moved from");
  return *state_;
}

FrameState& Workspace::state() {
  SWELL_CHECK(state_, "the Workspace was moved from");
  return *state_;
}

const FrameState& Workspace::state() const { return const_cast<Workspace*>(this)->state(); }

Workspace::Workspace() : state_(std::make_unique<FrameState>()) {}
Workspace::~Workspace() = default;
Workspace::Workspace(Workspace&&) noexcept = default;
Workspace& Workspace::operator=(Workspace&&) noexcept = default;

MomentState& Workspaces::prepare(int threads) {
  if (!state_ || state_->workspaces.size() != static_cast<std::size_t>(threads))
    state_ = std::make_unique<MomentState>(threads);
  return *state_;
}

Workspaces::Workspaces() = default;
Workspaces::~Workspaces() = default;
Workspaces::Workspaces(Workspaces&&) noexcept = default;
Workspaces& Workspaces::operator=(Workspaces&&) noexcept = default;

std::uint64_t picture_hash(const Target& target) {
  std::vector<std::uint8_t> rgb;
  rgb.reserve(target.rgba.size() * 3);
  for (const std::uint32_t p : target.rgba)
    for (int c = 0; c < 3; ++c) rgb.push_back(static_cast<std::uint8_t>(p >> (8 * c)));
  return XXH3_64bits(rgb.data(), rgb.size());
}

}  // namespace swell::render
