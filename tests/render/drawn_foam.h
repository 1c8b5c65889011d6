// Foam as pictures have it from above, and as the library answers for it.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "ocean/coast/train_square.h"
#include "ocean/water_surface.h"
#include "render/labelled_frame.h"
#include "scene/water.h"

namespace swell::render {

// Straight down from a height, a picture of as much sea as the eye is high.
inline View from_above(glm::dvec2 middle, double height_m, int size_px) {
  return make_view({middle, height_m}, 0.3, -0.5 * std::numbers::pi, 2.0 * std::atan(0.5), 0.25f,
                   size_px, size_px);
}

inline double mean_of(const std::vector<float>& values) {
  double sum = 0.0;
  for (const float value : values) sum += static_cast<double>(value);
  return sum / static_cast<double>(values.size());
}

// Pictures against the library's answers at the same places, in blocks of 16 x 16 pixels: coarser
// than foam's lace.
struct FoamComparison {
  double drawn = 0.0, asked = 0.0, both = 0.0, drawn2 = 0.0, asked2 = 0.0;
  int blocks = 0;
  void add(double a, double b) {
    drawn += a, asked += b, both += a * b, drawn2 += a * a, asked2 += b * b, ++blocks;
  }
  // Foam elsewhere than asked gives 0.
  double likeness() const { return both / std::sqrt(drawn2 * asked2); }
};

inline FoamComparison compare_foam(const scene::Scene& scene, glm::dvec2 middle, double height_m,
                                   int times) {
  const World world = world_of(scene);
  const scene::Water water(scene);
  Workers workers(2);
  const ocean::Whitecaps whitecaps = ocean::make_whitecaps(water.sea(), water.coast(), workers);
  ocean::SeaFrame sea;
  ocean::WhitecapFrame foam;
  FoamComparison result;
  for (int k = 0; k < times; ++k) {
    const double t_s = 60.0 + 7.7 * k;
    const scene::WaterSurface surface = water.at(t_s, sea, workers);
    ocean::advance_whitecaps(whitecaps, t_s, foam, workers);
    const LabelledFrame frame(world, from_above(middle, height_m, 160), t_s);
    std::vector<glm::dvec2> p;
    frame.for_pixels(1, [&](glm::ivec2 px) { p.emplace_back(frame.position(px)); });
    std::vector<float> white(p.size());
    surface.foam(p, foam, white);
    for (int block = 0; block < 100; ++block) {
      double a = 0.0, b = 0.0;
      for (int i = 0; i < 256; ++i) {
        const int x = block % 10 * 16 + i % 16, y = block / 10 * 16 + i / 16;
        a += static_cast<double>(frame.labels().foam[frame.at({x, y})]) / 256.0;
        b += static_cast<double>(white[static_cast<std::size_t>(y * 160 + x)]) / 256.0;
      }
      result.add(a, b);
    }
  }
  return result;
}

}  // namespace swell::render
