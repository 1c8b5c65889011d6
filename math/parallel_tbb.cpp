#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include "math/check.h"
#include "math/parallel.h"

namespace swell {

struct Workers::Pool {
  explicit Pool(int threads) : arena(threads) {}
  tbb::task_arena arena;
};

Workers::Workers(int thread_count) : thread_count_(thread_count) {
  SWELL_CHECK(thread_count >= 1 && thread_count <= 256, "thread_count={}", thread_count);
  pool_ = std::make_unique<Pool>(thread_count);
}

Workers::~Workers() = default;

void Workers::for_each(std::size_t count, FunctionRef<void(std::size_t, int)> body) {
  const ScopedFloatEnvironment ieee;
  if (thread_count_ == 1) {
    for (std::size_t i = 0; i < count; ++i) body(i, 0);
    return;
  }
  pool_->arena.execute([&] {
    tbb::parallel_for(
        std::size_t{0}, count,
        [&](std::size_t i) {
          const ScopedFloatEnvironment ieee_worker;
          body(i, tbb::this_task_arena::current_thread_index());
        },
        tbb::simple_partitioner{});
  });
}

void Workers::run_both(FunctionRef<void()> a, FunctionRef<void()> b) {
  const ScopedFloatEnvironment ieee;
  if (thread_count_ == 1) {
    a();
    b();
    return;
  }
  const auto with_ieee = [](FunctionRef<void()> f) {
    const ScopedFloatEnvironment ieee_worker;
    f();
  };
  pool_->arena.execute(
      [&] { tbb::parallel_invoke([&] { with_ieee(a); }, [&] { with_ieee(b); }); });
}

}  // namespace swell
