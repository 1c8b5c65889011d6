// Caustics: how the waves gather the light of the sun, under water and, reflected, above it. Rays
// go down from the points of a wave patch, each bent by the slope there, and light the points of
// the same grid at a depth: a periodic map of intensity over that under flat water, whose mean
// is 1.
//
// A place is not where a ray ends but where it would have entered flat water, so that a shader
// looks up a point by the slant of the sun's light alone. Without heights and with a sun straight
// above, a ray comes from x to x + d (1 - 1/n) grad h, the textbook's map of small slopes.
// Light that the surface mirrors goes up to x - 2 d grad h: eight times as fast apart, and gathered
// above the troughs.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "render/frame/parts.h"
#include "texture/packed_map.h"

namespace swell::ocean {
struct PatchFrame;
struct SeaFrame;
}  // namespace swell::ocean

namespace swell::render {

struct StageRun;
struct WorldState;

// Where rays go that meet flat water at the points of a periodic grid: point (i, j)'s crosses the
// depth d [m] at texel (i, j) + from_height + d per_depth.
struct CausticRays {
  int size = 0;              // points a side, a power of two in [16, kMostCausticSize]
  glm::dvec2 length_m{0.0};  // along x and y
  std::vector<float> from_height_x, from_height_y, per_depth_x, per_depth_y;  // [texels (/m)]
  std::vector<float> slope_x, slope_y, height_m, filtered,
      row;  // of a finer patch, on fewer points
};

inline constexpr int kMostCausticSize = 128;

// Bends the light of a sun or moon in the direction to_light (unit, z > 0) by the waves of a patch
// as if its heights repeated, into water of refraction index n. Of finer patches every second point
// is taken, or every fourth, after a tent filter. Waves shade nothing: a light lower than
// asin(1/5) moves by their heights as one that high.
void trace_rays(const ocean::PatchFrame& patch, glm::vec3 to_light, float n, CausticRays& rays);

// Traces the light that the waves mirror, as trace_rays() does, but to heights in place of depths.
// A light lower than asin(1/10) goes as far sideways as one that high.
void trace_mirrored_rays(const ocean::PatchFrame& patch, glm::vec3 to_light, CausticRays& rays);

// How far a light's rays go sideways, away from it, in each metre up from flat water.
glm::vec2 mirrored_slant(glm::vec3 to_light);

struct CausticScratch {
  std::vector<std::uint32_t> quads;  // a texel: what the corners of its square get, in 1/2^16
  std::vector<float> intensity, softened, row;
};

// The light at a depth [m], in units of that under flat water: size x size values in scratch, that
// of (i, j) at texel (i - 1/2, j - 1/2). Their mean is 1 but for rounding: each ray's 2^16 parts
// are counted once, as integers. Softened by a texel, which hides that rays are few, and by what
// spreads each ray: the standard deviation along an axis [m per m of depth], to at most 3 texels.
std::span<const float> gather_rays(const CausticRays& rays, float depth_m, float spread_per_m,
                                   CausticScratch& scratch);

// The maps of a frame.
struct CausticMaps {
  static constexpr std::size_t kDepths = 3, kMostPatches = 2;
  // Deeper than this the light is taken to lose its pattern as it does in clear water below the
  // focus of all but the longest waves.
  static constexpr double kDeepest_m = 9.0;
  static constexpr float kRange = 5.0f;  // intensities [0, kRange] are coded as [-1, 1]

  std::array<float, kDepths> depth_m{};  // rising
  std::size_t patches = 0;               // 0: no floor or no sun to show
  std::array<glm::dvec2, kMostPatches> length_m{};
  float spread_per_m = 0.0f;  // of rays: by the light's disc, and by waves too short for patches
  std::array<texture::PackedMap1, kDepths * kMostPatches> map;  // patch by patch, by depth
  // Reflected, a map a patch at a height of its own; none where nothing stands in the water.
  bool throws_up = false;
  std::array<float, kMostPatches> height_m{};
  float mirrored_spread_per_m = 0.0f;
  std::array<texture::PackedMap1, kMostPatches> mirrored;
  // Storage.
  std::array<CausticRays, kMostPatches> rays, mirrored_rays;
  std::array<CausticScratch, (kDepths + 1) * kMostPatches> scratch;
};

// Begins the maps of a frame of the world's sea: of its shortest two patches, but for one whose
// tiles differ, at depths between its floor's and none. Returns how many maps there are to make.
std::size_t trace_caustics(const WorldState& world, const ocean::SeaFrame& sea, PartSet without,
                           CausticMaps& maps, const StageRun& run);

// Makes one of them. May run for several at once.
void make_caustic_map(CausticMaps& maps, std::size_t number);

}  // namespace swell::render
