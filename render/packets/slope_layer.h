// A map laid over the sea or the land, as shaders sample it.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "ocean/open_sea/patch_tiles.h"
#include "texture/packed_map.h"

namespace swell::render {

// Slope variance of glass, which spreads the sun's disc to about twice its width, and no image.
inline constexpr float kGlassVariance = 2e-5f;

// A map of two channels, slopes as a rule, that repeats or lies over one square.
struct SlopeLayer {
  const texture::PackedMap2* map = nullptr;
  float texels_fx8_per_m = 1.0f;  // along x, 1/256 texels of level 0
  float y_texels_fx8_per_m = 1.0f;
  float x_eye_fx8 = 0.0f, y_eye_fx8 = 0.0f;  // map position under the eye; in the map if it repeats
  float log2_texels_per_m = 0.0f;            // along the axis with more of them
  float gain = 1.0f;                         // multiplies the slopes
  float uv_noise_m = 0.0f;                   // how far the coordinates are perturbed
  float coarsest = 0.0f;  // the level from which on nothing is left, a little less
  // Whether and how tiles cover the sea with it (not one square), and the eye's period, modulo
  // 2^16.
  ocean::PatchTiling tiling;
  int eye_column = 0, eye_row = 0;
  // Slope variance that each mip level has lost, after gain, and how much more the next one has;
  // repeated for wide vectors.
  static constexpr int kTableLevels = 8;
  std::array<float, 2 * kTableLevels> lost_variance{}, lost_by_next{};
};

// Slope variance, both axes together, that the layer has lost at footprints of 2^level_m metres.
float lost_variance(const SlopeLayer& layer, float level_m);

// x without its whole part, in [0, 1].
float fraction(double x);

// Lays `map` over the plane with period length_m > 0; `moved_m` is how far it has drifted.
SlopeLayer make_layer(const texture::PackedMap2& map, double length_m, float gain, glm::dvec2 eye,
                      glm::dvec2 moved_m);

// Lays a patch's map over the sea by the patch's tiles; length_m: along x and y.
SlopeLayer make_patch_layer(const texture::PackedMap2& map, glm::dvec2 length_m,
                            const ocean::PatchTiling& tiling, glm::dvec2 eye);

// A layer over one square that does not repeat: the eye's place in it, from_corner [m], is not
// wrapped.
SlopeLayer make_square_layer(const texture::PackedMap2& map, double size_m, glm::dvec2 from_corner);

// ---- Colours that tint a surface, as parts of their mean: what is too far for their texels has it

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
