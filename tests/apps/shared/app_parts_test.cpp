// The parts of the programs that work on values alone.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numeric>

#include "apps/shared/options.h"
#include "apps/shared/picture_file.h"
#include "apps/shared/report.h"
#include "apps/shared/trace.h"

namespace swell::apps {
namespace {

TEST(Spread, OfOneToTwoHundredIsByNearestRank) {
  std::vector<double> samples(200);
  std::iota(samples.rbegin(), samples.rend(), 1.0);
  const Spread s = spread(samples);
  EXPECT_EQ(s.median, 100.0);
  EXPECT_EQ(s.p95, 190.0);
  EXPECT_EQ(s.p99, 198.0);
  EXPECT_EQ(s.max, 200.0);
}

TEST(Spread, OfOneSampleIsThatSample) {
  const Spread s = spread({2.5});
  EXPECT_EQ(s.median, 2.5);
  EXPECT_EQ(s.p95, 2.5);
  EXPECT_EQ(s.p99, 2.5);
  EXPECT_EQ(s.max, 2.5);
}

TEST(FrameFile, PutsTheNumberWhereThePatternSays) {
  const auto file = [](const char* pattern, int k) {
    return frame_file(parse_file_pattern(pattern), k).string();
  };
  EXPECT_EQ(file("out/f_%04d.png", 7), "out/f_0007.png");
  EXPECT_EQ(file("out/f_%04d.png", 12345), "out/f_12345.png");
  EXPECT_EQ(file("%d.exr", 7), "7.exr");
  EXPECT_EQ(file("a%01d%02d.png", 7), "a7%02d.png");
  EXPECT_EQ(file("%05d/f.png", 7), "%05d/f.png") << "directories are not numbered";
  EXPECT_EQ(file("%s%n%4d%%.png", 7), "%s%n%4d%%.png");
  EXPECT_FALSE(parse_file_pattern("%04x.png").numbered);
  EXPECT_FALSE(parse_file_pattern("trailing%0").numbered);
  EXPECT_FALSE(parse_file_pattern("trailing%").numbered);
}

TEST(Options, SizesAndRangesHoldTheirLimits) {
  EXPECT_EQ(parse_size("1x1").width_px, 1);
  EXPECT_EQ(parse_size("1920x1080").height_px, 1080);
  EXPECT_EQ(parse_size("8192x8192").width_px, 8192);
  for (const char* text : {"", "x", "0x1", "1x0", "8193x1", "1X1", "+1x1", "1x1x", " 1x1", "1e3x1"})
    EXPECT_THROW(parse_size(text), OptionError) << text;
  EXPECT_EQ(parse_frame_range("5-5").last, 5);
  EXPECT_EQ(parse_frame_range("0-9999999").last, 9999999);
  for (const char* text : {"", "-", "5", "5-", "-5", "6-5", "0-10000000", "0--1", "0-1-2"})
    EXPECT_THROW(parse_frame_range(text), OptionError) << text;
}

// What --threads 'text' leaves in the value, or 0 if it is refused.
int parsed_integer(std::string text) {
  CommandLine line("test", "");
  int value = 0;
  add_integer(line, "--threads", value, 1, 256, "");
  std::string program = "test", option = "--threads";
  char* argv[] = {program.data(), option.data(), text.data()};
  try {
    return line.parse(3, argv) ? value : 0;
  } catch (const OptionError&) {
    return 0;
  }
}

TEST(Options, WholeNumbersHoldTheirLimits) {
  EXPECT_EQ(parsed_integer("1"), 1);
  EXPECT_EQ(parsed_integer("256"), 256);
  for (const char* text : {"0", "257", "-1", "1.5", "1e2", "0x10", "two", "99999999999999999999"})
    EXPECT_EQ(parsed_integer(text), 0) << text;
}

TEST(Trace, HasCountersForGraphs) {
  Trace trace;
  trace.add_counter("triangles", 125.0, 30000);
  const nlohmann::json events = nlohmann::json::parse(trace.json()).at("traceEvents");
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].at("ph"), "C");
  EXPECT_EQ(events[0].at("name"), "triangles");
  EXPECT_EQ(events[0].at("ts"), 125.0);
  EXPECT_EQ(events[0].at("args").at("value"), 30000.0);
}

TEST(Trace, PlacesStagesInTheRun) {
  Trace trace;
  trace.add_frame(3, 1000.0, 50.0,
                  std::vector{render::TraceEvent{render::Stage::kShade, 1, 10, 30}});
  const auto json = nlohmann::json::parse(trace.json());
  ASSERT_EQ(json.at("traceEvents").size(), 2u);
  const auto& frame = json["traceEvents"][0];
  EXPECT_EQ(frame.at("name"), "frame");
  EXPECT_EQ(frame.at("ts"), 1000.0);
  EXPECT_EQ(frame.at("dur"), 50.0);
  EXPECT_EQ(frame.at("args").at("frame"), 3);
  const auto& shade = json["traceEvents"][1];
  EXPECT_EQ(shade.at("name"), "shade");
  EXPECT_EQ(shade.at("ts"), 1010.0);
  EXPECT_EQ(shade.at("dur"), 20.0);
  EXPECT_EQ(shade.at("tid"), 2) << "track 0 holds the frames";
}

TEST(OneLine, RemovesWhatWouldBreakTheLine) {
  EXPECT_EQ(one_line("a\nb\tc\r\n"), "a b c");
  EXPECT_EQ(one_line(""), "");
}

}  // namespace
}  // namespace swell::apps
