#include "ocean/inland/drift.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "math/elementary.h"
#include "math/stop.h"

namespace swell::ocean {
namespace {

constexpr double kStepOfWidth = 0.05, kLeastStepOfWidth = 0.01;
constexpr double kLongestStep_s = 5.0;  // where the water is slow

constexpr double kOffTheBow = 0.1;  // of a lane from what it leads onto, in half its size
constexpr double kAside = 0.1;      // of a step, back onto the lane beside an obstacle
constexpr double kStepBeside = 0.25, kLeastStepBeside = 0.1;  // of the way to it, of half its size
// Steps' ends lie this much further apart than they must, so that what lies between them does, too.
constexpr double kApart = 1.02;
// Of a step of two, in the gap between them or, if that is more, in their distance: how far each
// may go, so that neither reaches the other where that one stays, and how far one from the other.
constexpr double kStepOfGap = 0.5, kStepOfApart = 0.14;
constexpr double kNearingOfGap = 0.25, kNearingOfApart = 0.05;
constexpr double kStayAgain = 0.25;  // of the time that one has stayed, until it tries again

// The current where a drifter is, and how it turns it.
class Stream {
 public:
  // around: the flow past what is wider by its radius.
  Stream(const RiverNetwork& network, const RiverFlow& flow, const RiverFlow& around,
         const Drifter& drifter)
      : network_(network), flow_(flow), around_(around), drifter_(drifter) {}

  // How the place changes in a second. Bow and stern count no further apart than a quarter of the
  // river; beside a bank the flow goes on as in a mirror.
  DriftPlace rates(const DriftPlace& at, double width_m) const {
    const auto place = network_.water_near(at.p);
    const double share = place ? place->speed_share : 0.0;
    const double half_m = std::min(0.5 * drifter_.length_m, 0.125 * width_m);
    const double s = sin(at.turned_rad), c = cos(at.turned_rad);
    const glm::dvec2 a = drifter_.ahead;
    const glm::dvec2 ahead(c * a.x - s * a.y, s * a.x + c * a.y), left(-ahead.y, ahead.x);
    const glm::dvec2 bow = flow_.velocity(at.p + half_m * ahead),
                     stern = flow_.velocity(at.p - half_m * ahead);
    return {share * around_.velocity(at.p), share * glm::dot(left, bow - stern) / (2.0 * half_m)};
  }

  // Back to the level line of psi, along psi's gradient; at most so far.
  glm::dvec2 onto_line(glm::dvec2 p, double psi, double most_m) const {
    const auto here = around_.psi(p);
    const glm::dvec2 v = around_.velocity(p);  // (dpsi/dy, -dpsi/dx)
    const double steep2 = glm::dot(v, v);
    if (!here || steep2 < kDriftEnds_mps * kDriftEnds_mps) return p;
    const glm::dvec2 way = (psi - *here) / steep2 * glm::dvec2(-v.y, v.x);
    const double length_m = glm::length(way);
    return length_m > most_m ? p + most_m / length_m * way : p + way;
  }

  // A lane that does not lead straight onto what stands near p.
  double clear_lane(double psi, glm::dvec2 p) const {
    for (const std::uint32_t n : around_.standing_near(p)) {
      const RiverFlow::Standing& one = around_.standing()[n];
      const double least = kOffTheBow * one.half_speed;
      if (one.weight == 0.0 || std::abs(psi - one.psi) >= least) continue;
      if (sizes_from(one.outline, p) < kObstacleReach)
        psi = one.psi + (psi < one.psi ? -least : least);
    }
    return psi;
  }

  // Shorter near banks, around whose corners the flow bends sharply, and near what stands in it.
  double step_m(const WaterPlace& water, glm::dvec2 p) const {
    double step_m = water.width_m * std::clamp(-0.5 * water.outside_m / water.width_m,
                                               kLeastStepOfWidth, kStepOfWidth);
    for (const std::uint32_t n : around_.standing_near(p)) {
      const Obstacle& outline = around_.standing()[n].outline;
      const double half_m = std::min(outline.half_m.x, outline.half_m.y);
      const double outside = sizes_from(outline, p) - 1.0;
      step_m = std::min(step_m, half_m * std::max(kStepBeside * outside, kLeastStepBeside));
    }
    return step_m;
  }

