// Stage 4: implicit surfaces, which are found by rays and not by triangles.
//
// Squares of the picture that a part may show in are halved, and parts left out that a square
// cannot show: by the bounds of their terms over all points that the square's rays pass. What is
// left is found along each ray (implicit_rays.h), and written into the visibility buffer where it
// is nearer than what is there. A part's number in the buffer is that of the triangle which stands
// for its paint in ObjectDraws.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "raster/samples.h"
#include "render/view/implicit_rays.h"

namespace swell::render {

struct RenderView;
struct ObjectDraws;
struct ObjectInstance;

// An implicit surface in one view.
struct ImplicitInView {
  const PosedImplicit* implicit = nullptr;
  std::uint32_t first_primitive = 0;
  // p_implicit = implicit_from_ray (ray of depth 1) depth + implicit_from_eye, of straight rays.
  glm::dmat3 implicit_from_ray{1.0};
  glm::dvec3 implicit_from_eye{0.0};
  double middle_depth_m = 0.0;
  std::optional<BentRays> bent;
  std::array<glm::vec4, 2> planes;
  int plane_count = 0;
  std::uint32_t first_place = 0;     // of its parts, in ImplicitsInView::places
  std::uint32_t first_in_order = 0;  // likewise, in ImplicitsInView::order
  // Whole pixels, inclusive; empty if x1 < x0.
  int x0 = 0, y0 = 0, x1 = -1, y1 = -1;
};

// Where a part may show, and how deep.
struct PartPlace {
  float x0, y0, x1, y1;  // [px]
  float nearest_m, farthest_m;
};

struct ImplicitsInView {
  std::vector<ImplicitInView> implicits;
  std::vector<PartPlace> places;
  std::vector<std::uint16_t> order;  // part numbers of each implicit surface, near ones first
  // The view's rays of depth 1: at window point (x, y) [px] ray + x ray_dx + y ray_dy.
  glm::dvec3 ray{0.0}, ray_dx{0.0}, ray_dy{0.0};
  float near_m = 0.25f;
  bool squares = true;  // false: every ray is tried with every part, for the same bits
};

// What the view shows of the objects that are implicit surfaces.
void find_implicits(const ObjectDraws& objects, RenderView& view);

// Draws the implicit surfaces over what a tile's buffers hold, side_px^2 long. With covered < 0
// they hold nothing yet. Returns how many pixels inside the viewport show a surface; still < 0 if
// none of the implicit surfaces may show in the tile. Different tiles may be drawn by different
// threads at one time.
int draw_implicits(const ImplicitsInView& implicits, const raster::PixelBox& box, int side_px,
                   int covered, std::span<float> depth, std::span<std::uint32_t> primitive);

// Adds to `mask` the tile's pixels in which an implicit surface may begin or end.
void mark_implicits(const ImplicitsInView& implicits, const raster::PixelBox& box, int side_px,
                    std::span<const std::uint32_t> primitive, raster::PixelMask& mask);

// Draws the implicit surfaces over what the samples of the marked pixels show, as
// raster::draw_samples() leaves them.
void draw_implicit_samples(const ImplicitsInView& implicits, const raster::PixelBox& box,
                           int samples, const raster::PixelMask& mask, std::span<float> depth,
                           std::span<std::uint32_t> primitive);

// How far a point p_rel of part `part` of an object that is an implicit surface moves in step_s
// seconds by the part's turning: map * (p_rel, 1); all relative to the eye. None: it does not turn.
std::optional<glm::dmat4x3> part_move(const ObjectInstance& object, std::uint32_t part,
                                      double step_s);

}  // namespace swell::render
