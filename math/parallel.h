// The one door to threads. Two back ends, chosen at build time (SWELL_PARALLEL): oneTBB, and a
// std::thread pool that ThreadSanitizer can see through.
//
// Determinism: a body must write only to places fixed by its index; nothing may depend on which
// thread runs it or when. `slot` exists for scratch memory alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <source_location>
#include <type_traits>
#include <utility>

namespace swell {

// A borrowed callable: valid while the callable it was made from lives.
template <class Signature>
class FunctionRef;

template <class Result, class... Args>
class FunctionRef<Result(Args...)> {
 public:
  template <class F>
  requires(!std::is_same_v<std::remove_cvref_t<F>, FunctionRef>)
      FunctionRef(F&& f)  // NOLINT: implicit by design, as a parameter type
      : object_(const_cast<void*>(static_cast<const void*>(std::addressof(f)))),
        call_([](void* object, Args... args) -> Result {
          return (*static_cast<std::remove_reference_t<F>*>(object))(std::forward<Args>(args)...);
        }) {}

  Result operator()(Args... args) const { return call_(object_, std::forward<Args>(args)...); }

 private:
  void* object_;
  Result (*call_)(void*, Args...);
};

// What for_each and run_both do one after the other where there is one thread.
enum class WorkStep : std::uint8_t {
  kLoopBegin,  // of for_each
  kItemEnd,    // after each body
  kLoopEnd,
  kBothBegin,   // of run_both, before a
  kBothMiddle,  // before b
  kBothEnd,
};
using WorkObserver = std::function<void(WorkStep step, const std::source_location& caller)>;

// A fixed number of threads that work together on one frame at a time. Every body runs with
// IEEE defaults (round to nearest, no flush to zero), whatever the calling program has set.
// An exception of a body reaches the caller; the pool stays usable. math/stop.h ends loops early.
class Workers {
 public:
  // thread_count in [1, 256], the calling thread included. Throws std::runtime_error if the system
  // does not let us start so many, for which it starts them once beforehand (30 us each): where
  // oneTBB cannot start one later it ends the program.
  explicit Workers(int thread_count);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  int thread_count() const { return thread_count_; }

  // Calls body(index, slot) once for each index in [0, count), in any order, and returns when all
  // are done. slot in [0, thread_count) is not used by two bodies at one time; but a body that
  // calls Workers again waits there, and its thread may take up another body with the same slot
  // meanwhile, so it must not keep scratch memory across that call. After an exception the
  // remaining indices may be left out. Make an index a coarse piece of work (a tile, a row, a
  // thousand vertices).
  void for_each(std::size_t count, FunctionRef<void(std::size_t index, int slot)> body,
                const std::source_location& caller = std::source_location::current());

  // Calls a() and b(), side by side where there are threads for it; both may use for_each. If
  // one throws, the other may not have run.
  void run_both(FunctionRef<void()> a, FunctionRef<void()> b,
                const std::source_location& caller = std::source_location::current());

  // Tells the observer of each step from now on; an empty one ends that. For one thread alone,
  // whose steps say what more threads could share: aborts with more.
  void observe(WorkObserver observer);

 private:
  struct Pool;
  void for_each_alone(std::size_t count, FunctionRef<void(std::size_t, int)> body, int slot,
                      const std::source_location& caller) const;
  void run_both_in_turn(FunctionRef<void()> a, FunctionRef<void()> b,
                        const std::source_location& caller) const;

  int thread_count_;
  std::unique_ptr<Pool> pool_;
  WorkObserver observer_;
};

// The number of CPUs this process may use: the affinity mask and the cgroup quota, at least 1.
int available_cpus();

// Starts so many threads at once, which end again. Throws std::runtime_error if there are fewer.
void check_threads(int count);

// Sets IEEE defaults for the calling thread (SSE and x87); restores the old state at scope exit.
class ScopedFloatEnvironment {
 public:
  ScopedFloatEnvironment();
  ~ScopedFloatEnvironment();
  ScopedFloatEnvironment(const ScopedFloatEnvironment&) = delete;
  ScopedFloatEnvironment& operator=(const ScopedFloatEnvironment&) = delete;

 private:
  unsigned saved_;
};

}  // namespace swell
