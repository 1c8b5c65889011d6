#include "math/parallel.h"

#include <fmt/core.h>
#include <sched.h>

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
#include "math/stop.h"

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace swell {
namespace {

#if defined(__x86_64__)
// Two words of control, each of 16 bits: that of SSE, whose upper half stays as it is, and that of
// x87, by which the C library rounds the numbers that it reads and writes.
using ControlWord = std::uint16_t;
constexpr ControlWord kSseDefault = 0x1f80;  // all exceptions masked, to nearest, no FTZ, no DAZ
constexpr ControlWord kX87Default = 0x037f;  // the same, 64 bits of mantissa
constexpr ControlWord kX87Masks = 0x003f;

ControlWord sse_control() { return static_cast<ControlWord>(_mm_getcsr()); }

void set_sse_control(ControlWord word) { _mm_setcsr((_mm_getcsr() & ~0xffffu) | word); }

ControlWord x87_control() {
  ControlWord word;
  __asm__ volatile("fnstcw %0" : "=m"(word));
  return word;
}

void set_x87_control(ControlWord word) {
  // What was raised while it was masked would trap now.
  if ((word & kX87Masks) != kX87Masks) __asm__ volatile("fnclex");
  __asm__ volatile("fldcw %0" : : "m"(word));
}
#else
// Rounding, flushing and traps of 64-bit Arm: none but rounding to nearest where all bits are 0.
std::uint64_t fp_control() {
  std::uint64_t word;
  __asm__ volatile("mrs %0, fpcr" : "=r"(word));
  return word;
}

void set_fp_control(std::uint64_t word) { __asm__ volatile("msr fpcr, %0" : : "r"(word)); }
#endif

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
    check_stop();
    body(i, slot);
    if (observer_) observer_(WorkStep::kItemEnd, caller);
  }
  if (observer_) observer_(WorkStep::kLoopEnd, caller);
}

void Workers::run_both_in_turn(FunctionRef<void()> a, FunctionRef<void()> b,
                               const std::source_location& caller) const {
  if (observer_) observer_(WorkStep::kBothBegin, caller);
  a();
  check_stop();
  if (observer_) observer_(WorkStep::kBothMiddle, caller);
  b();
  check_stop();
  if (observer_) observer_(WorkStep::kBothEnd, caller);
}

#if defined(__x86_64__)
ScopedFloatEnvironment::ScopedFloatEnvironment()
    : saved_(static_cast<unsigned>(x87_control()) << 16 | sse_control()) {
  if (sse_control() != kSseDefault) set_sse_control(kSseDefault);
  if (x87_control() != kX87Default) set_x87_control(kX87Default);
}

ScopedFloatEnvironment::~ScopedFloatEnvironment() {
  const auto sse = static_cast<ControlWord>(saved_), x87 = static_cast<ControlWord>(saved_ >> 16);
  if (sse != sse_control()) set_sse_control(sse);
  if (x87 != x87_control()) set_x87_control(x87);
}
#else
ScopedFloatEnvironment::ScopedFloatEnvironment() : saved_(static_cast<unsigned>(fp_control())) {
  if (saved_ != 0) set_fp_control(0);
}

ScopedFloatEnvironment::~ScopedFloatEnvironment() {
  if (saved_ != fp_control()) set_fp_control(saved_);
}
#endif

}  // namespace swell
