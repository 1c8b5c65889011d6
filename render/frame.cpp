#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "math/check.h"
#include "math/large_array.h"
#include "ocean/water_surface.h"
#include "raster/sample_pattern.h"
#include "render/draw_moment.h"
#include "render/picture/label_tile.h"
#include "render/shadows/self_shadows.h"
#include "render/sky/volume_clouds.h"
#include "render/tile/ripples.h"
#include "render/workspace.h"
#include "render/world/world_state.h"

namespace swell::render {
namespace {

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

void prepare_scratch(int threads, FrameState& ws) {
  while (ws.scratch.size() < static_cast<std::size_t>(threads))
    ws.scratch.push_back(std::make_unique<ThreadScratch>());
}

// What every stage of a frame reads, and where they write.
struct FrameInputs {
  const WorldState& world;
  const View& view;  // as it is drawn
  double t_s;
  const FrameOptions& options;  // with the scene's defaults
  FrameState& ws;
  Workers& workers;

  bool has(Part part) const { return !options.without.has(part); }

  // Runs work(run) as a whole stage: a row of the profile, of the bench and of the trace.
  template <class Work>
  void stage(Stage name, const Work& work) const {
    const StageScope scope(ws.profile, name);
    work(StageRun{workers, ws.profile, name});
  }
};

// Views of a frame, which stages go through one by one.
class ViewList {
 public:
  void add(RenderView& view) { views_[count_++] = &view; }
  void add(FrameViews views) {
    for (RenderView* const view : views) add(*view);
  }
  FrameViews all() const { return std::span(views_).first(count_); }

