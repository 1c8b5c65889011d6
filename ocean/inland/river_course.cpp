#include "ocean/inland/river_course.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace swell::ocean {
namespace {

constexpr double kLeastStep_m = 0.5, kMostStep_m = 10.0;
constexpr double kSharpestBend = 0.9;  // half width over radius

double value_of_node(const std::vector<double>& values, std::size_t n) {
  return values.size() == 1 ? values[0] : values[n];
}

// Hermite's cubic.
template <class T>
T cubic(T p0, T m0, T p1, T m1, double t) {
  const double t2 = t * t, t3 = t2 * t;
  return (2 * t3 - 3 * t2 + 1) * p0 + (t3 - 2 * t2 + t) * m0 + (3 * t2 - 2 * t3) * p1 +
         (t3 - t2) * m1;
}

// A value along the river's points, monotone between them.
class Profile {
 public:
  Profile(std::vector<double> values, const std::vector<double>& chord_m)
      : values_(std::move(values)), chord_m_(chord_m), slope_(values_.size(), 0.0) {
    for (std::size_t n = 1; n + 1 < values_.size(); ++n) {
      const double before = (values_[n] - values_[n - 1]) / chord_m[n - 1];
      const double after = (values_[n + 1] - values_[n]) / chord_m[n];
      if (before * after <= 0.0) continue;
      const double all = chord_m[n - 1] + chord_m[n];
      // The harmonic mean keeps within the bound of Fritsch and Carlson.
      const double a = (all + chord_m[n]) / (3.0 * all), b = (all + chord_m[n - 1]) / (3.0 * all);
      slope_[n] = before * after / (a * after + b * before);
    }
  }
  double at(std::size_t n, double t) const {
    const double chord = chord_m_[n];
    return cubic(values_[n], slope_[n] * chord, values_[n + 1], slope_[n + 1] * chord, t);
  }

 private:
  std::vector<double> values_;
  const std::vector<double>& chord_m_;
  std::vector<double> slope_;
};

std::vector<double> chords_of(const std::vector<glm::dvec2>& path) {
  std::vector<double> chord;
  for (std::size_t n = 1; n < path.size(); ++n)
    chord.push_back(glm::distance(path[n - 1], path[n]));
  return chord;
}

// Slopes of the parabolas through three points each, per metre of chord.
std::vector<glm::dvec2> directions_of(const std::vector<glm::dvec2>& p,
                                      const std::vector<double>& chord) {
  const std::size_t last = p.size() - 1;
  std::vector<glm::dvec2> d(p.size());
  const auto piece = [&](std::size_t n) { return (p[n + 1] - p[n]) / chord[n]; };
  for (std::size_t n = 1; n < last; ++n)
    d[n] = (chord[n] * piece(n - 1) + chord[n - 1] * piece(n)) / (chord[n - 1] + chord[n]);
  d[0] = last > 1 ? 2.0 * piece(0) - d[1] : piece(0);
  d[last] = last > 1 ? 2.0 * piece(last - 1) - d[last - 1] : piece(0);
  return d;
}

bool cross(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, glm::dvec2 d) {
  const auto side = [](glm::dvec2 o, glm::dvec2 p, glm::dvec2 q) {
    return (p.x - o.x) * (q.y - o.y) - (p.y - o.y) * (q.x - o.x);
  };
  return side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0;
}

void check_lists(const River& river, const std::string& key) {
  const std::size_t points = river.path_m.size();
  if (points < 2) throw RiverError(key + ".path_m", fmt::format("{} points", points), "2 or more");
  const auto check = [&](const char* name, const std::vector<double>& values, bool one_for_all) {
    if (values.size() == points || (one_for_all && values.size() == 1)) return;
    throw RiverError(
        key + "." + name, fmt::format("{} numbers", values.size()),
        fmt::format("{} for {} points", one_for_all ? "one, or one each" : "one each", points));
  };
  check("width_m", river.width_m, true);
  check("depth_m", river.depth_m, true);
  check("surface_m", river.surface_m, false);
  for (std::size_t n = 1; n < points; ++n)
    if (glm::distance(river.path_m[n - 1], river.path_m[n]) < 1.0)
      throw RiverError(fmt::format("{}.path_m[{}]", key, n),
                       fmt::format("[{}, {}]", river.path_m[n].x, river.path_m[n].y),
                       "a point 1 m or more from the one before");
  for (std::size_t n = 1; n < points; ++n)
    for (std::size_t m = n + 2; m < points; ++m)
      if (cross(river.path_m[n - 1], river.path_m[n], river.path_m[m - 1], river.path_m[m]))
        throw RiverError(fmt::format("{}.path_m[{}]", key, m), "a line that crosses itself",
                         "one that does not");
}

void check_bends(const Course& course, const std::string& key) {
  for (std::size_t n = 1; n + 1 < course.nodes.size(); ++n) {
    const CourseNode &a = course.nodes[n - 1], &b = course.nodes[n + 1];
    const double turn = std::abs(a.along.x * b.along.y - a.along.y * b.along.x);
    if (turn * course.nodes[n].half_width_m > kSharpestBend * (b.s_m - a.s_m) ||
        glm::dot(a.along, b.along) < 0.0)
      throw RiverError(key + ".path_m",
                       fmt::format("a bend at [{:.0f}, {:.0f}] sharper than the river is wide",
                                   course.nodes[n].p.x, course.nodes[n].p.y),
                       "wider bends, or a narrower river");
  }
}

}  // namespace

