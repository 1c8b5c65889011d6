#include "render/exposure.h"

#include <algorithm>
#include <span>
#include <utility>

#include "math/large_array.h"
#include "render/picture/develop.h"
#include "render/picture/sensor_noise.h"
#include "scene/camera.h"

namespace swell::render {

Exposure exposure_of(const scene::Camera& camera, const FrameOptions& options) {
  if (options.wireframe || camera.exposure_s == 0.0) return {};
  return {camera.shutter_samples, camera.exposure_s / camera.shutter_samples};
}

scene::SensorNoise noise_of(const scene::Camera& camera, const FrameOptions& options) {
  if (options.wireframe) return {};
  return options.noise.value_or(camera.noise);
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
    frame.exposure = moment.exposure;
    return;
  }
  for (std::size_t i = 0; i < frame.linear.size(); ++i) frame.linear[i] += moment.linear[i];
}

void finish_exposure(int moments, const scene::SensorNoise& noise, double t_s, bool keep_linear,
                     Target& frame, Workers& workers) {
  const auto width = static_cast<std::size_t>(frame.width_px);
  const auto height = static_cast<std::size_t>(frame.height_px);
  resize_large(frame.rgba, width * height);
  workers.for_each(height, [&](std::size_t y, int) {
    const std::span<float> light = std::span(frame.linear).subspan(3 * width * y, 3 * width);
    int summed = moments;
    if (noise.full_well_e > 0.0) {
      for (float& sum : light) sum /= static_cast<float>(moments);
      summed = 1;
      add_sensor_noise(noise, t_s, frame.exposure, width * y, light);
    }
    develop_row(light, summed, frame.exposure, static_cast<int>(y),
                std::span(frame.rgba).subspan(width * y, width));
  });
  if (!keep_linear) frame.linear.clear();
}

}  // namespace swell::render
