#include "raster/interpolate.h"

#include <algorithm>
#include <cmath>

namespace swell::raster {

TriangleInterpolator::TriangleInterpolator(const std::array<glm::vec4, 3>& p_clip,
                                           Viewport viewport) {
  std::array<WindowVertex, 3> window;
  project_vertices(p_clip, {}, viewport, window);
  const std::uint32_t flags = window[0].flags | window[1].flags | window[2].flags;
  for (int i = 0; i < 3; ++i) w_clip_[i] = double{p_clip[i].w};
  if ((flags & (kClipFlags | kNotFinite)) == 0) {
    set_up_snapped(window);
  } else {
    set_up_clipped(p_clip, viewport);
  }
  for (EdgeLine& line : lines_) {
    const double length = std::sqrt(line.fx * line.fx + line.fy * line.fy);
    line.px_per_unit = length > 0.0 ? 1.0 / length : 0.0;
  }
}

// The edge function opposite a vertex is proportional to the vertex's weight in the window;
// divided by the vertex's w it is proportional to its weight on the surface.
// Source: Blinn, Hyperbolic Interpolation, 1992.
void TriangleInterpolator::set_up_snapped(const std::array<WindowVertex, 3>& window) {
  constexpr double kPxPerFx8 = 1.0 / kPixelFx8;
  for (int i = 0; i < 3; ++i) {
    const WindowVertex& a = window[(i + 1) % 3];
    const WindowVertex& b = window[(i + 2) % 3];
    lines_[i] = {(a.y_fx8 - b.y_fx8) * kPxPerFx8,
                 (b.x_fx8 - a.x_fx8) * kPxPerFx8,
                 0.0,
                 a.x_fx8 * kPxPerFx8,
                 a.y_fx8 * kPxPerFx8,
                 1.0 / w_clip_[i],
                 0.0};
  }
}

// With M = (p_0 p_1 p_2), p = (x, y, w), the weights b of window point (x_ndc, y_ndc) solve
// M b = w (x_ndc, y_ndc, 1), so b_i is proportional to (p_j x p_k) . (x_ndc, y_ndc, 1), whatever
// the signs of the vertices' w.
// Source: Olano and Greer, Triangle Scan Conversion using 2D Homogeneous Coordinates, 1997.
void TriangleInterpolator::set_up_clipped(const std::array<glm::vec4, 3>& p_clip,
                                          Viewport viewport) {
  for (int i = 0; i < 3; ++i) {
    const glm::dvec4 j(p_clip[(i + 1) % 3]), k(p_clip[(i + 2) % 3]);
    const glm::dvec3 line = glm::cross(glm::dvec3(j.x, j.y, j.w), glm::dvec3(k.x, k.y, k.w));
    // x_ndc = 2 x / width - 1, y_ndc = 1 - 2 y / height.
    lines_[i] = {2.0 * line.x / viewport.width_px,
                 -2.0 * line.y / viewport.height_px,
                 line.z - line.x + line.y,
                 0.0,
                 0.0,
                 1.0,
                 0.0};
  }
}

SurfacePoint TriangleInterpolator::at(int x_px, int y_px) const {
  std::array<double, 3> edge, weight;
  double sum = 0.0;
  for (int i = 0; i < 3; ++i) {
    const EdgeLine& line = lines_[i];
    edge[i] = line.fx * (x_px + 0.5 - line.x0_px) + line.fy * (y_px + 0.5 - line.y0_px) + line.f0;
    weight[i] = edge[i] * line.weight;
    sum += weight[i];
  }
  // Inside, all weights have the sign of their sum.
  const double sign = sum < 0.0 ? -1.0 : 1.0;
  double inside_sum = 0.0;
  for (double& w : weight) inside_sum += w = std::max(w * sign, 0.0);

  SurfacePoint point{};
  double w_clip = 0.0;
  for (int i = 0; i < 3; ++i) {
    const double normalised = inside_sum > 0.0 ? weight[i] / inside_sum : 1.0 / 3.0;
    point.weight[i] = static_cast<float>(normalised);
    point.edge_distance_px[i] = static_cast<float>(edge[i] * sign * lines_[i].px_per_unit);
    w_clip += normalised * w_clip_[i];
  }
  point.w_clip = static_cast<float>(w_clip);
  return point;
}

}  // namespace swell::raster
