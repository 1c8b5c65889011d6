// Making a scene ready to draw: everything that does not change with time.
#include "lod/relief_bounds.h"
#include "math/check.h"
#include "ocean/coast.h"
#include "ocean/inland_water.h"
#include "ocean/sea.h"
#include "ocean/shelter.h"
#include "ocean/whitecaps.h"
#include "render/labels/classes.h"
#include "render/labels/label_channels.h"
#include "render/sea/ripple_sequence.h"
#include "render/sky/cloud_volume.h"
#include "render/sky/sky_maps.h"
#include "render/world/coast_maps.h"
#include "render/world/forest.h"
#include "render/world/land_rays.h"
#include "render/world/land_shadow.h"
#include "render/world/near_shore_map.h"
#include "render/world/object_meshes.h"
#include "render/world/sun_texture.h"
#include "render/world/terrain_maps.h"
#include "render/world/world_state.h"
#include "scene/check_scene.h"
#include "scene/coast.h"
#include "scene/drift.h"
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

template <class T>
std::shared_ptr<const T> shared(T value) {
  return std::make_shared<const T>(std::move(value));
}

CoastMaps build_coast_maps(const ocean::CoastSea& coast, Workers& workers) {
  return {ocean::make_coast_map(coast, kCoastMapSize, workers), build_ceded_map(coast)};
}

// The parts of a world. like: one that describes the part alike, or null.

// like: may have another sky.
void add_sky(const World::State* like, bool same_sky, Workers& workers, World::State& state) {
  const scene::Sky& sky = state.scene.sky;
  const bool is_gradient = sky::is_gradient(sky);
  const bool same_air = like && like->scene.sky.turbidity == sky.turbidity &&
                        sky::is_gradient(like->scene.sky) == is_gradient;
  state.atmosphere = same_air ? like->atmosphere
                              : shared(is_gradient ? sky::Atmosphere()
                                                   : sky::make_atmosphere(sky.turbidity, workers));
  state.sky = same_sky ? like->sky : shared(build_sky_maps(sky, *state.atmosphere, workers));
}

// Once there is a sky. like: with the same clouds.
void add_clouds(const World::State* like, Workers& workers, World::State& state) {
  const scene::CloudField& field = state.scene.clouds;
  if (field.kind == scene::CloudKind::kNone) return;
  const glm::vec3 to_light = state.sky->to_light;
  state.cloud_volume = like && like->sky->to_light == to_light
                           ? like->cloud_volume
                           : shared(build_cloud_volume(field, to_light, workers));
}

void add_sea(const World::State* like, Workers& workers, World::State& state) {
  state.sea = like ? like->sea : std::make_shared<const ocean::Sea>(state.scene.sea);
  state.whitecaps = like ? like->whitecaps : shared(ocean::make_whitecaps(*state.sea, workers));
}

void add_bump(const World::State* like, World::State& state) {
  state.textures.bump = like ? like->textures.bump : shared(build_bump_map(state.scene.sea.seed));
}

// like: may be null.
void add_paper_look(const World::State* like, Workers& workers, World::State& state) {
  const scene::Scene& now = state.scene;
  if (now.ripples.kind == scene::RippleKind::kSequence)
    state.textures.ripple_sequence = like && same_ripple_sequence(like->scene, now)
                                         ? like->textures.ripple_sequence
                                         : shared(build_ripple_sequence(now, workers));
  if (now.water.glitter == scene::Glitter::kProjective)
    state.textures.sun_texture = like && like->textures.sun_texture ? like->textures.sun_texture
                                                                    : shared(make_sun_texture());
}

void add_foam_pattern(const World::State* like, World::State& state) {
  state.textures.foam = like ? like->textures.foam : shared(build_foam_pattern());
}

void add_ground_pattern(const World::State* like, World::State& state) {
  state.textures.ground = like ? like->textures.ground : shared(build_ground_pattern());
}

void add_terrain(const World::State* like, Workers& workers, World::State& state) {
  if (!state.scene.terrain) return;
  if (like) {
    state.terrain = like->terrain;
    state.terrain_maps = like->terrain_maps;
    state.shore = like->shore;
    state.relief_bounds = like->relief_bounds;
    state.inland = like->inland;
    state.land_rays = like->land_rays;
    return;
  }
  std::optional<scene::Land> land = scene::build_land(state.scene, workers);
  state.terrain = shared(std::move(land->terrain));
  state.inland = std::move(land->water);
  state.shore =
      shared(*scene::build_shore(state.scene, state.terrain.get(), workers.thread_count()));
  const terrain::HeightGrid around = sample_around(*state.terrain, workers);
  const terrain::TerrainDescription& description = *state.scene.terrain;
  terrain::HeightGrid smooth;
  if (description.bicubic) smooth = terrain::refine_bicubic(*state.terrain, workers);
  const terrain::HeightGrid& drawn = description.bicubic ? smooth : *state.terrain;
  state.terrain_maps = shared(build_terrain_maps(drawn, around, description, workers));
  state.relief_bounds =
      shared(lod::ReliefBounds(around.height_m, around.grid.samples_x, around.grid.spacing_m));
  if (state.scene.detail.terrain_method == scene::TerrainMethod::kRays)
    state.land_rays = shared(build_land_rays(drawn, around, description, workers));
}

