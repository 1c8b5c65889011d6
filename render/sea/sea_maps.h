// Stage 1: the sea at one time, and the maps that shading looks into.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "ocean/open_sea/sea.h"
#include "ocean/open_sea/whitecaps.h"
#include "render/frame/parts.h"
#include "render/frame/profile.h"
#include "render/sea/caustic_maps.h"
#include "render/sea/foam_blocks.h"
#include "render/sea/ripple_sequence.h"
#include "texture/packed_map.h"
#include "texture/uv_noise.h"

namespace swell::ocean {
class WaterSurface;
}

namespace swell::render {

struct WorldState;

struct SeaMaps {
  ocean::SeaFrame frame;
  std::vector<texture::PackedMap2> patch_slopes;  // one a patch, longest first
  ocean::WhitecapFrame whitecaps;
  std::vector<texture::PackedMap1> foam;         // one a patch of whitecaps, as 2 foam - 1
  std::vector<FoamBlocks> foam_blocks;           // the same
  texture::PackedMap2 uv_noise;                  // bends the coordinates of ripples
  texture::PackedMap2 coast_slopes, coast_surf;  // slopes of the trains; ceded, foam
  // The trains' whitecaps, and what these leave of short waves', both twice less 1.
  texture::PackedMap2 coast_whitecaps;
  RippleMaps ripples;                            // of a sequence
  CausticMaps caustics;                          // the sun under water
  std::vector<texture::PackedMap2> wake_slopes;  // one a window of wakes
  std::vector<texture::PackedMap1> wake_foam;    // the same, as 2 foam - 1
  // Storage.
  texture::UvNoise noise{{}};
  std::vector<float> noise_cos, noise_sin;
  std::vector<float> coast_slope_x, coast_slope_y, coast_foam;
  std::vector<float> train_foam, short_part;
  std::vector<std::vector<float>> foam_values;  // one a patch
  std::vector<std::vector<float>> wake_values;  // one a window
};

// Fills `frame` with the world's waves at t_s and those of what disturbs the water besides, as
// pictures without these parts have them.
void advance_waves(const WorldState& world, double t_s, std::span<const ocean::Disturbance> more,
                   PartSet without, ocean::SeaFrame& frame, Workers& workers);

// Fills `sea` with the world's sea at time t_s, as far as pictures without these parts need it.
void advance_sea(const WorldState& world, double t_s, std::span<const ocean::Disturbance> more,
                 PartSet without, SeaMaps& sea, const StageRun& run);

// Where foam of a patch is, at any time between its steps.
FoamBlocks find_foam_blocks(const ocean::WhitecapFrame::Patch& patch);

// The water's surface at the time of `sea`, of the same world.
ocean::WaterSurface water_surface(const WorldState& world, const SeaMaps& sea);

}  // namespace swell::render
