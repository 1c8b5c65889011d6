#include "render/frame.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "math/check.h"
#include "math/large_array.h"
#include "raster/sample_pattern.h"
#include "render/view/self_shadows.h"
#include "render/workspace.h"

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
  if (!o.next_view) return;
  check_view(*o.next_view);
  SWELL_CHECK(o.next_view->width_px == view.width_px && o.next_view->height_px == view.height_px,
              "next_view of {}x{}, view of {}x{}", o.next_view->width_px, o.next_view->height_px,
              view.width_px, view.height_px);
}

void check_arguments(const View& view, double t_s, const FrameOptions& options) {
  check_view(view);
  check_options(options);
  check_labels(options, view);
  SWELL_CHECK(std::isfinite(t_s), "t_s={}", t_s);
}

// What is drawn when the picture is drawn small: the same view on fewer pixels.
View drawn_view(const View& view, const FrameOptions& options) {
  View drawn = view;
  if (options.keep_linear) return drawn;
  const auto scaled = [&](int size) {
    return std::clamp(static_cast<int>(std::lround(size * options.picture_scale)), 1, size);
  };
  drawn.width_px = scaled(view.width_px);
  drawn.height_px = scaled(view.height_px);
  return drawn;
}

// Sizes what depends on the picture and the thread count; after the first frame this does nothing.
void prepare_target(const View& view, const FrameOptions& options, Target& target) {
  const std::size_t pixels = static_cast<std::size_t>(view.width_px) * view.height_px;
  target.width_px = view.width_px;
  target.height_px = view.height_px;
  resize_large(target.rgba, pixels);
  target.linear.resize(options.keep_linear ? 3 * pixels : 0);
  resize_labels(options.labels, {view.width_px, view.height_px}, target.labels);
}

void prepare_scratch(int threads, Workspace::State& ws) {
  while (ws.scratch.size() < static_cast<std::size_t>(threads))
    ws.scratch.push_back(std::make_unique<ThreadScratch>());
}

// The cameras of the window and of what its water looks into, from the air and from below.
std::array<RenderView*, 5> prepare_views(const World::State& world, const View& view,
                                         const FrameOptions& options, Workspace::State& ws) {
  ws.window.camera = view;
  for (PlanarMaps* const images : {&ws.planar_maps, &ws.wet_planar_maps}) {
    RenderView &reflection = images->reflection.view, &refraction = images->refraction.view;
    reflection.kind = ViewKind::kReflection;
    refraction.kind = ViewKind::kRefraction;
    refraction.refraction_index = static_cast<float>(world.scene.water.refraction_index);
    refraction.paper_refraction = world.scene.water.refraction == scene::RefractionModel::kPaper;
    reflection.camera = refraction.camera = planar_camera(view, options.lookup_scale);
  }
  const std::array views = {&ws.window, &ws.planar_maps.reflection.view,
                            &ws.planar_maps.refraction.view, &ws.wet_planar_maps.reflection.view,
                            &ws.wet_planar_maps.refraction.view};
  RenderView& mirror = ws.river_mirror.view;
  mirror.kind = ViewKind::kReflection;
  mirror.camera = planar_camera(view, options.lookup_scale);
  mirror.drop_per_m2 = drop_per_m2(world.earth_radius_m(options.without));
  mirror.clip_plane = options.clip_plane;
  mirror.clip_margin_m = 0.05f;
  for (RenderView* const shown : views) {
    shown->drop_per_m2 = drop_per_m2(world.earth_radius_m(options.without));
    shown->clip_plane = options.clip_plane;
    shown->land = world.land_rays.get();
    shown->land_has_apron = !options.without.has(Part::kApron);
    shown->clip_margin_m = clip_margin_m(world.water_bounds().height_m);
  }
  return views;
}

void set_eye(const EyeInWater& eye, FrameViews views) {
  for (RenderView* const view : views) view->eye = eye;
}

