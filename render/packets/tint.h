// Colours that tint a surface, as parts of their mean: what is too far for their texels has it.
#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "render/packets/slope_layer.h"
#include "texture/packed_map.h"

namespace swell::render {

// Values less 1. Of grey ones, blue is empty: red stands for all.
struct TintMaps {
  texture::PackedMap2 red_green, blue;
};

// Fills the maps with one channel or three, size * size values each, in [-1, 1].
void pack_tint(int size, std::span<const std::vector<float>> channels, TintMaps& maps);

// As shaders sample them.
struct TintLayer {
  SlopeLayer red_green, blue;
  bool on() const { return red_green.map != nullptr; }
};

// Lays them over the plane with period length_m > 0.
TintLayer make_tint(const TintMaps& maps, double length_m, glm::dvec2 eye);

}  // namespace swell::render
