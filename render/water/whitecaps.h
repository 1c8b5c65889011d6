// Whitecaps of the open sea: where its foam lies (ocean/open_sea/whitecaps.h) and how it tears.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "ocean/spectrum/limits.h"
#include "render/packets/slope_layer.h"
#include "render/tile/inputs.h"

namespace swell::render {

struct FoamBlocks;

// Thresholds in [-1, 1] laid along the wind and stretched by it.
struct FoamLace {
  const texture::PackedMap2* map = nullptr;
  glm::vec2 x_fx8_per_m{0.0f}, y_fx8_per_m{0.0f};  // 1/256 texels of level 0: across, along
  float x_eye_fx8 = 0.0f, y_eye_fx8 = 0.0f;        // under the eye
  float log2_texels_per_m = 0.0f;                  // across
};

// The foam of one patch's waves.
struct FoamMap {
  const texture::PackedMap1* map = nullptr;  // 2 foam - 1
  float texels_fx8_per_m = 1.0f;             // 1/256 texels of level 0
  float x_eye_fx8 = 0.0f, y_eye_fx8 = 0.0f;  // under the eye
  float log2_texels_per_m = 0.0f;
  float mean = 0.0f;                   // over the sea
  const FoamBlocks* blocks = nullptr;  // where there is any, if that is worth looking
  // Tiles are moved by whole samples of the waves' patch, which are so large in this map.
  int fx8_per_sample = 256;
};

struct Whitecaps {
  int count = 0;  // of maps of foam; 0: none
  std::array<FoamMap, ocean::kMostFoamPatches> foam;
  float crest_per_m = 0.0f;  // ocean::foam_on_crest()
  float least = 0.0f;        // less foam is not drawn: less than far water shows
  FoamLace eddies, tears, lace;
};

Whitecaps make_whitecaps(const MaterialInputs& in, glm::dvec2 eye);

}  // namespace swell::render
