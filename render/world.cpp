// Making a scene ready to draw: everything that does not change with time.
#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "lod/relief_bounds.h"
#include "math/check.h"
#include "math/elementary.h"
#include "math/stop.h"
#include "ocean/coast/coast.h"
#include "ocean/coast/shelter.h"
#include "ocean/coast/train_square.h"
#include "ocean/inland/drift.h"
#include "ocean/inland/inland_water.h"
#include "ocean/inland/river_network.h"
#include "ocean/open_sea/sea.h"
#include "ocean/open_sea/whitecaps.h"
#include "render/labels/classes.h"
#include "render/labels/label_channels.h"
#include "render/sea/ripple_sequence.h"
#include "render/sky/cloud_volume.h"
#include "render/sky/sky_maps.h"
#include "render/world/coast_maps.h"
#include "render/world/forest.h"
#include "render/world/land_rays.h"
#include "render/world/land_shadow.h"
#include "render/world/making_report.h"
#include "render/world/near_shore_map.h"
#include "render/world/object_meshes.h"
#include "render/world/part_cache.h"
#include "render/world/part_maker.h"
#include "render/world/sun_texture.h"
#include "render/world/terrain_maps.h"
#include "render/world/water_texture.h"
#include "render/world/world_state.h"
#include "scene/check_scene.h"
#include "scene/coast.h"
#include "scene/obstacles.h"
#include "scene/terrain.h"
#include "sky/atmosphere.h"
#include "sky/sky_light.h"
#include "terrain/bicubic.h"
#include "terrain/height_grid.h"
#include "terrain/shore_map.h"
#include "texture/foam_pattern.h"
#include "texture/normal_map.h"

