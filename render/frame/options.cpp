#include "render/frame/options.h"

#include "scene/camera.h"

namespace swell::render {

FrameOptions with_scene_defaults(const FrameOptions& options, const scene::Scene& scene) {
  FrameOptions result = options;
  if (result.water_triangles == 0) result.water_triangles = scene.detail.water_triangles;
  if (result.terrain_triangles == 0) result.terrain_triangles = scene.detail.terrain_triangles;
  if (result.lookup_scale == 0.0) result.lookup_scale = scene.water.lookup_scale;
  if (result.background_error_px < 0.0)
    result.background_error_px = scene.detail.background_error_px;
  if (result.edge_samples < 0) result.edge_samples = scene.picture.edge_samples;
  const scene::Camera& camera = scene.camera;
  if (!result.exposure && camera.f_number > 0.0)
    result.exposure = scene::camera_exposure(camera.f_number, camera.exposure_s,
                                             result.noise.value_or(camera.noise).iso);
  if (!result.shading) result.shading = scene.picture.shading;
  if (result.keep_linear && !result.is_face) result.shading = scene::ShadingRate::kFull;
  return result;
}

}  // namespace swell::render
