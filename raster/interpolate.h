// Where on its triangle is a visible pixel? For attributes of objects and for wireframes.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "raster/pass.h"
#include "raster/vertices.h"

namespace swell::raster {

struct SurfacePoint {
  // Perspective-correct weights of the three vertices, each in [0, 1], their sum 1 up to rounding.
  std::array<float, 3> weight;
  // Window distance to the edge opposite each vertex [px]; positive inside.
  std::array<float, 3> edge_distance_px;
  float w_clip;  // of the surface at the pixel
};

// One source triangle, ready to be asked at many pixels. If no vertex needs clipping, all is
// measured on the snapped window positions, as coverage is; otherwise on the exact plane.
class TriangleInterpolator {
 public:
  // p_clip as in Draw, all finite. The triangle must be one that a pass can draw: of no zero area.
  TriangleInterpolator(const std::array<glm::vec4, 3>& p_clip, Viewport viewport);

  // At the centre of pixel (x_px, y_px), which the triangle should cover. Elsewhere weights are
  // limited to [0, 1]; where nothing of the triangle is near, they are equal.
  SurfacePoint at(int x_px, int y_px) const;

 private:
  // Positive on the triangle's side of the edge opposite a vertex, or negative, all three alike:
  // fx (x - x0) + fy (y - y0) + f0. Times `weight`, it is the vertex's weight, not normalised.
  struct EdgeLine {
    double fx, fy, f0, x0_px, y0_px;
    double weight, px_per_unit;
  };

  void set_up_snapped(const std::array<WindowVertex, 3>& window);
  void set_up_clipped(const std::array<glm::vec4, 3>& p_clip, Viewport viewport);

  std::array<EdgeLine, 3> lines_;
  std::array<double, 3> w_clip_;
};

}  // namespace swell::raster
