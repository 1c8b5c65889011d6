// The layers of a shore and its fronts of surf, as figures.
#pragma once

#include <string>

#include "scene/water.h"
#include "texture/image/image.h"
#include "tools/figures/wave_figures.h"

namespace swell::apps {

// The layers from the shore outwards, from straight above, north up: banks, lit by their normals;
// sand that swash wets; surf with four fronts, a colour each; the floor as far down as caustics
// keep their contrast; deep water. `water` has fronts that lift it.
texture::Image8 draw_shore_layers(const scene::Water& water, double t_s, const MapView& view);

// The front function far out, where it breaks and near the shore, as SVG.
std::string plot_front_function();

}  // namespace swell::apps
