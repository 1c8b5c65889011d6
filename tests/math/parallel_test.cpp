#include "math/parallel.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cfenv>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "float_control.h"
#include "math/stop.h"
#include "refused_calls.h"

namespace swell {
namespace {

class WorkersOf : public testing::TestWithParam<int> {};

INSTANTIATE_TEST_SUITE_P(Threads, WorkersOf, testing::Values(1, 2, 3, 7, 16));

// Counts calls and watches that no two of them are in one slot at one time.
struct SlotWatch {
  explicit SlotWatch(int thread_count) : busy(static_cast<std::size_t>(thread_count)) {}

  void enter(int slot) {
    if (slot < 0 || static_cast<std::size_t>(slot) >= busy.size()) {
      ++violations;
    } else if (busy[static_cast<std::size_t>(slot)].exchange(true)) {
      ++violations;
    }
  }
  void leave(int slot) {
    if (slot >= 0 && static_cast<std::size_t>(slot) < busy.size()) {
      busy[static_cast<std::size_t>(slot)] = false;
    }
  }

  std::vector<std::atomic<bool>> busy;
  std::atomic<int> violations{0};
};

void spin(int rounds) {
  for (int i = 0; i < rounds; ++i) std::atomic_signal_fence(std::memory_order_seq_cst);
}

TEST_P(WorkersOf, ForEachCallsEveryIndexOnce) {
  Workers workers(GetParam());
  EXPECT_EQ(workers.thread_count(), GetParam());
  for (const std::size_t count : {0u, 1u, 2u, 5u, 16u, 17u, 1000u, 200000u}) {
    std::vector<std::atomic<int>> calls(count);
    std::atomic<std::size_t> outside{0};
    workers.for_each(count, [&](std::size_t i, int) {
      if (i < count) {
        calls[i].fetch_add(1, std::memory_order_relaxed);
      } else {
        ++outside;
      }
    });
    EXPECT_EQ(std::count(calls.begin(), calls.end(), 1), static_cast<std::ptrdiff_t>(count));
    EXPECT_EQ(outside, 0u);
  }
}

TEST_P(WorkersOf, ResultsAreVisibleToTheCallerAndToTheNextLoop) {
  Workers workers(GetParam());
  std::vector<int> first(1000), second(1000);  // plain memory: the loops must order it
  for (int round = 1; round <= 50; ++round) {
    workers.for_each(first.size(), [&](std::size_t i, int) { first[i] = round; });
    workers.for_each(first.size(),
                     [&](std::size_t i, int) { second[i] = first[first.size() - 1 - i]; });
    ASSERT_EQ(std::count(second.begin(), second.end(), round), 1000);
  }
}

TEST_P(WorkersOf, SlotsAreInRangeAndNeverSharedAtOneTime) {
  Workers workers(GetParam());
  SlotWatch watch(GetParam());
  for (int round = 0; round < 20; ++round) {
    workers.for_each(300, [&](std::size_t i, int slot) {
      watch.enter(slot);
      spin(static_cast<int>(i % 50));
      watch.leave(slot);
    });
  }
  EXPECT_EQ(watch.violations, 0);
}

TEST_P(WorkersOf, SlotsStayUniqueWhereTwoLoopsRunSideBySide) {
  Workers workers(GetParam());
  SlotWatch watch(GetParam());
  std::atomic<int> calls{0};
  const auto loop = [&] {
    for (int step = 0; step < 5; ++step) {
      workers.for_each(40, [&](std::size_t i, int slot) {
        watch.enter(slot);
        ++calls;
        spin(static_cast<int>(i % 50));
        watch.leave(slot);
      });
    }
  };
  for (int round = 0; round < 20; ++round) workers.run_both(loop, loop);
  EXPECT_EQ(watch.violations, 0);
  EXPECT_EQ(calls, 20 * 2 * 5 * 40);
}

TEST_P(WorkersOf, AllThreadsWorkSideBySide) {
  Workers workers(GetParam());
  const int threads = GetParam();
  std::atomic<int> arrived{0};
  const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  workers.for_each(static_cast<std::size_t>(threads), [&](std::size_t, int) {
    ++arrived;
    // Each body waits for all others, which fewer threads can never satisfy.
    while (arrived < threads && std::chrono::steady_clock::now() < limit) {
      std::this_thread::sleep_for(std::chrono::microseconds(50));
    }
  });
  EXPECT_LT(std::chrono::steady_clock::now(), limit);
}

TEST_P(WorkersOf, RunBothRunsEachSideOnce) {
  Workers workers(GetParam());
  for (int round = 0; round < 100; ++round) {
    int a = 0, b = 0;
    workers.run_both([&] { ++a; }, [&] { b += 2; });
    ASSERT_EQ(a, 1);
    ASSERT_EQ(b, 2);
  }
}

TEST_P(WorkersOf, ALoopInsideABodyCoversItsIndicesWithSlotsInRange) {
  Workers workers(GetParam());
  std::vector<std::atomic<int>> calls(50 * 20);
  std::atomic<int> bad_slots{0};
  workers.for_each(50, [&](std::size_t i, int) {
    workers.for_each(20, [&](std::size_t j, int slot) {
      ++calls[i * 20 + j];
      if (slot < 0 || slot >= GetParam()) ++bad_slots;
    });
  });
  EXPECT_EQ(std::count(calls.begin(), calls.end(), 1), 50 * 20);
  EXPECT_EQ(bad_slots, 0);
}

TEST_P(WorkersOf, InnerBodiesHaveSlotsOfTheirOwn) {
  Workers workers(GetParam());
  SlotWatch watch(GetParam());
  workers.for_each(50, [&](std::size_t, int) {
    workers.for_each(20, [&](std::size_t j, int slot) {
      watch.enter(slot);
      spin(static_cast<int>(10 * j));
      watch.leave(slot);
    });
  });
  EXPECT_EQ(watch.violations, 0);
}

TEST_P(WorkersOf, AnExceptionReachesTheCallerAndThePoolSurvives) {
  Workers workers(GetParam());
  for (int round = 0; round < 20; ++round) {
    std::string caught;
    try {
      workers.for_each(100, [&](std::size_t i, int) {
        if (i == 37) throw std::runtime_error("index 37");
      });
    } catch (const std::runtime_error& error) {
      caught = error.what();
    }
    ASSERT_EQ(caught, "index 37");
    std::atomic<int> calls{0};
    workers.for_each(100, [&](std::size_t, int) { ++calls; });
    ASSERT_EQ(calls, 100);
  }
}

TEST_P(WorkersOf, OneExceptionArrivesWhereEveryBodyThrows) {
  Workers workers(GetParam());
  EXPECT_THROW(workers.for_each(100, [](std::size_t, int) { throw std::logic_error("all"); }),
               std::logic_error);
  EXPECT_NO_THROW(workers.for_each(100, [](std::size_t, int) {}));
}

TEST_P(WorkersOf, AnExceptionOfALoopInsideRunBothReachesTheCaller) {
  Workers workers(GetParam());
  const auto throws = [&] {
    workers.for_each(30, [](std::size_t i, int) {
      if (i == 7) throw std::out_of_range("inner");
    });
  };
  EXPECT_THROW(workers.run_both(throws, [] {}), std::out_of_range);
  EXPECT_THROW(workers.run_both([] {}, throws), std::out_of_range);
  int sides = 0;
  workers.run_both([&] { ++sides; }, [] {});
  EXPECT_EQ(sides, 1);
}

// A program linked with -ffast-math sets flush-to-zero for its whole process.
TEST_P(WorkersOf, WorkThatIsToldToStopEndsBetweenTwoBodies) {
  Workers workers(GetParam());
  std::atomic<bool> stop{false};
  std::atomic<int> calls{0};
  const ScopedStop stoppable(&stop);
  const auto count_up = [&](std::size_t, int) {
    if (++calls == 10) stop = true;
  };
  EXPECT_THROW(workers.for_each(100000, count_up), Stopped);
  EXPECT_GE(calls, 10);
  EXPECT_LT(calls, 10 + 2 * GetParam());  // at most one more on each thread
  EXPECT_THROW(workers.for_each(1, count_up), Stopped);
  EXPECT_THROW(workers.run_both([] {}, [] {}), Stopped);

  stop = false;  // the pool is as good as before
  calls = 100;
  workers.for_each(1000, count_up);
  EXPECT_EQ(calls, 1100);
}

TEST_P(WorkersOf, ALoopThatIsStoppedInsideOthersIsNeverTakenForDone) {
  Workers workers(GetParam());
  for (int round = 0; round < 20; ++round) {
    std::atomic<bool> stop{false};
    std::atomic<int> half_done{0};
    const ScopedStop stoppable(&stop);
    const auto side = [&](bool stops) {
      for (int loop = 0; loop < 50; ++loop) {
        std::atomic<int> calls{0};
        workers.for_each(40, [&](std::size_t i, int) {
          if (stops && loop == round && i == 7) stop = true;
          spin(1000);
          ++calls;
        });
        if (calls != 40) ++half_done;
      }
    };
    EXPECT_THROW(workers.run_both([&] { side(true); }, [&] { side(false); }), Stopped);
    EXPECT_EQ(half_done, 0);
  }
}

TEST(ScopedStop, HoldsForItsScopeAndItsThreadAlone) {
  std::atomic<bool> stop{true};
  check_stop();
  {
    const ScopedStop stoppable(&stop);
    EXPECT_THROW(check_stop(), Stopped);
    std::thread([] { EXPECT_NO_THROW(check_stop()); }).join();
    {
      const ScopedStop goes_on(nullptr);
      EXPECT_NO_THROW(check_stop());
    }
    EXPECT_THROW(check_stop(), Stopped);
  }
  EXPECT_EQ(stop_of_thread(), nullptr);
}

TEST_P(WorkersOf, BodiesHaveIeeeArithmeticWhateverTheCallerHasSet) {
  const std::uint64_t before = float_control();
  const std::uint64_t callers = before | kFlushToZero | kRoundUp;
  set_float_control(callers);
  std::atomic<int> wrong{0};
  const auto inspect = [&] {
    if ((float_control() & kControlBits) != kFloatDefaults) ++wrong;
    const volatile float smallest_normal = std::numeric_limits<float>::min();
    const volatile float half = smallest_normal * 0.5f;
    if (half == 0.0f || half * 2.0f != smallest_normal) ++wrong;
  };
  {
    Workers workers(GetParam());
    for (int round = 0; round < 10; ++round) {
      workers.for_each(100, [&](std::size_t, int) { inspect(); });
      workers.run_both([&] { inspect(); },
                       [&] { workers.for_each(50, [&](std::size_t, int) { inspect(); }); });
    }
    EXPECT_EQ(float_control() & kControlBits, callers & kControlBits);
  }
  set_float_control(before);
  EXPECT_EQ(wrong, 0);
}

TEST_P(WorkersOf, TheCallersFloatStateComesBackAfterAnException) {
  const std::uint64_t before = float_control();
  set_float_control(before | kFlushToZero);
  {
    Workers workers(GetParam());
    EXPECT_THROW(workers.for_each(10, [](std::size_t, int) { throw std::logic_error("x"); }),
                 std::logic_error);
  }
  const std::uint64_t after = float_control();
  set_float_control(before);
  EXPECT_EQ(after & kControlBits, (before | kFlushToZero) & kControlBits);
}

TEST_P(WorkersOf, BodiesInAFixedPlaceGiveTheSameBitsForAnyThreadCount) {
  const auto compute = [](Workers& workers) {
    std::vector<double> out(5000);
    workers.for_each(out.size(), [&](std::size_t i, int) {
      double x = static_cast<double>(i);
      for (int k = 0; k < 50; ++k) x = std::sqrt(x * 1.1 + k);
      out[i] = x;
    });
    return out;
  };
  Workers alone(1), many(GetParam());
  EXPECT_EQ(compute(many), compute(alone));
}

TEST(Workers, SeveralPoolsCanExistAtOneTime) {
  Workers two(2), three(3);
  std::atomic<int> calls{0};
  for (int round = 0; round < 20; ++round) {
    two.for_each(10, [&](std::size_t, int) { ++calls; });
    three.for_each(10, [&](std::size_t, int) { ++calls; });
  }
  EXPECT_EQ(calls, 400);
}

// oneTBB would end the program where a thread cannot be started.
TEST(Workers, ThatGetTooFewThreadsAreRefused) {
  const pid_t child = fork();
  if (child == 0) {
    if (!refuse_threads()) _exit(9);
    Workers alone(1);
    int calls = 0;
    alone.for_each(3, [&](std::size_t, int) { ++calls; });
    try {
      Workers many(8);
    } catch (const std::runtime_error& error) {
      _exit(calls == 3 && std::string(error.what()).find("0 of 7") != std::string::npos ? 3 : 4);
    }
    _exit(0);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 3);
}

TEST(ScopedFloatEnvironment, SetsIeeeDefaultsAndRestoresTheOldState) {
  const std::uint64_t before = float_control();
  set_float_control(before | kFlushToZero | kRoundUp);
  std::uint64_t inside = 0;
  int rounding_inside = -1;
  {
    const ScopedFloatEnvironment ieee;
    inside = float_control();
    rounding_inside = std::fegetround();
  }
  const std::uint64_t after = float_control();
  set_float_control(before);
  EXPECT_EQ(inside & kControlBits, kFloatDefaults);
  EXPECT_EQ(after, before | kFlushToZero | kRoundUp);
  EXPECT_EQ(rounding_inside, FE_TONEAREST);
}

TEST(AvailableCpus, IsBoundedByTheAffinityMask) {
  cpu_set_t old_mask, one_cpu;
  ASSERT_EQ(sched_getaffinity(0, sizeof(old_mask), &old_mask), 0);
  EXPECT_GE(available_cpus(), 1);
  EXPECT_LE(available_cpus(), CPU_COUNT(&old_mask));
  CPU_ZERO(&one_cpu);
  int first = 0;
  while (!CPU_ISSET(first, &old_mask)) ++first;
  CPU_SET(first, &one_cpu);
  ASSERT_EQ(sched_setaffinity(0, sizeof(one_cpu), &one_cpu), 0);
  EXPECT_EQ(available_cpus(), 1);
  sched_setaffinity(0, sizeof(old_mask), &old_mask);
}

TEST(FunctionRef, CallsWhatItWasMadeFromWithoutACopy) {
  int calls = 0;
  auto counting = [&calls, own = 0](int step) mutable {
    own += step;
    calls = own;
    return own;
  };
  const FunctionRef<int(int)> ref = counting;
  EXPECT_EQ(ref(2), 2);
  EXPECT_EQ(ref(3), 5);
  EXPECT_EQ(counting(1), 6);  // one state, not two
  EXPECT_EQ(calls, 6);
}

TEST(Workers, AnObserverIsToldOfEachStepAndOfItsCaller) {
  Workers workers(1);
  std::string steps;
  workers.observe([&](WorkStep step, const std::source_location& caller) {
    steps += "(i)<|>"[static_cast<std::size_t>(step)];
    EXPECT_NE(std::string(caller.file_name()).find("parallel_test.cpp"), std::string::npos);
  });
  const auto body = [&](std::size_t i, int) { steps += std::to_string(i); };
  workers.run_both([&] { workers.for_each(3, body); }, [&] { steps += "b"; });
  workers.for_each(0, body);
  EXPECT_EQ(steps, "<(0i1i2i)|b>()");
  workers.observe({});
  workers.for_each(1, body);
  EXPECT_EQ(steps, "<(0i1i2i)|b>()0");
}

}  // namespace
}  // namespace swell
