// A lock that a handler of signals may take.
#pragma once

#include <atomic>
#include <csignal>
#include <ctime>

namespace swell::texture {

// In static storage. It is short work that waits for it: no wake-up, only another look.
class SignalLock {
 public:
  void take() noexcept {
    constexpr timespec kMoment{0, 50'000};
    while (taken_.test_and_set(std::memory_order_acquire)) ::nanosleep(&kMoment, nullptr);
  }
  void leave() noexcept { taken_.clear(std::memory_order_release); }

 private:
  std::atomic_flag taken_;
};

// Takes the lock while it lives. This thread handles no signal meanwhile, so that a handler that
// waits for the lock never waits for the thread that it interrupts.
class SignalLockGuard {
 public:
  explicit SignalLockGuard(SignalLock& lock) : lock_(lock) {
    sigset_t all;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &before_);
    lock_.take();
  }
  ~SignalLockGuard() {
    lock_.leave();
    ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  SignalLockGuard(const SignalLockGuard&) = delete;
  SignalLockGuard& operator=(const SignalLockGuard&) = delete;

 private:
  SignalLock& lock_;
  sigset_t before_;
};

}  // namespace swell::texture
