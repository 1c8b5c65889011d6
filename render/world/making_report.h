// Who makes a world says here what is made; the caller is told how far it is.
#pragma once

#include <chrono>
#include <mutex>
#include <string_view>
#include <vector>

#include "render/world/part_needs.h"
#include "render/world/world_making.h"
#include "scene/scene.h"

namespace swell::render {

// Several threads may use one at a time.
class MakingReport {
 public:
  using Clock = std::chrono::steady_clock;

  // Throws OverMemoryBound if the scene's parts need too much. `making` outlives it.
  MakingReport(const scene::Scene& scene, const WorldMaking& making);

  void has(std::string_view part);  // which was there already
  void made(std::string_view part, Clock::time_point start);
  void read(std::string_view part, Clock::time_point start);  // from a cache
  void finish();                                              // all are there

 private:
  void log(std::string_view part, Clock::time_point start, std::string_view how);
  void tell(double done);

  const WorldMaking& making_;
  std::mutex mutex_;  // of what follows, and of the calls to the caller
  std::vector<PartNeed> missing_;
  double all_s_ = 0.0, missing_s_ = 0.0;
};

}  // namespace swell::render