namespace swell::render {
namespace {

constexpr int kBumpSize = 256, kFoamSize = 256;
constexpr std::uint64_t kFoamSeed = 4, kGroundSeed = 11;

texture::PackedMap2 build_bump_map(std::uint64_t seed) {
  const texture::SlopeMap slopes = texture::make_bump_slopes(kBumpSize, seed);
  texture::PackedMap2 map;
  texture::pack_map2(kBumpSize, slopes.x, slopes.y, 0.0f, map);
  return map;
}

// What the sea's own waves give up to the trains.
std::vector<float> build_ceded_map(const ocean::CoastSea& coast) {
  constexpr int n = kCoastMapSize;
  const terrain::Grid& floor = coast.trains.grid;
  const terrain::Grid grid{floor.min_world, floor.size_m() / n, n, n};
  std::vector<glm::dvec2> p;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) p.push_back(grid.point(i, j));
  std::vector<float> share(p.size());
  ocean::sample_coast_share(coast, p, share);
  std::vector<float> ceded;
  for (const float x : share) ceded.push_back(1.0f - ocean::spectrum_weight(x));
  return ceded;
}

texture::PackedMap2 build_foam_pattern() {
  std::vector<float> lace = texture::make_foam_pattern(kFoamSize, kFoamSeed);
  std::vector<float> tears = texture::make_tear_pattern(kFoamSize, kFoamSeed);
  for (std::vector<float>* const thresholds : {&lace, &tears})
    for (float& x : *thresholds) x = 2.0f * x - 1.0f;
  texture::PackedMap2 map;
  texture::pack_map2(kFoamSize, lace, tears, 1.0f / 127.0f, map);
  return map;
}

texture::PackedMap2 build_ground_pattern() {
  std::vector<float> thresholds = texture::make_tear_pattern(kFoamSize, kGroundSeed);
  std::vector<float> shades = texture::make_tear_pattern(kFoamSize, kGroundSeed + 1);
  for (std::vector<float>* const values : {&thresholds, &shades})
    for (float& x : *values) x = 2.0f * x - 1.0f;
  texture::PackedMap2 map;
  texture::pack_map2(kFoamSize, thresholds, shades, 1.0f / 127.0f, map);
  return map;
}

CoastMaps build_coast_maps(const ocean::CoastSea& coast, Workers& workers) {
  return {ocean::make_coast_map(coast, kCoastMapSize, workers), build_ceded_map(coast)};
}

// What parts are made of.
ValueBytes sea_inputs(const PartMaker& parts) {
  return parts.of({"sea", "-sea.douglas", "-sea.beaufort", "-sea.centre_m", "-sea.size_m",
                   "-sea.earth", "wind"});
}
ValueBytes land_inputs(const PartMaker& parts) {
  return parts.of({"terrain", "-terrain.method", "river", "lake"});
}
ValueBytes coast_inputs(const PartMaker& parts) {
  return parts.of({"coast"}).add(sea_inputs(parts).hash()).add(land_inputs(parts).hash());
}
std::vector<ocean::Obstacle> river_obstacles(const scene::Scene& scene) {
  if (scene.rivers.empty()) return {};
  return scene::river_obstacles(scene, {scene.rivers, scene.lakes});
}
ValueBytes add_obstacles(std::span<const ocean::Obstacle> obstacles, ValueBytes inputs) {
  inputs.add(obstacles.size());
  for (const ocean::Obstacle& o : obstacles)
    inputs.add(o.middle).add(o.ahead).add(o.half_m).add(o.is_round);
  return inputs;
}
// Once there is a sky.
ValueBytes lit_land_inputs(const PartMaker& parts, const WorldState& state) {
  return land_inputs(parts).add(state.sky->to_light);
}

void add_sky(PartMaker& parts, Workers& workers, WorldState& state) {
  const scene::Sky& sky = state.scene.sky;
  const bool is_gradient = sky::is_gradient(sky);
  state.atmosphere = parts.share("air", ValueBytes().add(is_gradient).add(sky.turbidity), [&] {
    return is_gradient ? sky::Atmosphere() : sky::make_atmosphere(sky.turbidity, workers);
  });
  state.sky = parts.share("sky", parts.of({"sky"}).add(sky.sun_direction),
                          [&] { return build_sky_maps(sky, *state.atmosphere, workers); });
}

// Once there is a sky.
void add_clouds(PartMaker& parts, Workers& workers, WorldState& state) {
  const scene::CloudField& field = state.scene.clouds;
  if (field.kind == scene::CloudKind::kNone) return;
  const glm::vec3 to_light = state.sky->to_light;
  state.cloud_volume = parts.share("clouds", parts.of({"clouds"}).add(to_light),
                                   [&] { return build_cloud_volume(field, to_light, workers); });
}

void add_sea(PartMaker& parts, WorldState& state) {
  state.sea = parts.share("sea", sea_inputs(parts), [&] { return ocean::Sea(state.scene.sea); });
}

void add_textures(PartMaker& parts, Workers& workers, WorldState& state) {
  const scene::Scene& scene = state.scene;
  Textures& textures = state.textures;
  textures.foam = parts.share("foam", {}, build_foam_pattern);
  textures.ground = parts.share("ground", {}, build_ground_pattern);
  textures.bump = parts.share("bump", ValueBytes().add(scene.sea.seed),
                              [&] { return build_bump_map(scene.sea.seed); });
  if (scene.ripples.kind == scene::RippleKind::kSequence)
    textures.ripple_sequence = parts.share(
        "ripples", parts.of({"ripples", "wind.from_deg", "sea.gravity_mps2", "sea.seed"}),
        [&] { return build_ripple_sequence(scene, workers); });
  if (scene.water.glitter == scene::Glitter::kProjective)
    textures.sun_texture = parts.share("sun", {}, make_sun_texture);
  if (!scene.water.texture.empty())
    textures.water = parts.share("water texture", parts.of({"water.texture"}),
                                 [&] { return build_water_texture(scene); });
}

// The land, and what follows from its heights alone.
struct LandParts {
  terrain::HeightGrid terrain;
  ocean::LakeFill lakes;
  terrain::ShoreMap shore;
  TerrainMaps maps;
  lod::ReliefBounds relief_bounds;