 private:
  // The window, two images a side of the water, mirrors of rivers.
  std::array<RenderView*, 5 + kMostRiverMirrors> views_{};
  std::size_t count_ = 0;
};

// The images that water on one side looks into.
ViewList views_of(PlanarMaps& maps) {
  ViewList views;
  views.add(maps.reflection.view);
  views.add(maps.refraction.view);
  return views;
}

// The cameras of the window and of what its water looks into, from the air and from below.
void prepare_views(const FrameInputs& in) {
  FrameState& ws = in.ws;
  const auto prepare = [&](RenderView& view, ViewKind kind, const View& camera, float margin_m) {
    view.kind = kind;
    view.camera = camera;
    view.drop_per_m2 = drop_per_m2(in.world.earth_radius_m(in.options.without));
    view.clip_plane = in.options.clip_plane;
    view.clip_margin_m = margin_m;
    view.level_m = 0.0f;
  };
  const View image = planar_camera(in.view, in.options.lookup_scale);
  const float margin_m = clip_margin_m(in.world.water_bounds().height_m);
  prepare(ws.window, ViewKind::kWindow, in.view, margin_m);
  for (PlanarTarget& mirror : ws.river_mirrors.targets)
    prepare(mirror.view, ViewKind::kReflection, image, 0.05f);
  ViewList with_land;
  with_land.add(ws.window);
  for (PlanarMaps* const maps : {&ws.planar_maps, &ws.wet_planar_maps}) {
    RenderView& refraction = maps->refraction.view;
    prepare(maps->reflection.view, ViewKind::kReflection, image, margin_m);
    prepare(refraction, ViewKind::kRefraction, image, margin_m);
    refraction.refraction_index = static_cast<float>(in.world.scene.water.refraction_index);
    refraction.paper_refraction = in.world.scene.water.refraction == scene::RefractionModel::kPaper;
    with_land.add(views_of(*maps).all());
  }
  for (RenderView* const view : with_land.all()) {
    view->land = in.world.land_rays.get();
    view->land_has_apron = in.has(Part::kApron);
  }
}

// The air over the eye, before there is a sea.
struct Air {
  double sky_m;             // the eye's height, as the sky counts it
  Clouds clouds, mirrored;  // as the eye sees them, and as the sea's level does
  Fog fog;
};

Air find_air(const FrameInputs& in) {
  const glm::dvec3 eye = in.view.eye_world;
  const PartSet without = in.options.without;
  const double sky_m = sky_height_m(in.view, without);
  return {sky_m, make_clouds(in.world, in.t_s, {eye.x, eye.y, sky_m}, without),
          make_clouds(in.world, in.t_s, {eye.x, eye.y, 0.0}, without),
          make_fog(in.world, in.t_s, eye, without)};
}

Light find_light(const FrameInputs& in, const Air& air) {
  Light light = make_light(in.world, air.clouds, in.ws.sky, air.fog, base_variance(in.world.scene));
  light.stars = make_stars(in.world, in.t_s, in.options.without);
  if (in.options.exposure)
    light.exposure = static_cast<float>(*in.options.exposure /
                                        static_cast<double>(in.world.sky->stored_exposure));
  return light;
}

// Stage 1: the sea, the clouds and the sky at the frame's time.
void advance(const FrameInputs& in, const Air& air, const StageRun& run) {
  const PartSet without = in.options.without;
  const glm::dvec2 eye(in.view.eye_world);
  if (in.ws.sea == &in.ws.own_sea)
    advance_sea(in.world, in.t_s, in.options.disturbances, without, in.ws.own_sea, run);
  advance_clouds(in.world, air.mirrored, in.t_s, eye, without, in.ws.sky, run);
  advance_sky(in.world, air.mirrored, air.fog, air.sky_m, without, in.ws.sky, run);
}

void set_eye(const EyeInWater& eye, FrameViews views) {
  for (RenderView* const view : views) {
    view->eye = eye;
    view->level_m = eye.level_m;
  }
}

// Displaces water and land into the views, and finds where the waterline crosses the picture.
// Returns the views that are shown: then images of both sides. Without water the window alone.
ViewList place_water(const FrameInputs& in, const StageRun& run) {
  FrameState& ws = in.ws;
  const WaterAtEye water = find_water_at_eye(in.world, *ws.sea, in.view, in.options);
  const ViewList images = in.has(Part::kWater) ? views_of(ws.planar_maps) : ViewList{};
  ViewList views;
  views.add(ws.window);
  views.add(images.all());
  set_eye(water.from(water.submerged), views.all());
  displace(in.world, *ws.sea, in.view, in.options, ws.meshes, views.all(), run);
  ws.crossing.picture = Begins::kInAir;
  if (in.has(Part::kUnderwater))
    find_crossing(ws.meshes.water, in.view, water,
                  in.world.water_bounds(in.options.disturbances).height_m, ws.crossing);
  const bool begins_in_water = ws.crossing.picture == Begins::kInWater;
  if (water.submerged != begins_in_water) {
    set_eye(water.from(begins_in_water), views.all());
    map_land(ws.meshes, images.all(), run);
  }
  if (ws.crossing.picture == Begins::kInBoth) {
    const ViewList wet = views_of(ws.wet_planar_maps);
    set_eye(water.in_water, wet.all());
    map_land(ws.meshes, wet.all(), run);
    views.add(wet.all());
  }
  return views;
}

// Adds the mirrors of rivers and lakes, if they are seen from the air.
void place_river_mirrors(const FrameInputs& in, ViewList& views, const StageRun& run) {
  FrameState& ws = in.ws;
  const std::span<const RiverMirror> levels = ws.meshes.rivers.mirrors();
  if (levels.empty() || ws.window.eye.submerged) return;
  ViewList mirrors;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    RenderView& mirror = ws.river_mirrors.targets[k].view;
    mirror.level_m = levels[k].level_m;
    const float above_m = static_cast<float>(in.view.eye_world.z) - mirror.level_m;
    mirror.eye = {false, std::max(above_m, 0.05f)};
    mirrors.add(mirror);
  }
  map_land(ws.meshes, mirrors.all(), run);
  views.add(mirrors.all());
}

// Stage 3: the places of all vertices but the trees' in the frame's views, which it returns.
ViewList place_vertices(const FrameInputs& in, const StageRun& run) {
  FrameState& ws = in.ws;
  ViewList views = place_water(in, run);
  place_river_mirrors(in, views, run);
  ws.meshes.objects.draws_implicits = in.has(Part::kImplicits);
  place_objects(in.world, *ws.sea, in.options.poses, ws.meshes, views.all(), run);
  place_surfaces({in.world, in.t_s, in.view, in.options.without}, ws.meshes, views.all());
  return views;
}

void find_shadows(const FrameInputs& in, const Light& light, const StageRun& run) {
  const ShadowOptions shadows{light.sun_direction, in.options.without, in.options.disturbances};
  find_shadow_casters(in.world, shadows, in.view, in.ws.meshes.objects, run);
  find_self_shadows(in.world, shadows, in.view, in.ws.meshes.objects, run);
}

// Stage 5 on one side of the water: the images that it looks into, and what shading needs.
void draw_side(const FrameInputs& in, const Light& light, const Media& media, PlanarMaps& maps,
               ViewShading& shading, const StageRun& run) {
  FrameState& ws = in.ws;
  MaterialInputs inputs{in.world, in.t_s, *ws.sea,           ws.meshes.objects,
                        light,    media,  in.options.without};
  inputs.wave_reach_m = ws.meshes.water.statistics.reach_m;
  inputs.trees = &ws.meshes.trees;
  draw_planar_maps(ws.meshes, ws.window, ws.visibility, ws.scratch, inputs, maps, run);
  if (!media.submerged)
    draw_river_mirrors(ws.meshes, ws.window, ws.visibility, ws.scratch, inputs, ws.river_mirrors,
                       run);
  fill_shading(inputs, ws.window, in.options.tile_size_px, shading);
  shading.is_adaptive = in.options.shading == scene::ShadingRate::kAdaptive;
}

// Stage 5: images of both sides if the waterline crosses the picture, the eye's own last.
void draw_images(const FrameInputs& in, const Light& light, const Air& air, const StageRun& run) {
  FrameState& ws = in.ws;
  const Media in_air = make_media(in.world, light, air.fog, air.sky_m, in.options.without);
  const RenderView& from_water = ws.crossing.picture == Begins::kInBoth
                                     ? ws.wet_planar_maps.reflection.view
                                     : ws.planar_maps.reflection.view;
  const Media in_water = submerge(in_air, in.view.eye_world.z, from_water.level_m);
  if (ws.crossing.picture == Begins::kInBoth)
    draw_side(in, light, in_water, ws.wet_planar_maps, ws.wet_shading, run);
  draw_side(in, light, ws.window.eye.submerged ? in_water : in_air, ws.planar_maps, ws.shading,
            run);
}

// Volumetric clouds in the window, which is drawn `scale` times as large as asked for.
void draw_window_clouds(const FrameInputs& in, float scale, const StageRun& run) {
  const VolumeClouds clouds = make_volume_clouds(
      in.world, in.t_s, in.view.eye_world, make_rays(in.view).pixel_angle, in.options.without);
  draw_clouds(in.ws.shading, clouds, scale, in.ws.clouds, run);
  in.ws.shading.clouds = &in.ws.clouds;
}

// Fog at vertices or by depth in the window, if the scene has it found so.
void store_fog(const FrameInputs& in, const StageRun& run) {
  FrameState& ws = in.ws;
  const Fog& fog = ws.shading.media.fog;
  const scene::FogMethod method = in.world.scene.air.method;
  const bool is_stored =
      fog.on && !ws.shading.media.submerged && method != scene::FogMethod::kPixel;
  ws.shading.stored_fog = is_stored ? &ws.fog : nullptr;
  if (!is_stored) return;
  if (method == scene::FogMethod::kVertex)
    find_fog_at_vertices(fog, ws.meshes, ws.window, ws.fog, run);
  else
    find_fog_by_depth(fog, ws.shading.rays, {in.view.width_px, in.view.height_px}, ws.fog);
}

// Stage 6: the picture, and the labels that are asked for.
void shade(const FrameInputs& in, Target& target, const StageRun& run) {
  FrameState& ws = in.ws;
  const bool has_labels = !in.options.labels.empty();
  if (has_labels)
    fill_label_tables({in.world, ws.meshes, ws.window, in.options, in.t_s}, ws.labels, run);
  const WetSide wet{ws.crossing, ws.wet_shading, ws.wet_planar_maps.of_tile,
                    in.has(Part::kMeniscus)};
  const LabelSources labels{ws.labels, ws.shading, in.world};
  shade_picture(
      {ws.window, ws.visibility, ws.edges, ws.planar_maps.of_tile, ws.shading, in.options.wireframe,
       has_labels ? &labels : nullptr, ws.crossing.picture == Begins::kInBoth ? &wet : nullptr},
      ws.scratch, ws.shaded, target, run);
}

// Multiplies linear light by the exposure that is still to be applied.
void expose(Target& target, Workers& workers) {
  const auto width = static_cast<std::size_t>(target.width_px);
  workers.for_each(target.linear.size() / (3 * width), [&](std::size_t y, int) {
    for (float& light : std::span(target.linear).subspan(3 * width * y, 3 * width))
      light *= target.exposure;
  });
  target.exposure = 1.0f;
}

void enlarge_picture(const Target& small, EnlargeTables& tables, const View& view, Target& target,
                     Workers& workers) {
  prepare_target(view, {}, target);
  enlarge(small.rgba, {small.width_px, small.height_px}, target.rgba,
          {view.width_px, view.height_px}, tables, workers);
}

FrameStatistics statistics_of(const FrameState& ws) {
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
  for (const ShadedPixels& tile : ws.shaded) {
    s.shaded_pixels += static_cast<std::uint64_t>(tile.shaded);
    s.interpolated_pixels += static_cast<std::uint64_t>(tile.interpolated);
  }
  return s;
}

}  // namespace

