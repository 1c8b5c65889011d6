#include "apps/dataset/instances.h"

#include <algorithm>
#include <map>

namespace swell::apps {
namespace {

// What is known of an instance while columns are gone through.
struct Growing {
  int left, right, top, bottom;       // inclusive
  std::int64_t area_px = 0, end = 0;  // `end`: of its last run
  std::vector<std::int64_t> runs;
};

}  // namespace

std::vector<Instance> find_instances(std::span<const std::uint32_t> ids, int width_px,
                                     std::uint32_t first, std::uint32_t end) {
  const int height_px = static_cast<int>(std::ssize(ids)) / width_px;
  std::map<std::uint32_t, Growing> growing;
  for (int x = 0; x < width_px; ++x)
    for (int y = 0; y < height_px; ++y) {
      const std::uint32_t id = ids[static_cast<std::size_t>(y) * width_px + x];
      if (id < first || id >= end) continue;
      Growing& g = growing.try_emplace(id, Growing{x, x, y, y, 0, 0, {}}).first->second;
      g.left = std::min(g.left, x);
      g.right = std::max(g.right, x);
      g.top = std::min(g.top, y);
      g.bottom = std::max(g.bottom, y);
      const std::int64_t place = std::int64_t{x} * height_px + y;
      if (g.runs.empty() || place != g.end) {
        g.runs.push_back(place - g.end);
        g.runs.push_back(0);
      }
      ++g.runs.back();
      ++g.area_px;
      g.end = place + 1;
    }
  std::vector<Instance> instances;
  for (auto& [id, g] : growing) {
    if (const std::int64_t rest = std::ssize(ids) - g.end; rest > 0) g.runs.push_back(rest);
    instances.push_back({id, g.left, g.top, g.right - g.left + 1, g.bottom - g.top + 1, g.area_px,
                         std::move(g.runs)});
  }
  return instances;
}

}  // namespace swell::apps
