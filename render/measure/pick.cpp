#include "render/measure/pick.h"

#include <array>
#include <cmath>

#include "lod/mesh_query.h"
#include "math/check.h"
#include "math/ray_triangle.h"
#include "math/with_ieee.h"
#include "ocean/water_surface.h"
#include "render/workspace.h"
#include "render/world/land_rays.h"
#include "render/world/world_state.h"
#include "shapes/object_ray.h"
#include "terrain/height_rays.h"

namespace swell::render {
namespace {

constexpr double kFarthest_m = 1e6;

void keep_nearer(const Pick& met, std::optional<Pick>& nearest) {
  if (!nearest || met.distance_m < nearest->distance_m) nearest = met;
}

void meet_surface(Shown what, const Surface& surface, bool is_bintree, const Ray& ray,
                  PickScratch& scratch, std::optional<Pick>& nearest) {
  if (surface.mesh.level.empty()) return;  // not drawn yet
  const lod::HeightMesh mesh{surface.mesh, scratch.envelopes, surface.height_m, surface.domain};
  if (is_bintree) lod::build_envelopes(surface.mesh, surface.height_m, scratch.envelopes);
  const lod::RayHit hit = is_bintree
                              ? intersect_ray(mesh, ray.origin, ray.along, kFarthest_m)
                              : intersect_ray_in_all(mesh, ray.origin, ray.along, kFarthest_m);
  if (hit.triangle == lod::kNoTriangle) return;
  const int level = surface.mesh.level[static_cast<std::size_t>(hit.triangle)];
  keep_nearer(
      {.what = what, .distance_m = hit.distance_m, .triangle = hit.triangle, .level = level},
      nearest);
}

// Land that rays find, with its apron.
void meet_land(const LandRays& land, const Ray& ray, std::optional<Pick>& nearest) {
  const auto x = static_cast<float>(ray.along.x), y = static_cast<float>(ray.along.y);
  const auto z = static_cast<float>(ray.origin.z), z_t = static_cast<float>(ray.along.z);
  const float z_tt = 0.0f, begin = 0.0f, end = static_cast<float>(kFarthest_m);
  for (const terrain::HeightPyramid* const heights : {&land.map, &land.around}) {
    float t = 0.0f;
    terrain::cast_rays(*heights, glm::dvec2(ray.origin), 0.0f,
                       {{&x, 1}, {&y, 1}, {&z, 1}, {&z_t, 1}, {&z_tt, 1}, {&begin, 1}, {&end, 1}},
                       {&t, 1});
    if (std::isfinite(t))
      keep_nearer({.what = Shown::kLand, .distance_m = static_cast<double>(t)}, nearest);
  }
}

void meet_objects(std::span<const scene::FloatingObject> objects, const ObjectGeometry& drawn,
                  const Ray& ray, std::optional<Pick>& nearest) {
  for (std::size_t i = 0; i < drawn.meshes.size(); ++i) {
    if (!drawn.meshes[i]) continue;
    const auto hit =
        shapes::intersect_ray(objects[i], drawn.poses[i], *drawn.meshes[i], ray.origin, ray.along);
    if (hit)
      keep_nearer({.what = Shown::kObject,
                   .distance_m = hit->distance_m,
                   .object = i,
                   .object_kind = objects[i].kind,
                   .triangle = hit->triangle},
                  nearest);
  }
}

void ask_water(const WorldState& world, const ocean::SeaFrame& sea, Pick& pick) {
  const ocean::WaterSurface water = water_surface(world, sea);
  const glm::dvec2 p(pick.p_world);
  glm::vec2 slope;
  water.slopes({&p, 1}, {&slope, 1});
  pick.model_height_m = static_cast<double>(water.height(p));
  pick.slope = slope;
}

// The slope by a difference over one sample.
void ask_land(const terrain::HeightGrid& terrain, Pick& pick) {
  const glm::dvec2 p(pick.p_world), dx(0.5 * terrain.grid.spacing_m, 0.0), dy(0.0, dx.x);
  const std::array<glm::dvec2, 5> at = {p, p + dx, p - dx, p + dy, p - dy};
  std::array<float, 5> z;
  terrain::sample_heights(terrain, at, z);
  pick.model_height_m = static_cast<double>(z[0]);
  pick.slope = glm::dvec2(z[1] - z[2], z[3] - z[4]) / terrain.grid.spacing_m;
}

// The nearest thing that was drawn on a ray of the flat world.
std::optional<Pick> meet_all(const WorldState& w, const FrameState& ws, const Ray& ray,
                             PickScratch& scratch) {
  std::optional<Pick> nearest;
  const bool is_bintree = w.scene.detail.triangulation != scene::Triangulation::kRadial;
  meet_surface(Shown::kWater, ws.meshes.water, is_bintree, ray, scratch, nearest);
  if (w.land_rays)
    meet_land(*w.land_rays, ray, nearest);
  else if (w.terrain)
    meet_surface(Shown::kLand, ws.meshes.land, true, ray, scratch, nearest);
  meet_objects(w.scene.objects, ws.meshes.objects, ray, nearest);
  return nearest;
}

// A ray of a picture of the round earth. In the flat world it bends up by
// drop_per_m2 horizontal2 s^2 at the distance s; the chord to a place on it meets that place too.
struct BentRay {
  Ray ray;
  double horizontal2;  // squared length of the horizontal part of ray.along
  double drop_per_m2;

