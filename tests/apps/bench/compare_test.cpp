// swell-bench frame --compare: which stages are slower than another program's, and which programs
// it refuses.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/bench/run_comparison.h"
#include "apps/shared/child_process.h"
#include "apps/shared/program_runner.h"

namespace swell::apps {
namespace {

// Pairs of runs of a frame of 10 ms in which one stage took `before_ms`, then after[i].
std::vector<RunPair> pairs_of(double before_ms, const std::vector<double>& after_ms) {
  std::vector<RunPair> pairs;
  for (const double ms : after_ms)
    pairs.push_back(
        {{{{"shade", before_ms}, {"frame", 10.0}}, ""}, {{{"shade", ms}, {"frame", 10.0}}, ""}});
  return pairs;
}

StageComparison compare_shade(double before_ms, const std::vector<double>& after_ms) {
  return compare_runs(pairs_of(before_ms, after_ms)).front();
}

TEST(CompareRuns, TheRatioIsTheMedianOfThePairs) {
  const StageComparison row = compare_shade(5.0, {5.5, 6.0, 5.5, 5.5, 5.25, 5.5, 100.0});
  EXPECT_EQ(row.stage, "shade");
  EXPECT_DOUBLE_EQ(row.ratio, 1.1);
  EXPECT_DOUBLE_EQ(row.before_ms, 5.0);
  EXPECT_DOUBLE_EQ(row.after_ms, 5.5);
  EXPECT_EQ(row.verdict, Verdict::kSlower);
}

// P(all on one side) of n pairs is 2 / 2^n: 1.6 % for 7, where the next would be 12.5 %. For 15 it
// is 3.5 % that twelve or more heads or tails fall, so the ranks are 4 and 12.
TEST(CompareRuns, TheIntervalIsOfOrderStatistics) {
  std::vector<double> after_ms;
  for (int i = 1; i <= 15; ++i) {
    after_ms.push_back(i);
    if (i != 6 && i != 7 && i != 15) continue;
    const StageComparison row = compare_shade(1.0, after_ms);
    EXPECT_EQ(row.ratio_low, i == 15 ? 4.0 : 1.0) << i;
    EXPECT_EQ(row.ratio_high, i == 15 ? 12.0 : i) << i;
  }
}

TEST(CompareRuns, OnePairOfSevenTheOtherWayIsNoise) {
  EXPECT_EQ(compare_shade(5.0, {5.5, 5.5, 4.9, 5.5, 5.5, 5.5, 5.5}).verdict, Verdict::kSame);
  EXPECT_EQ(compare_shade(5.0, {4.5, 4.5, 5.1, 4.5, 4.5, 4.5, 4.5}).verdict, Verdict::kSame);
  EXPECT_EQ(compare_shade(5.0, {4.5, 4.5, 4.9, 4.5, 4.5, 4.5, 4.5}).verdict, Verdict::kFaster);
}

TEST(CompareRuns, AStageBelowAHundredthOfTheFrameIsNeverSlower) {
  const std::vector<double> twice(7, 0.09), much(7, 0.16);
  EXPECT_EQ(compare_shade(0.05, twice).verdict, Verdict::kSame);
  EXPECT_EQ(compare_shade(0.05, much).verdict, Verdict::kSlower);
  EXPECT_EQ(compare_shade(0.16, std::vector<double>(7, 0.05)).verdict, Verdict::kFaster);
}

TEST(CompareRuns, AStageOfNoTimeHasARatio) {
  EXPECT_EQ(compare_shade(0.0, std::vector<double>(7, 0.0)).ratio, 1.0);
  EXPECT_DOUBLE_EQ(compare_shade(0.0, std::vector<double>(7, 1.0)).ratio, 1e4);
}

TEST(CompareRuns, AStageOfOneSideIsNamedAndNotJudged) {
  std::vector<RunPair> pairs = pairs_of(5.0, std::vector<double>(7, 5.0));
  for (RunPair& pair : pairs) {
    pair.before.stage_ms.emplace_back("bin", 9.0);
    pair.after.stage_ms.emplace_back("edges", 8.0);
  }
  const std::vector<StageComparison> rows = compare_runs(pairs);
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[2].stage, "edges");
  EXPECT_EQ(rows[2].verdict, Verdict::kOnlyAfter);
  EXPECT_EQ(rows[2].after_ms, 8.0);
  EXPECT_EQ(rows[3].stage, "bin");
  EXPECT_EQ(rows[3].verdict, Verdict::kOnlyBefore);
  EXPECT_EQ(rows[3].before_ms, 9.0);
  EXPECT_EQ(slower_stages(rows), "");
}

TEST(RunChild, BothStreamsAndTheExitCodeComeBackWhole) {
  const ChildOutcome outcome = run_child(
      "/bin/sh", {"-c", "head -c 300000 /dev/zero >&2; head -c 200000 /dev/zero; cat; exit 7"});
  EXPECT_EQ(outcome.exit_code, 7);
  EXPECT_EQ(outcome.out.size(), 200000u);
  EXPECT_EQ(outcome.err.size(), 300000u);
  EXPECT_EQ(run_child("/bin/sh", {"-c", "kill -9 $$"}).exit_code, -9);
}

class Compare : public testing::Test {
 protected:
  Compare() { write_text(scene_, sea_scene_text()); }

