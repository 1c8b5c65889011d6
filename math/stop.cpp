#include "math/stop.h"

namespace swell {
namespace {

thread_local const std::atomic<bool>* current_stop = nullptr;

}  // namespace

ScopedStop::ScopedStop(const std::atomic<bool>* stop) : before_(current_stop) {
  current_stop = stop;
}

ScopedStop::~ScopedStop() { current_stop = before_; }

const std::atomic<bool>* stop_of_thread() { return current_stop; }

void check_stop() {
  if (current_stop && current_stop->load(std::memory_order_relaxed)) throw Stopped();
}

}  // namespace swell
