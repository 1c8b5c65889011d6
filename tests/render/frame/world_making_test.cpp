// How worlds are made beside their scenes: who is told, what ends it, what bounds it; and that
// their water is not made twice. tests/capi/making_test.c measures how soon they end and what they
// take.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <string>
#include <vector>

#include "render/shot.h"
#include "render/world/world_state.h"

namespace swell::render {
namespace {

TEST(WorldMaking, TellsOfEachPartAndHowFarItIs) {
  std::vector<double> told;
  std::vector<std::string> lines;
  const World world(load_shipped("beach"),
                    {.threads = 2,
                     .tell = [&](double done) { told.push_back(done); },
                     .log = [&](const std::string& line) { lines.push_back(line); }});
  EXPECT_GT(told.size(), 8u);
  EXPECT_TRUE(std::ranges::is_sorted(told));
  EXPECT_GE(told.front(), 0.0);
  EXPECT_EQ(told.back(), 1.0);
  const auto has = [&](std::string_view part) {
    return std::ranges::count_if(lines, [&](const std::string& l) { return l.starts_with(part); });
  };
  EXPECT_EQ(has("land: "), 1);
  EXPECT_EQ(has("sky: "), 1);

  // What another world has is there at once.
  told.clear(), lines.clear();
  const std::vector<const World*> like = {&world};
  const World same(load_shipped("beach"),
                   {.threads = 2,
                    .like = like,
                    .tell = [&](double done) { told.push_back(done); },
                    .log = [&](const std::string& line) { lines.push_back(line); }});
  EXPECT_EQ(told.back(), 1.0);
  EXPECT_TRUE(lines.empty());
  EXPECT_EQ(same.state().terrain, world.state().terrain);
}

TEST(WorldMaking, IsEndedByAFlagThatMayBeSetBefore) {
  const std::atomic<bool> stop{true};
  EXPECT_THROW(World(load_shipped("beach"), {.threads = 2, .stop = &stop}), Stopped);
  EXPECT_NO_THROW(check_stop());  // this thread's own work goes on
}

TEST(WorldMaking, IsRefusedWhereItMightTakeMoreThanItMay) {
  try {
    World(load_shipped("beach"), {.threads = 2, .most_bytes = 1000});
    FAIL() << "was made";
  } catch (const OverMemoryBound& error) {
    EXPECT_NE(std::string(error.what()).find("allowed 1000"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace swell::render
