#include "apps/view/frame_history.h"

#include <algorithm>
#include <cmath>

namespace swell::view {

void add_frame(FrameHistory& history, double frame_ms) {
  history.frame_ms[history.next] = static_cast<float>(frame_ms);
  history.next = (history.next + 1) % FrameHistory::kLength;
  history.count = std::min(history.count + 1, FrameHistory::kLength);
}

double percentile_ms(const FrameHistory& history, double p) {
  if (history.count == 0) return 0.0;
  std::array<float, FrameHistory::kLength> sorted = history.frame_ms;
  const double rank = std::ceil(p * static_cast<double>(history.count));
  const auto index = static_cast<std::size_t>(std::max(rank, 1.0)) - 1;
  const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(history.count);
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(index), end);
  return sorted[index];
}

double share_over_budget(const FrameHistory& history, double budget_ms) {
  if (history.count == 0) return 0.0;
  const auto end = history.frame_ms.begin() + static_cast<std::ptrdiff_t>(history.count);
  const auto over = std::count_if(history.frame_ms.begin(), end, [budget_ms](float ms) {
    return static_cast<double>(ms) > budget_ms;
  });
  return static_cast<double>(over) / static_cast<double>(history.count);
}

}  // namespace swell::view