// like: may have another coast.
void add_coast(const World::State* like, bool same_coast, Workers& workers, World::State& state) {
  if (same_coast) {
    state.coast = like->coast;
    state.coast_maps = like->coast_maps;
  } else if (auto coast =
                 scene::build_coast(state.scene, state.terrain.get(), state.shore.get(), workers)) {
    state.coast = shared(std::move(*coast));
    state.coast_maps = shared(build_coast_maps(*state.coast, workers));
  }
}

// like: one with the same terrain and sea, or null.
void add_shelter(const World::State* like, Workers& workers, World::State& state) {
  if (like) {
    state.shelter = like->shelter;
  } else if (auto shelter = scene::build_shelter(state.scene, state.shore.get(), workers)) {
    state.shelter = shared(std::move(*shelter));
  }
}

// Once there are sea, coast and shelter. like: with the same of them all, or null.
void add_near_shore(const World::State* like, Workers& workers, World::State& state) {
  if (like) {
    state.near_shore = like->near_shore;
  } else if (state.shelter) {
    state.near_shore = shared(build_near_shore(state, workers));
  }
}

// Once there are land and sky. like: with the same land and water.
void add_land_shadow(const World::State* like, Workers& workers, World::State& state) {
  if (!state.terrain) return;
  const glm::vec3 to_light = state.sky->to_light;
  if (like && like->sky->to_light == to_light) {
    state.land_shadow = like->land_shadow;
  } else if (auto shadow = cast_land_shadow(*state.terrain, to_light,
                                            state.scene.water.refraction_index, workers)) {
    state.land_shadow = shared(std::move(*shadow));
  }
}

// Once there are land and sky. like: with the same land and trees.
void add_forest(const World::State* like, Workers& workers, World::State& state) {
  if (state.scene.trees.empty()) return;
  if (like && like->sky->to_light == state.sky->to_light) {
    state.forest = like->forest;
    return;
  }
  Forest forest =
      grow_forest(state.scene, *state.terrain, state.inland.get(), state.sky->to_light, workers);
  if (!forest.trees.empty()) state.forest = shared(std::move(forest));
}

// like: may be null.
std::unique_ptr<World::State> make_state(scene::Scene scene, const World::State* like,
                                         int threads) {
  const ScopedFloatEnvironment ieee;
  scene::check_scene(scene);
  SWELL_CHECK(threads >= 1 && threads <= 256, "threads={}", threads);
  auto state = std::make_unique<World::State>(World::State{.scene = std::move(scene)});
  const scene::Scene& now = state->scene;
  const auto if_alike = [&](bool is_alike) { return is_alike ? like : nullptr; };
  const bool same_sea = like && like->scene.sea == now.sea;
  const bool same_terrain = like && like->scene.terrain == now.terrain &&
                            like->scene.rivers == now.rivers && like->scene.lakes == now.lakes &&
                            like->scene.detail.terrain_method == now.detail.terrain_method;
  const bool same_coast = same_sea && same_terrain && like->scene.coast == now.coast;
  Workers workers(threads);
  workers.run_both(
      [&] {
        add_terrain(if_alike(same_terrain), workers, *state);
        add_coast(like, same_coast, workers, *state);
        add_shelter(if_alike(same_sea && same_terrain), workers, *state);
      },
      [&] {
        add_sea(if_alike(same_sea), workers, *state);
        add_foam_pattern(like, *state);
        add_ground_pattern(like, *state);
        add_paper_look(like, workers, *state);
        add_bump(if_alike(like && like->scene.sea.seed == now.sea.seed), *state);
        add_sky(like, like && like->scene.sky == now.sky, workers, *state);
        add_clouds(if_alike(like && like->scene.clouds == now.clouds), workers, *state);
      });
  state->fog_light = shared(light_fog(now.air, *state->sky));
  const bool same_water = like && like->scene.water.refraction_index == now.water.refraction_index;
  add_near_shore(if_alike(same_coast), workers, *state);
  add_land_shadow(if_alike(same_terrain && same_water), workers, *state);
  add_forest(if_alike(same_terrain && like->scene.trees == now.trees), workers, *state);
  state->objects = build_object_meshes(state->scene, like);
  scene::find_drift_tracks(state->scene, same_terrain ? &like->scene : nullptr, workers);
  state->object_classes = object_classes(now);
  state->tree_class = class_of(class_names(now), kTreeClassName).value_or(kObjectClass);
  state->disturbances = scene::all_disturbances(now);
  return state;
}

}  // namespace

World::World(scene::Scene scene, int threads)
    : state_(make_state(std::move(scene), nullptr, threads)) {}
World::World(scene::Scene scene, const World& like, int threads)
    : state_(make_state(std::move(scene), &like.state(), threads)) {}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;
const scene::Scene& World::scene() const { return state().scene; }

}  // namespace swell::render
