// The ways on which views see land: straight lines over the plane, or parabolas on a round earth.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "render/packets/view_rays.h"
#include "render/view/render_view.h"

namespace swell::render {

// The height over the mean level of the point that a view shows at t on a ray: z + z_t t + z_tt
// t^2, for t in [begin, end). Every view shows a point at its true place in the plane.
struct LandPath {
  float z = 0.0f, z_t = 0.0f, z_tt = 0.0f;
  float begin = 1.0f, end = 0.0f;  // as it stands: none
};

inline constexpr float kFarthestLand = 1e9f;  // [t]

// Returns the path of the ray with this direction, relative to the eye; its depth grows by 1 per t.
// A mirrored ray goes up from where it meets the level, a refracted one on from there by Snell's
// law, as straight as the other. By the paper's law (RenderView::paper_refraction) it is bent a
// little, and the path is its chord from the level to `towards` [t]; 0: its tangent at the level.
LandPath land_path(const RenderView& view, glm::vec3 direction, float towards = 0.0f);

// Rays through places of a picture, an element each; all spans have one length. They end where
// something nearer is, and land that is lower than view.land->outline_m, or beyond view.clip_plane,
// is not on their ways.
struct LandRaysThrough {
  std::span<const float> x_px, y_px;
  std::span<const float> depth;              // what is there, as in the depth buffer
  std::span<const float> free, free_around;  // t before which a ray meets neither map
  std::span<const float> towards;            // as land_path()'s
  std::span<float> x, y, z, z_t, z_tt;       // as terrain::HeightRays'
  std::span<float> begin, begin_around, end;
};

// 3 ns a ray.
void set_land_rays(const RenderView& view, const ViewRays& rays, const LandRaysThrough& through);

}  // namespace swell::render
