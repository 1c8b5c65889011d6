#include "render/tile/cloud_picture.h"

#include <algorithm>

#include "render/frame/profile.h"
#include "render/sky/volume_clouds.h"
#include "render/tile/cloud_rows.h"
#include "render/tile/shading.h"

namespace swell::render {
namespace {

// Nodes that lie farther apart than this, as an angle or over the clouds, would show as squares.
constexpr float kWidest = 0.0075f, kWidest_m = 80.0f;

// log2 of the pixels between nodes: 4 in pictures of 720 rows and 60 degrees, 2 in smaller or wider
// ones.
std::uint8_t find_step_log2(float pixel_angle, float above_m) {
  int step_log2 = CloudPicture::kMostStepLog2;
  const auto between = [&] { return static_cast<float>(1 << step_log2) * pixel_angle; };
  while (step_log2 > CloudPicture::kLeastStepLog2 && between() > kWidest) --step_log2;
  if (above_m * between() > kWidest_m) step_log2 = CloudPicture::kLeastStepLog2;
  return static_cast<std::uint8_t>(step_log2);
}

}  // namespace

void draw_clouds(const Shading& shading, const VolumeClouds& clouds, float picture_scale,
                 CloudPicture& picture, const StageRun& run) {
  picture.any = clouds.any();
  if (!picture.any) return;
  picture.step_log2 =
      find_step_log2(picture_scale * shading.rays.pixel_angle, clouds.eye_z - clouds.volume->top_m);
  const int step = picture.step();
  // 4 n + 1, so that coarse nodes lie all around.
  picture.columns = ((shading.viewport.width_px - 1) / step + 4) / 4 * 4 + 1;
  picture.rows = ((shading.viewport.height_px - 1) / step + 4) / 4 * 4 + 1;
  picture.stride = static_cast<std::size_t>(picture.columns) + CloudPicture::kPadding;
  const std::size_t size = picture.stride * static_cast<std::size_t>(picture.rows);
  for (std::vector<float>& channel : picture.nodes) channel.resize(size);
  picture.clear.resize(size);
  picture.even.resize(size);
  const auto in_rows = [&](int at_once, auto&& write) {
    run.for_each(static_cast<std::size_t>((picture.rows + at_once - 1) / at_once),
                 [&](std::size_t n, int) { write(at_once * static_cast<int>(n)); });
  };
  for (const int spacing : {4, 2})
    in_rows(4 * spacing,
            [&](int j) { write_coarse_clouds(shading, clouds, j, spacing, spacing < 4, picture); });
  run.for_each(static_cast<std::size_t>(picture.rows / 2),
               [&](std::size_t n, int) { find_even_cells(2 * static_cast<int>(n) + 1, picture); });
  in_rows(4, [&](int j) { write_fine_clouds(shading, clouds, j, picture); });
}

}  // namespace swell::render
