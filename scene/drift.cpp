#include "scene/drift.h"

#include <algorithm>
#include <memory>
#include <span>

#include "math/elementary.h"
#include "ocean/inland/drift.h"

namespace swell::scene {
namespace {

// The object as the water sees it at t = 0.
ocean::Drifter drifter_of(const FloatingObject& object) {
  return {object.position_m, {sin(object.heading_rad), cos(object.heading_rad)}, object.size_m.y};
}

std::shared_ptr<const ocean::DriftTrack> track_of(const ocean::Drifter& drifter,
                                                  std::span<const Scene* const> scenes) {
  for (const Scene* const scene : scenes)
    for (const FloatingObject& other : scene->objects)
      if (other.drift_track && other.drift_track->drifter() == drifter) return other.drift_track;
  return nullptr;
}

}  // namespace

void find_drift_tracks(Scene& scene, std::span<const Scene* const> like, Workers& workers) {
  if (std::ranges::none_of(scene.objects, &FloatingObject::drift)) return;
  const ocean::RiverNetwork network(scene.rivers, scene.lakes);
  const ocean::RiverFlow flow(network);
  workers.for_each(scene.objects.size(), [&](std::size_t n, int) {
    FloatingObject& object = scene.objects[n];
    object.drift_track = nullptr;
    if (!object.drift) return;
    const ocean::Drifter drifter = drifter_of(object);
    object.drift_track = track_of(drifter, like);
    if (!object.drift_track)
      object.drift_track = std::make_shared<const ocean::DriftTrack>(network, flow, drifter);
  });
}

}  // namespace swell::scene
