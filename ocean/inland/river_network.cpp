#include "ocean/inland/river_network.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/smoothstep.h"

namespace swell::ocean {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kNetworkCell_m = 32.0;
constexpr int kDeepest = 64;  // rivers one after the other

std::string key_of(std::string_view kind, std::size_t n) { return fmt::format("{}[{}]", kind, n); }

std::optional<std::size_t> find_named(const auto& things, const std::string& name) {
  for (std::size_t n = 0; n < things.size(); ++n)
    if (things[n].name == name) return n;
  return std::nullopt;
}

void check_lake(const Lake& lake, const std::string& key) {
  const auto& p = lake.outline_m;
  if (p.empty()) return;
  if (p.size() < 3)
    throw RiverError(key + ".outline_m", fmt::format("{} points", p.size()), "3 or more");
  const auto side = [](glm::dvec2 o, glm::dvec2 a, glm::dvec2 b) {
    return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
  };
  const auto at = [&](std::size_t n) { return p[n % p.size()]; };
  for (std::size_t n = 0; n < p.size(); ++n)
    for (std::size_t m = n + 2; m < p.size(); ++m)
      if (side(at(n), at(n + 1), at(m)) * side(at(n), at(n + 1), at(m + 1)) < 0.0 &&
          side(at(m), at(m + 1), at(n)) * side(at(m), at(m + 1), at(n + 1)) < 0.0)
        throw RiverError(fmt::format("{}.outline_m[{}]", key, m), "an outline that crosses itself",
                         "one that does not");
}

}  // namespace

double outside_outline(std::span<const glm::dvec2> outline, glm::dvec2 p) {
  double least_m = HUGE_VAL;
  bool inside = false;
  for (std::size_t n = 0, before = outline.size() - 1; n < outline.size(); before = n++) {
    const glm::dvec2 a = outline[before], b = outline[n];
    least_m = std::min(least_m, nearest_on({a, b}, p).distance_m);
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
      inside = !inside;
  }
  return inside ? -least_m : least_m;
}

RiverNetwork::RiverNetwork(std::span<const River> rivers, std::span<const Lake> lakes)
    : rivers_(rivers.begin(), rivers.end()), lakes_(lakes.begin(), lakes.end()) {
  for (std::size_t n = 0; n < lakes_.size(); ++n) check_lake(lakes_[n], key_of(kLakeKey, n));
  for (std::size_t n = 0; n < rivers_.size(); ++n)
    courses_.push_back(make_course(rivers_[n], key_of(kRiverKey, n)));
  find_joints();
  set_all_levels();
  for (Joint& joint : joints_)
    joint.discharge_m2_s = joint.joins
                               ? discharge_at(joint.river, courses_[joint.river].length_m(), 0)
                               : discharge_at_start(joint.river, 0);
  set_sea_shares();
  index_segments();
}

void RiverNetwork::find_joints() {
  for (std::size_t r = 0; r < rivers_.size(); ++r) {
    for (const bool joins : {false, true}) {
      const std::string& name = joins ? rivers_[r].into : rivers_[r].from;
      const std::string key = key_of(kRiverKey, r) + (joins ? ".into" : ".from");
      if (name.empty() || find_named(lakes_, name)) continue;
      const std::optional<std::size_t> on = find_named(rivers_, name);
      if (!on || *on == r)
        throw RiverError(key, fmt::format("\"{}\"", name),
                         "the name of another river or of a lake");
      const std::vector<CourseNode>& nodes = courses_[r].nodes;
      const CourseNode& end = joins ? nodes.back() : nodes.front();
      const CoursePlace place = place_on(courses_[*on], end.p);
      if (place.outside_m > 0.0)
        throw RiverError(
            key, fmt::format("\"{}\", {:.0f} m from the river's end", name, place.outside_m),
            "a river in which it ends");
      // From where it comes: the first node that is not in the other river.
      const auto side_of = [&](const CourseNode& node) {
        const CoursePlace at = place_on(courses_[*on], node.p);
        return at.outside_m > 0.0 ? at.offset_m : 0.0;
      };
      double side = 0.0;
      for (std::size_t n = 0; n < nodes.size() && side == 0.0; ++n)
        side = side_of(joins ? nodes[nodes.size() - 1 - n] : nodes[n]);
      if (side == 0.0)
        throw RiverError(key, fmt::format("\"{}\", in which all of it lies", name),
                         "a river beside it");
      joints_.push_back({r, *on, joins, place.node.s_m, side > 0.0});
    }
  }
}

