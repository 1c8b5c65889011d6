// What the sea is like at a place and time.
#include <limits>

#include "capi/asked_sea.h"
#include "capi/call.h"
#include "capi/camera.h"
#include "capi/disturbances.h"
#include "capi/handles.h"
#include "ocean/open_sea/sea.h"
#include "ocean/water_surface.h"
#include "render/sea/sea_maps.h"
#include "render/world/world_state.h"
#include "terrain/height_grid.h"

namespace swell::capi {
namespace {

constexpr std::size_t kPointsAtOnce = 4096;

void check_points(const swell_query& query) {
  if (query.count > std::numeric_limits<std::size_t>::max() / 64)
    refuse("query.count, got {}, allowed the number of points", query.count);
  if (query.count > 0) check_not_null(query.xy_m, "query.xy_m");
  for (std::size_t i = 0; i < 2 * query.count; ++i)
    if (!(std::abs(query.xy_m[i]) < kFarthest_m))
      refuse("query.xy_m[{}], got {}, allowed below {} m", i / 2, query.xy_m[i], kFarthest_m);
}

void ask(const swell_query& query, swell_session& session) {
  check_time(query.t_s);
  check_points(query);
  const auto disturbances = given_disturbances(query.disturbances, query.disturbance_count);
  if (query.count == 0) return;
  const render::WorldState& world = state_of(session);
  std::optional<Forgetting> forgetting;
  if (!disturbances.empty()) forgetting.emplace(session);
  const ocean::SeaFrame& sea = sea_at(query.t_s, session, disturbances);
  const ocean::WaterSurface water = render::water_surface(world, sea);
  if (query.velocity_mps) velocity_at(query.t_s, session);
  if (query.foam)
    frame_at(query.t_s, session.whitecaps, [&](ocean::WhitecapFrame& frame) {
      ocean::advance_whitecaps(*world.whitecaps, query.t_s, frame, session.workers);
    });
  const auto* points = reinterpret_cast<const glm::dvec2*>(query.xy_m);
  session.workers.for_each(
      (query.count + kPointsAtOnce - 1) / kPointsAtOnce, [&](std::size_t chunk, int) {
        const std::size_t begin = chunk * kPointsAtOnce;
        const std::size_t count = std::min(kPointsAtOnce, query.count - begin);
        const std::span<const glm::dvec2> p(points + begin, count);
        if (query.height_m) water.heights(p, {query.height_m + begin, count});
        if (query.slope)
          water.slopes(p, {reinterpret_cast<glm::vec2*>(query.slope) + begin, count});
        if (query.normal)
          water.normals(p, {reinterpret_cast<glm::vec3*>(query.normal) + begin, count});
        if (query.velocity_mps)
          water.velocities(p, session.velocity.frame,
                           {reinterpret_cast<glm::vec3*>(query.velocity_mps) + begin, count});
        if (query.foam) water.foam(p, session.whitecaps.frame, {query.foam + begin, count});
        if (query.still_depth_m)
          for (std::size_t i = 0; i < count; ++i)
            query.still_depth_m[begin + i] =
                world.terrain ? static_cast<float>(-terrain::height_at(*world.terrain, p[i]))
                              : std::numeric_limits<float>::infinity();
      });
}

}  // namespace
}  // namespace swell::capi

using namespace swell;
using namespace swell::capi;

swell_status swell_ask(swell_session* session, const swell_query* query) {
  return guarded([&] {
    const Held held(session, "session");
    ask(taken(query, "query"), *held);
  });
}

swell_status swell_ray(swell_session* session, double t_s, const double origin_m[3],
                       const double direction[3], double max_distance_m, swell_hit* hit) {
  return guarded([&] {
    const Held held(session, "session");
    check_time(t_s);
    check_not_null(origin_m, "origin_m");
    check_not_null(direction, "direction");
    glm::dvec3 origin, along;
    for (int i = 0; i < 3; ++i) {
      check_range("origin_m", origin_m[i], -1e7, 1e7);
      check_range("direction", direction[i], -1e100, 1e100);
      origin[i] = origin_m[i];
      along[i] = direction[i];
    }
    const double largest = std::max({std::abs(along.x), std::abs(along.y), std::abs(along.z)});
    if (!(largest > 1e-100)) refuse("direction, got 0, allowed a length over 0");
    check_range("max_distance_m", max_distance_m, 1e-9, 1e6);
    const auto water = render::water_surface(state_of(*held), sea_at(t_s, *held));
    const auto met = water.intersect(origin, along / largest, max_distance_m);
    swell_hit found{};
    if (met) {
      found.hits = 1;
      for (int i = 0; i < 3; ++i) found.position_m[i] = met->p_world[i];
      found.distance_m = met->distance_m;
      found.from_above = met->from_above ? 1 : 0;
    }
    give(found, hit, "hit");
  });
}

swell_status swell_object_poses(swell_session* session, double t_s, swell_pose* poses,
                                size_t count) {
  return guarded([&] {
    const Held held(session, "session");
    check_time(t_s);
    const scene::Scene& scene = held->named->world.scene();
    if (count != scene.objects.size())
      refuse("count, got {}, allowed {}, the number of objects", count, scene.objects.size());
    if (count == 0) return;
    check_not_null(poses, "poses");
    for (std::size_t i = 0; i < count; ++i)
      if (poses[i].size != sizeof(swell_pose))
        refuse("poses[{}].size, got {}, allowed {}", i, poses[i].size, sizeof(swell_pose));
    std::vector<scene::ObjectPose> found(count);
    object_poses(scene.objects, render::water_surface(state_of(*held), sea_at(t_s, *held)), found);
    if (scene.detail.triangulation == scene::Triangulation::kPlane)
      scene::lay_flat(scene.objects, found);
    for (std::size_t i = 0; i < count; ++i) poses[i] = pose_of(i, found[i]);
  });
}
