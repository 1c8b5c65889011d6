// The sky of one frame: what the eye sees from its height, and the blurred sky that waves mirror,
// with the clouds where they have drifted.
#pragma once

#include "render/materials/clouds.h"
#include "render/profile.h"
#include "render/world/world_state.h"

namespace swell::render {

struct SkyFrame {
  // Of the eye's height. What is lit and drawn is a function of that height alone, not of frames
  // before.
  const texture::SmoothImage* map = nullptr;
  float horizon_sine = 0.0f;
  glm::vec3 to_disc{0, 0, 1}, disc_radiance{0.0f};
  float exposure = 1.0f;  // that is still to be applied

  const texture::RgbMap* mirrored = nullptr;

  // Storage.
  texture::SmoothImage between;
  texture::RgbMap soft;
  texture::RgbaImage codes;
};

// The height of the eye that counts, 0 where the eye's height is left out.
double sky_height_m(const View& view, PartSet without);

// Fills `sky` for an eye at height_m >= 0. `mirrored`: the clouds as seen from the sea.
void advance_sky(const World::State& world, const Clouds& mirrored, double height_m,
                 PartSet without, SkyFrame& sky, const StageRun& run);

// Writes row y of `codes`: the clear sky and its clouds as bytes.
void write_soft_sky_row(const SkyMaps& sky, const Clouds& clouds, int y, texture::RgbaImage& codes);

}  // namespace swell::render
