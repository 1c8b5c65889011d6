// How the water moves below its surface, and what it does to hulls.
#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "capi/asked_sea.h"
#include "capi/call.h"
#include "capi/camera.h"
#include "capi/disturbances.h"
#include "ocean/water_surface.h"
#include "render/sea/sea_maps.h"
#include "render/world/world_state.h"

namespace swell::capi {
namespace {

constexpr std::size_t kPointsBelowAtOnce = 1 << 16;
constexpr double kDeepest_m = 1e7;

double density_of(double given, const char* name) {
  if (given == 0.0) return ocean::kSeaDensity_kg_m3;
  check_range(name, given, 1.0, 1e5);
  return given;
}

void check_points(const char* name, const double* xyz_m, std::size_t count) {
  if (count > std::numeric_limits<std::size_t>::max() / 64)
    refuse("{}: their count, got {}, allowed the number of points", name, count);
  if (count > 0) check_not_null(xyz_m, name);
  for (std::size_t i = 0; i < 3 * count; ++i) {
    if (i % 3 < 2 && !(std::abs(xyz_m[i]) < kFarthest_m))
      refuse("{}[{}], got {}, allowed below {} m", name, i / 3, xyz_m[i], kFarthest_m);
    if (i % 3 == 2 && !(std::abs(xyz_m[i]) <= kDeepest_m))
      refuse("{}[{}], got z = {}, allowed within {} m", name, i / 3, xyz_m[i], kDeepest_m);
  }
}

// The water below the surface at a time. Calls ask(surface, below).
template <class Ask>
void ask_below(double t_s, std::span<const ocean::Disturbance> disturbances, bool with_velocity,
               swell_session& session, const Ask& ask) {
  const render::WorldState& world = state_of(session);
  std::optional<Forgetting> forgetting;
  if (!disturbances.empty()) forgetting.emplace(session);
  const ocean::SeaFrame& sea = sea_at(t_s, session, disturbances);
  if (with_velocity) velocity_at(t_s, session);
  frame_at(t_s, session.below, [&](ocean::BelowFrame& frame) {
    ocean::begin_below(*world.sea, sea, &session.velocity.frame, frame);
  });
  ask(render::water_surface(world, sea), session.below.frame);
}

void copy(const glm::vec3& from, float* to) { std::copy_n(&from.x, 3, to); }
void copy(const glm::dvec3& from, double (&to)[3]) { std::copy_n(&from.x, 3, to); }

void give_motions(std::span<const ocean::WaterMotion> motion, const swell_below& query,
                  std::size_t first) {
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const ocean::WaterMotion& m = motion[i];
    const std::size_t n = first + i;
    if (query.velocity_mps) copy(m.velocity_mps, query.velocity_mps + 3 * n);
    if (query.acceleration_mps2) copy(m.acceleration_mps2, query.acceleration_mps2 + 3 * n);
    if (query.pressure_pa) query.pressure_pa[n] = m.pressure_pa;
    if (query.place) query.place[n] = static_cast<std::uint8_t>(m.place);
  }
}

void ask(const swell_below& query, swell_session& session) {
  check_time(query.t_s);
  const double density = density_of(query.density_kg_m3, "below.density_kg_m3");
  check_points("below.xyz_m", query.xyz_m, query.count);
  const auto disturbances = given_disturbances(query.disturbances, query.disturbance_count);
  const ocean::MotionParts parts{query.velocity_mps != nullptr, query.acceleration_mps2 != nullptr,
                                 query.pressure_pa != nullptr};
  const std::span<const glm::dvec3> points(reinterpret_cast<const glm::dvec3*>(query.xyz_m),
                                           query.count);
  if (points.empty()) return;
  ask_below(query.t_s, disturbances, parts.velocity, session,
            [&](const ocean::WaterSurface& water, ocean::BelowFrame& below) {
              std::vector<ocean::WaterMotion> motion(std::min(kPointsBelowAtOnce, points.size()));
              for (std::size_t first = 0; first < points.size(); first += kPointsBelowAtOnce) {
                const auto some =
                    points.subspan(first, std::min(kPointsBelowAtOnce, points.size() - first));
                const auto moved = std::span(motion).first(some.size());
                water.motions(some, parts, density, below, session.workers, moved);
                give_motions(moved, query, first);
              }
            });
}

swell_loads loads_on(const swell_hull& hull, swell_session& session) {
  check_time(hull.t_s);
  const double density = density_of(hull.density_kg_m3, "hull.density_kg_m3");
  check_points("hull.xyz_m", hull.xyz_m, hull.point_count);
  check_points("hull.about_m", hull.about_m, 1);
  if (hull.triangle_count > std::numeric_limits<std::size_t>::max() / 64)
    refuse("hull.triangle_count, got {}, allowed the number of triangles", hull.triangle_count);
  if (hull.triangle_count > 0) check_not_null(hull.triangles, "hull.triangles");
  for (std::size_t i = 0; i < 3 * hull.triangle_count; ++i)
    if (hull.triangles[i] >= hull.point_count)
      refuse("hull.triangles[{}], got point {}, allowed below {}, the number of points", i / 3,
             hull.triangles[i], hull.point_count);
  const auto disturbances = given_disturbances(hull.disturbances, hull.disturbance_count);
  const ocean::HullMesh mesh{
      {reinterpret_cast<const glm::dvec3*>(hull.xyz_m), hull.point_count},
      {reinterpret_cast<const glm::uvec3*>(hull.triangles), hull.triangle_count}};
  const glm::dvec3 about(hull.about_m[0], hull.about_m[1], hull.about_m[2]);
  swell_loads loads{};
  ask_below(hull.t_s, disturbances, false, session,
            [&](const ocean::WaterSurface& water, ocean::BelowFrame& below) {
              const ocean::HullLoads found =
                  water.hull_loads(mesh, about, density, below, session.workers);
              copy(found.buoyancy.force_n, loads.buoyancy_n);
              copy(found.buoyancy.moment_nm, loads.buoyancy_nm);
              copy(found.froude_krylov.force_n, loads.froude_krylov_n);
              copy(found.froude_krylov.moment_nm, loads.froude_krylov_nm);
            });
  return loads;
}

}  // namespace
}  // namespace swell::capi

using namespace swell;
using namespace swell::capi;

swell_status swell_ask_below(swell_session* session, const swell_below* below) {
  return guarded([&] {
    const Held held(session, "session");
    ask(taken(below, "below"), *held);
  });
}

swell_status swell_hull_loads(swell_session* session, const swell_hull* hull, swell_loads* loads) {
  return guarded([&] {
    const Held held(session, "session");
    give(loads_on(taken(hull, "hull"), *held), loads, "loads");
  });
}
