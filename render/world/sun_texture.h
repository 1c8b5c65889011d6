// The picture that the mirrored sun throws on the water where the sun's glitter is projected: a
// bright spot with a halo. Source: Ma, Zhu, Gong, 2006, who draw one by hand.
#pragma once

#include "texture/packed_map.h"

namespace swell::render {

struct SunTexture {
  static constexpr int kSize = 128;      // texels a side; the spot lies in the middle
  static constexpr float kReach = 6.0f;  // from the middle to the sides, in radii of the spot
  texture::RgbaImage image;              // root of the light over that in the middle
  float whole = 1.0f;                    // its integral, in units of the spot's radius squared
};

SunTexture make_sun_texture();

}  // namespace swell::render
