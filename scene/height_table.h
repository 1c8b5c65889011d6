// Tables of heights over base planes: a plane that a scalar function perturbs. A point p lies at
// (u, v) of the table, z over the base plane by parallel projection along the plane's normal, and
// belongs to the table's solid where
//
//   h(u, v) - z >= 0  and  h(u, v) >= threshold
//
// so that a threshold gives the outline any form. h is bilinear between the table's posts. A table
// of several frames is a surface that moves, as a function of time alone.
//
// Source: Vyatkin, Dolgovesov, 2019, formulas 11 to 13.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <limits>
#include <memory>

namespace swell::terrain {
struct HeightPyramid;
}

namespace swell::scene {

struct HeightFrames;

struct HeightTable {
  std::shared_ptr<const HeightFrames> heights;
  double loop_s = 0.0;  // in which all frames are shown once; 0: the first one stays
  // (u, v, z) = linear p + offset: u and v in posts, z in metres.
  glm::dmat3 linear{1.0};
  glm::dvec3 offset{0.0};
  double threshold_m = -std::numeric_limits<double>::infinity();

  glm::dvec3 operator()(glm::dvec3 p) const { return linear * p + offset; }
};

// The frames that a table is between at a time: share of `next`, in [0, 1). At k loop_s / frames it
// is frame k alone.
struct FramesAt {
  const terrain::HeightPyramid *now, *next;
  double share;
};
FramesAt frames_at(const HeightTable& table, double t_s);

// The lesser of what the first frame leaves over p and over the threshold [m].
double value(const HeightTable& table, glm::dvec3 p);

// At least what value() is of any frame for points middle + sum of s_i span[i], s_i in [-1, 1].
double most_of(const HeightTable& table, glm::dvec3 middle, const std::array<glm::dvec3, 3>& spans);

}  // namespace swell::scene
