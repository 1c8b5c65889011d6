#pragma once

namespace swell::render {

// How the surface (not sky) pixels of a tile got their light.
struct ShadedPixels {
  int shaded = 0, interpolated = 0;
};

}  // namespace swell::render
