// Implicit surfaces in one frame, as rays meet them (scene/implicit_surface.h says what an implicit
// surface is).
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace swell::scene {
struct ImplicitSurface;
}
namespace swell::terrain {
struct HeightPyramid;
}

namespace swell::render {

// p^T A p + 2 b . p + c.
struct RayQuadric {
  float xx, yy, zz, xy, xz, yz;
  glm::vec3 b;
  float c;

  glm::vec3 times(glm::vec3 p) const {  // A p
    return {xx * p.x + xy * p.y + xz * p.z, xy * p.x + yy * p.y + yz * p.z,
            xz * p.x + yz * p.y + zz * p.z};
  }
};

struct RayPerturbation {
  RayQuadric quadric;
  float factor;
};

struct RayTerm {
  RayQuadric quadric;
  std::uint32_t first_perturbation, perturbations;
};

// A table of heights at a time (scene/height_table.h): (u, v, z) = linear p + at, u and v in posts.
struct RayTable {
  static constexpr float kNoThreshold_m = -1e30f;

  const terrain::HeightPyramid *now, *next;
  float share;  // of next
  float threshold_m;
  glm::mat3 linear;
  glm::vec3 at;
};

// In floats relative to the middle of its box, which keep what its place would cost them.
struct RayPart {
  static constexpr std::int32_t kNoTable = -1;

  glm::vec3 middle, half;  // of its box, in the form's axes
  std::uint32_t first_term, terms;
  std::int32_t table;   // its table of heights; kNoTable: none
  glm::vec3 hub, spin;  // it turns about the line through hub along spin, |spin| times a second
};

// An implicit surface as it has turned at a time.
struct PosedImplicit {
  std::vector<RayPart> parts;
  std::vector<RayTerm> terms;
  std::vector<RayPerturbation> perturbations;
  std::vector<RayTable> tables;
};

// The bits of `posed` depend on `implicit` and time alone; its storage is used again.
void pose_implicit(const scene::ImplicitSurface& implicit, double t_s, PosedImplicit& posed);

// Rays p = p_rel / depth of a view that looks at things through the water's surface: beyond its
// level they go on bent, so that a depth stays where the view shows the point.
struct BentRays {
  glm::vec3 ray, ray_dx, ray_dy;  // through the block's middle, and per pixel; world axes
  float rise_m;                   // where rays of depth 0 are over the eye, on a round earth
  float level_rel_m;              // of the water over the eye
  float index2;                   // the square of what lies beyond over what lies before it
  float towards;                  // the side of the level that the eye looks to: -1 down, 1 up
  glm::mat3 implicit_from_world;
  glm::vec3 origin_rel;  // of the implicit surface
};

// The rays of pixels around one: at (x, y) from it a ray has the points
// middle + u (ray + x ray_dx + y ray_dy) + middle_depth (x ray_dx + y ray_dy) at the depths
// middle_depth + u, in the form's axes.
struct RayBlock {
  glm::vec3 middle, ray, ray_dx, ray_dy;
  float middle_depth_m, near_m;
  const BentRays* bent;             // none: straight
  std::array<glm::vec4, 2> planes;  // what lies at n . p + w < 0 is cut off
  int plane_count;
};

// Parts of an implicit surface; part n has the primitive number first_primitive + n.
struct ListedParts {
  const PosedImplicit& implicit;
  std::span<const std::uint16_t> number;
  std::uint32_t first_primitive;
};

// Finds the nearest of the listed parts along the rays at (x, y) [px] from the block's middle.
// Where it is nearer than z of the depth buffer it sets z and the part's primitive. The spans are
// of one length, a multiple of 16. Quickest with the nearest parts first. What rays meet depends on
// the order of the list alone, where two parts are equally near, not on which others are in it, nor
// on which other rays.
void cast_rays(const ListedParts& parts, const RayBlock& block, std::span<const float> x,
               std::span<const float> y, std::span<float> z, std::span<std::uint32_t> primitive);

}  // namespace swell::render
