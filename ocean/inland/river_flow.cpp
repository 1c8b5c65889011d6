#include "ocean/inland/river_flow.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace swell::ocean {
namespace {

constexpr double kReachOfWidth = 3.0;
constexpr double kFlowCell_m = 24.0;
constexpr std::size_t kMostBanks = 24;  // near one place

// f, for t in [0, 1].
double fall_off(double t) { return t * t * t * (t * (6.0 * t - 15.0) + 10.0); }

// Where a river's bank meets the bank of another that it joins: on the other's course.
struct Meeting {
  double s_m;
  glm::dvec2 p;
};

struct Cut {
  Meeting low, high;  // of a bank that has an opening
};

// psi along the two banks of each river, and which rivers are connected. opening_m: where on the
// other's course the middle of each joint's opening lies. A bank has one psi up to it, and another
// beyond; the middle lines may meet a width away.
class BankValues {
 public:
  BankValues(const RiverNetwork& network, std::span<const double> opening_m)
      : network_(network),
        opening_m_(opening_m),
        right_(network.courses().size(), 0.0),
        part_(right_.size(), -1) {
    for (std::size_t r = 0; r < right_.size(); ++r) {
      if (part_[r] >= 0) continue;
      part_[r] = static_cast<int>(r);
      spread();
    }
    check();
  }

  double at(std::size_t river, bool left, double s_m) const {
    const double start = right_[river] + (left ? network_.discharge_m2_s(river, 0.0) : 0.0);
    return start + change(river, left, s_m);
  }
  int part(std::size_t river) const { return part_[river]; }

 private:
  // What joints on a side have added to psi there, upstream of s_m.
  double change(std::size_t river, bool left, double s_m) const {
    double sum = 0.0;
    for (std::size_t n = 0; n < opening_m_.size(); ++n) {
      const Joint& j = network_.joints()[n];
      if (j.on == river && j.on_left == left && opening_m_[n] < s_m)
        sum += (j.joins == left ? 1.0 : -1.0) * j.discharge_m2_s;
    }
    return sum;
  }

  // psi of the bank of j.river that goes on from the other's upstream of the joint, as if its right
  // bank began with 0.
  double own_value(const Joint& j) const {
    const bool left = j.joins != j.on_left;
    const double s_m = j.joins ? HUGE_VAL : 0.0;
    return (left ? network_.discharge_m2_s(j.river, 0.0) : 0.0) + change(j.river, left, s_m);
  }

  // Returns psi of that bank of j.on, upstream of the joint, likewise.
  double other_value(const Joint& j) const {
    const double s_m = opening_m_[static_cast<std::size_t>(&j - network_.joints().data())];
    return (j.on_left ? network_.discharge_m2_s(j.on, 0.0) : 0.0) + change(j.on, j.on_left, s_m);
  }

  void spread() {
    for (bool found = true; found;) {
      found = false;
      for (const Joint& j : network_.joints()) {
        if ((part_[j.river] < 0) == (part_[j.on] < 0)) continue;
        const bool known = part_[j.on] >= 0;
        const std::size_t from = known ? j.on : j.river, to = known ? j.river : j.on;
        const double difference = other_value(j) - own_value(j);
        right_[to] = right_[from] + (known ? difference : -difference);
        part_[to] = part_[from];
        found = true;
      }
    }
  }

  void check() const {
    for (const Joint& j : network_.joints()) {
      const double own = right_[j.river] + own_value(j), other = right_[j.on] + other_value(j);
      if (std::abs(own - other) > 1e-6 * j.discharge_m2_s)
        throw RiverError(fmt::format("{}[{}].{}", kRiverKey, j.river, j.joins ? "into" : "from"),
                         "a river that crosses others on its way", "one that does not");
    }
  }

