// Where the land stands before the sun. The sun does not move within a scene, so that this is
// worked out once, for all heights: a point sees all of the sun's disc above one height and nothing
// of it below another.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <tuple>
#include <vector>

#include "math/parallel.h"
#include "terrain/height_grid.h"
#include "texture/packed_map.h"

namespace swell::render {

// Half the sun's disc, as an angle [rad].
inline constexpr double kSunRadius_rad = 0.00465;

// A height above which a point sees all of the sun, and one below which it sees nothing of it [m].
struct ShadowBounds {
  float dark_below_m, lit_above_m;
};

// Bounds at the points of a grid whose rows run away from the sun: point (along, across) lies at
// corner_world + texel_m (along away + across left), left being to the left of away. Outside the
// box nothing is shaded, nor below kLowest_m.
struct LandShadow {
  static constexpr float kLowest_m = -20.0f;
  static constexpr int kBlock_log2 = 4;  // of texels a side

  glm::dvec2 away{0.0, 1.0};  // from the sun, unit
  glm::dvec2 corner_world{0.0};
  double texel_m = 1.0;
  int texels_along = 0, texels_across = 0;
  // Where the land's shadow may be seen: texels [begin, end), none if it has none.
  glm::ivec2 begin{0}, end{0};

  // dark_below_m in the low 16 bits, lit_above_m in the high ones: kLowest_m + step_m * code.
  std::vector<std::uint32_t> bounds;
  float step_m = 1.0f;
  // By blocks of texels and the points that are bilinear between them: the highest lit_above_m.
  std::vector<float> block_lit_above_m;
  int blocks_along = 0;

  // Sun on the ground itself, over the terrain's square: a is -1 in the shade and 1 in full sun.
  // The sea floor gets it through the water, from where its light enters. No size: it is lit
  // everywhere.
  texture::PackedMap2 ground;

  auto fields() {
    return std::tie(away, corner_world, texel_m, texels_along, texels_across, begin, end, bounds,
                    step_m, block_lit_above_m, blocks_along, ground);
  }

  bool is_empty() const { return begin == end; }
  glm::dvec2 left() const { return {-away.y, away.x}; }
};

// The part of the sun's disc above a straight edge: `lit` is the part of its diameter above it, in
// [0, 1]. Error 0.01 of the disc. In shaders DiscPart() (render/tile/sun_shadow-inl.h).
inline float disc_part(float lit) {
  const float x = 2.0f * lit - 1.0f;
  return 0.5f + x * (0.637f - 0.137f * x * x);
}

// How far sideways, towards the sun, light has come in that falls on a point under flat water: by
// metre of depth. Snell's law.
glm::dvec2 underwater_slant(glm::dvec3 sun_direction, double water_index);

// The shadow of the land under a sun in a direction (unit, z > 0). None where the sun is below the
// horizon. The same bits with any workers; 20 ms for 512 x 512 samples on two threads. Light is
// taken to be refracted by water of index `water_index`.
std::optional<LandShadow> cast_land_shadow(const terrain::HeightGrid& land,
                                           glm::dvec3 sun_direction, double water_index,
                                           Workers& workers);

// What the map says of a point, bilinear; nothing shaded outside.
ShadowBounds shadow_bounds_at(const LandShadow& shadow, glm::dvec2 p_world);

// The part of the sun that a point at height z_m sees, in [0, 1].
double sun_visible_at(const LandShadow& shadow, glm::dvec2 p_world, double z_m);

}  // namespace swell::render
