// The shadow that clouds throw on sea and land in one frame.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "render/frame/parts.h"

namespace swell::render {

struct Clouds;
struct StageRun;
struct VolumeClouds;
struct WorldState;

// Squares about the eye, each four times as wide as the one before, on lattices that stand still in
// the world: what a place gets does not change as the camera moves.
struct CloudShadow {
  static constexpr int kSide = 128, kLevels = 3, kStride = kSide + 16;
  static constexpr std::array<float, kLevels> kTexels_m = {48.0f, 192.0f, 768.0f};

  bool any = false;
  // The sun that is left at sea level over its mean, 0 to most, as bytes: a word holds a point's
  // and those of its neighbours to the east, the north and the north-east.
  std::array<std::vector<std::uint32_t>, kLevels> words;
  std::array<glm::vec2, kLevels> eye{};  // in texels
  float most = 1.0f, mean = 1.0f;        // mean: further away
  glm::vec2 slant{0.0f};  // how far towards the sun its rays go over the level, a metre up
  // Between these heights clouds come to lie below a point.
  float lit_from_m = 1e9f, lit_all_m = 2e9f;

  // Storage.
  std::array<std::vector<std::uint8_t>, kLevels> bytes;
};

// deck: the layer of clouds as seen from the sea's level under the eye, or none; volume: the same.
void advance_cloud_shadow(const WorldState& world, const Clouds& deck, const VolumeClouds& volume,
                          glm::dvec3 eye, PartSet without, CloudShadow& shadow,
                          const StageRun& run);

// What a row of a level is made from; heights and places relative to the eye at sea level.
struct CloudShadowRow {
  const Clouds* deck = nullptr;          // none: no such clouds
  const VolumeClouds* volume = nullptr;  // none: no such clouds
  glm::vec2 slant{0.0f};
  float deck_lit = 1.0f;  // the deck's mean
  float most = 1.0f;
  glm::vec2 first_m{0.0f};  // of the row
  float texel_m = 1.0f;
};
void write_cloud_shadow_row(const CloudShadowRow& in, std::uint8_t* row);

}  // namespace swell::render