// Levels follow from what a river joins and leaves, whose own come first.
void RiverNetwork::set_all_levels() {
  std::vector<bool> done(rivers_.size(), false);
  const auto joint_of = [&](std::size_t r, bool joins) -> const Joint* {
    for (const Joint& joint : joints_)
      if (joint.river == r && joint.joins == joins) return &joint;
    return nullptr;
  };
  const auto is_ready = [&](std::size_t r) {
    const Joint *from = joint_of(r, false), *into = joint_of(r, true);
    return (!from || done[from->on]) && (!into || done[into->on]);
  };
  // The level of what the end meets; NaN: the river's own.
  const auto level_at = [&](std::size_t r, bool joins) {
    if (const Joint* joint = joint_of(r, joins))
      return node_at(courses_[joint->on], joint->s_m).level_m;
    const std::string& name = joins ? rivers_[r].into : rivers_[r].from;
    if (name.empty()) return joins ? 0.0 : kNone;
    return lakes_[*find_named(lakes_, name)].level_m;
  };
  for (std::size_t count = 0; count < rivers_.size(); ++count) {
    std::size_t r = 0;
    while (r < rivers_.size() && (done[r] || !is_ready(r))) ++r;
    if (r == rivers_.size()) {
      r = static_cast<std::size_t>(std::ranges::find(done, false) - done.begin());
      throw RiverError(key_of(kRiverKey, r), "rivers that join each other in a circle",
                       "one that does not lead back to itself");
    }
    set_levels(rivers_[r], level_at(r, false), level_at(r, true), key_of(kRiverKey, r),
               courses_[r]);
    done[r] = true;
  }
}

// A river into the sea is the sea's over its last two widths.
void RiverNetwork::set_sea_shares() {
  for (std::size_t r = 0; r < rivers_.size(); ++r) {
    if (!rivers_[r].into.empty()) continue;
    Course& course = courses_[r];
    const double width_m = 2.0 * course.nodes.back().half_width_m;
    const double end_m = course.length_m() - 0.25 * width_m;
    for (CourseNode& node : course.nodes)
      node.sea_share = smoothstep(end_m - 2.5 * width_m, end_m, node.s_m);
  }
}

double RiverNetwork::discharge_at_start(std::size_t r, int depth) const {
  const River& river = rivers_[r];
  if (depth > kDeepest)
    throw RiverError(key_of(kRiverKey, r), "rivers that join each other in a circle",
                     "one that does not lead back to itself");
  const double width_m = 2.0 * courses_[r].nodes.front().half_width_m;
  for (const Joint& joint : joints_) {
    if (joint.river != r || joint.joins) continue;
    const double other_m = 2.0 * node_at(courses_[joint.on], joint.s_m).half_width_m;
    return discharge_at(joint.on, joint.s_m, depth + 1) * width_m / (width_m + other_m);
  }
  if (river.from.empty()) return river.speed_mps * width_m;
  // Out of a lake comes what flows into it, by cross-section; out of one without rivers, its speed.
  double in = 0.0, out_m = 0.0;
  for (std::size_t other = 0; other < rivers_.size(); ++other) {
    if (rivers_[other].into == river.from)
      in += discharge_at(other, courses_[other].length_m(), depth + 1);
    if (rivers_[other].from == river.from)
      out_m += 2.0 * courses_[other].nodes.front().half_width_m;
  }
  return in > 0.0 ? in * width_m / out_m : river.speed_mps * width_m;
}

double RiverNetwork::discharge_at(std::size_t r, double s_m, int depth) const {
  double discharge = discharge_at_start(r, depth);
  for (const Joint& joint : joints_) {
    if (joint.on != r || !(joint.s_m < s_m)) continue;
    if (joint.joins)
      discharge += discharge_at(joint.river, courses_[joint.river].length_m(), depth + 1);
    else
      discharge -= discharge_at_start(joint.river, depth + 1);
  }
  return discharge;
}

double RiverNetwork::discharge_m2_s(std::size_t river, double s_m) const {
  return discharge_at(river, s_m, 0);
}

void RiverNetwork::index_segments() {
  std::vector<Segment> segments;
  const auto include = [&](glm::dvec2 p, double by_m) {
    low_ = glm::min(low_, p - by_m);
    high_ = glm::max(high_, p + by_m);
  };
  for (std::size_t r = 0; r < courses_.size(); ++r) {
    const auto& nodes = courses_[r].nodes;
    for (const CourseNode& node : nodes) {
      least_width_m_ = std::min(least_width_m_, 2.0 * node.half_width_m);
      include(node.p, node.half_width_m + margin_m_);
    }
    for (std::size_t n = 0; n + 1 < nodes.size(); ++n) {
      const double half_m = std::max(nodes[n].half_width_m, nodes[n + 1].half_width_m);
      segments.push_back({nodes[n].p, nodes[n + 1].p, half_m + margin_m_});
      of_segment_.push_back({static_cast<std::uint32_t>(r), static_cast<std::uint32_t>(n)});
    }
  }
  for (const Lake& lake : lakes_)
    for (const glm::dvec2& p : lake.outline_m) include(p, margin_m_);
  index_ = SegmentIndex(segments, kNetworkCell_m);
}