  Ray chord_to(double distance_m) const {
    glm::dvec3 along = ray.along;
    along.z += drop_per_m2 * horizontal2 * distance_m;
    return make_ray(ray.origin, along);
  }

  // Where it meets the mean level, or comes closest to it.
  double guess_m() const {
    const double closing = std::max(-ray.along.z, 0.0), bend = drop_per_m2 * horizontal2;
    const double height_m = std::max(ray.origin.z, 0.0);
    const double root2 = closing * closing - 4.0 * bend * height_m;
    if (root2 >= 0.0 && closing > 0.0) return 2.0 * height_m / (closing + std::sqrt(root2));
    return bend > 0.0 ? closing / (2.0 * bend) : 0.0;
  }
};

std::optional<Pick> meet_all(const WorldState& w, const FrameState& ws, const BentRay& bent,
                             PickScratch& scratch) {
  constexpr int kMostChords = 4;
  std::optional<Pick> met;
  double guess_m = bent.guess_m();
  for (int i = 0; i < kMostChords; ++i) {
    met = meet_all(w, ws, bent.chord_to(guess_m), scratch);
    if (!met || std::abs(met->distance_m - guess_m) <= 1e-4 * guess_m) break;
    guess_m = met->distance_m;
  }
  return met;
}

std::optional<Pick> find_pick(const World& world, const View& view, const Workspace& workspace,
                              glm::vec2 at_px, PickScratch& scratch) {
  SWELL_CHECK(std::isfinite(at_px.x) && std::isfinite(at_px.y), "at_px=({}, {})", at_px.x, at_px.y);
  const WorldState& w = world.state();
  const FrameState& ws = workspace.state();
  // From where the picture begins.
  const glm::dvec3 to_pixel(view.ray(at_px.x, at_px.y));
  const glm::dvec3 to_near_plane = static_cast<double>(view.near_m) * to_pixel;
  const Ray ray = make_ray(view.eye_world + to_near_plane, glm::normalize(to_pixel));

  const glm::dvec2 ahead(ray.along);
  const BentRay bent{ray, glm::dot(ahead, ahead), ws.window.drop_per_m2};
  std::optional<Pick> nearest = meet_all(w, ws, bent, scratch);
  if (!nearest) return nearest;

  nearest->p_world = ray.origin + nearest->distance_m * bent.chord_to(nearest->distance_m).along;
  nearest->distance_m = glm::distance(nearest->p_world, view.eye_world);
  if (nearest->what == Shown::kLand)
    ask_land(*w.terrain, *nearest);
  else
    ask_water(w, ws.sea->frame, *nearest);
  return nearest;
}

}  // namespace

std::optional<Pick> pick(const World& world, const View& view, const Workspace& workspace,
                         glm::vec2 at_px, PickScratch& scratch) {
  return with_ieee([&] { return find_pick(world, view, workspace, at_px, scratch); });
}

}  // namespace swell::render
