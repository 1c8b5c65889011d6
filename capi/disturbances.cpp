#include "capi/disturbances.h"

#include "capi/call.h"
#include "scene/check_scene.h"

namespace swell::capi {
namespace {

constexpr std::size_t kFarMore = 100'000;  // than scene::find_fault() allows

void set_if_given(double given, double& value) {
  if (given != 0.0) value = given;
}

ocean::Disturbance disturbance_of(const swell_disturbance& d) {
  check_range("disturbances[].kind", d.kind, SWELL_DROP, SWELL_ROTOR);
  ocean::Disturbance result;
  result.kind = static_cast<ocean::DisturbanceKind>(d.kind);
  result.position_m = {d.position_m[0], d.position_m[1]};
  result.t_s = d.t_s;
  set_if_given(d.duration_s, result.duration_s);
  set_if_given(d.radius_m, result.radius_m);
  set_if_given(d.height_m, result.height_m);
  if (d.path_count > kFarMore)
    refuse("disturbances[].path_count, got {}, allowed the number of points", d.path_count);
  if (d.path_count > 0) check_not_null(d.path_m, "disturbances[].path_m");
  for (std::size_t i = 0; i < d.path_count; ++i)
    result.path_m.emplace_back(d.path_m[2 * i], d.path_m[2 * i + 1]);
  set_if_given(d.speed_mps, result.speed_mps);
  result.path_closed = d.path_open == 0;
  for (int i = 0; i < 3; ++i) set_if_given(d.hull_m[i], result.hull_m[i]);
  result.depth_m = d.depth_m;
  return result;
}

}  // namespace

std::vector<ocean::Disturbance> given_disturbances(const swell_disturbance* disturbances,
                                                   std::size_t count) {
  if (count > kFarMore) refuse("disturbance_count, got {}, allowed the number of them", count);
  std::vector<ocean::Disturbance> given;
  for (std::size_t i = 0; i < count; ++i) {
    const swell_disturbance d = taken(disturbances ? disturbances + i : nullptr, "disturbances");
    if (disturbances[i].size != sizeof(swell_disturbance))
      refuse("disturbances[{}].size, got {}, allowed {}", i, disturbances[i].size,
             sizeof(swell_disturbance));
    given.push_back(disturbance_of(d));
  }
  if (const auto fault = scene::find_fault(given)) refuse("{}", scene::fault_text(*fault));
  return given;
}

}  // namespace swell::capi
