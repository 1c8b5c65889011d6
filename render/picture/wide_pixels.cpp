#include "render/picture/wide_pixels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "math/projection.h"

namespace swell::render {
namespace {

// A tent's weights of whole pixels along one axis.
struct Tent {
  Tent(float centre_px, float reach_px) {
    const float middle = centre_px - 0.5f;  // in units of pixels' centres
    first = static_cast<int>(std::floor(middle - reach_px)) + 1;
    const int last = static_cast<int>(std::ceil(middle + reach_px)) - 1;
    for (int i = first; i <= last && count < static_cast<int>(weights.size()); ++i) {
      const float weight = 1.0f - std::abs(static_cast<float>(i) - middle) / reach_px;
      weights[static_cast<std::size_t>(count++)] = weight;
      sum += weight;
    }
  }

  int first = 0, count = 0;
  float sum = 0.0f;
  std::array<float, 10> weights{};
};

glm::vec3 light_at(const WidePixel& pixel, const Target& face) {
  const Tent across(pixel.x_px, pixel.reach_x_px), down(pixel.y_px, pixel.reach_y_px);
  glm::vec3 light(0.0f);
  for (int j = 0; j < down.count; ++j) {
    const float* from = face.linear.data() + 3 * (static_cast<std::size_t>(down.first + j) *
                                                      static_cast<std::size_t>(face.width_px) +
                                                  static_cast<std::size_t>(across.first));
    glm::vec3 row(0.0f);
    for (int i = 0; i < across.count; ++i, from += 3)
      row += across.weights[static_cast<std::size_t>(i)] * glm::vec3(from[0], from[1], from[2]);
    light += down.weights[static_cast<std::size_t>(j)] * row;
  }
  return light / (across.sum * down.sum);
}

template <class Value>
void copy_value(const std::vector<Value>& from, std::size_t i, std::vector<Value>& to,
                std::size_t at) {
  if (!to.empty()) to[at] = from[i];
}

// Where a ray of a face's picture, through the place (x_px, y_px), goes in the wide one's optical
// frame.
glm::dvec3 ray_of(const WideFace& face, double x_px, double y_px) {
  return face.wide_from_face *
         glm::dvec3((x_px - face.k.cx) / face.k.fx, (y_px - face.k.cy) / face.k.fy, 1.0);
}

// The motion of what a face has moved from its pixel (x, y) by `moved_px`. The next picture's faces
// lie about its own axes, so that rays are compared in its frame.
glm::vec2 wide_motion(const WidePlan& plan, const WideFace& face, int x, int y,
                      glm::vec2 moved_px) {
  const double x_px = x + 0.5, y_px = y + 0.5;
  const auto now = place_of(plan.projection, plan.size_px, ray_of(face, x_px, y_px));
  const auto then = place_of(
      plan.projection, plan.size_px,
      ray_of(face, x_px + static_cast<double>(moved_px.x), y_px + static_cast<double>(moved_px.y)));
  if (!now || !then) return glm::vec2(0.0f);
  glm::dvec2 motion = *then - *now;
  if (plan.projection.kind == ProjectionKind::kEquirectangular)
    motion.x = std::remainder(motion.x, static_cast<double>(plan.size_px.x));  // exact
  return glm::vec2(motion);
}

void fill_nothing(std::size_t at, Labels& labels) {
  const auto fill = [at](auto& values, auto value) {
    if (!values.empty()) values[at] = value;
  };
  fill(labels.depth_m, std::numeric_limits<float>::infinity());
  fill(labels.normal, glm::vec3(0.0f));
  fill(labels.geometric_normal, glm::vec3(0.0f));
  fill(labels.id, kSkyId);
  fill(labels.klass, kSkyClass);
  fill(labels.motion_px, glm::vec2(0.0f));
  fill(labels.elevation_m, 0.0f);
  fill(labels.foam, 0.0f);
  fill(labels.flags, std::uint8_t{0});
}

}  // namespace

void gather_light(const WidePlan& plan, std::span<const Target> faces, std::size_t row,
                  std::span<float> light) {
  const auto width = static_cast<std::size_t>(plan.size_px.x);
  for (std::size_t x = 0; x < width; ++x) {
    const WidePixel& pixel = plan.pixels[row * width + x];
    const glm::vec3 seen =
        pixel.face == kNoFace ? glm::vec3(0.0f) : light_at(pixel, faces[pixel.face]);
    for (int c = 0; c < 3; ++c) light[3 * x + static_cast<std::size_t>(c)] = seen[c];
  }
}

void gather_labels(const WidePlan& plan, std::span<const Target> faces, std::size_t row,
                   Labels& labels) {
  const auto width = static_cast<std::size_t>(plan.size_px.x);
  for (std::size_t at = row * width; at < (row + 1) * width; ++at) {
    const WidePixel& pixel = plan.pixels[at];
    if (pixel.face == kNoFace) {
      fill_nothing(at, labels);
      continue;
    }
    const WideFace& face = plan.faces[pixel.face];
    const Labels& from = faces[pixel.face].labels;
    const auto x = static_cast<int>(pixel.x_px), y = static_cast<int>(pixel.y_px);
    const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(face.width_px) +
                          static_cast<std::size_t>(x);
    if (!labels.depth_m.empty())
      labels.depth_m[at] = static_cast<float>(static_cast<double>(from.depth_m[i]) *
                                              glm::length(ray_of(face, x + 0.5, y + 0.5)));
    copy_value(from.normal, i, labels.normal, at);
    copy_value(from.geometric_normal, i, labels.geometric_normal, at);
    copy_value(from.id, i, labels.id, at);
    copy_value(from.klass, i, labels.klass, at);
    if (!labels.motion_px.empty())
      labels.motion_px[at] = wide_motion(plan, face, x, y, from.motion_px[i]);
    copy_value(from.elevation_m, i, labels.elevation_m, at);
    copy_value(from.foam, i, labels.foam, at);
    copy_value(from.flags, i, labels.flags, at);
  }
}

}  // namespace swell::render
