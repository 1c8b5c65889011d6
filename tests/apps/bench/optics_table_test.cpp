// swell-bench optics: scenes of the paper's sizes, its own figures beside, and what it refuses.
#include "apps/bench/optics_table.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "apps/shared/program_runner.h"

namespace swell::apps {
namespace {

const std::string kHarbour = SWELL_SOURCE_DIR "/scenes/harbour.toml";

// 55 frames/s instead of 61: 6/61 of the time goes into the water.
TEST(OpticsTable, TakesTheWatersShareFromFramesPerSecond) {
  EXPECT_NEAR(kPaperRows[0].cost().water_share(), 6.0 / 61.0, 1e-12);
  EXPECT_NEAR(kPaperRows[1].cost().water_share(), 1.0 / 46.0, 1e-12);
  EXPECT_EQ(kPaperRows[2].cost().water_share(), 0.0);
}

TEST(OpticsTable, ShowsEachRowBesideThePapers) {
  const OpticsRow rows[] = {{10000, 3912, {4.0, 5.0}, 2.5, 0.75},
                            {20000, 7824, {8.0, 10.0}, 2.5, 1.0}};
  const std::string text = optics_text(rows);
  EXPECT_NE(
      text.find("    13912     250.0     200.0   20.0     2.50     0.75        61   55    9.8\n"),
      std::string::npos)
      << text;
  EXPECT_NE(
      text.find("    27824     125.0     100.0   20.0     2.50     1.00        46   45    2.2\n"),
      std::string::npos)
      << text;
}

TEST(OpticsProgram, DrawsScenesOfThePapersSizesExactly) {
  const Outcome outcome = run_bench(
      {"optics", "--scene", kHarbour, "--size", "160x90", "--frames", "1", "--json", "-"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out, nullptr, false);
  ASSERT_FALSE(json.is_discarded()) << outcome.out;
  EXPECT_EQ(json.at("scene"), "harbour");
  EXPECT_EQ(json.at("size"), nlohmann::json::parse("[160, 90]"));
  EXPECT_EQ(json.at("frames"), 1);
  const auto& rows = json.at("rows");
  ASSERT_EQ(rows.size(), 3u);
  const int triangles[] = {13912, 27824, 41736};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& row = rows[i];
    EXPECT_EQ(row.at("triangles"), triangles[i]);
    EXPECT_EQ(row.at("land_triangles").get<int>() + row.at("object_triangles").get<int>(),
              triangles[i]);
    EXPECT_GT(row.at("object_triangles"), 1000) << "pier and boats";
    const double dry_ms = row.at("ms_without"), wet_ms = row.at("ms_with");
    EXPECT_GT(dry_ms, 0.0);
    EXPECT_NEAR(row.at("water_share"), 1.0 - dry_ms / wet_ms, 1e-9);
    EXPECT_GT(row.at("ms_shading"), 0.0);
    EXPECT_GT(row.at("ms_lookups"), 0.0);
  }
  EXPECT_EQ(rows[0].at("paper").at("frames_per_s_without"), 61.0);
}

TEST(OpticsProgram, RefusesWhatHasNoSuchNumberOfTriangles) {
  const ScratchFolder folder;
  const std::string sea = folder.file("sea.toml");
  write_text(sea, "name = \"no land\"\n");
  const Outcome outcome = run_bench({"optics", "--scene", sea, "--size", "64x36"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(is_one_error_line(outcome.err, {"--scene", "13912 triangles"})) << outcome.err;
}

TEST(OpticsProgram, RefusesBadArguments) {
  for (const Arguments& bad :
       {Arguments{"optics"}, Arguments{"optics", "--scene", kHarbour, "--frames", "0"},
        Arguments{"optics", "--scene", kHarbour, "--triangles", "100"},
        Arguments{"optics", "--scene", "nowhere.toml"}}) {
    const Outcome outcome = run_bench(bad);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(is_one_error_line(outcome.err)) << outcome.err;
  }
}

}  // namespace
}  // namespace swell::apps