FrameStatistics draw_moment(const World& world, const FrameRequest& request, double t_s,
                            Workspace& workspace, Workers& workers) {
  FrameState& ws = workspace.state();
  const View& view = request.view;
  Target& target = *request.target;
  const FrameOptions options = with_scene_defaults(request.options, world.scene());
  const View drawn = drawn_view(view, options);
  const bool small = drawn.width_px < view.width_px || drawn.height_px < view.height_px;
  Target& drawn_target = small ? ws.small : target;
  const FrameInputs in{world.state(), drawn, t_s, options, ws, workers};
  ws.profile.begin_frame(workspace.trace_enabled);
  prepare_target(drawn, options, drawn_target);
  prepare_scratch(workers.thread_count(), ws);
  prepare_views(in);

  const Air air = find_air(in);
  workers.run_both(
      [&] { in.stage(Stage::kSea, [&](const StageRun& run) { advance(in, air, run); }); },
      [&] {
        in.stage(Stage::kTriangulate, [&](const StageRun& run) {
          triangulate(in.world, drawn, t_s, options, ws.meshes, run);
        });
      });
  const Light light = find_light(in, air);
  ViewList views;
  in.stage(Stage::kDisplace, [&](const StageRun& run) {
    views = place_vertices(in, run);
    find_shadows(in, light, run);
  });
  in.stage(Stage::kTrees, [&](const StageRun& run) {
    place_trees(in.world, t_s, options, ws.meshes, views.all(), run);
  });
  in.stage(Stage::kVisibility, [&](const StageRun& run) {
    find_visible(ws.meshes, options.tile_size_px, options.edge_samples, ws.window, ws.visibility,
                 run);
    prepare_edges(ws.window, ws.visibility, options.edge_samples, ws.edges);
  });
  if (has_rays(ws.window))
    in.stage(Stage::kRays, [&](const StageRun& run) {
      find_by_rays(ws.meshes, options.edge_samples, ws.window, ws.visibility, run);
    });
  in.stage(Stage::kPlanarMaps, [&](const StageRun& run) { draw_images(in, light, air, run); });
  in.stage(Stage::kClouds, [&](const StageRun& run) {
    draw_window_clouds(in, float(drawn.width_px) / float(view.width_px), run);
  });
  in.stage(Stage::kShade, [&](const StageRun& run) {
    store_fog(in, run);
    shade(in, drawn_target, run);
    target.exposure = ws.shading.exposure;
    if (options.exposure && options.keep_linear) expose(target, workers);
    if (small) enlarge_picture(ws.small, ws.enlarge, view, target, workers);
  });
  workspace.trace = ws.profile.trace();
  return statistics_of(ws);
}

}  // namespace swell::render
