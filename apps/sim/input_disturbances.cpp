#include "apps/sim/input_disturbances.h"

#include <algorithm>

namespace swell::apps {
namespace {

constexpr std::size_t kMostDisturbances = 256;
constexpr double kRings_s = 600.0;

}  // namespace

void InputDisturbances::add(const StampedDisturbance& disturbance) {
  if (kept_.size() == kMostDisturbances) kept_.erase(kept_.begin());
  kept_.push_back(disturbance);
}

void InputDisturbances::set_horizon(const Moment& moment) {
  horizon_ns_ = moment.t_ns;
  std::erase_if(kept_, [&](const StampedDisturbance& kept) {
    const bool lasts = kept.disturbance.kind == ocean::DisturbanceKind::kRotor;
    const double end_s =
        Moment{kept.stamp_ns}.t_s() + (lasts ? kept.disturbance.duration_s : 0.0) + kRings_s;
    return end_s < moment.t_s();
  });
}

std::vector<ocean::Disturbance> InputDisturbances::at(const Moment& moment) const {
  std::vector<ocean::Disturbance> list;
  for (const StampedDisturbance& kept : kept_) {
    if (kept.stamp_ns > std::min(moment.t_ns, horizon_ns_)) continue;
    list.push_back(kept.disturbance);
    list.back().t_s = Moment{kept.stamp_ns}.t_s();
  }
  return list;
}

}  // namespace swell::apps