  const RiverFlow& around() const { return around_; }

 private:
  const RiverNetwork& network_;
  const RiverFlow& flow_;
  const RiverFlow& around_;
  const Drifter& drifter_;
};

DriftPlace moved(const DriftPlace& from, const DriftPlace& rate, double by_s) {
  return {from.p + by_s * rate.p, from.turned_rad + by_s * rate.turned_rad};
}

// A step of Runge and Kutta's method of fourth order.
DriftPlace step(const Stream& stream, const DriftPlace& from, const DriftPlace& first,
                double width_m, double by_s) {
  const DriftPlace second = stream.rates(moved(from, first, 0.5 * by_s), width_m);
  const DriftPlace third = stream.rates(moved(from, second, 0.5 * by_s), width_m);
  const DriftPlace fourth = stream.rates(moved(from, third, by_s), width_m);
  const DriftPlace mean = {
      (first.p + 2.0 * second.p + 2.0 * third.p + fourth.p) / 6.0,
      (first.turned_rad + 2.0 * second.turned_rad + 2.0 * third.turned_rad + fourth.turned_rad) /
          6.0};
  return moved(from, mean, by_s);
}

// How far a drifter keeps from what stands in the water: no further than where it begins.
double distance_kept_m(std::span<const Obstacle> obstacles, const Drifter& drifter) {
  double kept_m = drifter.radius_m;
  for (const Obstacle& obstacle : obstacles)
    while (kept_m > 1e-3 && sizes_from(widened(obstacle, kept_m), drifter.p) < 1.02) kept_m *= 0.8;
  return kept_m > 1e-3 ? kept_m : 0.0;
}

using Point = DriftTrack::Point;

// Between two points, at t_s in [a.t_s, b.t_s].
DriftPlace place_between(const Point& a, const Point& b, double t_s) {
  const double way_s = b.t_s - a.t_s, u = (t_s - a.t_s) / way_s, rest = 1.0 - u;
  if (a.is_straight)
    return {rest * a.place.p + u * b.place.p, rest * a.place.turned_rad + u * b.place.turned_rad};
  // Hermite's cubic.
  const double begin = rest * rest * (1.0 + 2.0 * u), end = u * u * (3.0 - 2.0 * u);
  const double leaving_s = u * rest * rest * way_s, coming_s = -u * u * rest * way_s;
  return {begin * a.place.p + end * b.place.p + leaving_s * a.per_s.p + coming_s * b.per_s.p,
          begin * a.place.turned_rad + end * b.place.turned_rad + leaving_s * a.per_s.turned_rad +
              coming_s * b.per_s.turned_rad};
}

// All drifters of a network, one step of one after the other. Each stays, as the others see it,
// where its last step ended: so one that has no room may always stay, and none is ever too near.
class Fleet {
 public:
  Fleet(const RiverNetwork& network, std::span<const Obstacle> obstacles,
        std::span<const Drifter> drifters)
      : network_(network), flow_(network, obstacles), drifters_(drifters) {
    for (const Drifter& drifter : drifters) {
      const RiverFlow& around = flow_around(obstacles, distance_kept_m(obstacles, drifter));
      Afloat one{Stream(network, flow_, around, drifter)};
      one.at.place.p = drifter.p;
      one.psi = around.psi(drifter.p).value_or(0.0);
      afloat_.push_back(std::move(one));
    }
    for (Afloat& one : afloat_) look_around(one);
  }

  std::vector<DriftTrack> tracks() {
    while (const std::optional<std::size_t> i = next_to_move()) advance(*i);
    std::vector<DriftTrack> tracks;
    for (Afloat& one : afloat_) {
      one.at.per_s = {};
      one.at.is_straight = false;
      one.points.push_back(one.at);
      tracks.emplace_back(std::move(one.points));
    }
    return tracks;
  }

 private:
  struct Afloat {
    Stream stream;
    Point at{};              // where its last step has ended
    double psi = 0.0;        // its lane
    double width_m = 0.0;    // of the river there
    double longest_s = 0.0;  // of a step
    bool drifts = true;      // false: its way has ended
    bool waits = false;      // until another one has made its step
    int stays = 0;           // steps since any has moved
    int steps = 0;
    std::vector<Point> points{};  // before `at`
  };

