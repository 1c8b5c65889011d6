#include "ocean/inland/drift.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"

namespace swell::ocean {
namespace {

constexpr double kStepOfWidth = 0.05, kLeastStepOfWidth = 0.01;
constexpr double kLongestStep_s = 5.0;  // where the water is slow

// The current where a drifter is, and how it turns it.
class Stream {
 public:
  Stream(const RiverNetwork& network, const RiverFlow& flow, const Drifter& drifter)
      : network_(network), flow_(flow), drifter_(drifter) {}

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
    return {share * flow_.velocity(at.p), share * glm::dot(left, bow - stern) / (2.0 * half_m)};
  }

  // Back to the level line of psi, along psi's gradient.
  glm::dvec2 onto_line(glm::dvec2 p, double psi) const {
    const auto here = flow_.psi(p);
    const glm::dvec2 v = flow_.velocity(p);  // (dpsi/dy, -dpsi/dx)
    const double steep2 = glm::dot(v, v);
    if (!here || steep2 < kDriftEnds_mps * kDriftEnds_mps) return p;
    return p + (psi - *here) / steep2 * glm::dvec2(-v.y, v.x);
  }

 private:
  const RiverNetwork& network_;
  const RiverFlow& flow_;
  const Drifter& drifter_;
};

// Shorter near banks, around whose corners the flow bends sharply.
double step_m(const WaterPlace& water) {
  return water.width_m *
         std::clamp(-0.5 * water.outside_m / water.width_m, kLeastStepOfWidth, kStepOfWidth);
}

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

}  // namespace

DriftTrack::DriftTrack(const RiverNetwork& network, const RiverFlow& flow, const Drifter& drifter) {
  const Stream stream(network, flow, drifter);
  const double psi = flow.psi(drifter.p).value_or(0.0);
  Point at{0.0, {drifter.p, 0.0}, {}};
  for (int n = 0; n < kMostDriftSteps && drifts_at(network, flow, at.place.p); ++n) {
    const WaterPlace water = *network.water_near(at.place.p);
    at.per_s = stream.rates(at.place, water.width_m);
    points_.push_back(at);
    const double by_s = std::min(step_m(water) / glm::length(at.per_s.p), kLongestStep_s);
    at.place = step(stream, at.place, at.per_s, water.width_m, by_s);
    at.place.p = stream.onto_line(at.place.p, psi);
    at.t_s += by_s;
  }
  at.per_s = {};
  points_.push_back(at);
}

DriftPlace DriftTrack::at(double t_s) const {
  const auto next = std::ranges::upper_bound(points_, t_s, {}, &Point::t_s);
  if (next == points_.begin()) return points_.front().place;
  if (next == points_.end()) return points_.back().place;
  const Point &a = *(next - 1), &b = *next;
  // Hermite's cubic.
  const double way_s = b.t_s - a.t_s, u = (t_s - a.t_s) / way_s, rest = 1.0 - u;
  const double begin = rest * rest * (1.0 + 2.0 * u), end = u * u * (3.0 - 2.0 * u);
  const double leaving_s = u * rest * rest * way_s, coming_s = -u * u * rest * way_s;
  return {begin * a.place.p + end * b.place.p + leaving_s * a.per_s.p + coming_s * b.per_s.p,
          begin * a.place.turned_rad + end * b.place.turned_rad + leaving_s * a.per_s.turned_rad +
              coming_s * b.per_s.turned_rad};
}

bool drifts_at(const RiverNetwork& network, const RiverFlow& flow, glm::dvec2 p) {
  const auto place = network.water_near(p);
  return place && glm::length(river_current(flow, *place, p)) >= kDriftEnds_mps;
}

}  // namespace swell::ocean
