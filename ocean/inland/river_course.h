// The middle line of a river, smooth, with what it has along it.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "ocean/inland/river.h"
#include "ocean/inland/segment_index.h"

namespace swell::ocean {

struct CourseNode {
  glm::dvec2 p{0.0};      // world
  glm::dvec2 along{1.0};  // unit, downstream
  double s_m = 0.0;       // from the source, along the line
  double point = 0.0;     // the same in the river's points: 2.5 lies half way after the third
  double half_width_m = 1.0, depth_m = 1.0;
  double level_m = 0.0;
  double sea_share = 0.0;  // 1: here the sea's surface goes on

  glm::dvec2 left() const { return {-along.y, along.x}; }
  glm::dvec2 bank(bool on_left) const {
    return p + (on_left ? half_width_m : -half_width_m) * left();
  }
};

// Two nodes or more, at most a quarter of the width apart (and 0.5 m or more).
struct Course {
  std::vector<CourseNode> nodes;
  double length_m() const { return nodes.back().s_m; }
};

// A node between two of a course: t in [0, 1] from node n to the next.
CourseNode node_between(const Course& course, std::size_t n, double t);
CourseNode node_at(const Course& course, double s_m);

// Where on a course a place is.
struct CoursePlace {
  CourseNode node;         // the nearest
  double offset_m = 0.0;   // from the line, left positive
  double outside_m = 0.0;  // beyond the water's edge; negative in the river
};
CoursePlace place_on(const Course& course, glm::dvec2 p);  // searches all of it
CoursePlace place_on(const Course& course, std::size_t segment, glm::dvec2 p);

// The line through the river's points: a cubic with the slopes of Bessel's parabolas (de Boor, A
// Practical Guide to Splines, 1978, ch. IV); widths, depths and heights between points follow the
// monotone cubic of Fritsch and Carlson, 1980, so that a surface that never rises from point to
// point never rises between them. `key` names the river in errors. Throws RiverError: lists that do
// not match, a surface that rises, a line that crosses itself or bends more sharply than its banks
// can.
Course make_course(const River& river, const std::string& key);

// Sets the nodes' levels. first_m, last_m: of the ends where other waters decide on them, else NaN.
void set_levels(const River& river, double first_m, double last_m, const std::string& key,
                Course& course);

}  // namespace swell::ocean
