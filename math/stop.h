// Work that its caller may no longer want. Long loops ask here whether to go on; Workers ask before
// each body, for the thread that called them.
//
//   std::atomic<bool> stop = false;  // any thread may set it
//   const ScopedStop stoppable(&stop);
//   make_something();  // throws Stopped soon after `stop` is set
#pragma once

#include <atomic>
#include <exception>

namespace swell {

// Not a std::runtime_error: what handles those would take it for a fault.
class Stopped : public std::exception {
 public:
  const char* what() const noexcept override { return "stopped"; }
};

// While it lives, `stop` ends the work of this thread, and of Workers that it calls. Null: nothing
// does. Restores what was before at scope exit.
class ScopedStop {
 public:
  explicit ScopedStop(const std::atomic<bool>* stop);
  ~ScopedStop();
  ScopedStop(const ScopedStop&) = delete;
  ScopedStop& operator=(const ScopedStop&) = delete;

 private:
  const std::atomic<bool>* before_;
};

// What ends the work of this thread, or null.
const std::atomic<bool>* stop_of_thread();

// Throws Stopped if the work of this thread is to end; else costs 2 ns.
void check_stop();

}  // namespace swell
