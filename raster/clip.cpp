#include "raster/clip.h"

#include <algorithm>
#include <tuple>

#include "raster/vertices.h"

namespace swell::raster {
namespace {

bool comes_first(const ClipVertex& a, const ClipVertex& b) {
  return std::tie(a.p_clip.x, a.p_clip.y, a.p_clip.z, a.p_clip.w, a.user) <
         std::tie(b.p_clip.x, b.p_clip.y, b.p_clip.z, b.p_clip.w, b.user);
}

// Keeps the part of the polygon where distance(vertex) >= 0.
template <class Distance>
void clip_by_plane(ClipPolygon& polygon, Distance distance) {
  std::array<double, ClipPolygon::kMaxVertices> d;
  bool any_outside = false;
  for (int i = 0; i < polygon.count; ++i) {
    d[i] = distance(polygon.vertices[i]);
    any_outside |= d[i] < 0.0;
  }
  if (!any_outside) return;

  ClipPolygon kept;
  for (int i = 0; i < polygon.count; ++i) {
    const int next = i + 1 == polygon.count ? 0 : i + 1;
    if (d[i] >= 0.0) kept.vertices[kept.count++] = polygon.vertices[i];
    // An edge that only touches the plane has its touching end already.
    const bool crosses = (d[i] > 0.0 && d[next] < 0.0) || (d[i] < 0.0 && d[next] > 0.0);
    if (crosses && kept.count < ClipPolygon::kMaxVertices) {
      kept.vertices[kept.count++] =
          cut_edge(polygon.vertices[i], d[i], polygon.vertices[next], d[next]);
    }
  }
  polygon = kept;
}

}  // namespace

ClipVertex cut_edge(const ClipVertex& a, double da, const ClipVertex& b, double db) {
  if (comes_first(b, a)) return cut_edge(b, db, a, da);
  const double t = da / (da - db);
  return {a.p_clip + (b.p_clip - a.p_clip) * t, a.user + (b.user - a.user) * t, -1};
}

ClipPolygon clip_triangle(const std::array<ClipVertex, 3>& triangle, Viewport viewport) {
  ClipPolygon polygon;
  polygon.count = 3;
  std::copy(triangle.begin(), triangle.end(), polygon.vertices.begin());
  const auto first = std::min_element(triangle.begin(), triangle.end(), comes_first);
  std::rotate(polygon.vertices.begin(), polygon.vertices.begin() + (first - triangle.begin()),
              polygon.vertices.begin() + 3);

  clip_by_plane(polygon, [](const ClipVertex& v) { return v.p_clip.w - double{kMinW}; });
  clip_by_plane(polygon, [](const ClipVertex& v) { return v.p_clip.w - v.p_clip.z; });
  clip_by_plane(polygon, [](const ClipVertex& v) { return v.p_clip.z; });
  clip_by_plane(polygon, [](const ClipVertex& v) { return v.user; });
  // The limits are the float numbers that project_vertices compares with.
  const double limit_x = 2.0f * kGuardPx / static_cast<float>(viewport.width_px) - 1.0f;
  const double limit_y = 2.0f * kGuardPx / static_cast<float>(viewport.height_px) - 1.0f;
  clip_by_plane(polygon, [=](const ClipVertex& v) { return limit_x * v.p_clip.w - v.p_clip.x; });
  clip_by_plane(polygon, [=](const ClipVertex& v) { return limit_x * v.p_clip.w + v.p_clip.x; });
  clip_by_plane(polygon, [=](const ClipVertex& v) { return limit_y * v.p_clip.w - v.p_clip.y; });
  clip_by_plane(polygon, [=](const ClipVertex& v) { return limit_y * v.p_clip.w + v.p_clip.y; });
  if (polygon.count < 3) polygon.count = 0;
  return polygon;
}

}  // namespace swell::raster
