// Figures that explain a scene's waves: the spectrum as a filter, the sea as a map, a section
// through sea and floor. The same bytes everywhere: no function of the C library's mathematics.
#pragma once

#include <glm/glm.hpp>
#include <string>

#include "ocean/spectrum/spectrum.h"
#include "scene/water.h"
#include "texture/image/image.h"

namespace swell::apps {

// What the spectrum multiplies white noise with, sqrt(S(k)), from black (0) to white (the most), on
// the square |k_x|, |k_y| <= 3 k_m, north up: a point is the wave that travels from the middle
// towards it. Rings at k_m, the wave number of the peak frequency, and 2 k_m. A wind of more than
// 0, size_px of at least 2.
texture::Image8 draw_filter(const ocean::WaveSystem& wind, int size_px);

struct MapView {
  glm::dvec2 centre_m{0.0};
  double side_m = 1000.0;         // > 0
  int size_px = 480;              // >= 2
  glm::dvec2 to_light{0.0, 1.0};  // unit vector; the waves show best lit along their travel
};

// The surface from straight above, north up: crests and lit slopes white, troughs and shadows black
// (all of the scale belongs to the map: a ripple looks like a storm), greener where it is shallow,
// with lines at depths of 1, 2, 4, 8, ... m; land is sand.
texture::Image8 draw_map(const scene::WaterSurface& surface, const terrain::HeightGrid* terrain,
                         const MapView& view);

// An SVG picture of surface and floor along the straight line between two different points, heights
// exaggerated as it says; `title` (any text) goes before that.
std::string draw_section(const scene::WaterSurface& surface, const terrain::HeightGrid* terrain,
                         glm::dvec2 from_m, glm::dvec2 to_m, const std::string& title);

}  // namespace swell::apps
