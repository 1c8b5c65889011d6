#include "mesh_import/process_limits.h"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "shapes/run_importer.h"

namespace swell::mesh_import {
namespace {

#ifdef SWELL_SANITIZED
constexpr bool kLimitsMemory = false;  // the checks take terabytes of addresses
#else
constexpr bool kLimitsMemory = true;
#endif

// `now`, which can be raised to `most`. A bound that is lower already stays.
void limit(__rlimit_resource what, rlim_t now, rlim_t most) {
  rlimit before{};
  if (getrlimit(what, &before) != 0) return;
  most = std::min(most, before.rlim_cur);
  const rlimit bound{std::min(now, most), most};
  setrlimit(what, &bound);
}

void limit(__rlimit_resource what, rlim_t most) { limit(what, most, most); }

// What RLIMIT_DATA counts of this process.
std::uint64_t counted_memory() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t pages = 0;
  for (int field = 0; field < 6; ++field) file >> pages;  // the sixth: data and stack
  return file ? pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) : 0;
}

void bound_memory(const rlimit& bound) { setrlimit(RLIMIT_DATA, &bound); }

}  // namespace

bool end_with_parent(pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  // No signal comes for a parent that ended before the call: this process has another parent then.
  return getppid() == parent;
}

void limit_process() {
  limit(RLIMIT_CPU, shapes::kMostImport_s);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, 0);
  if (!kLimitsMemory) return;
  limit(RLIMIT_AS, kMostMemory);
  limit(RLIMIT_DATA, kLeastMemory, kMostMemory);
}

void allow_memory_for(std::uint64_t inputs) {
  rlimit bound{};
  if (!kLimitsMemory || getrlimit(RLIMIT_DATA, &bound) != 0) return;
  const std::uint64_t more = std::min(inputs, kMostMemory / kMemoryPerInput) * kMemoryPerInput;
  bound_memory({std::min(bound.rlim_cur + more, bound.rlim_max), bound.rlim_max});
}

void load_uncounted(const std::function<void()>& load) {
  rlimit bound{};
  if (!kLimitsMemory || getrlimit(RLIMIT_DATA, &bound) != 0) return load();
  bound_memory({bound.rlim_max, bound.rlim_max});
  const std::uint64_t before = counted_memory();
  load();
  const std::uint64_t taken = std::max(counted_memory(), before) - before;
  bound_memory({std::min(bound.rlim_cur + taken, bound.rlim_max), bound.rlim_max});
}

}  // namespace swell::mesh_import
