// swell-bench shading: what tiles' times say of a pixel, and that a run prints it.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/bench/cpu_clock.h"
#include "apps/bench/shading_report.h"
#include "apps/shared/program_runner.h"

namespace swell::apps {
namespace {

using Shows = ShadedTile::Shows;

// Two tiles of water at 5 and 8 ns a pixel, both interrupted once; one of sky at 2 ns; one that
// shows water in one frame alone, and one of both.
std::vector<ShadedFrame> three_frames() {
  const ShadedTile both = {Shows::kOther, 4000, 500.0};
  const ShadedTile water = {Shows::kWater, 4000, 9000.0}, other = {Shows::kOther, 4000, 50.0};
  const ShadedTile sky = {Shows::kSky, 4000, 8.0};
  return {{{Shows::kWater, 4000, 20.0}, both, {Shows::kWater, 1000, 3000.0}, sky, other},
          {{Shows::kWater, 4000, 4000.0}, both, {Shows::kWater, 1000, 8.0}, sky, water},
          {{Shows::kWater, 4000, 19.0}, both, {Shows::kWater, 1000, 7.5}, sky, other}};
}

TEST(ShadingReport, DividesTheTilesMedianTimesByTheirPixels) {
  const ShadingReport report = report_shading(three_frames(), 4.0);
  EXPECT_EQ(report.frames, 3);
  EXPECT_EQ(report.clock_ghz, 4.0);
  EXPECT_EQ(report.water.tiles, 2);
  EXPECT_DOUBLE_EQ(report.water.ns, 28e3 / 5000);
  EXPECT_DOUBLE_EQ(report.water.cycles, 4 * 28e3 / 5000);
  EXPECT_EQ(report.sky.tiles, 1);
  EXPECT_DOUBLE_EQ(report.sky.ns, 2.0);
  EXPECT_DOUBLE_EQ(report.sky.cycles, 8.0);
}

TEST(ShadingReport, NamesTheClockThatItAssumes) {
  const std::string text = shading_text(report_shading(three_frames(), 4.0));
  EXPECT_NE(
      text.find("water 22.4 cycles a pixel at 4.00 GHz, 5.60 ns (median of 3 frames; 2 tiles)"),
      std::string::npos)
      << text;
  EXPECT_NE(text.find("sky 8.0 cycles a pixel"), std::string::npos) << text;
  EXPECT_NE(text.find("multiplications, 3 cycles each"), std::string::npos) << text;
}

TEST(ShadingReport, SaysWhereNoTileShowsAThingAlone) {
  const std::vector<ShadedFrame> frames = {{{Shows::kOther, 64, 1.0}, {Shows::kSky, 64, 1.0}}};
  const ShadingReport report = report_shading(frames, 4.0);
  EXPECT_EQ(report.water.tiles, 0);
  EXPECT_NE(shading_text(report).find("water: no tile shows it alone\n"), std::string::npos);
  EXPECT_TRUE(shading_json(report).at("water").is_null());
  EXPECT_EQ(shading_json(report).at("sky").at("tiles"), 1);
}

// Clocks of CPUs with AVX2; wrong by the latency's factor of 3, it would leave the range.
TEST(Clock, IsThatOfACpu) {
  double clock_ghz = 0.0;
  for (int i = 0; i < 100; ++i) clock_ghz = std::max(clock_ghz, measure_clock_ghz());
  EXPECT_GT(clock_ghz, 1.5);
  EXPECT_LT(clock_ghz, 6.5);
}

TEST(ShadingProgram, FindsWhatWaterAndSkyTake) {
#ifdef SWELL_SANITIZED
  constexpr double kSlower = 20.0;
#else
  constexpr double kSlower = 1.0;
#endif
  const ScratchFolder folder;
  const std::string scene = folder.file("sea.toml");
  write_text(scene, sea_scene_text());
  const Outcome outcome =
      run_bench({"shading", "--scene", scene, "--size", "320x240", "--frames", "9", "--json", "-"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out, nullptr, false);
  ASSERT_FALSE(json.is_discarded()) << outcome.out;
  EXPECT_EQ(json.at("frames"), 9);
  EXPECT_EQ(json.at("size"), nlohmann::json::parse("[320, 240]"));
  const double clock_ghz = json.at("clock_ghz");
  for (const char* kind : {"water", "sky"}) {
    SCOPED_TRACE(kind);
    const auto& cost = json.at(kind);
    ASSERT_FALSE(cost.is_null());
    EXPECT_GT(cost.at("tiles"), 0);
    const double cycles = cost.at("cycles_a_pixel");
    EXPECT_NEAR(cycles, cost.at("ns_a_pixel").get<double>() * clock_ghz, 1e-9 * cycles);
    EXPECT_GT(cycles, 5.0);
    EXPECT_LT(cycles, 500.0 * kSlower);
  }
  EXPECT_GT(json.at("water").at("ns_a_pixel"), json.at("sky").at("ns_a_pixel"));
}

}  // namespace
}  // namespace swell::apps
