// The curve of sRGB (IEC 61966-2-1).
#pragma once

#include "math/elementary.h"

namespace swell::texture {

// The linear light of a code in [0, 1].
inline double linear_of_srgb(double code) {
  return code <= 0.04045 ? code / 12.92 : pow((code + 0.055) / 1.055, 2.4);
}

}  // namespace swell::texture
