// Caustics, as shaders look them up (caustics-inl.h): the frame's maps laid under the sea.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "render/sea/caustic_maps.h"
#include "render/tile/ripples.h"

namespace swell {
struct View;
}

namespace swell::render {

struct MaterialInputs;

// The maps of one wave patch.
struct CausticPatch {
  std::array<const texture::PackedMap1*, CausticMaps::kDepths> map{};
  const texture::PackedMap1* mirrored = nullptr;  // reflected caustics, at a height over the level
  float mirrored_m = 1.0f;
  float texels_fx8_per_m = 1.0f;  // along x, 1/256 texels of level 0
  float y_texels_fx8_per_m = 1.0f;
  float x_eye_fx8 = 0.0f, y_eye_fx8 = 0.0f;  // under the eye
  float log2_texels_per_m = 0.0f;            // along the axis with more of them
};

// Neighbouring pixels look past each other through waves: finer patterns would be noise. How many
// mip levels coarser they are seen, by the log2 of a pixel's footprint [m] from kFirst_m on;
// repeated for wide vectors.
struct RefractionBlur {
  static constexpr int kEntries = 8;
  static constexpr float kFirst_m = -7.0f;
  std::array<float, 2 * kEntries> levels{}, levels_by_next{};
  float by_sine = 1.0f, least = 1.0f;  // as Distortion's
};

struct Caustics {
  std::size_t patches = 0;  // 0: none
  std::array<CausticPatch, CausticMaps::kMostPatches> patch;
  std::array<float, CausticMaps::kDepths> depth_m{};
  float strength = 1.0f;  // of the contrast
  // Over the depth from which on fronts of surf leave the pattern as it is; 0: there are none.
  float per_surf_depth = 0.0f;
  bool throws_up = false;
  glm::vec2 reflected_from{0.0f};  // towards the light, in each metre up
  // How ripples move the lookup.
  float bend_m = 0.0f;  // Cc, 0: not at all
  Ripples ripples;
  RefractionBlur blur;  // of views through the water's surface
};

// camera: of a view through the water's surface.
RefractionBlur make_refraction_blur(const MaterialInputs& in, const View& camera);

Caustics make_caustics(const MaterialInputs& in, glm::dvec2 eye);

}  // namespace swell::render