  // A program that prints `report`, whatever it is asked for, and writes down what that was.
  std::string program(const std::string& report, const std::string& more = "") {
    const std::string path = folder_.file("old");
    write_text(path, fmt::format("#!/bin/sh\necho \"$*\" >>{}\n{}\ncat <<'END'\n{}\nEND\n",
                                 folder_.file("calls"), more, report));
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    return path;
  }
  Outcome compare(const std::string& old_program, const Arguments& more = {}) {
    Arguments arguments = {"frame",    "--scene",   scene_,     "--size",    "64x36",
                           "--frames", "2",         "--warmup", "1",         "--runs",
                           "6",        "--threads", "1",        "--compare", old_program};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_bench(arguments);
  }
  // A report in which every stage takes so long, and the frame `frame_ms`.
  static std::string report(double stage_ms, double frame_ms) {
    return fmt::format(
        R"({{"stages_ms": {{"sea": {0}, "triangulate": {0}, "displace": {0}, "visibility": {0}, )"
        R"("lookups": {0}, "shade": {0}, "old": 3}}, "frame_ms": {{"median": {1}}}, "hash": "0"}})",
        stage_ms, frame_ms);
  }
  std::string verdict_of(const std::string& stage) {
    const auto json = nlohmann::json::parse(read_text(folder_.file("c.json")), nullptr, false);
    for (const auto& row : json.at("stages"))
      if (row.at("stage") == stage) return row.at("verdict");
    return "missing";
  }

  ScratchFolder folder_;
  std::string scene_ = folder_.file("sea.toml");
};

TEST_F(Compare, AgainstASlowProgramEverythingIsFaster) {
  const Outcome outcome = compare(program(report(1e6, 1e7)), {"--json", folder_.file("c.json")});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* stage : {"sea", "triangulate", "displace", "visibility", "shade", "frame"})
    EXPECT_EQ(verdict_of(stage), "faster") << stage;
  EXPECT_EQ(verdict_of("old"), "only_old");
  EXPECT_NE(outcome.out.find("only in the old one"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("last frame: different"), std::string::npos) << outcome.out;
}

TEST_F(Compare, AgainstAFastProgramTheSlowerStagesEndItWithOne) {
  const Outcome outcome = compare(program(report(1e-4, 1e-3)), {"--json", folder_.file("c.json")});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(is_one_error_line(outcome.err, {"slower than", "shade", "frame"})) << outcome.err;
  EXPECT_EQ(verdict_of("shade"), "slower");
}

TEST_F(Compare, ItDrawsTheSamePictureAsItself) {
  // Its times are those of a busy machine, and are left to it: one stage in thirty-two has six
  // pairs on one side by chance.
  const Outcome outcome = compare(SWELL_BINARY_DIR "/bin/swell-bench", {"--json", "-"});
  EXPECT_NE(outcome.exit_code, 2) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out, nullptr, false);
  EXPECT_EQ(json.value("pictures", ""), "same");
  EXPECT_EQ(json.at("stages").size(), 10u);
}

TEST_F(Compare, RunsAlternateWithTheOptionsAsGiven) {
  compare(program(report(1e6, 1e7)), {"--wireframe", "--json", "-"});
  const std::string calls = read_text(folder_.file("calls"));
  EXPECT_EQ(std::ranges::count(calls, '\n'), 6);
  const std::string call = calls.substr(0, calls.find('\n'));
  for (const std::string& piece :
       {"frame --json - --scene " + scene_, std::string("--size 64x36"), std::string("--frames 2"),
        std::string("--threads 1"), std::string("--wireframe")})
    EXPECT_NE(call.find(piece), std::string::npos) << call;
  for (const char* piece : {"--compare", "--runs"})
    EXPECT_EQ(call.find(piece), std::string::npos) << call;
}

TEST_F(Compare, RefusesWhatIsNoProgram) {
  struct Case {
    std::string old_program;
    std::vector<std::string> pieces;
  };
  for (const Case& c : {Case{folder_.file("none"), {"none", "No such file"}},
                        Case{scene_, {"sea.toml", "Permission denied"}}}) {
    const Outcome outcome = compare(c.old_program);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(is_one_error_line(outcome.err, c.pieces)) << outcome.err;
  }
}

TEST_F(Compare, RefusesAProgramThatFailsOrReportsNothing) {
  const auto error_of = [&](const std::string& report, const std::string& more) {
    const Outcome outcome = compare(program(report, more));
    EXPECT_EQ(outcome.exit_code, 2);
    return outcome.err;
  };
  const std::string unknown =
      error_of("", "echo \"error: command line: unknown option, got '--tile'\" >&2; exit 2");
  EXPECT_TRUE(
      is_one_error_line(unknown, {"ended with 2", ": command line: unknown option, got '--tile'"}))
      << unknown;
  for (const auto& [report, piece] :
       {std::pair{"text", "no JSON object"}, std::pair{"[1]", "no JSON object"},
        std::pair{"{}", "'stages_ms'"},
        std::pair{R"({"stages_ms": {}, "frame_ms": {}})", "'median'"},
        std::pair{R"({"stages_ms": {"sea": "1"}, "frame_ms": {}})", "'sea'"}})
    EXPECT_TRUE(is_one_error_line(error_of(report, ""), {"--compare", piece})) << report;
}

TEST_F(Compare, AMissingSceneIsNamedAsWithoutIt) {
  const Outcome outcome = run_bench(
      {"frame", "--scene", folder_.file("none.toml"), "--compare", program(report(1, 10))});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(outcome.err.starts_with("error: " + folder_.file("none.toml"))) << outcome.err;
}

}  // namespace
}  // namespace swell::apps