// Stage 3: the places of all vertices in the frame's views. Where the waterline crosses the
// picture, the first three are of an eye in air and two more of one in water. Without water there
// is the window alone.
void place_vertices(const World::State& world, const View& view, double t_s,
                    const FrameOptions& options, FrameViews all_views, Workspace::State& ws,
                    const StageRun& run) {
  EyeInWater eye = find_eye_in_water(world, ws.sea, view, options);
  FrameViews views = all_views.first(options.without.has(Part::kWater) ? 1 : 3);
  set_eye(eye, views);
  displace(world, ws.sea, view, options, ws.meshes, views, run);
  ws.crossing.picture = Begins::kInAir;
  if (!options.without.has(Part::kUnderwater))
    find_crossing(ws.meshes.water, view, eye, world.water_bounds(options.disturbances).height_m,
                  ws.crossing);
  if (eye.submerged != (ws.crossing.picture == Begins::kInWater)) {
    eye.submerged = !eye.submerged;
    set_eye(eye, views);
    map_land(ws.meshes, views.subspan(1), run);
  }
  if (ws.crossing.picture == Begins::kInBoth) {
    views = all_views;
    set_eye({true, eye.to_surface_m}, views.subspan(3));
    map_land(ws.meshes, views.subspan(3), run);
  }
  std::array<RenderView*, 6> shown{};
  std::size_t count = 0;
  for (RenderView* const one : views) shown[count++] = one;
  if (ws.meshes.rivers.mirror_level_m && !eye.submerged) {
    RenderView& mirror = ws.river_mirror.view;
    mirror.level_m = *ws.meshes.rivers.mirror_level_m;
    mirror.eye = {false, std::max(static_cast<float>(view.eye_world.z) - mirror.level_m, 0.05f)};
    map_land(ws.meshes, {&(shown[count++] = &mirror), 1}, run);
  }
  ws.meshes.objects.draws_implicits = !options.without.has(Part::kImplicits);
  const FrameViews all = FrameViews(shown).first(count);
  place_objects(world, ws.sea, options.poses, ws.meshes, all, run);
  const double before_us = run.profile.now_us();
  place_trees(world, t_s, options, ws.meshes, all, {run.workers, run.profile, Stage::kTrees});
  run.profile.move(run.stage, Stage::kTrees, 1e-3 * (run.profile.now_us() - before_us));
}

void enlarge_picture(const Target& small, EnlargeTables& tables, const View& view, Target& target,
                     Workers& workers) {
  prepare_target(view, {}, target);
  enlarge(small.rgba, {small.width_px, small.height_px}, target.rgba,
          {view.width_px, view.height_px}, tables, workers);
}

FrameStatistics statistics_of(const Workspace::State& ws) {
  FrameStatistics s;
  s.stage_ms = ws.profile.stage_ms();
  s.frame_ms = ws.profile.now_us() * 1e-3;
  s.water_triangles = ws.meshes.water.statistics.triangles;
  s.terrain_triangles = ws.meshes.land.statistics.triangles;
  s.object_triangles = static_cast<int>(ws.meshes.objects.in_window().primitives.size());
  s.splits = ws.meshes.water.statistics.splits + ws.meshes.land.statistics.splits;
  s.merges = ws.meshes.water.statistics.merges + ws.meshes.land.statistics.merges;
  s.lod_stopped = ws.meshes.water.statistics.stopped || ws.meshes.land.statistics.stopped;
  for (const int covered : ws.visibility.covered)
    s.visible_pixels += static_cast<std::uint64_t>(std::max(covered, 0));
  for (const int shaded : ws.shaded) s.shaded_pixels += static_cast<std::uint64_t>(shaded);
  return s;
}

}  // namespace

std::string_view stage_name(Stage stage) {
  using enum Stage;
  constexpr auto kNames = enum_words<Stage>({
      {kSea, "sea"},
      {kTriangulate, "triangulate"},
      {kDisplace, "displace"},
      {kTrees, "trees"},
      {kVisibility, "visibility"},
      {kRays, "rays"},
      {kPlanarMaps, "lookups"},
      {kClouds, "clouds"},
      {kShade, "shade"},
  });
  return kNames[stage];
}

FrameOptions with_scene_defaults(const FrameOptions& options, const scene::Scene& scene) {
  FrameOptions result = options;
  if (result.water_triangles == 0) result.water_triangles = scene.detail.water_triangles;
  if (result.terrain_triangles == 0) result.terrain_triangles = scene.detail.terrain_triangles;
  if (result.lookup_scale == 0.0) result.lookup_scale = scene.water.lookup_scale;
  if (result.background_error_px < 0.0)
    result.background_error_px = scene.detail.background_error_px;
  if (result.edge_samples < 0) result.edge_samples = scene.picture.edge_samples;
  return result;
}

