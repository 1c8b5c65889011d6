// Implicit surfaces: things made of functions. A point p belongs to an implicit surface where one
// of its parts has it, and to a part where every one of the part's terms is at least 0 there. A
// term is a quadric with perturbations:
//
//   F'(p) = F(p) + sum of factor_i R_i(p),  R_i = Q_i(p)^3 where Q_i(p) > 0, else 0
//
// So a term has a continuous gradient and curvature, and few of them make a smooth, curved shape.
// A part may have a table of heights besides, which bounds it as a term does
// (scene/height_table.h). The union of parts, the intersection of terms and the difference (a term
// with its signs changed) give any combination.
//
// Source: Vyatkin, Dolgovesov, 2019; the surfaces after Vyatkin, Complex-Surface Modeling Using
// Perturbation Functions, Avtometriya 43(3), 2007.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/height_table.h"

namespace swell::scene {

// p^T A p + 2 b . p + c, A symmetric.
struct Quadric {
  double xx = 0.0, yy = 0.0, zz = 0.0, xy = 0.0, xz = 0.0, yz = 0.0;
  glm::dvec3 b{0.0};
  double c = 0.0;

  glm::dvec3 times(glm::dvec3 p) const {  // A p
    return {xx * p.x + xy * p.y + xz * p.z, xy * p.x + yy * p.y + yz * p.z,
            xz * p.x + yz * p.y + zz * p.z};
  }
  double operator()(glm::dvec3 p) const { return glm::dot(p, times(p) + 2.0 * b) + c; }
  glm::dvec3 gradient(glm::dvec3 p) const { return 2.0 * (times(p) + b); }
};

struct Perturbation {
  Quadric quadric;
  double factor = 0.0;
};

struct ImplicitTerm {
  Quadric quadric;
  std::vector<Perturbation> perturbations;  // at most kMostPerturbations
};

// In metres along the implicit surface's axes: right, ahead, up. z = 0 is its waterline.
struct ImplicitPart {
  std::vector<ImplicitTerm> terms;   // 1 to kMostTerms; the first alone has perturbations
  std::optional<HeightTable> table;  // then no term has perturbations
  glm::dvec3 low{0.0}, high{0.0};    // a box that holds it, as it is at t = 0
  glm::dvec3 inside{0.0};            // one of its points, near its middle if that is one
  glm::dmat3 frame{1.0};             // its first shape's half axes
  bool is_box = false;               // that is what its first shape is
  bool is_hollow = false;            // its middle is not one of its points: a sail, a ring
  // It turns about the line through `hub` along `axis` (unit), by a right-handed angle.
  glm::dvec3 hub{0.0}, axis{0.0, 1.0, 0.0};
  double turns_per_s = 0.0;
  glm::vec3 colour{0.6f};  // linear RGB reflectance
  float roughness = 0.42f, metalness = 0.0f, translucency = 0.0f;
  bool painted = false;  // colour times the object's, and its roughness and metalness
};

inline constexpr std::size_t kMostImplicitParts = 128;
inline constexpr std::size_t kMostTerms = 8, kMostPerturbations = 8;
inline constexpr std::size_t kMostImplicitBytes = 65536;

struct ImplicitSurface {
  std::vector<ImplicitPart> parts;    // at least one
  glm::dvec3 low{0.0}, high{0.0};     // a box that holds them however they turn
  std::vector<std::string> pictures;  // the files of its tables
};

// The right-handed turn by so many whole turns about a unit axis.
glm::dmat3 turn_about(glm::dvec3 axis, double turns);

double value(const ImplicitTerm& term, glm::dvec3 p);
glm::dvec3 gradient(const ImplicitTerm& term, glm::dvec3 p);
// The least of the part's terms and its table: at least 0 inside.
double value(const ImplicitPart& part, glm::dvec3 p);

// What points middle + sum of s_i span[i], s_i in [-1, 1], have of a function, at least and at
// most; rounding included.
struct Interval {
  double low, high;
};
using Spans = std::array<glm::dvec3, 3>;
Interval bounds(const Quadric& quadric, glm::dvec3 middle, const Spans& spans);
Interval bounds(const ImplicitTerm& term, glm::dvec3 middle, const Spans& spans);
// Whether the function may be at least 0 somewhere in the points: never false where it is.
bool may_hold(const ImplicitPart& part, glm::dvec3 middle, const Spans& spans);

// Finds the part's box and its inside. Throws std::runtime_error in one line that begins with what
// was found: a part without an inside, or one without an end.
void find_box(ImplicitPart& part);

// Finds the boxes of the implicit surface and of those of its parts that have none yet. Throws as
// find_box().
void find_boxes(ImplicitSurface& implicit);

}  // namespace swell::scene
