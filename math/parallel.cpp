#include "math/parallel.h"

#include <fmt/core.h>
#include <sched.h>
#include <xmmintrin.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "math/check.h"

namespace swell {
namespace {

constexpr unsigned kMxcsrDefault = 0x1f80;  // all exceptions masked, to nearest, no FTZ, no DAZ

// CPUs granted by a cgroup v2 quota ("max 100000" or "QUOTA PERIOD"), or 0 if there is none.
int cgroup_cpus() {
  std::ifstream file("/sys/fs/cgroup/cpu.max");
  std::string quota;
  double period = 0.0;
  if (!(file >> quota >> period) || quota == "max" || period <= 0.0) return 0;
  return static_cast<int>(std::ceil(std::strtod(quota.c_str(), nullptr) / period));
}

}  // namespace

int available_cpus() {
  cpu_set_t set;
  CPU_ZERO(&set);
  int cpus = sched_getaffinity(0, sizeof(set), &set) == 0 ? CPU_COUNT(&set) : 1;
  if (const int quota = cgroup_cpus(); quota > 0) cpus = std::min(cpus, quota);
  return std::clamp(cpus, 1, 256);
}

void check_threads(int count) {
  struct Waiting {
    std::atomic<bool> may_end{false};
    std::vector<std::thread> threads;
    ~Waiting() {
      may_end = true;
      may_end.notify_all();
      for (std::thread& thread : threads) thread.join();
    }
  } waiting;
  waiting.threads.reserve(static_cast<std::size_t>(count));
  try {
    while (std::ssize(waiting.threads) < count)
      waiting.threads.emplace_back([&] { waiting.may_end.wait(false); });
  } catch (const std::system_error& error) {
    throw std::runtime_error(fmt::format("threads besides those that run, got {} of {}: {}",
                                         waiting.threads.size(), count, error.code().message()));
  }
}

void Workers::observe(WorkObserver observer) {
  SWELL_CHECK(thread_count_ == 1, "thread_count={}", thread_count_);
  observer_ = std::move(observer);
}

void Workers::for_each_alone(std::size_t count, FunctionRef<void(std::size_t, int)> body, int slot,
                             const std::source_location& caller) const {
  if (observer_) observer_(WorkStep::kLoopBegin, caller);
  for (std::size_t i = 0; i < count; ++i) {
    body(i, slot);
    if (observer_) observer_(WorkStep::kItemEnd, caller);
  }
  if (observer_) observer_(WorkStep::kLoopEnd, caller);
}

void Workers::run_both_in_turn(FunctionRef<void()> a, FunctionRef<void()> b,
                               const std::source_location& caller) const {
  if (observer_) observer_(WorkStep::kBothBegin, caller);
  a();
  if (observer_) observer_(WorkStep::kBothMiddle, caller);
  b();
  if (observer_) observer_(WorkStep::kBothEnd, caller);
}

ScopedFloatEnvironment::ScopedFloatEnvironment() : saved_(_mm_getcsr()) {
  if (saved_ != kMxcsrDefault) _mm_setcsr(kMxcsrDefault);
}

ScopedFloatEnvironment::~ScopedFloatEnvironment() {
  if (saved_ != _mm_getcsr()) _mm_setcsr(saved_);
}

}  // namespace swell
