// What stands before the sun, and what floats near by, as the shaders of a view look for it
// (sun_shadow-inl.h).
#pragma once

#include <glm/glm.hpp>

#include "raster/pass.h"
#include "render/packets/square_map.h"
#include "render/view/shadow_casters.h"

namespace swell::render {

struct CloudShadow;
struct LandShadow;
struct MaterialInputs;
struct RenderView;

struct SunShadow {
  // The land's: texel `along` of a point p relative to the eye is (p.x, p.y, 1) . along.
  const LandShadow* land = nullptr;  // none: shades nothing
  glm::vec3 along{0.0f}, across{0.0f};
  // How far sideways light comes in that falls on a point under water: towards the sun, by depth.
  glm::vec2 entry{0.0f};
  // That of clouds; none: shades nothing.
  const CloudShadow* clouds = nullptr;
  // The part of the sun's light that trees leave to the ground and the water under them; and how
  // far their shadow slides away from the sun on what stands higher, by metre.
  SquareMap under_trees;
  glm::vec2 tree_slide{0.0f};
  glm::vec2 sea_shade_low{0.0f}, sea_shade_high{0.0f};  // from the eye: what holds all on the sea
  // The objects'.
  const ObjectShadows* objects = nullptr;
  TileCasters casters;
};

void fill_sun_shadow(const MaterialInputs& in, const RenderView& view, const raster::TileGrid& grid,
                     SunShadow& shadow);

}  // namespace swell::render
