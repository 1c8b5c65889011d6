// The sky of one frame: what the eye sees from its height, and the blurred sky that waves mirror,
// with the clouds where they have drifted.
#pragma once

#include "math/view.h"
#include "render/frame/parts.h"
#include "render/frame/profile.h"
#include "render/sky/cloud_shadow.h"
#include "render/sky/cloud_sky.h"
#include "render/sky/clouds.h"
#include "render/sky/fog.h"
#include "render/sky/sky_maps.h"

namespace swell::render {

struct WorldState;

struct SkyFrame {
  // The sky from the eye's height. What is lit and drawn is a function of that height alone, not of
  // frames before.
  const texture::SmoothImage* map = nullptr;
  float horizon_sine = 0.0f;
  glm::vec3 to_disc{0, 0, 1}, disc_radiance{0.0f};
  float exposure = 1.0f;  // that is still to be applied

  const texture::RgbMap* mirrored = nullptr;        // through fog
  const texture::RgbMap* mirrored_clear = nullptr;  // without it
  Clouds layer;                                     // a layer's, as seen from the sea
  CloudSky clouds;                                  // volumetric ones, in what waves mirror
  CloudShadow shadow;                               // of all clouds

  // Storage.
  texture::SmoothImage between;
  texture::RgbMap soft, soft_clear;
  texture::RgbaImage codes, codes_clear;
};

// The height of the eye that counts, 0 where the eye's height is left out.
double sky_height_m(const View& view, PartSet without);

// Fills `sky` for an eye at height_m >= 0. `mirrored`: the clouds as seen from the sea; sky.clouds:
// the volumetric ones.
void advance_sky(const WorldState& world, const Clouds& mirrored, const Fog& fog, double height_m,
                 PartSet without, SkyFrame& sky, const StageRun& run);

// Fills sky.clouds and sky.shadow: what the volumetric clouds and those of a layer (`mirrored`) do
// to the mirror and to the sun on the sea, at t_s, under an eye.
void advance_clouds(const WorldState& world, const Clouds& mirrored, double t_s, glm::dvec2 eye,
                    PartSet without, SkyFrame& sky, const StageRun& run);

// Writes row y of `clear`: the sky, the clouds of a layer and volumetric ones, if there are any, as
// bytes; and where there is fog, of `foggy` as well: the same through fog.
void write_soft_sky_row(const SkyMaps& sky, const Clouds& clouds, const CloudSky& volume,
                        const Fog& fog, int y, texture::RgbaImage& clear,
                        texture::RgbaImage& foggy);

}  // namespace swell::render
