// The perspective pictures that a wide picture is put together from: faces of a cube around the
// eye, and where in them its pixels lie.
//
// All faces have one focal length, so that on both sides of a seam, where the angles to both axes
// are equal, pixels see as much: shading and levels of detail fit together. Each is cut to what the
// picture shows of it, with a margin beyond, out of which its water mirrors things.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "math/parallel.h"
#include "math/view.h"

namespace swell::render {

struct WideFace {
  glm::dmat3 wide_from_face{1.0};  // optical frames: right, down, ahead
  Intrinsics k;
  int width_px = 0, height_px = 0;
};

inline constexpr std::uint32_t kNoFace = ~std::uint32_t{0};  // of pixels that show nothing

// Where a pixel's centre lies in a face, and how far the tent that weighs the face's pixels around
// it reaches: one pixel, or as far as the next pixel of the wide picture if that is further.
struct WidePixel {
  float x_px = 0.0f, y_px = 0.0f;
  float reach_x_px = 1.0f, reach_y_px = 1.0f;
  std::uint32_t face = kNoFace;
};

struct WidePlan {
  Projection projection;
  glm::ivec2 size_px{0};
  std::vector<WideFace> faces;  // those that the picture meets
  std::vector<WidePixel> pixels;
};

// Of a wide projection, as ray_at() takes it, and a size in [1, 8192] x [1, 8192]. The faces have
// pixels as fine as the picture's own where these are finest (of equirectangular ones: on the
// equator), but are not larger than 8192 x 8192.
WidePlan plan_wide(const Projection& projection, glm::ivec2 size_px, Workers& workers);

// The view that draws a face of the picture of a wide view.
View face_view(const View& wide, const WideFace& face);

}  // namespace swell::render