  const RiverNetwork& network_;
  std::span<const double> opening_m_;
  std::vector<double> right_;
  std::vector<int> part_;
};

struct BankPoint {
  glm::dvec2 p;
  double s_m, half_width_m;
};

std::vector<BankPoint> bank_of(const Course& course, bool left) {
  std::vector<BankPoint> points;
  for (const CourseNode& node : course.nodes)
    points.push_back({node.bank(left), node.s_m, node.half_width_m});
  return points;
}

// Takes off what lies in the other river, at the end or the beginning, and says where they meet.
Meeting trim(const Course& other, bool at_end, const std::string& key,
             std::vector<BankPoint>& bank) {
  const auto outside = [&](glm::dvec2 p) { return place_on(other, p).outside_m; };
  if (at_end) std::ranges::reverse(bank);
  std::size_t first = 0;
  while (first < bank.size() && outside(bank[first].p) <= 0.0) ++first;
  if (first == 0 || first == bank.size())
    throw RiverError(key, "an end whose banks do not both meet the other river's",
                     "one that runs into the other river from the side, to its middle");
  // The crossing, by bisection.
  BankPoint in = bank[first - 1], out = bank[first];
  for (int n = 0; n < 50; ++n) {
    const BankPoint middle = {0.5 * (in.p + out.p), 0.5 * (in.s_m + out.s_m), out.half_width_m};
    (outside(middle.p) <= 0.0 ? in : out) = middle;
  }
  bank.erase(bank.begin(), bank.begin() + static_cast<std::ptrdiff_t>(first));
  bank.insert(bank.begin(), out);
  if (at_end) std::ranges::reverse(bank);
  return {place_on(other, out.p).node.s_m, out.p};
}

}  // namespace

RiverFlow::RiverFlow(const RiverNetwork& network, std::span<const Obstacle> obstacles,
                     double widened_m) {
  const std::vector<Course>& courses = network.courses();
  std::vector<std::array<std::vector<BankPoint>, 2>> banks(courses.size());  // right, left
  for (std::size_t r = 0; r < courses.size(); ++r)
    banks[r] = {bank_of(courses[r], false), bank_of(courses[r], true)};
  std::vector<std::array<std::vector<Cut>, 2>> cuts(courses.size());
  std::vector<double> opening_m;
  for (const Joint& j : network.joints()) {
    const std::string key = fmt::format("{}[{}].{}", kRiverKey, j.river, j.joins ? "into" : "from");
    Meeting a = trim(courses[j.on], j.joins, key, banks[j.river][0]);
    Meeting b = trim(courses[j.on], j.joins, key, banks[j.river][1]);
    if (b.s_m < a.s_m) std::swap(a, b);
    cuts[j.on][j.on_left].push_back({a, b});
    opening_m.push_back(0.5 * (a.s_m + b.s_m));
  }
  const BankValues values(network, opening_m);

  std::vector<std::pair<int, double>> numbers;  // of banks: their part and psi
  const auto add = [&](std::size_t river, bool left, const BankPoint& a, const BankPoint& b) {
    if (glm::distance(a.p, b.p) < 1e-9) return;
    const double psi = values.at(river, left, 0.5 * (a.s_m + b.s_m));
    const int part = values.part(river);
    const auto same = std::ranges::find_if(numbers, [&](const auto& n) {
      return n.first == part && std::abs(n.second - psi) < 1e-6 * (1.0 + std::abs(psi));
    });
    const auto number = static_cast<std::uint32_t>(same - numbers.begin());
    if (same == numbers.end()) numbers.emplace_back(part, psi);
    const double reach_m = kReachOfWidth * (a.half_width_m + b.half_width_m);
    banks_.push_back({{a.p, b.p, reach_m}, numbers[number].second, number, left});
  };
  for (std::size_t r = 0; r < courses.size(); ++r) {
    for (const bool left : {false, true}) {
      std::vector<Cut>& openings = cuts[r][left];
      std::ranges::sort(openings, {}, [](const Cut& cut) { return cut.low.s_m; });
      const std::vector<BankPoint>& points = banks[r][left];
      std::size_t cut = 0;
      for (std::size_t n = 0; n + 1 < points.size(); ++n) {
        BankPoint a = points[n];
        const BankPoint b = points[n + 1];
        // What an opening takes of this piece.
        while (cut < openings.size() && openings[cut].high.s_m <= a.s_m) ++cut;
        for (std::size_t c = cut; c < openings.size() && openings[c].low.s_m < b.s_m; ++c) {
          const Cut& open = openings[c];
          if (open.low.s_m > a.s_m) add(r, left, a, {open.low.p, open.low.s_m, a.half_width_m});
          a = {open.high.p, std::min(open.high.s_m, b.s_m), b.half_width_m};
          if (open.high.s_m >= b.s_m) break;
        }
        if (a.s_m < b.s_m) add(r, left, a, b);
      }
    }
  }
  std::vector<Segment> segments;
  for (const BankPiece& piece : banks_) segments.push_back(piece.segment);
  index_ = SegmentIndex(segments, kFlowCell_m);
  add_obstacles(network, obstacles, widened_m);
}