  auto fields() { return std::tie(terrain, lakes, shore, maps, relief_bounds); }
};

// The land as it is drawn, and heights of it and of what surrounds it.
struct DrawnLand {
  terrain::HeightGrid heights, around;
};

DrawnLand draw_land(const terrain::HeightGrid& land, bool bicubic, Workers& workers) {
  return {bicubic ? terrain::refine_bicubic(land, workers) : land, sample_around(land, workers)};
}

// `drawn` gives the DrawnLand of a terrain.
template <class Drawn>
LandParts build_land_parts(const scene::Scene& scene, Workers& workers, Drawn&& drawn) {
  std::optional<scene::Ground> ground = scene::build_ground(scene, workers);
  LandParts parts;
  parts.terrain = std::move(ground->terrain);
  parts.lakes = std::move(ground->lakes);
  parts.shore = *scene::build_shore(scene, &parts.terrain, workers.thread_count());
  const auto& [heights, around] = drawn(parts.terrain);
  parts.maps = build_terrain_maps(heights, around, *scene.terrain, workers);
  parts.relief_bounds =
      lod::ReliefBounds(around.height_m, around.grid.samples_x, around.grid.spacing_m);
  return parts;
}

void add_land(PartMaker& parts, Workers& workers, WorldState& state) {
  const scene::Scene& scene = state.scene;
  if (!scene.terrain) return;
  const ValueBytes inputs = land_inputs(parts);
  std::optional<DrawnLand> made;  // if a part has to be made
  const auto drawn = [&](const terrain::HeightGrid& land) -> const DrawnLand& {
    return made ? *made : made.emplace(draw_land(land, scene.terrain->bicubic, workers));
  };
  const auto land =
      parts.share("land", inputs, [&] { return build_land_parts(scene, workers, drawn); });
  state.terrain = {land, &land->terrain};
  state.inland = parts.share("inland water", add_obstacles(river_obstacles(scene), inputs), [&] {
    return scene::build_inland_water(scene, land->lakes, land->terrain, workers);
  });
  state.shore = {land, &land->shore};
  state.terrain_maps = {land, &land->maps};
  state.relief_bounds = {land, &land->relief_bounds};
  if (scene.detail.terrain_method != scene::TerrainMethod::kRays) return;
  state.land_rays = parts.share("land rays", inputs, [&] {
    const auto& [heights, around] = drawn(*state.terrain);
    return build_land_rays(heights, around, *scene.terrain, workers);
  });
}

// Once there is land.
void add_coast(PartMaker& parts, Workers& workers, WorldState& state) {
  const ValueBytes inputs = coast_inputs(parts);
  state.coast = parts.share("coast", inputs, [&] {
    return scene::build_coast(state.scene, state.terrain.get(), state.shore.get(), workers);
  });
  if (state.coast)
    state.coast_maps =
        parts.share("coast maps", inputs, [&] { return build_coast_maps(*state.coast, workers); });
  state.shelter = parts.share("shelter", sea_inputs(parts).add(land_inputs(parts).hash()), [&] {
    return scene::build_shelter(state.scene, state.shore.get(), workers);
  });
}

// Once there are sea and coast.
void add_whitecaps(PartMaker& parts, Workers& workers, WorldState& state) {
  const ValueBytes inputs = state.coast ? coast_inputs(parts) : sea_inputs(parts);
  state.whitecaps = parts.share("whitecaps", inputs, [&] {
    return ocean::make_whitecaps(*state.sea, state.coast.get(), workers);
  });
}

// Once there are sea, coast and shelter.
void add_near_shore(PartMaker& parts, Workers& workers, WorldState& state) {
  if (!state.shelter) return;
  state.near_shore = parts.share("near shore", coast_inputs(parts),
                                 [&] { return build_near_shore(state, workers); });
}

// Once there are land and sky.
void add_land_shadow(PartMaker& parts, Workers& workers, WorldState& state) {
  if (!state.terrain) return;
  const double water_index = state.scene.water.refraction_index;
  state.land_shadow = parts.share(
      "land shadow", lit_land_inputs(parts, state).add(water_index),
      [&] { return cast_land_shadow(*state.terrain, state.sky->to_light, water_index, workers); });
}

// Once there are land and sky.
void add_forest(PartMaker& parts, Workers& workers, WorldState& state) {
  if (state.scene.trees.empty()) return;
  // What stands in rivers may make the lattice finer, at whose points lakes are looked up.
  const double spacing_m = state.inland ? state.inland->spacing_m() : 0.0;
  const ValueBytes inputs =
      parts.of({"trees"}).add(lit_land_inputs(parts, state).hash()).add(spacing_m);
  state.forest = parts.share("forest", inputs, [&]() -> std::optional<Forest> {
    Forest forest =
        grow_forest(state.scene, *state.terrain, state.inland.get(), state.sky->to_light, workers);
    return forest.trees.empty() ? std::nullopt : std::optional(std::move(forest));
  });
}

ocean::Drifter drifter_of(const scene::FloatingObject& object) {
  const glm::dvec2 size = object.size_m;
  const bool is_compact = scene::kObjectKinds[object.kind].plan == scene::PlanShape::kRound &&
                          scene::kObjectKinds[object.kind].is_compact;
  return {.p = object.position_m,
          .ahead = {sin(object.heading_rad), cos(object.heading_rad)},
          .length_m = size.y,
          .radius_m = 0.5 * (is_compact ? std::max(size.x, size.y) : glm::length(size))};
}

// The ways of objects that rivers carry away. Once their sizes are known.
void add_drift(PartMaker& parts, scene::Scene& scene) {
  std::vector<ocean::Drifter> drifters;
  for (const scene::FloatingObject& object : scene.objects)
    if (object.drift) drifters.push_back(drifter_of(object));
  if (drifters.empty()) return;
  const std::vector<ocean::Obstacle> obstacles = river_obstacles(scene);
  ValueBytes inputs = add_obstacles(obstacles, parts.of({"river", "lake"}));
  for (const ocean::Drifter& d : drifters)
    inputs.add(d.p).add(d.ahead).add(d.length_m).add(d.radius_m);
  const std::shared_ptr<const std::vector<ocean::DriftTrack>> tracks =
      parts.share("drift", inputs, [&] {
        const ocean::RiverNetwork network(scene.rivers, scene.lakes);
        return ocean::make_drift_tracks(network, obstacles, drifters);
      });
  std::size_t n = 0;
  for (scene::FloatingObject& object : scene.objects)
    object.drift_track =
        object.drift ? std::shared_ptr<const ocean::DriftTrack>(tracks, &(*tracks)[n++]) : nullptr;
}

std::unique_ptr<WorldState> make_state(scene::Scene scene, const WorldMaking& making) {
  const ScopedFloatEnvironment ieee;
  const ScopedStop stoppable(making.stop);
  scene::check_scene(scene);
  const int threads = making.threads;
  SWELL_CHECK(threads >= 1 && threads <= 256, "threads={}", threads);
  MakingReport report(scene, making);
  auto state = std::make_unique<WorldState>(WorldState{.scene = std::move(scene)});
  const scene::Scene& now = state->scene;
  state->cache = std::make_shared<PartCache>(making.cache_folder, now);
  PartMaker parts(now, making.like, *state->cache, report, state->parts);
  Workers workers(threads);
  state->objects = build_object_meshes(state->scene, parts);
  workers.run_both(
      [&] {
        add_land(parts, workers, *state);
        add_coast(parts, workers, *state);
      },
      [&] {
        add_sea(parts, *state);
        add_textures(parts, workers, *state);
        add_sky(parts, workers, *state);
        add_clouds(parts, workers, *state);
      });
  state->fog_light = std::make_shared<const FogLights>(light_fog(now.air, *state->sky));
  workers.run_both(
      [&] {
        add_whitecaps(parts, workers, *state);
        add_near_shore(parts, workers, *state);
        add_land_shadow(parts, workers, *state);
      },
      [&] { add_forest(parts, workers, *state); });
  add_drift(parts, state->scene);
  state->object_classes = object_classes(now);
  state->tree_class = class_of(class_names(now), kTreeClassName).value_or(kObjectClass);
  state->disturbances = scene::all_disturbances(now);
  state->cache->trim();
  report.finish();
  return state;
}

}  // namespace

World::World(scene::Scene scene, const WorldMaking& making)
    : state_(make_state(std::move(scene), making)) {}
World::World(scene::Scene scene, int threads)
    : World(std::move(scene), WorldMaking{.threads = threads}) {}
World::World(scene::Scene scene, const World& like, int threads)
    : World(std::move(scene), std::array{&like}, threads) {}
World::World(scene::Scene scene, std::span<const World* const> like, int threads)
    : World(std::move(scene), WorldMaking{.threads = threads, .like = like}) {}
World::~World() {
  if (state_) state_->cache->wait();
}
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;
const scene::Scene& World::scene() const { return state().scene; }

}  // namespace swell::render
