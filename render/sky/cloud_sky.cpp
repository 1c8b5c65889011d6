#include "render/sky/cloud_sky.h"

#include "render/frame/profile.h"
#include "render/sky/volume_clouds.h"

namespace swell::render {

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
