#include <algorithm>
#include <cmath>

#include "math/check.h"
#include "math/elementary.h"
#include "scene/scene.h"

namespace swell::scene {

View camera_view(const Camera& camera, double t_s, int width_px, int height_px) {
  SWELL_CHECK(std::isfinite(t_s), "t_s={}", t_s);
  constexpr double kMaxTime = 1e12, kMaxDistance = 1e7;
  const double t = std::clamp(t_s, -kMaxTime, kMaxTime);
  const glm::dvec3 eye_world = glm::clamp(camera.eye_m + camera.velocity_mps * t,
                                          glm::dvec3(-kMaxDistance), glm::dvec3(kMaxDistance));
  // fmod is exact, so this costs no bits that the product had.
  const double heading_rad = std::fmod(camera.heading_rad + camera.turn_rad_s * t, 2.0 * kPi);
  return make_view(eye_world, heading_rad, camera.pitch_rad, camera.fov_y_rad,
                   static_cast<float>(camera.near_m), width_px, height_px);
}

}  // namespace swell::scene
