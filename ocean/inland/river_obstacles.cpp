// What stands in rivers as banks of their flow: which are one, and what psi they have.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "ocean/inland/river_flow.h"

namespace swell::ocean {
namespace {

constexpr double kNarrow = 0.5;  // a gap through which nothing flows, over half the lesser size
constexpr double kAroundCell_m = 24.0;

double lesser_half_m(const Obstacle& o) { return std::min(o.half_m.x, o.half_m.y); }
double larger_half_m(const Obstacle& o) { return std::max(o.half_m.x, o.half_m.y); }

// Between the outlines, or a little more; negative: they cross.
double gap_m(const Obstacle& a, const Obstacle& b) {
  double least_m = HUGE_VAL;
  for (const glm::dvec2& p : outline_of(a)) least_m = std::min(least_m, metres_outside(b, p));
  for (const glm::dvec2& p : outline_of(b)) least_m = std::min(least_m, metres_outside(a, p));
  return least_m;
}

// The number of each one's group: those between which nothing flows.
std::vector<std::size_t> groups_of(std::span<const Obstacle> outlines,
                                   std::span<const double> narrow_m) {
  std::vector<std::size_t> group(outlines.size());
  std::iota(group.begin(), group.end(), std::size_t{0});
  for (std::size_t i = 0; i < outlines.size(); ++i)
    for (std::size_t j = i + 1; j < outlines.size(); ++j) {
      const double narrow = std::min(narrow_m[i], narrow_m[j]);
      const double most_m = larger_half_m(outlines[i]) + larger_half_m(outlines[j]) + narrow;
      const double apart_m = glm::distance(outlines[i].middle, outlines[j].middle);
      // Corners of boxes lie up to 1.2 times as far out as their sides.
      if (group[i] == group[j] || apart_m > 1.2 * most_m) continue;
      if (gap_m(outlines[i], outlines[j]) < narrow)
        std::ranges::replace(group, std::size_t(group[j]), std::size_t(group[i]));
    }
  return group;
}

// Obstacles that are one, with what lies beside them.
class Group {
 public:
  // psi_here: as it is without obstacles.
  void add(const std::vector<std::uint32_t>& banks, std::optional<double> psi_here) {
    banks_.insert(banks_.end(), banks.begin(), banks.end());
    if (!psi_here) ++without_;
    sum_ += psi_here.value_or(0.0);
    ++count_;
  }

  // The bank's beside it, else the mean of its members'; nothing of a dam, or far from all banks.
  std::optional<double> psi(std::span<const BankPiece> pieces) const {
    if (without_ > 0) return std::nullopt;
    if (banks_.empty()) return sum_ / count_;
    if (std::ranges::any_of(banks_, [&](std::uint32_t bank) { return bank != banks_[0]; }))
      return std::nullopt;
    return std::ranges::find(pieces, banks_[0], &BankPiece::bank)->psi;
  }

 private:
  std::vector<std::uint32_t> banks_;
  double sum_ = 0.0;
  int count_ = 0, without_ = 0;
};

}  // namespace

// The numbers of the banks that lie nearer to an outline than narrow_m, or that it crosses.
std::vector<std::uint32_t> RiverFlow::banks_beside(const RiverNetwork& network,
                                                   const Obstacle& outline, double narrow_m) const {
  std::vector<std::uint32_t> beside;
  for (const glm::dvec2& p : outline_of(outline)) {
    const std::optional<WaterPlace> water = network.water_near(p);
    const bool is_dry = !water || water->outside_m > 0.0;
    const BankPiece* nearest = nullptr;
    double least_m = HUGE_VAL;
    for (const std::uint32_t n : index_.near(p))
      if (const double d = nearest_on(banks_[n].segment, p).distance_m; d < least_m)
        least_m = d, nearest = &banks_[n];
    if (nearest && (is_dry || least_m < narrow_m)) beside.push_back(nearest->bank);
  }
  std::ranges::sort(beside);
  beside.erase(std::ranges::unique(beside).begin(), beside.end());
  return beside;
}

void RiverFlow::add_obstacles(const RiverNetwork& network, std::span<const Obstacle> obstacles,
                              double widened_m) {
  std::vector<Obstacle> outlines;
  std::vector<double> narrow_m;
  std::vector<Segment> reaches;
  for (const Obstacle& o : obstacles) {
    outlines.push_back(widened_m > 0.0 ? widened(o, widened_m) : o);
    narrow_m.push_back(kNarrow * lesser_half_m(o));
    const glm::dvec2 middle = outlines.back().middle;
    reaches.push_back({middle, middle, 1.2 * kObstacleReach * larger_half_m(outlines.back())});
  }
  const std::vector<std::size_t> group = groups_of(outlines, narrow_m);
  std::vector<Group> groups(outlines.size());
  for (std::size_t i = 0; i < outlines.size(); ++i)
    groups[group[i]].add(banks_beside(network, outlines[i], narrow_m[i]), psi(outlines[i].middle));
  std::vector<Standing> standing;
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    const Obstacle& o = outlines[i];
    Standing one{o};
    if (const std::optional<double> value = groups[group[i]].psi(banks_)) {
      one.psi = *value;
      one.weight = banks_at(o.middle, lesser_half_m(o)).weights;
      one.half_speed = lesser_half_m(o) * glm::length(velocity(o.middle));
    }
    standing.push_back(one);
  }
  standing_ = std::move(standing);
  around_ = SegmentIndex(reaches, kAroundCell_m);
}

}  // namespace swell::ocean
