// swell-bench scaling: recorded work, and how long it takes on more threads.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "apps/bench/scaling_report.h"
#include "apps/bench/work_record.h"
#include "apps/bench/work_schedule.h"
#include "apps/shared/program_runner.h"

namespace swell::apps {
namespace {

using Parts = std::vector<WorkPart>;

WorkPart serial(double us) { return {WorkPart::Kind::kSerial, 0.0, {us}}; }
WorkPart loop(std::vector<double> item_us) {
  return {WorkPart::Kind::kLoop, 0.0, std::move(item_us)};
}
WorkPart both(Parts a, Parts b) {
  WorkPart part{WorkPart::Kind::kBoth, 0.0, {}};
  part.a = std::move(a), part.b = std::move(b);
  return part;
}

TEST(Schedule, SerialWorkTakesItsTimeOnAnyNumberOfThreads) {
  for (const int threads : {1, 2, 32})
    EXPECT_EQ(schedule_us(Parts{serial(3.0), serial(4.0)}, threads), 7.0);
  EXPECT_EQ(schedule_us({}, 4), 0.0);
}

TEST(Schedule, ALoopIsSharedInWholeBodies) {
  const Parts parts = {loop({3.0, 3.0, 3.0, 3.0})};
  EXPECT_EQ(schedule_us(parts, 1), 12.0);
  EXPECT_EQ(schedule_us(parts, 2), 6.0);
  EXPECT_EQ(schedule_us(parts, 3), 6.0);
  EXPECT_EQ(schedule_us(parts, 4), 3.0);
  EXPECT_EQ(schedule_us(parts, 32), 3.0);
}

// In the order of the indices: 1 and 1, then 1 and 3 from 1 to 4. The best order would end at 3.
TEST(Schedule, BodiesAreTakenInTheirOrder) {
  EXPECT_EQ(schedule_us(Parts{loop({1.0, 1.0, 1.0, 3.0})}, 2), 4.0);
  EXPECT_EQ(schedule_us(Parts{loop({3.0, 1.0, 1.0, 1.0})}, 2), 3.0);
}

TEST(Schedule, APartWaitsForTheWholeLoopBefore) {
  const Parts parts = {loop({2.0, 1.0}), serial(5.0), loop({}), loop({4.0, 4.0})};
  EXPECT_EQ(schedule_us(parts, 1), 16.0);
  EXPECT_EQ(schedule_us(parts, 2), 11.0);
}

// 2 threads: a's serial part to 4, b's to 6; a body from 4 to 6, two to 8, one to 10. 3 threads:
// two bodies to 6, two to 8.
TEST(Schedule, BothSidesRunBesideEachOther) {
  const Parts parts = {both({serial(4.0), loop({2.0, 2.0, 2.0, 2.0})}, {serial(6.0)}), serial(1.0)};
  EXPECT_EQ(schedule_us(parts, 1), 19.0);
  EXPECT_EQ(schedule_us(parts, 2), 11.0);
  EXPECT_EQ(schedule_us(parts, 3), 9.0);
  EXPECT_EQ(schedule_us(Parts{both({}, {both({serial(2.0)}, {})})}, 2), 2.0);
}

// A frame of two stages; "sea" ends and "shade" begins in the middle of a serial part.
Parts recorded() {
  WorkRecorder recorder;
  const auto add = [&](WorkStep step, double us) {
    recorder.add(step, "void swell::{anonymous}::fill(int)", us);
  };
  recorder.begin(100.0);
  add(WorkStep::kBothBegin, 110.0);
  add(WorkStep::kLoopBegin, 115.0);
  add(WorkStep::kItemEnd, 120.0);
  add(WorkStep::kItemEnd, 140.0);
  add(WorkStep::kLoopEnd, 140.0);
  add(WorkStep::kBothMiddle, 140.0);
  add(WorkStep::kLoopBegin, 142.0);
  add(WorkStep::kLoopEnd, 142.0);
  add(WorkStep::kBothEnd, 150.0);
  return recorder.end(180.0, std::vector<StageSpan>{{"sea", 0.0, 60.0}, {"shade", 60.0, 80.0}});
}

TEST(WorkRecord, HoldsWhatWasDoneInOrder) {
  const Parts parts = recorded();
  ASSERT_EQ(parts.size(), 4u);
  EXPECT_EQ(parts[0].item_us, std::vector{10.0});
  EXPECT_EQ(parts[0].name, "before fill");
  ASSERT_EQ(parts[1].kind, WorkPart::Kind::kBoth);
  ASSERT_EQ(parts[1].a.size(), 2u);
  EXPECT_EQ(parts[1].a[1].kind, WorkPart::Kind::kLoop);
  EXPECT_EQ(parts[1].a[1].name, "fill");
  EXPECT_EQ(parts[1].a[1].item_us, (std::vector{5.0, 20.0}));
  ASSERT_EQ(parts[1].b.size(), 2u) << "a loop of no bodies is none";
  EXPECT_EQ(parts[1].b[0].item_us[0] + parts[1].b[1].item_us[0], 10.0);
  EXPECT_EQ(parts[2].stage, "sea");
  EXPECT_EQ(parts[2].name, "after fill");
  EXPECT_EQ(parts[2].item_us, std::vector{10.0});
  EXPECT_EQ(parts[3].stage, "shade");
  EXPECT_EQ(parts[3].name, "all of it");
  EXPECT_EQ(parts[3].item_us, std::vector{20.0});
  EXPECT_EQ(schedule_us(parts, 1), 80.0);
}

TEST(WorkRecord, FunctionsAreNamedWithoutTypesAndNamespaces) {
  EXPECT_EQ(short_function_name("void a::{anonymous}::draw(const B&, int)"), "draw");
  EXPECT_EQ(short_function_name("void a::(anonymous namespace)::draw(int)"), "draw");
  EXPECT_EQ(short_function_name("a::f(int)::<lambda(auto:1)>"), "f");
  EXPECT_EQ(short_function_name("void sort(It) [with It = a::b<int>]"), "sort");
  EXPECT_EQ(short_function_name("main"), "main");
}

TEST(ScalingReport, SumsWhatAFrameHasTwiceAndTakesMediansOfFrames) {
  WorkPart fill = loop({1000.0, 3000.0}), work = serial(500.0);
  fill.stage = work.stage = "sea";
  fill.name = "fill", work.name = "after fill";
  WorkPart slow = fill;
  slow.item_us = {9000.0, 9000.0};
  WorkPart beside = work;
  const std::vector<Parts> frames = {{fill, work, fill, work, both({beside}, {})},
                                     {fill, work, fill, work, both({beside}, {})},
                                     {slow, work, slow, work, both({beside}, {})}};
  const ScalingReport report = predict_scaling(frames, 2);
  EXPECT_DOUBLE_EQ(report.frame_ms[0], 9.5);
  EXPECT_DOUBLE_EQ(report.frame_ms[1], 7.5);
  EXPECT_DOUBLE_EQ(report.checked_ms, 7.5);
  ASSERT_EQ(report.loops.size(), 1u);
  EXPECT_EQ(report.loops[0].items, 4.0);
  EXPECT_DOUBLE_EQ(report.loops[0].ms, 8.0);
  EXPECT_DOUBLE_EQ(report.loops[0].largest_ms, 3.0);
  ASSERT_EQ(report.serial.size(), 2u);
  EXPECT_DOUBLE_EQ(report.serial[0].ms, 1.0);
  EXPECT_TRUE(report.serial[1].beside);
  EXPECT_DOUBLE_EQ(report.serial_ms(), 1.0);
}

TEST(ScalingProgram, AccountsForTheWholeFrame) {
  const ScratchFolder folder;
  const std::string scene = folder.file("island.toml");
  write_text(scene, island_scene_text());
  const Outcome outcome = run_bench({"scaling", "--scene", scene, "--size", "160x90", "--frames",
                                     "9", "--threads", "2", "--json", "-"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out, nullptr, false);
  ASSERT_FALSE(json.is_discarded()) << outcome.out;
  const double one_ms = json.at("measured").at("one_thread_ms");
  EXPECT_NEAR(json.at("predicted").at(0).at("frame_ms").get<double>(), one_ms,
              1e-9 + 1e-6 * one_ms);
  EXPECT_EQ(json.at("predicted").size(), 6u);
  EXPECT_EQ(json.at("measured").at("threads"), 2);
  double sum_ms = 0.0;
  for (const auto& part : json.at("serial")) sum_ms += part.at("ms").get<double>();
  std::string stages;
  for (const auto& part : json.at("loops")) {
    sum_ms += part.at("ms").get<double>();
    EXPECT_LE(part.at("largest_ms"), part.at("ms"));
    stages += part.at("stage").get<std::string>() + " ";
  }
  EXPECT_NEAR(sum_ms, one_ms, 0.5 * one_ms) << "medians of parts do not add up exactly";
  for (const char* stage : {"sea", "displace", "visibility", "lookups", "shade"})
    EXPECT_NE(stages.find(stage), std::string::npos) << stages;
}

}  // namespace
}  // namespace swell::apps
