#include "ocean/inland/segment_index.h"

#include <algorithm>
#include <cmath>

namespace swell::ocean {

SegmentPoint nearest_on(const Segment& segment, glm::dvec2 p) {
  const glm::dvec2 along = segment.b - segment.a, to_p = p - segment.a;
  const double length2 = glm::dot(along, along);
  const double t = length2 > 0.0 ? std::clamp(glm::dot(to_p, along) / length2, 0.0, 1.0) : 0.0;
  return {t, glm::length(to_p - t * along)};
}

SegmentIndex::SegmentIndex(std::span<const Segment> segments, double cell_m) : cell_m_(cell_m) {
  if (segments.empty()) return;
  glm::dvec2 low(HUGE_VAL), high(-HUGE_VAL);
  for (const Segment& s : segments) {
    low = glm::min(low, glm::min(s.a, s.b) - s.reach_m);
    high = glm::max(high, glm::max(s.a, s.b) + s.reach_m);
  }
  corner_ = low;
  cells_x_ = static_cast<int>((high.x - low.x) / cell_m) + 1;
  cells_y_ = static_cast<int>((high.y - low.y) / cell_m) + 1;
  // Calls visit(cell) for the cells that a segment reaches.
  const auto for_cells = [&](const Segment& s, auto&& visit) {
    const glm::dvec2 from = (glm::min(s.a, s.b) - s.reach_m - corner_) / cell_m_;
    const glm::dvec2 to = (glm::max(s.a, s.b) + s.reach_m - corner_) / cell_m_;
    const double half_diagonal_m = cell_m_ * std::sqrt(0.5);
    for (int y = std::max(0, static_cast<int>(from.y));
         y <= std::min(cells_y_ - 1, static_cast<int>(to.y)); ++y)
      for (int x = std::max(0, static_cast<int>(from.x));
           x <= std::min(cells_x_ - 1, static_cast<int>(to.x)); ++x) {
        const glm::dvec2 middle = corner_ + cell_m_ * glm::dvec2(x + 0.5, y + 0.5);
        if (nearest_on(s, middle).distance_m <= s.reach_m + half_diagonal_m)
          visit(static_cast<std::size_t>(y) * cells_x_ + x);
      }
  };
  begin_.assign(static_cast<std::size_t>(cells_x_) * cells_y_ + 1, 0);
  for (const Segment& s : segments) for_cells(s, [&](std::size_t cell) { ++begin_[cell + 1]; });
  for (std::size_t cell = 1; cell < begin_.size(); ++cell) begin_[cell] += begin_[cell - 1];
  list_.resize(begin_.back());
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t n = 0; n < segments.size(); ++n)
    for_cells(segments[n],
              [&](std::size_t cell) { list_[next[cell]++] = static_cast<std::uint32_t>(n); });
}

std::span<const std::uint32_t> SegmentIndex::near(glm::dvec2 p) const {
  const glm::dvec2 at = (p - corner_) / cell_m_;
  if (!(at.x >= 0.0 && at.y >= 0.0 && at.x < cells_x_ && at.y < cells_y_)) return {};
  const std::size_t cell =
      static_cast<std::size_t>(at.y) * cells_x_ + static_cast<std::size_t>(at.x);
  return std::span(list_).subspan(begin_[cell], begin_[cell + 1] - begin_[cell]);
}

}  // namespace swell::ocean
