// Simple drawings as SVG.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

namespace swell::apps {

struct Curve {
  std::string label;
  std::vector<glm::dvec2> points;
  bool dashed = false;
};

// Curves over axes that hold all of them, with their labels.
std::string plot_svg(const std::string& x_label, const std::string& y_label,
                     std::span<const Curve> curves);

// Lines between points and words at places of a sheet of 100 x 60, y upwards.
struct Sketch {
  struct Line {
    glm::dvec2 from, to;
    bool dashed = false;
  };
  struct Words {
    glm::dvec2 at;
    std::string text;
  };
  std::vector<Line> lines;
  std::vector<Words> words;
};
std::string sketch_svg(const Sketch& sketch);

}  // namespace swell::apps
