#include "render/exposure.h"

#include <algorithm>
#include <span>
#include <utility>

#include "math/large_array.h"
#include "render/picture/develop.h"
#include "scene/camera.h"

namespace swell::render {

Exposure exposure_of(const scene::Camera& camera, const FrameOptions& options) {
  if (options.wireframe || camera.exposure_s == 0.0) return {};
  return {camera.shutter_samples, camera.exposure_s / camera.shutter_samples};
}

FrameRequest moment_request(const FrameRequest& frame, int k, Target& moment) {
  FrameRequest request = frame;
  const std::span<const View> views = frame.options.exposed_views;
  if (!views.empty()) request.view = views[static_cast<std::size_t>(k)];
  request.options.keep_linear = true;
  if (k > 0) request.options.labels = {};
  request.target = &moment;
  return request;
}

void add_moment(int k, Target& moment, Target& frame) {
  if (k == 0) {
    frame.width_px = moment.width_px;
    frame.height_px = moment.height_px;
    std::swap(frame.labels, moment.labels);
    std::swap(frame.linear, moment.linear);
    return;
  }
  for (std::size_t i = 0; i < frame.linear.size(); ++i) frame.linear[i] += moment.linear[i];
}

void finish_exposure(int moments, float exposure, bool keep_linear, Target& frame,
                     Workers& workers) {
  const auto width = static_cast<std::size_t>(frame.width_px);
  const auto height = static_cast<std::size_t>(frame.height_px);
  resize_large(frame.rgba, width * height);
  workers.for_each(height, [&](std::size_t y, int) {
    develop_row(std::span(frame.linear).subspan(3 * width * y, 3 * width), moments, exposure,
                static_cast<int>(y), std::span(frame.rgba).subspan(width * y, width));
  });
  if (!keep_linear) frame.linear.clear();
}

}  // namespace swell::render
