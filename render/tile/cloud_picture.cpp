#include "render/tile/cloud_picture.h"

#include "render/tile/cloud_rows.h"
#include "render/tile/shading.h"

namespace swell::render {

void draw_clouds(const Shading& shading, const VolumeClouds& clouds, CloudPicture& picture,
                 const StageRun& run) {
  picture.any = clouds.any();
  if (!picture.any) return;
  // Nodes this far apart would show as squares.
  constexpr float kWidest_m = 80.0f;
  const float above_m = clouds.eye_z - clouds.volume->top_m;
  const float between = static_cast<float>(1 << CloudPicture::kStepLog2) * shading.rays.pixel_angle;
  picture.step_log2 =
      above_m * between > kWidest_m ? CloudPicture::kLeastStepLog2 : CloudPicture::kStepLog2;
  const int step = picture.step();
  // Odd, so that coarse nodes lie all around.
  picture.columns = ((shading.viewport.width_px - 1) / step + 2) | 1;
  picture.rows = ((shading.viewport.height_px - 1) / step + 2) | 1;
  picture.stride = static_cast<std::size_t>(picture.columns) + CloudPicture::kPadding;
  for (std::vector<float>& channel : picture.nodes)
    channel.resize(picture.stride * static_cast<std::size_t>(picture.rows));
  const auto rows = static_cast<std::size_t>(picture.rows);
  run.for_each((rows + 3) / 4, [&](std::size_t n, int) {
    write_coarse_clouds(shading, clouds, 4 * static_cast<int>(n), picture);
  });
  run.for_each((rows + 1) / 2, [&](std::size_t n, int) {
    write_fine_clouds(shading, clouds, 2 * static_cast<int>(n), picture);
  });
}

void draw_cloud_sky(const VolumeClouds& clouds, const CloudAir& air, CloudSky& sky,
                    const StageRun& run) {
  sky.any = clouds.any();
  if (!sky.any) return;
  for (std::vector<float>& channel : sky.texels)
    channel.resize(static_cast<std::size_t>(CloudSky::kSide) * CloudSky::kSide);
  run.for_each(CloudSky::kSide, [&](std::size_t y, int) {
    write_cloud_sky_row(clouds, air, static_cast<int>(y), sky);
  });
}

}  // namespace swell::render