FrameStatistics render_frame(const World& world, const View& view, double t_s,
                             const FrameOptions& asked, Workspace& workspace, Target& target,
                             Workers& workers) {
  check_arguments(view, t_s, asked);
  for (const auto& poses : {asked.poses, asked.next_poses})
    scene::check_given_poses(poses, world.scene().objects.size());
  const ScopedFloatEnvironment ieee;
  const World::State& world_state = world.state();
  Workspace::State& ws = workspace.state();
  const FrameOptions options = with_scene_defaults(asked, world.scene());
  const View drawn = drawn_view(view, options);
  const bool small = drawn.width_px < view.width_px || drawn.height_px < view.height_px;
  Target& drawn_target = small ? ws.small : target;
  ws.profile.begin_frame(workspace.trace_enabled);
  prepare_target(drawn, options, drawn_target);
  prepare_scratch(workers.thread_count(), ws);
  const std::array<RenderView*, 5> views = prepare_views(world_state, drawn, options, ws);
  const auto stage = [&](Stage name, auto&& work) {
    const StageScope scope(ws.profile, name);
    work(StageRun{workers, ws.profile, name});
  };

  const glm::dvec3 eye = view.eye_world;
  const double sky_m = sky_height_m(view, options.without);
  const Clouds clouds = make_clouds(world_state, t_s, {eye.x, eye.y, sky_m}, options.without);
  const Fog fog = make_fog(world_state, t_s, eye, options.without);
  const Clouds mirrored = make_clouds(world_state, t_s, {eye.x, eye.y, 0.0}, options.without);
  workers.run_both(
      [&] {
        stage(Stage::kSea, [&](const StageRun& run) {
          advance_sea(world_state, t_s, options.disturbances, options.without, ws.sea, run);
          advance_clouds(world_state, mirrored, t_s, glm::dvec2(eye), options.without, ws.sky, run);
          advance_sky(world_state, mirrored, fog, sky_m, options.without, ws.sky, run);
        });
      },
      [&] {
        stage(Stage::kTriangulate, [&](const StageRun& run) {
          triangulate(world_state, drawn, t_s, options, ws.meshes, run);
        });
      });
  Light light = make_light(world_state, clouds, ws.sky, fog);
  light.stars = make_stars(world_state, t_s, options.without);
  stage(Stage::kDisplace, [&](const StageRun& run) {
    place_vertices(world_state, drawn, t_s, options, views, ws, run);
    const ShadowOptions shadows{light.sun_direction, options.without, options.disturbances};
    find_shadow_casters(world_state, shadows, drawn, ws.meshes.objects, run);
    find_self_shadows(world_state, shadows, drawn, ws.meshes.objects, run);
  });
  stage(Stage::kVisibility, [&](const StageRun& run) {
    find_visible(ws.meshes, options.tile_size_px, options.edge_samples, ws.window, ws.visibility,
                 run);
    prepare_edges(ws.meshes.objects.in_window(), ws.window, ws.visibility, options.edge_samples,
                  ws.edges);
  });
  const VolumeClouds volume_clouds =
      make_volume_clouds(world_state, t_s, eye, make_rays(drawn).pixel_angle, options.without);
  const Media air = make_media(world_state, light, fog, sky_m, options.without);
  const Media water = submerge(air, drawn.eye_world.z);
  const EyeInWater first_side = ws.window.eye;
  const bool crosses = ws.crossing.picture == Begins::kInBoth;
  const auto draw_side = [&](const EyeInWater& side, PlanarMaps& planar_maps, Shading& shading,
                             const StageRun& run) {
    MaterialInputs inputs{world_state,       t_s,   ws.sea,
                          ws.meshes.objects, light, side.submerged ? water : air,
                          options.without};
    inputs.wave_reach_m = ws.meshes.water.statistics.reach_m;
    inputs.trees = &ws.meshes.trees;
    ws.window.eye = side;
    draw_planar_maps(ws.meshes, ws.window, ws.visibility, ws.scratch, inputs, planar_maps, run);
    if (ws.meshes.rivers.mirror_level_m && !side.submerged)
      draw_river_mirror(ws.meshes, ws.window, ws.visibility, ws.scratch, inputs, ws.river_mirror,
                        run);
    fill_shading(inputs, ws.window, options.tile_size_px, shading);
  };
  stage(Stage::kPlanarMaps, [&](const StageRun& run) {
    if (crosses)
      draw_side({true, first_side.to_surface_m}, ws.wet_planar_maps, ws.wet_shading, run);
    draw_side(first_side, ws.planar_maps, ws.shading, run);
  });
  stage(Stage::kClouds, [&](const StageRun& run) {
    draw_clouds(ws.shading, volume_clouds, float(drawn.width_px) / float(view.width_px), ws.clouds,
                run);
    ws.shading.clouds = &ws.clouds;
  });
  stage(Stage::kShade, [&](const StageRun& run) {
    if (!options.labels.empty())
      fill_label_tables({world_state, ws.meshes, ws.window, options, t_s}, ws.labels, run);
    const WetSide wet{ws.crossing, ws.wet_shading, ws.wet_planar_maps.of_tile,
                      !options.without.has(Part::kMeniscus)};
    const LabelSources labels{ws.labels, ws.shading, ws.meshes.objects.in_window(),
                              ws.meshes.trees.drawn_in(ViewKind::kWindow), world_state};
    shade_picture(
        {ws.meshes, ws.window, ws.visibility, ws.edges, ws.planar_maps.of_tile, ws.shading,
         options.wireframe, options.labels.empty() ? nullptr : &labels, crosses ? &wet : nullptr},
        ws.scratch, ws.shaded, drawn_target, run);
    if (small) enlarge_picture(ws.small, ws.enlarge, view, target, workers);
  });
  workspace.trace = ws.profile.trace();
  return statistics_of(ws);
}

const World::State& World::state() const {
  SWELL_CHECK(state_, "the World was moved from");
  return *state_;
}

Workspace::State& Workspace::state() {
  SWELL_CHECK(state_, "the Workspace was moved from");
  return *state_;
}

const Workspace::State& Workspace::state() const { return const_cast<Workspace*>(this)->state(); }

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
