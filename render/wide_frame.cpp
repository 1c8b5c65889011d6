#include "render/wide_frame.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "math/elementary.h"
#include "math/large_array.h"
#include "render/exposure.h"
#include "render/picture/label_tile.h"
#include "render/picture/wide_pixels.h"

namespace swell::render {
namespace {

// Triangles for a face, of those for a common picture: twice as dense, and no fewer.
// Sparser ones would show at seams, as a face whose ground is near has smaller ones than the next,
// and water bends the floor from corner to corner.
int face_triangles(int triangles, const WideFace& face) {
  constexpr double kDenser = 2.0;
  const double tan_half_y = tan(radians(25.0)), tan_half_x = tan_half_y * 16.0 / 9.0;
  const double seen = face.width_px / face.k.fx * (face.height_px / face.k.fy);
  const double times = std::max(kDenser * seen / (4.0 * tan_half_x * tan_half_y), 1.0);
  return std::min(static_cast<int>(std::lround(triangles * times)), kMostTriangles);
}

FrameOptions face_options(const FrameOptions& wide, const scene::Scene& scene,
                          const WideFace& face) {
  FrameOptions options = wide;
  options.is_face = !wide.keep_linear;
  options.keep_linear = true;
  options = with_scene_defaults(options, scene);
  options.terrain_triangles = face_triangles(options.terrain_triangles, face);
  options.noise = scene::SensorNoise{};
  options.lod_operations = 0;
  options.lod_ms = 0.0;
  options.exposed_views = {};
  if (wide.next_view) options.next_view = face_view(*wide.next_view, face);
  return options;
}

}  // namespace

std::vector<FrameRequest> face_requests(const scene::Scene& scene, const FrameRequest& request,
                                        WideFrame& wide, Workers& workers) {
  const View& view = request.view;
  const glm::ivec2 size_px(view.width_px, view.height_px);
  if (wide.plan.projection != view.projection || wide.plan.size_px != size_px)
    wide.plan = plan_wide(view.projection, size_px, workers);
  const std::size_t count = wide.plan.faces.size();
  wide.faces.resize(count);
  wide.exposed.resize(count);
  std::vector<FrameRequest> requests;
  for (std::size_t n = 0; n < count; ++n) {
    const WideFace& face = wide.plan.faces[n];
    FrameOptions options = face_options(request.options, scene, face);
    wide.exposed[n].clear();
    for (const View& exposed : request.options.exposed_views)
      wide.exposed[n].push_back(face_view(exposed, face));
    options.exposed_views = wide.exposed[n];
    requests.push_back({face_view(view, face), options, &wide.faces[n]});
  }
  return requests;
}

void finish_wide(const FrameRequest& request, const WideFrame& wide,
                 const scene::SensorNoise& noise, double t_s, Workers& workers) {
  const View& view = request.view;
  Target& target = *request.target;
  const auto width = static_cast<std::size_t>(view.width_px);
  const auto height = static_cast<std::size_t>(view.height_px);
  target.width_px = view.width_px;
  target.height_px = view.height_px;
  target.exposure = wide.faces.empty() ? 1.0f : wide.faces.front().exposure;
  resize_large(target.linear, 3 * width * height);
  resize_labels(request.options.labels, {view.width_px, view.height_px}, target.labels);
  workers.for_each(height, [&](std::size_t row, int) {
    gather_light(wide.plan, wide.faces, row,
                 std::span(target.linear).subspan(3 * width * row, 3 * width));
    gather_labels(wide.plan, wide.faces, row, target.labels);
  });
  finish_exposure(1, noise, t_s, request.options.keep_linear, target, workers);
}

}  // namespace swell::render
