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

// Keeps the part of the polygon where distance(vertex) >= 0. put_on_plane(vertex) removes what
// rounding leaves of a new vertex's distance: between two ends at 1e30 px that can be 1e14 px.
template <class Distance, class PutOnPlane>
void clip_by_plane(ClipPolygon& polygon, Distance distance, PutOnPlane put_on_plane) {
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
    if (!crosses || kept.count == ClipPolygon::kMaxVertices) continue;
    ClipVertex& cut = kept.vertices[kept.count++];
    cut = cut_edge(polygon.vertices[i], d[i], polygon.vertices[next], d[next]);
    put_on_plane(cut);
  }
  polygon = kept;
}

}  // namespace

// Both weights are quotients of their own, so that a vertex at 1e30 leaves the other one's digits
// alone; a + t (b - a) would not, and would depend on the order of a and b.
ClipVertex cut_edge(const ClipVertex& a, double da, const ClipVertex& b, double db) {
  const double weight_a = db / (db - da), weight_b = da / (da - db);
  ClipVertex cut{a.p_clip * weight_a + b.p_clip * weight_b, {}};
  for (std::size_t k = 0; k < kClipDistances; ++k)
    cut.user[k] = a.user[k] * weight_a + b.user[k] * weight_b;
  return cut;
}

ClipPolygon clip_triangle(const std::array<ClipVertex, 3>& triangle, Viewport viewport) {
  ClipPolygon polygon;
  polygon.count = 3;
  std::copy(triangle.begin(), triangle.end(), polygon.vertices.begin());
  const auto first = std::min_element(triangle.begin(), triangle.end(), comes_first);
  std::rotate(polygon.vertices.begin(), polygon.vertices.begin() + (first - triangle.begin()),
              polygon.vertices.begin() + 3);

  using Vertex = ClipVertex;
  clip_by_plane(
      polygon, [](const Vertex& v) { return v.p_clip.w - double{kMinW}; },
      [](Vertex& v) { v.p_clip.w = double{kMinW}; });
  clip_by_plane(
      polygon, [](const Vertex& v) { return v.p_clip.w - v.p_clip.z; },
      [](Vertex& v) { v.p_clip.z = v.p_clip.w; });
  clip_by_plane(
      polygon, [](const Vertex& v) { return v.p_clip.z; }, [](Vertex& v) { v.p_clip.z = 0.0; });
  for (std::size_t k = 0; k < kClipDistances; ++k)
    clip_by_plane(
        polygon, [=](const Vertex& v) { return v.user[k]; }, [=](Vertex& v) { v.user[k] = 0.0; });

  // Guard band: both sides of x, then of y. The limits are the floats that project_vertices uses.
  const double limits[] = {2.0f * kGuardPx / static_cast<float>(viewport.width_px) - 1.0f,
                           2.0f * kGuardPx / static_cast<float>(viewport.height_px) - 1.0f};
  for (int axis = 0; axis < 2; ++axis) {
    for (const double limit : {limits[axis], -limits[axis]}) {
      const double side = limit > 0.0 ? 1.0 : -1.0;
      clip_by_plane(
          polygon, [=](const Vertex& v) { return side * (limit * v.p_clip.w - v.p_clip[axis]); },
          [=](Vertex& v) { v.p_clip[axis] = limit * v.p_clip.w; });
    }
  }
  if (polygon.count < 3) polygon.count = 0;
  return polygon;
}

}  // namespace swell::raster