CourseNode node_between(const Course& course, std::size_t n, double t) {
  const CourseNode &a = course.nodes[n], &b = course.nodes[n + 1];
  const auto mix = [t](double x, double y) { return x + t * (y - x); };
  CourseNode node;
  node.p = glm::mix(a.p, b.p, t);
  node.along = glm::normalize(glm::mix(a.along, b.along, t));
  node.s_m = mix(a.s_m, b.s_m);
  node.point = mix(a.point, b.point);
  node.half_width_m = mix(a.half_width_m, b.half_width_m);
  node.depth_m = mix(a.depth_m, b.depth_m);
  node.level_m = mix(a.level_m, b.level_m);
  node.sea_share = mix(a.sea_share, b.sea_share);
  return node;
}

CourseNode node_at(const Course& course, double s_m) {
  const auto after = std::ranges::upper_bound(course.nodes, s_m, {}, &CourseNode::s_m);
  const auto n = std::clamp<std::ptrdiff_t>(after - course.nodes.begin() - 1, 0,
                                            static_cast<std::ptrdiff_t>(course.nodes.size()) - 2);
  const double from = course.nodes[n].s_m, to = course.nodes[n + 1].s_m;
  return node_between(course, static_cast<std::size_t>(n),
                      std::clamp((s_m - from) / (to - from), 0.0, 1.0));
}

CoursePlace place_on(const Course& course, std::size_t segment, glm::dvec2 p) {
  const auto [t, distance_m] =
      nearest_on({course.nodes[segment].p, course.nodes[segment + 1].p}, p);
  CoursePlace place{node_between(course, segment, t)};
  const bool on_left = glm::dot(p - place.node.p, place.node.left()) >= 0.0;
  place.offset_m = on_left ? distance_m : -distance_m;
  place.outside_m = distance_m - place.node.half_width_m;
  return place;
}

CoursePlace place_on(const Course& course, glm::dvec2 p) {
  std::size_t nearest = 0;
  double least_m = HUGE_VAL;
  for (std::size_t n = 0; n + 1 < course.nodes.size(); ++n) {
    const double d = nearest_on({course.nodes[n].p, course.nodes[n + 1].p}, p).distance_m;
    if (d < least_m) least_m = d, nearest = n;
  }
  return place_on(course, nearest, p);
}

Course make_course(const River& river, const std::string& key) {
  check_lists(river, key);
  const std::size_t points = river.path_m.size();
  const std::vector<double> chord = chords_of(river.path_m);
  const std::vector<glm::dvec2> direction = directions_of(river.path_m, chord);
  std::vector<double> widths(points), depths(points);
  for (std::size_t n = 0; n < points; ++n) {
    widths[n] = value_of_node(river.width_m, n);
    depths[n] = value_of_node(river.depth_m, n);
  }
  const Profile width(widths, chord), depth(depths, chord);
  Course course;
  for (std::size_t n = 0; n + 1 < points; ++n) {
    const double narrow_m = std::min(widths[n], widths[n + 1]);
    const double step_m = std::clamp(0.2 * narrow_m, kLeastStep_m, kMostStep_m);
    const int steps = std::max(2, static_cast<int>(std::ceil(chord[n] / step_m)));
    for (int k = n == 0 ? 0 : 1; k <= steps; ++k) {
      const double t = static_cast<double>(k) / steps;
      CourseNode node;
      node.p = cubic(river.path_m[n], direction[n] * chord[n], river.path_m[n + 1],
                     direction[n + 1] * chord[n], t);
      node.point = static_cast<double>(n) + t;
      node.half_width_m = 0.5 * width.at(n, t);
      node.depth_m = depth.at(n, t);
      if (!course.nodes.empty())
        node.s_m = course.nodes.back().s_m + glm::distance(course.nodes.back().p, node.p);
      course.nodes.push_back(node);
    }
  }
  const std::size_t last = course.nodes.size() - 1;
  for (std::size_t n = 0; n <= last; ++n)
    course.nodes[n].along =
        glm::normalize(course.nodes[std::min(n + 1, last)].p - course.nodes[n == 0 ? 0 : n - 1].p);
  check_bends(course, key);
  return course;
}

void set_levels(const River& river, double first_m, double last_m, const std::string& key,
                Course& course) {
  std::vector<double> surface = river.surface_m;
  if (std::isfinite(first_m)) surface.front() = first_m;
  if (std::isfinite(last_m)) surface.back() = last_m;
  for (std::size_t n = 1; n < surface.size(); ++n)
    if (!(surface[n] <= surface[n - 1]))
      throw RiverError(fmt::format("{}.surface_m[{}]", key, n), fmt::format("{:.6g}", surface[n]),
                       fmt::format("at most {:.6g}, where the water comes from", surface[n - 1]));
  const std::vector<double> chord = chords_of(river.path_m);
  const Profile level(surface, chord);
  for (CourseNode& node : course.nodes) {
    const std::size_t n = std::min(static_cast<std::size_t>(node.point), surface.size() - 2);
    node.level_m = level.at(n, node.point - static_cast<double>(n));
  }
}

}  // namespace swell::ocean
