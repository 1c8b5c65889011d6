// The blurred sky at one time: what waves mirror, with the clouds where they have drifted.
#pragma once

#include "render/materials/clouds.h"
#include "render/profile.h"
#include "render/world/world_state.h"

namespace swell::render {

struct SkyFrame {
  texture::RgbMap soft;
  texture::RgbaImage codes;  // storage
};

// Fills `sky` for a world with clouds; without them there is nothing to do.
void advance_sky(const World::State& world, const Clouds& clouds, SkyFrame& sky,
                 const StageRun& run);

// Writes row y of `codes`: the clear sky and its clouds as bytes.
void write_soft_sky_row(const SkyMaps& sky, const Clouds& clouds, int y, texture::RgbaImage& codes);

}  // namespace swell::render
