// Heights of many points at once.
#pragma once

#include <span>

#include "terrain/height_grid.h"

namespace swell::terrain {

// height_at() of many points, of a grid of two samples a side or more. p_world and height_m have
// the same length.
void sample_doubles(const HeightGrid& heights, std::span<const glm::dvec2> p_world,
                    std::span<double> height_m);

}  // namespace swell::terrain
