// Several views of one time: each has the bits that it has alone.
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "render/shot.h"
#include "render/world_view.h"

namespace swell::render {
namespace {

constexpr double kTime_s = 4.0;

// Views around the scene's own, of several sizes; one looks from below the water.
std::vector<View> views_around(const World& world, int count) {
  Workers workers(2);
  ocean::SeaFrame sea;
  std::vector<View> views;
  for (int k = 0; k < count; ++k) {
    View view = world_view(world, kTime_s, 64 + 8 * k, 48, sea, workers);
    view.eye_world += glm::dvec3(25.0 * k, -10.0 * k, k == 2 ? -view.eye_world.z - 3.0 : 4.0 * k);
    views.push_back(view);
  }
  return views;
}

void expect_same_pictures(const World& world, const std::vector<View>& views,
                          const FrameOptions& options, Workspaces& workspaces, int threads) {
  Workers workers(threads);
  std::vector<Target> targets(views.size());
  std::vector<FrameRequest> requests;
  for (std::size_t k = 0; k < views.size(); ++k)
    requests.push_back({views[k], options, &targets[k]});
  const std::vector<FrameStatistics> statistics =
      render_many(world, requests, kTime_s, workspaces, workers);
  ASSERT_EQ(statistics.size(), views.size());
  for (std::size_t k = 0; k < views.size(); ++k) {
    Shot alone(world, views[k], kTime_s, options);
    EXPECT_EQ(picture_hash(targets[k]), picture_hash(alone.target)) << k << ", " << threads;
    EXPECT_EQ(targets[k].labels.depth_m, alone.target.labels.depth_m) << k;
    EXPECT_EQ(targets[k].labels.id, alone.target.labels.id) << k;
    EXPECT_EQ(targets[k].labels.motion_px, alone.target.labels.motion_px) << k;
    EXPECT_EQ(statistics[k].visible_pixels, alone.statistics.visible_pixels) << k;
  }
}

TEST(RenderMany, DrawsEachViewAsItIsAlone) {
  FrameOptions labelled;
  labelled.labels = LabelSet::all();
  for (const std::string name : {"everything", "open_ocean"}) {
    const World& world = shipped_world(name);
    const std::vector<View> views = views_around(world, 5);
    Workspaces workspaces;
    for (const int threads : {2, 1, 3})
      expect_same_pictures(world, views, labelled, workspaces, threads);
  }
}

TEST(RenderMany, HasAsManyViewsAsAreAsked) {
  const World& world = shipped_world("open_ocean");
  Workspaces workspaces;
  Workers workers(2);
  EXPECT_TRUE(render_many(world, {}, kTime_s, workspaces, workers).empty());
  for (const int count : {1, 2, 3})
    expect_same_pictures(world, views_around(world, count), {}, workspaces, 2);
}

// A workspace that shared a sea makes its own again, of another time and another world.
TEST(RenderMany, LeavesNoTrace) {
  const World& world = shipped_world("open_ocean");
  Workspaces workspaces;
  Workers workers(2);
  const std::vector<View> views = views_around(world, 2);
  std::array<Target, 2> targets;
  const std::array<FrameRequest, 2> requests = {FrameRequest{views[0], {}, &targets[0]},
                                                FrameRequest{views[1], {}, &targets[1]}};
  render_many(world, requests, 100.0, workspaces, workers);
  const World& lagoon = shipped_world("lagoon");
  expect_same_pictures(lagoon, views_around(lagoon, 2), {}, workspaces, 2);
  expect_same_pictures(world, views, {}, workspaces, 2);
}

TEST(RenderManyDeathTest, RefusesViewsOfSeveralSeas) {
  const World& world = shipped_world("open_ocean");
  Workspaces workspaces;
  Workers workers(1);
  const std::vector<View> views = views_around(world, 2);
  std::array<Target, 2> targets;
  std::array<FrameRequest, 2> requests = {FrameRequest{views[0], {}, &targets[0]},
                                          FrameRequest{views[1], {}, nullptr}};
  EXPECT_DEATH(render_many(world, requests, 0.0, workspaces, workers), "without a target");
  requests[1].target = &targets[1];
  requests[1].options.without.add(Part::kWakes);
  EXPECT_DEATH(render_many(world, requests, 0.0, workspaces, workers), "several seas");
}

}  // namespace
}  // namespace swell::render
