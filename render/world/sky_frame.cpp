#include "render/world/sky_frame.h"

#include "render/world/for_each_row.h"

namespace swell::render {

void advance_sky(const World::State& world, const Clouds& clouds, SkyFrame& sky,
                 const StageRun& run) {
  if (!clouds.any) return;
  if (sky.codes.width != kSoftSkySize) texture::resize_image(kSoftSkySize, kSoftSkySize, sky.codes);
  for_each_row(kSoftSkySize, run.workers,
               [&](int y) { write_soft_sky_row(*world.sky, clouds, y, sky.codes); });
  texture::pack_rgb(sky.codes, sky.soft);
}

}  // namespace swell::render
