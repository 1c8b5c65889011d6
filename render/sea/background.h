// Far water: waves that move a vertex by less than a share of a pixel need not be evaluated there.
// A vertex keeps the sea's longest patches of waves, as few as the allowed error takes, or none
// at all and lies at the mean level. What it keeps depends on the view and the sea state alone,
// not on time or on frames before. With the triangles of a bintree, few of which are far, this pays
// little: 0.28 ms for open_ocean's 30,000 at 1280x720 with and without, 0.96 ms instead of 1.02 on
// the beach with 0.5 pixels allowed. So it is off unless asked for.
//
// A point whose place relative to the eye is p, with depth w along the view and horizontal
// distance r from the eye, moves by at most f r |dz| / (w (w - |dz|)) pixels when it rises by dz
// (f: pixels per unit of x / w or y / w): its window position changes by f dz (p x z) / (w w'),
// taken without its component along the view, and |p x z| = r.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>

#include "math/view.h"
#include "ocean/open_sea/sea.h"
#include "ocean/water_surface.h"

namespace swell::render {

class Background {
 public:
  // bound_m: |height| of everything on the sea, trains of a coast too; error_px > 0. The error
  // holds where that bound does: 6 standard deviations.
  Background(const View& view, const ocean::Sea& sea, float bound_m, float error_px);

  // 0: the vertex may lie at the mean level. k > 0: the longest k patches of waves, sines and
  // trains have to move it. `offset_m`: horizontal place relative to the eye.
  int detail_at(glm::vec2 offset_m) const;
  int most_detail() const { return most_detail_; }

 private:
  glm::vec3 forward_;
  float eye_z_, bound_m_, error_per_f_;
  int most_detail_;
  std::array<float, ocean::kMaxPatches> left_out_m_{};  // bound of what detail k leaves out
};

// Heights of vertices as WaterSurface::heights() has them, but for what the background leaves
// out. Spans of one length, at most 2048; `offset_m` are the places of p_world relative to the
// eye. Allocates nothing.
void background_heights(const Background& background, const ocean::WaterSurface& surface,
                        std::span<const glm::dvec2> p_world, std::span<const glm::vec2> offset_m,
                        std::span<float> height_m);

}  // namespace swell::render
