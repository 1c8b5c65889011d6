#include "math/parallel.h"

#include <sched.h>
#include <xmmintrin.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string>

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

ScopedFloatEnvironment::ScopedFloatEnvironment() : saved_(_mm_getcsr()) {
  if (saved_ != kMxcsrDefault) _mm_setcsr(kMxcsrDefault);
}

ScopedFloatEnvironment::~ScopedFloatEnvironment() {
  if (saved_ != _mm_getcsr()) _mm_setcsr(saved_);
}

}  // namespace swell
