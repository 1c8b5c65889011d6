// The keys of [[disturbance]], and what of a scene disturbs the water.
#include <array>

#include "scene/file/parameter_row.h"
#include "scene/file/parameters.h"

namespace swell::scene {
namespace {

using ocean::Disturbance;

struct KindName {
  static constexpr auto words = ocean::kDisturbanceKindNames;
  auto& operator()(auto& disturbance) const { return disturbance.kind; }
};

#define SWELL_FIELD(PATH) \
  [](auto& disturbance) -> auto& { return disturbance.PATH; }

// The draught of a boat's hull proper, without its keel: of its beam.
constexpr double kDraughtOfBeam = 0.17;

bool makes_wake(const FloatingObject& object) {
  return kObjectKinds[object.kind].makes_wake && object.wake && object.motion == Motion::kFloat &&
         object.path_m.size() >= 2;
}

Disturbance hull_of(const FloatingObject& object) {
  Disturbance hull;
  hull.kind = ocean::DisturbanceKind::kHull;
  hull.path_m = object.path_m;
  hull.speed_mps = object.speed_mps;
  hull.path_closed = object.path_closed;
  hull.hull_m = {object.size_m.x, object.size_m.y, kDraughtOfBeam * object.size_m.x};
  return hull;
}

}  // namespace

std::vector<Parameter<Disturbance>> disturbance_parameters() {
  using WakeRow = Row<Disturbance>;
  return {
      WakeRow::choice("kind", KindName{},
                      "a drop's hump, a footstep's hollow, a hull under way, or the gusts under a "
                      "rotor"),
      WakeRow::vector("position_m", {-1e6, 1e6, "m"}, SWELL_FIELD(position_m),
                      "of its middle: east, north; not of a hull"),
      WakeRow::number("t_s", {-1e6, 1e6, "s"}, SWELL_FIELD(t_s),
                      "when it happens, or a rotor begins; not of a hull"),
      WakeRow::number("duration_s", {0, 1e6, "s"}, SWELL_FIELD(duration_s), "of a rotor"),
      WakeRow::number("radius_m", {0.02, 50, "m"}, SWELL_FIELD(radius_m),
                      "of a drop or a step, where 1/e of the height is left; of a rotor"),
      WakeRow::number("height_m", {-10, 10, "m"}, SWELL_FIELD(height_m),
                      "of a drop's hump, below 0 a hollow; depth of a step; of a rotor's gusts the "
                      "most"),
      WakeRow::points("path_m", {-1e6, 1e6, "m"}, 2, kMaxPathPoints, SWELL_FIELD(path_m),
                      "a hull goes along the line through these points [east, north], from the "
                      "first at t = 0"),
      WakeRow::number("speed_mps", {0, 1000, "m/s"}, SWELL_FIELD(speed_mps), "of a hull"),
      WakeRow::plain<bool>("path_closed", ParameterKind::kBoolean, SWELL_FIELD(path_closed),
                           "round and round; false: the hull stops at the last point"),
      WakeRow::vector("hull_m", {0.05, 500, "m"}, SWELL_FIELD(hull_m),
                      "of a hull: beam, length, draught"),
      WakeRow::or_zero(WakeRow::number("depth_m", {0.1, 10000, "m"}, SWELL_FIELD(depth_m),
                                       "of the water under a hull, which slows long waves; 0: "
                                       "deep")),
  };
}

#undef SWELL_FIELD

std::vector<Disturbance> all_disturbances(const Scene& scene) {
  std::vector<Disturbance> all = scene.disturbances;
  for (const FloatingObject& object : scene.objects)
    if (makes_wake(object)) all.push_back(hull_of(object));
  return all;
}

}  // namespace swell::scene
