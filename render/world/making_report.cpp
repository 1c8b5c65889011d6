#include "render/world/making_report.h"

#include <fmt/core.h>

#include "scene/coast.h"

namespace swell::render {

MakingReport::MakingReport(const scene::Scene& scene, const WorldMaking& making)
    : making_(making), missing_(part_needs(scene)) {
  std::size_t bytes = 0;
  for (const PartNeed& part : missing_) {
    all_s_ += part.seconds;
    bytes += part.bytes;
  }
  missing_s_ = all_s_;
  if (making.most_bytes != 0 && bytes > making.most_bytes)
    throw OverMemoryBound(fmt::format(
        "memory of the world, got a need of up to {} bytes, allowed {}", bytes, making.most_bytes));
  const std::string work = scene::slow_coast_text(scene);
  if (making.log && !work.empty()) making.log(fmt::format("note: {}; that takes a while", work));
}

void MakingReport::has(std::string_view part) {
  const std::lock_guard lock(mutex_);
  const auto found = std::ranges::find(missing_, part, &PartNeed::name);
  if (found == missing_.end()) return;
  missing_s_ -= found->seconds;
  missing_.erase(found);
  tell(1.0 - missing_s_ / all_s_);
}

void MakingReport::made(std::string_view part, Clock::time_point start) {
  has(part);
  log(part, start, "");
}

void MakingReport::read(std::string_view part, Clock::time_point start) {
  has(part);
  log(part, start, ", read from the cache");
}

void MakingReport::log(std::string_view part, Clock::time_point start, std::string_view how) {
  if (!making_.log) return;
  const std::chrono::duration<double> time = Clock::now() - start;
  const std::lock_guard lock(mutex_);
  making_.log(fmt::format("{}: {:.3f} s{}", part, time.count(), how));
}

void MakingReport::finish() {
  const std::lock_guard lock(mutex_);
  tell(1.0);
}

void MakingReport::tell(double done) {
  if (making_.tell) making_.tell(done);
}

}  // namespace swell::render