// The water of several rivers and lakes near a place, each counted by how near it is.
class RiverNetwork::NearWater {
 public:
  NearWater(const RiverNetwork& network, glm::dvec2 p) : network_(network), p_(p) {
    sum_.bed_m = HUGE_VAL;
  }

  // Adds a river at the node of its nearest segment.
  void add_river(std::uint32_t river, std::uint32_t nearest) {
    const Course& course = network_.courses_[river];
    const CoursePlace at = place_on(course, nearest, p_);
    if (at.outside_m > network_.margin_m_) return;
    const auto& nodes = course.nodes;
    const double half_m = at.node.half_width_m;
    const double falls = (nodes[nearest].level_m - nodes[nearest + 1].level_m) /
                         (nodes[nearest + 1].s_m - nodes[nearest].s_m);
    // Beside the mouth lies the sea, too.
    const double aside = smoothstep(-0.2 * half_m, 0.1 * half_m, at.outside_m) *
                         smoothstep(0.0, 0.05, at.node.sea_share);
    const double to_sea = 1.0 - (1.0 - at.node.sea_share) * (1.0 - aside);
    add(at.node.level_m, at.outside_m, 0.1 * half_m, to_sea, falls, speed_share(river, at));
    const double across = std::abs(at.offset_m) / half_m;
    sum_.bed_m = std::min(sum_.bed_m, at.node.level_m - at.node.depth_m * (1.0 - across * across));
    if (at.outside_m < sum_.outside_m) {
      sum_.outside_m = at.outside_m;
      sum_.width_m = 2.0 * half_m;
      sum_.depth_m = at.node.depth_m;
    }
  }

  void add_lake(const Lake& lake) {
    if (lake.outline_m.empty()) return;
    const double outside_m = outside_outline(lake.outline_m, p_);
    if (outside_m > network_.margin_m_) return;
    add(lake.level_m, outside_m, 1.0, 0.0, 0.0, 0.0);
    if (lake.depth_m > 0.0) {
      const double dug = smoothstep(0.0, 8.0 * lake.depth_m, -outside_m);
      const double rim = std::max(outside_m, 0.0) * 0.1;
      sum_.bed_m = std::min(sum_.bed_m, lake.level_m - lake.depth_m * std::max(dug, 0.0) + rim);
    }
    if (outside_m < sum_.outside_m) {
      sum_.outside_m = outside_m;
      sum_.width_m = 0.0;
      sum_.depth_m = lake.depth_m;
      sum_.in_lake = outside_m <= 0.0;
    }
  }

  std::optional<WaterPlace> mean() const {
    if (weights_ == 0.0) return std::nullopt;
    WaterPlace mean = sum_;
    mean.level_m = level_ / weights_;
    mean.sea_share = share_ / weights_;
    mean.fall = fall_ / weights_;
    mean.speed_share = speed_ / weights_;
    return mean;
  }

 private:
  void add(double level_m, double outside_m, double softness_m, double sea_share, double falls,
           double moves) {
    const double far = std::max(outside_m, 0.0) + softness_m;
    const double weight = 1.0 / (far * far);
    weights_ += weight;
    level_ += weight * level_m;
    share_ += weight * sea_share;
    fall_ += weight * falls;
    speed_ += weight * moves;
  }

  // Lakes slow a river's water over two widths.
  double speed_share(std::uint32_t river, const CoursePlace& at) const {
    const River& described = network_.rivers_[river];
    const double ends_m = 4.0 * at.node.half_width_m;
    double moves = 1.0 - at.node.sea_share;
    if (find_named(network_.lakes_, described.into))
      moves *= smoothstep(0.0, ends_m, network_.courses_[river].length_m() - at.node.s_m);
    if (find_named(network_.lakes_, described.from)) moves *= smoothstep(0.0, ends_m, at.node.s_m);
    return moves;
  }

  const RiverNetwork& network_;
  glm::dvec2 p_;
  WaterPlace sum_;
  double weights_ = 0.0, level_ = 0.0, share_ = 0.0, fall_ = 0.0, speed_ = 0.0;
};

std::optional<WaterPlace> RiverNetwork::water_near(glm::dvec2 p) const {
  NearWater water(*this, p);
  // The nearest place of each river that reaches p; segments come river by river.
  const auto near = index_.near(p);
  for (std::size_t k = 0; k < near.size();) {
    const std::uint32_t river = of_segment_[near[k]].river;
    const auto& nodes = courses_[river].nodes;
    std::uint32_t nearest = 0;
    double least_m = HUGE_VAL;
    for (; k < near.size() && of_segment_[near[k]].river == river; ++k) {
      const std::uint32_t node = of_segment_[near[k]].node;
      const double d = nearest_on({nodes[node].p, nodes[node + 1].p}, p).distance_m;
      if (d < least_m) least_m = d, nearest = node;
    }
    water.add_river(river, nearest);
  }
  for (const Lake& lake : lakes_) water.add_lake(lake);
  return water.mean();
}

}  // namespace swell::ocean
