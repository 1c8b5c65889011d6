#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "math/check.h"
#include "math/parallel.h"
#include "math/stop.h"

namespace swell {
namespace {

// The slot of the body this thread is in, or -1. A nested loop runs where it stands, so it keeps
// the slot.
thread_local int current_slot = -1;

}  // namespace

struct Workers::Pool {
  struct Loop {
    std::size_t count = 0;
    FunctionRef<void(std::size_t, int)>* body = nullptr;
    const std::atomic<bool>* stop = nullptr;
    std::atomic<std::size_t> next{0};
  };

  explicit Pool(int threads) {
    try {
      for (int slot = 1; slot < threads; ++slot) helpers.emplace_back([this, slot] { help(slot); });
    } catch (...) {
      stop();
      throw;
    }
  }

  ~Pool() { stop(); }

  void stop() {
    {
      const std::lock_guard lock(mutex);
      stopping = true;
    }
    wake.notify_all();
    for (std::thread& helper : helpers) helper.join();
  }

  // Takes indices until none is left; the first exception is kept and ends the loop.
  void work(int slot) {
    const ScopedFloatEnvironment ieee;
    const ScopedStop stoppable(loop.stop);
    current_slot = slot;
    for (std::size_t i; (i = loop.next.fetch_add(1)) < loop.count;) {
      try {
        check_stop();
        (*loop.body)(i, slot);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!error) error = std::current_exception();
        loop.next = loop.count;
      }
    }
    current_slot = -1;
  }

  void help(int slot) {
    std::size_t seen = 0;
    std::unique_lock lock(mutex);
    while (true) {
      wake.wait(lock, [&] { return stopping || generation != seen; });
      if (stopping) return;
      seen = generation;
      lock.unlock();
      work(slot);
      lock.lock();
      if (--busy == 0) done.notify_one();
    }
  }

  void run(std::size_t count, FunctionRef<void(std::size_t, int)> body) {
    {
      const std::lock_guard lock(mutex);
      loop.count = count;
      loop.body = &body;
      loop.stop = stop_of_thread();
      loop.next = 0;
      busy = helpers.size();
      error = nullptr;
      ++generation;
    }
    wake.notify_all();
    work(0);
    std::unique_lock lock(mutex);
    done.wait(lock, [&] { return busy == 0; });
    if (error) std::rethrow_exception(error);
  }

  std::mutex mutex;
  std::condition_variable wake, done;
  Loop loop;
  std::size_t generation = 0, busy = 0;
  bool stopping = false;
  std::exception_ptr error;
  std::vector<std::thread> helpers;
};

Workers::Workers(int thread_count) : thread_count_(thread_count) {
  SWELL_CHECK(thread_count >= 1 && thread_count <= 256, "thread_count={}", thread_count);
  check_threads(thread_count - 1);
  pool_ = std::make_unique<Pool>(thread_count);
}

Workers::~Workers() = default;

void Workers::for_each(std::size_t count, FunctionRef<void(std::size_t, int)> body,
                       const std::source_location& caller) {
  if (current_slot >= 0 || thread_count_ == 1) {
    const ScopedFloatEnvironment ieee;
    return for_each_alone(count, body, thread_count_ == 1 ? 0 : current_slot, caller);
  }
  pool_->run(count, body);
}

// One after the other: the loops inside each already use every thread.
void Workers::run_both(FunctionRef<void()> a, FunctionRef<void()> b,
                       const std::source_location& caller) {
  const ScopedFloatEnvironment ieee;
  run_both_in_turn(a, b, caller);
}

}  // namespace swell
