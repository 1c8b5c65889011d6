// Linear pictures of one world, one after the other, for tests.
#pragma once

#include <glm/glm.hpp>

#include "render/frame.h"
#include "scene/scene.h"

namespace swell::render {

struct LinearRenderer {
  explicit LinearRenderer(const scene::Scene& scene) : world(scene, 2) {
    options.keep_linear = true;
  }

  void draw_view(const View& seen, double t_s) {
    view = seen;
    render_frame(world, view, t_s, options, workspace, target, workers);
  }
  glm::vec3 at(int x, int y) const {
    const float* p = target.linear.data() + 3 * (y * view.width_px + x);
    return {p[0], p[1], p[2]};
  }
  // Of the middle of a pixel's ray, of length 1.
  glm::vec3 direction(int x, int y) const {
    return glm::normalize(view.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
  }

  World world;
  Workers workers{2};
  FrameOptions options;
  Workspace workspace;
  Target target;
  View view;
};

}  // namespace swell::render
