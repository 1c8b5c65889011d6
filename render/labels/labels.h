// What labels do not store, as it follows from the depth.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "math/view.h"
#include "render/labels/label_channels.h"

namespace swell::render {

// The place in the world of pixel (x_px, y_px) at this depth, and its distance from the eye. The
// view is that of the frame. Of the sky as label_table() says.
glm::dvec3 position_of(const View& view, int x_px, int y_px, float depth_m);
double distance_of(const View& view, int x_px, int y_px, float depth_m);

// One of these at all pixels of a view.
template <class Value>
std::vector<Value> from_depth(const View& view, const std::vector<float>& depth_m,
                              Value (*of_depth)(const View&, int, int, float)) {
  std::vector<Value> values;
  values.reserve(depth_m.size());
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    const int at = static_cast<int>(i);
    values.push_back(of_depth(view, at % view.width_px, at / view.width_px, depth_m[i]));
  }
  return values;
}

}  // namespace swell::render
