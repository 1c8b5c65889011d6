// Where rays meet a surface of heights, without triangles: a pyramid of maxima leaves out what a
// ray passes above, nearest part first, down to cells, or to blocks as small as a pixel.
//
// Source: Vyatkin, Dolgovesov, 2019 (land as a base plane with a "shape texture"); the step through
// a pyramid by Tevs, Ihrke, Seidel, Maximum Mipmaps for Fast, Accurate, and Scalable Dynamic Height
// Field Rendering, 2008.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "terrain/height_pyramid.h"

namespace swell::terrain {

// Rays from one place: at t the ray's point is x t east and y t north of it, at the height
// z + z_t t + z_tt t^2, for t in [begin, end). All spans have one length.
struct HeightRays {
  std::span<const float> x, y;          // [m per t]
  std::span<const float> z, z_t, z_tt;  // [m], [m per t], [m per t^2]
  std::span<const float> begin, end;    // begin >= 0
};

// Blocks of no more pixels in width are cells in pictures, and smooth ones of so many times more:
// these are 3/16 of a pixel off at most (HeightPyramid::kSmooth).
inline constexpr float kBlock_px = 1.0f, kSmoothBlocks = 3.0f;

// The nearest t at which each ray meets the surface between posts, from above or from the side;
// infinity where it meets nothing. from_world: the place, at most 2^24 posts from the grid. Blocks
// no wider than detail_m_per_t * t, smooth ones than kSmoothBlocks times this, are taken for one
// cell between their corners; 0: down to the posts. Right to 1e-6 of t and 1e-3 of a cell. The same
// bits on every SIMD target. No steps: counts no more than 8 side + 64 cells a ray.
void cast_rays(const HeightPyramid& pyramid, glm::dvec2 from_world, float detail_m_per_t,
               const HeightRays& rays, std::span<float> t_hit);

// Bundles of rays as HeightRays, whose directions lie between these, and which from `begin` on are
// no lower than z + z_t t + z_tt t^2, nor than `floor`.
struct HeightBeams {
  std::span<const float> x_low, x_high, y_low, y_high;  // [m per t]
  std::span<const float> z, z_t, z_tt;                  // as HeightRays'
  std::span<const float> floor;                         // [m]
  std::span<const float> begin;                         // >= 0
};

// Up to which t, at least, no ray of a beam meets anything of the surface; infinity where none ever
// does.
void cast_beams(const HeightPyramid& pyramid, glm::dvec2 from_world, const HeightBeams& beams,
                std::span<float> t_free);

}  // namespace swell::terrain
