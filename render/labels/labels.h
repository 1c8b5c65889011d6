// The labels of a picture, as render_frame() fills them.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "math/view.h"
#include "render/labels/label_channels.h"

namespace swell::render {

// One value a pixel each, row by row; empty where it was not asked for. Distance and position are
// not stored: they follow from the depth, which is there for them.
struct Labels {
  LabelSet set;
  std::vector<float> depth_m;
  std::vector<glm::vec3> normal, geometric_normal;
  std::vector<std::uint32_t> id, klass;
  std::vector<glm::vec2> motion_px;
  std::vector<float> elevation_m, foam;
  std::vector<std::uint8_t> flags;
};

// The place in the world of pixel (x_px, y_px) at this depth, and its distance from the eye. The
// view is that of the frame. Of the sky as label_table() says.
glm::dvec3 position_of(const View& view, int x_px, int y_px, float depth_m);
double distance_of(const View& view, int x_px, int y_px, float depth_m);

}  // namespace swell::render