  const RiverFlow& flow_around(std::span<const Obstacle> obstacles, double kept_m) {
    if (obstacles.empty() || kept_m == 0.0) return flow_;
    for (const auto& [by_m, flow] : wider_)
      if (by_m == kept_m) return *flow;
    return *wider_.emplace_back(kept_m, std::make_unique<RiverFlow>(network_, obstacles, kept_m))
                .second;
  }

  double apart_m(std::size_t i, std::size_t j) const {
    const Drifter &a = drifters_[i], &b = drifters_[j];
    return std::min(a.radius_m + b.radius_m, 0.98 * glm::distance(a.p, b.p));
  }

  // How it moves where it is, and how long it may.
  void look_around(Afloat& one) const {
    const glm::dvec2 p = one.at.place.p;
    one.drifts = one.steps < kMostDriftSteps && drifts_at(network_, one.stream.around(), p);
    one.at.per_s = {};
    if (!one.drifts) return;
    const WaterPlace water = *network_.water_near(p);
    one.width_m = water.width_m;
    one.at.per_s = one.stream.rates(one.at.place, water.width_m);
    one.longest_s =
        std::min(one.stream.step_m(water, p) / glm::length(one.at.per_s.p), kLongestStep_s);
  }

  // The one whose last step ended first; nothing if all ways have ended.
  std::optional<std::size_t> next_to_move() const {
    std::optional<std::size_t> first;
    for (std::size_t i = 0; i < afloat_.size(); ++i) {
      if (!afloat_[i].drifts || afloat_[i].waits) continue;
      if (!first || afloat_[i].at.t_s < afloat_[*first].at.t_s) first = i;
    }
    return first;
  }

  // Where one is as far as it is known: after its last step it stays.
  DriftPlace place_at(const Afloat& one, double t_s) const {
    const Point* after = &one.at;
    for (std::size_t n = one.points.size(); t_s < after->t_s && n > 0; after = &one.points[n])
      if (const Point& before = one.points[--n]; before.t_s <= t_s)
        return place_between(before, *after, t_s);
    return after->place;
  }

  double longest_step_s(std::size_t i) const {
    const Afloat& one = afloat_[i];
    double by_s = one.longest_s;
    for (std::size_t j = 0; j < afloat_.size(); ++j) {
      if (i == j) continue;
      const glm::dvec2 v = one.at.per_s.p, w = afloat_[j].at.per_s.p;
      const double radii_m = drifters_[i].radius_m + drifters_[j].radius_m;
      const glm::dvec2 other = place_at(afloat_[j], one.at.t_s).p;
      const double gap_m = glm::distance(one.at.place.p, other) - apart_m(i, j);
      by_s = std::min(
          {by_s,
           std::max(kStepOfGap * gap_m, kStepOfApart * radii_m) /
               std::max(glm::length(v), glm::length(w)),
           std::max(kNearingOfGap * gap_m, kNearingOfApart * radii_m) / glm::distance(v, w)});
    }
    return by_s;
  }

  // Where it goes if no other is in its way.
  DriftPlace next_place(Afloat& one, double by_s) const {
    const glm::dvec2 here = one.at.place.p;
    DriftPlace next = step(one.stream, one.at.place, one.at.per_s, one.width_m, by_s);
    const bool is_parted = one.stream.around().is_parted(next.p);
    if (is_parted) one.psi = one.stream.clear_lane(one.psi, next.p);
    const double most_m = is_parted ? kAside * glm::distance(here, next.p) : HUGE_VAL;
    next.p = one.stream.onto_line(next.p, one.psi, most_m);
    return next;
  }

