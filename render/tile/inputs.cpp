#include "render/tile/inputs.h"

#include "scene/scene.h"

namespace swell::render {

Distortion make_distortion(const scene::Scene& scene, const View& camera) {
  Distortion distortion;
  distortion.px_per_slope = static_cast<float>(scene.water.distortion * camera.picture_height_px());
  if (scene.water.distortion_factor == scene::DistortionFactor::kPaper) {
    distortion.by_sine = 0.5f / camera.tan_half_y;
    distortion.least = 0.0f;
    distortion.across = 1.0f;
  }
  return distortion;
}

}  // namespace swell::render