RiverFlow::Banks RiverFlow::banks_at(glm::dvec2 p, double least_m) const {
  // The most that any piece of a bank weighs: near its end the next one takes over without a step.
  struct Found {
    std::uint32_t bank;
    double psi, weight;
  };
  std::array<Found, kMostBanks> found;
  std::size_t count = 0;
  for (const std::uint32_t n : index_.near(p)) {
    const BankPiece& piece = banks_[n];
    const double s = piece.segment.reach_m;
    const double d = std::max(nearest_on(piece.segment, p).distance_m, least_m);
    if (d < 1e-9 * s) return {piece.psi, 1.0, true};
    if (d >= s) continue;
    const double weight = fall_off(1.0 - d / s) / d;
    std::size_t k = 0;
    while (k < count && found[k].bank != piece.bank) ++k;
    if (k == count) {
      if (count == kMostBanks) continue;
      found[count++] = {piece.bank, piece.psi, 0.0};
    }
    found[k].weight = std::max(found[k].weight, weight);
  }
  Banks all;
  for (std::size_t k = 0; k < count; ++k) {
    all.sum += found[k].weight * found[k].psi;
    all.weights += found[k].weight;
  }
  return all;
}

std::optional<double> RiverFlow::psi(glm::dvec2 p) const {
  Banks all = banks_at(p, 0.0);
  if (all.on_bank) return all.sum;
  if (all.weights == 0.0) return std::nullopt;
  for (const std::uint32_t n : around_.near(p)) {
    const Standing& one = standing_[n];
    const double q = sizes_from(one.outline, p);
    if (q >= kObstacleReach || one.weight == 0.0) continue;
    if (q <= 1.0) return one.psi;
    const double weight =
        one.weight * fall_off((kObstacleReach - q) / (kObstacleReach - 1.0)) / (q * q - 1.0);
    all.sum += weight * one.psi;
    all.weights += weight;
  }
  return all.sum / all.weights;
}

glm::dvec2 RiverFlow::velocity(glm::dvec2 p, double half_m) const {
  const auto east = psi(p + glm::dvec2(half_m, 0.0)), west = psi(p - glm::dvec2(half_m, 0.0));
  const auto north = psi(p + glm::dvec2(0.0, half_m)), south = psi(p - glm::dvec2(0.0, half_m));
  if (!east || !west || !north || !south) return glm::dvec2(0.0);
  return glm::dvec2(*north - *south, *west - *east) / (2.0 * half_m);
}

bool RiverFlow::is_parted(glm::dvec2 p) const {
  return std::ranges::any_of(around_.near(p), [&](std::uint32_t n) {
    return standing_[n].weight > 0.0 && sizes_from(standing_[n].outline, p) < kObstacleReach;
  });
}

bool RiverFlow::is_blocked(glm::dvec2 p) const {
  return std::ranges::any_of(
      around_.near(p), [&](std::uint32_t n) { return sizes_from(standing_[n].outline, p) < 1.0; });
}

glm::dvec2 river_current(const RiverFlow& flow, const WaterPlace& place, glm::dvec2 p,
                         double half_m) {
  if (place.width_m == 0.0 || place.speed_share <= 0.0 || place.outside_m > 0.0)
    return glm::dvec2(0.0);
  return place.speed_share * flow.velocity(p, half_m);
}

}  // namespace swell::ocean
