// The volumetric clouds of a frame: where the wind has them, and the light that falls on them.
#pragma once

#include <glm/glm.hpp>

#include "math/view.h"
#include "render/frame/parts.h"
#include "render/sky/cloud_volume.h"

namespace swell::scene {
struct Scene;
}

namespace swell::render {

struct WorldState;

// Samples of a ray lie on whole steps from the eye; from far_m on steps are twice as long, and so
// on. Both are powers of two.
struct CloudSteps {
  static constexpr int kGroup = 4;  // steps that are passed over or taken together
  float step_m = 16.0f, far_m = 4096.0f;
  // The most that extinction times distance is, from far_m on: a step's depth stays at most 0.5.
  float most_depth = 0.5f * far_m / step_m;
};

struct VolumeClouds {
  const CloudVolume* volume = nullptr;  // none: there are no such clouds
  float eye_z = 0.0f;
  glm::vec2 eye_voxel{0.0f};      // where the eye is; within the volume if it repeats
  glm::vec3 detail_at_eye{0.0f};  // the same in points of the detail, of the height 0
  float drop_per_m2 = 0.0f;
  CloudSteps steps;
  bool rays = false, powder = false, skips_empty = true;
  bool small_forms = true;  // else they count by their mean
  glm::vec3 to_light{0, 0, 1};
  // Linear RGB, exposed.
  glm::vec3 sun{0.0f};     // irradiance over the clouds
  glm::vec3 sky{0.0f};     // mean radiance from above
  glm::vec3 ground{0.0f};  // and from all around, deep in clouds

  bool any() const { return volume != nullptr; }
};

// The farthest that clouds are followed [m].
inline constexpr float kFarthestCloud_m = 100000.0f;

// As seen from `eye` at t_s; pixel_angle [rad] says how fine far steps must be.
VolumeClouds make_volume_clouds(const WorldState& world, double t_s, glm::dvec3 eye,
                                float pixel_angle, PartSet without);

// How far the wind has carried them: a function of t_s.
glm::dvec2 volume_drift_m(const scene::Scene& scene, double period_m, double t_s);

}  // namespace swell::render