  // A step, or none yet: what another does first may make room for it.
  void advance(std::size_t i) {
    Afloat& one = afloat_[i];
    const double by_s = longest_step_s(i), end_s = one.at.t_s + by_s;
    const DriftPlace here = one.at.place, next = next_place(one, by_s);
    DriftPlace to = next;
    if (one.stream.around().is_blocked(next.p)) {
      to = here;
    } else if (const auto other = in_way(i, next.p, end_s)) {
      const Afloat& first = afloat_[*other];
      one.waits = first.drifts && !first.waits && first.at.t_s < end_s;
      if (one.waits) return;
      to = place_beside(i, next, *other, end_s);
    }
    one.at.is_straight = to.p != next.p;
    const bool stays = to.p == here.p;
    const bool stayed =
        !one.points.empty() && one.points.back().is_straight && one.points.back().place.p == here.p;
    const double stayed_s = stayed ? one.at.t_s - one.points.back().t_s : 0.0;
    if (!stays || !stayed) one.points.push_back(one.at);
    one.at.place = to;
    one.at.t_s = std::max(
        end_s, stays ? one.at.t_s + std::min(kStayAgain * stayed_s, kLongestStep_s) : end_s);
    ++one.steps;
    look_around(one);
    rouse(one, stays);
  }

  // After a step of one: nobody waits for it any more, and where nothing moves all ways end.
  void rouse(Afloat& one, bool stays) {
    check_stop();
    ++one.stays;
    for (Afloat& each : afloat_) {
      each.waits = false;
      if (!stays) each.stays = 0;
    }
    constexpr int kOften = 3;
    if (std::ranges::all_of(afloat_,
                            [](const Afloat& a) { return !a.drifts || a.stays >= kOften; }))
      for (Afloat& each : afloat_) each.drifts = false;
  }

  // The one that drifter i would come too near to on its way to p, most of all.
  std::optional<std::size_t> in_way(std::size_t i, glm::dvec2 p, double end_s) const {
    const Point& from = afloat_[i].at;
    std::optional<std::size_t> nearest;
    double least = kApart;
    for (std::size_t j = 0; j < afloat_.size(); ++j) {
      if (j == i) continue;
      const double apart = apart_m(i, j);
      for (const double part : {1.0, 2.0 / 3.0, 1.0 / 3.0}) {
        const double t_s = from.t_s + part * (end_s - from.t_s);
        const glm::dvec2 at = glm::mix(from.place.p, p, part);
        const double ratio = glm::distance(at, place_at(afloat_[j], t_s).p) / apart;
        if (ratio < least) least = ratio, nearest = j;
      }
    }
    return nearest;
  }

  // Where a step leads that has no room: along the other, or nowhere.
  DriftPlace place_beside(std::size_t i, const DriftPlace& next, std::size_t other, double end_s) {
    Afloat& one = afloat_[i];
    const DriftPlace here = one.at.place;
    const glm::dvec2 from_other = glm::normalize(here.p - place_at(afloat_[other], end_s).p);
    const glm::dvec2 left(-from_other.y, from_other.x), way = next.p - here.p;
    const double aside_m = glm::dot(way, left) < 0.0 ? -glm::length(way) : glm::length(way);
    const glm::dvec2 p = here.p + aside_m * left;
    if (in_way(i, p, end_s) || one.stream.around().is_blocked(p)) return here;
    const auto water = network_.water_near(p), before = network_.water_near(here.p);
    const double most_m = std::max(before->outside_m, -drifters_[i].radius_m);
    const std::optional<double> psi = one.stream.around().psi(p);
    if (!water || water->outside_m > most_m || !psi) return here;
    one.psi = *psi;
    return {p, next.turned_rad};
  }

  const RiverNetwork& network_;
  RiverFlow flow_;
  std::span<const Drifter> drifters_;
  std::vector<std::pair<double, std::unique_ptr<const RiverFlow>>> wider_;
  std::vector<Afloat> afloat_;
};

}  // namespace

std::vector<DriftTrack> make_drift_tracks(const RiverNetwork& network,
                                          std::span<const Obstacle> obstacles,
                                          std::span<const Drifter> drifters) {
  return Fleet(network, obstacles, drifters).tracks();
}

DriftPlace DriftTrack::at(double t_s) const {
  const auto next = std::ranges::upper_bound(points_, t_s, {}, &Point::t_s);
  if (next == points_.begin()) return points_.front().place;
  if (next == points_.end()) return points_.back().place;
  return place_between(*(next - 1), *next, t_s);
}

bool drifts_at(const RiverNetwork& network, const RiverFlow& flow, glm::dvec2 p) {
  const auto place = network.water_near(p);
  return place && glm::length(river_current(flow, *place, p)) >= kDriftEnds_mps;
}

}  // namespace swell::ocean
