#include "render/pick.h"

#include <array>

#include "lod/mesh_query.h"
#include "render/frame_state.h"
#include "scene/water_surface.h"

namespace swell::render {
namespace {

constexpr double kFarthest_m = 1e6;

struct Ray {
  glm::dvec3 origin, direction;
};

// Nothing before the surface was drawn.
lod::RayHit hit_of(const Surface& surface, bool is_bintree, const Ray& ray, PickScratch& scratch) {
  const lod::HeightMesh mesh{surface.mesh, scratch.envelopes, surface.height_m, surface.domain};
  if (surface.mesh.level.empty()) return {};
  if (!is_bintree) return intersect_ray_in_all(mesh, ray.origin, ray.direction, kFarthest_m);
  lod::build_envelopes(surface.mesh, surface.height_m, scratch.envelopes);
  return intersect_ray(mesh, ray.origin, ray.direction, kFarthest_m);
}

void ask_water(const World::State& world, const ocean::SeaFrame& sea, Pick& pick) {
  const scene::WaterSurface water(*world.sea, sea, world.scene.area, world.terrain.get(),
                                  world.coast.get());
  const glm::dvec2 p(pick.p_world);
  glm::vec2 slope;
  water.slopes({&p, 1}, {&slope, 1});
  pick.model_height_m = static_cast<double>(water.height(p));
  pick.slope = slope;
}

// The slope by a difference over one sample.
void ask_land(const scene::Terrain& terrain, Pick& pick) {
  const glm::dvec2 p(pick.p_world), dx(0.5 * terrain.spacing_m, 0.0), dy(0.0, dx.x);
  const std::array<glm::dvec2, 5> at = {p, p + dx, p - dx, p + dy, p - dy};
  std::array<float, 5> z;
  scene::sample_heights(terrain, at, z);
  pick.model_height_m = static_cast<double>(z[0]);
  pick.slope = glm::dvec2(z[1] - z[2], z[3] - z[4]) / terrain.spacing_m;
}

}  // namespace

std::optional<Pick> pick(const World& world, const View& view, const Workspace& workspace,
                         glm::vec2 at_px, PickScratch& scratch) {
  const World::State& w = world.state();
  const Workspace::State& ws = workspace.state();
  const Ray ray{view.eye_world, glm::dvec3(view.ray(at_px.x, at_px.y))};
  const bool is_bintree = w.scene.detail.triangulation != scene::Triangulation::kRadial;
  const lod::RayHit water = hit_of(ws.water, is_bintree, ray, scratch);
  const lod::RayHit land = w.terrain ? hit_of(ws.land, true, ray, scratch) : lod::RayHit{};

  // The nearer one.
  const bool hits_water = water.triangle != lod::kNoTriangle;
  const bool hits_land = land.triangle != lod::kNoTriangle;
  if (!hits_water && !hits_land) return std::nullopt;
  Pick pick;
  pick.is_water = hits_water && (!hits_land || water.distance_m <= land.distance_m);
  const lod::RayHit& hit = pick.is_water ? water : land;
  pick.p_world = ray.origin + hit.distance_m * glm::normalize(ray.direction);
  pick.distance_m = hit.distance_m;
  pick.triangle = hit.triangle;
  const lod::Mesh& mesh = pick.is_water ? ws.water.mesh : ws.land.mesh;
  pick.level = mesh.level[static_cast<std::size_t>(hit.triangle)];
  if (pick.is_water)
    ask_water(w, ws.sea, pick);
  else
    ask_land(*w.terrain, pick);
  return pick;
}

}  // namespace swell::render
