// Runs by a clock of their own: when messages are made and given, and what is said of it.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/sim/costs.h"
#include "apps/sim/run.h"

namespace swell::apps {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr std::int64_t kMillisecond_ns = 1'000'000;
constexpr std::int64_t kSomeUtc_ns = 1'790'000'000'123'456'789;

std::int64_t ns_since(SteadyClock::time_point start) {
  return std::chrono::nanoseconds(SteadyClock::now() - start).count();
}

// A clock of 200 Hz, and when its messages were made and given.
class TimedRun : public MessageOutput {
 public:
  struct Entry {
    std::int64_t stamp_ns, at_ns;  // since the begin
  };

  TimedRun() {
    const std::size_t topic = simulation_.topic("/clock", msg::Clock::kType);
    simulation_.sources.push_back(
        {"clock", "clock", 200.0, [this, topic](const Moment& moment, const Emit& emit) {
           made.push_back({moment.t_ns, ns_since(start_)});
           ++made_so_far_;
           emit(topic, msg::Clock{moment.stamp()});
         }});
  }
  void write(std::size_t, std::int64_t stamp_ns, const msg::Message&) override {
    if (given.size() == faulty_at) throw std::runtime_error("full");
    if (given.empty()) made_before_first = made_so_far_;
    given.push_back({stamp_ns, ns_since(start_)});
  }
  void finish() override { is_finished = true; }

  Costs run(
      RunSettings settings, FunctionRef<bool()> is_stopped = [] { return false; }) {
    Inputs inputs({});
    InputPoses poses;
    MessageOutput* output = this;
    settings.realtime = true;
    settings.measure = true;
    start_ = SteadyClock::now();
    return run_simulation(simulation_, settings, {&output, 1}, inputs, poses, is_stopped);
  }
  std::int64_t so_far_ns() const { return ns_since(start_); }

  Simulation simulation_;
  std::vector<Entry> made, given;
  std::size_t made_before_first = 0;
  std::size_t faulty_at = std::numeric_limits<std::size_t>::max();
  bool is_finished = false;

 private:
  SteadyClock::time_point start_;
  std::atomic<std::size_t> made_so_far_ = 0;  // asked by the thread that gives
};

TEST(RealTime, NothingIsGivenBeforeItsMomentAndAllIsGiven) {
  for (const std::int64_t ahead_ns : {std::int64_t{0}, 100 * kMillisecond_ns}) {
    TimedRun run;
    run.run({.duration_s = 0.2, .first_ns = kSomeUtc_ns, .ahead_ns = ahead_ns});
    EXPECT_TRUE(run.is_finished);
    ASSERT_EQ(run.given.size(), 40u);
    for (std::size_t n = 0; n < run.given.size(); ++n) {
      EXPECT_EQ(run.given[n].stamp_ns,
                1'790'000'000'125'000'000 + static_cast<std::int64_t>(n) * 5 * kMillisecond_ns);
      EXPECT_GE(run.given[n].at_ns, run.given[n].stamp_ns - kSomeUtc_ns + ahead_ns);
    }
  }
}

TEST(RealTime, MessagesAreMadeBeforeTheyAreGivenWhereNothingComesFromOutside) {
  TimedRun run;
  run.run({.duration_s = 0.1, .ahead_ns = 100 * kMillisecond_ns});
  EXPECT_GT(run.made_before_first, 5u);
  TimedRun late;
  late.run({.duration_s = 0.1});
  for (const TimedRun::Entry& made : late.made) EXPECT_GE(made.at_ns, made.stamp_ns);
}

TEST(RealTime, ARunThatIsStoppedGivesWhatIsDueAndFinishes) {
  TimedRun run;
  const Costs costs = run.run(
      {.duration_s = std::numeric_limits<double>::infinity(), .ahead_ns = 100 * kMillisecond_ns},
      [&] { return run.so_far_ns() > 180 * kMillisecond_ns; });
  EXPECT_TRUE(run.is_finished);
  ASSERT_FALSE(run.given.empty());
  EXPECT_LE(run.given.back().stamp_ns, run.so_far_ns() - 100 * kMillisecond_ns);
  EXPECT_EQ(costs.duration_s, Moment{run.given.back().stamp_ns}.t_s());
}

TEST(RealTime, WhatAnOutputThrowsEndsTheRun) {
  TimedRun run;
  run.faulty_at = 3;
  EXPECT_THROW(run.run({.duration_s = 1e6, .ahead_ns = 20 * kMillisecond_ns}), std::runtime_error);
  EXPECT_EQ(run.given.size(), 3u);
  EXPECT_FALSE(run.is_finished);
}

TEST(RealTime, StampsOfUtcAreExactToTheNanosecond) {
  EXPECT_EQ(stamp_ns(179'000'000'007, 100.0), 1'790'000'000'070'000'000);
  EXPECT_EQ(stamp_ns(53'700'000'001, 30.0), 1'790'000'000'033'333'333);
  EXPECT_EQ(stamp_ns(1'790'000'000, 1.0), 1'790'000'000'000'000'000);
  EXPECT_EQ(stamp_ns(17, 0.1), 170'000'000'000);
}

// ---- What --measure says

struct Told {
  Simulation simulation;
  Costs costs;

  // A source of 10 Hz over 10 s, of which each message is given so much late.
  Told() {
    simulation.sources.push_back({"probe", "wave_probe", 10.0, {}});
    costs.sources.resize(1);
    costs.given.sources.resize(1);
    costs.duration_s = costs.wall_s = 10.0;
  }
  void give(int k, double late_ms) {
    const double given_s = k / 10.0 + late_ms / 1e3;
    costs.given.sources[0].add(stamp_ns(k, 10.0), given_s);
    costs.given.late_ms.push_back(static_cast<float>(late_ms));
  }
  std::string text() const { return cost_table(simulation, costs); }
};

TEST(RealTime, IsHeldWhereAllComesInTime) {
  Told told;
  for (int k = 0; k < 100; ++k) told.give(k, 4.0);
  EXPECT_NE(
      told.text().find("99 % of messages within 4.0 ms, all within 4.0 ms, 0.00 % over 50 ms\n"
                       "stamps skipped: 0; mean periods off by +0.000 % at most\n"
                       "real time was held\n"),
      std::string::npos)
      << told.text();
}

TEST(RealTime, IsNotHeldWhereOneInFiftyIsLateOrAStampIsSkippedOrPeriodsAreLonger) {
  Told late, skipped, slow;
  for (int k = 0; k < 100; ++k) {
    late.give(k, k % 50 == 20 ? 51.0 : 1.0);
    if (k != 40) skipped.give(k, 1.0);
    slow.give(k, 0.2 * k);  // 0.2 %
  }
  EXPECT_NE(late.text().find("2.00 % over 50 ms"), std::string::npos) << late.text();
  EXPECT_NE(skipped.text().find("stamps skipped: 1;"), std::string::npos) << skipped.text();
  EXPECT_NE(slow.text().find("off by +0.200 %"), std::string::npos) << slow.text();
  for (const Told* told : {&late, &skipped, &slow})
    EXPECT_NE(told->text().find("real time was not held\n"), std::string::npos) << told->text();
}

}  // namespace
}  // namespace swell::apps
