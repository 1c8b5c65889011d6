// Pictures whose shutter is open for several moments.
#include "render/exposure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/shot.h"
#include "render/world_view.h"

namespace swell::render {
namespace {

constexpr double kOpening_s = 2.0, kExposure_s = 0.5;
constexpr int kMoments = 4, kColumns = 96, kRows = 54;

// Buoys from a camera that moves and turns.
scene::Scene moving_scene() {
  scene::Scene scene = load_shipped("buoys");
  scene.camera.velocity_mps = {2.0, 6.0, 0.5};
  scene.camera.turn_rad_s = 0.2;
  scene.camera.path.clear();
  scene.camera.exposure_s = kExposure_s;
  scene.camera.shutter_samples = kMoments;
  return scene;
}

scene::Scene instant_scene() {
  scene::Scene scene = moving_scene();
  scene.camera.shutter_samples = 1;
  return scene;
}

std::vector<View> views_of_moments(const World& world) {
  Workers workers(1);
  ocean::SeaFrame sea;
  return exposed_views(world, kOpening_s, {}, {kColumns, kRows}, sea, workers);
}

FrameOptions linear_with(const std::vector<View>& views) {
  FrameOptions options;
  options.keep_linear = true;
  options.exposed_views = views;
  return options;
}

// sRGB times 255 of linear light, by the standard's curve, after the shoulder that frames have.
double code_of(double light) {
  const double over = std::max(light - 0.4, 0.0);
  const double shown = std::min(std::min(light, 0.4) + over / (over / 0.6 + 1.0), 1.0);
  return 255.0 * (shown < 0.0031308 ? 12.92 * shown : 1.055 * std::pow(shown, 1.0 / 2.4) - 0.055);
}

TEST(Exposure, OfOneMomentIsAnInstant) {
  const World open(instant_scene());
  scene::Scene closed_scene = instant_scene();
  closed_scene.camera.exposure_s = 0.0;
  closed_scene.camera.shutter_samples = 16;
  const World closed(closed_scene, open, 2);
  EXPECT_TRUE(views_of_moments(open).empty());
  EXPECT_TRUE(views_of_moments(closed).empty());
  const View view = view_of(open, kOpening_s, kColumns, kRows);
  const Shot one(open, view, kOpening_s), other(closed, view, kOpening_s);
  EXPECT_EQ(picture_hash(one.target), picture_hash(other.target));
}

TEST(Exposure, HasTheMeanLightOfItsMoments) {
  const World world(moving_scene()), instants(instant_scene(), world, 2);
  const std::vector<View> views = views_of_moments(world);
  ASSERT_EQ(views.size(), static_cast<std::size_t>(kMoments));
  const Shot exposed(world, views[0], kOpening_s, linear_with(views));
  std::vector<float> sum(3 * kColumns * kRows, 0.0f);
  FrameOptions linear;
  linear.keep_linear = true;
  for (int k = 0; k < kMoments; ++k) {
    const double t_s = kOpening_s + k * kExposure_s / kMoments;
    EXPECT_EQ(views[static_cast<std::size_t>(k)].eye_world,
              view_of(world, t_s, kColumns, kRows).eye_world);
    const Shot moment(instants, view_of(world, t_s, kColumns, kRows), t_s, linear);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += moment.target.linear[i];
  }
  for (float& light : sum) light /= static_cast<float>(kMoments);
  EXPECT_EQ(exposed.target.linear, sum);

  // Half a step to each side for rounding, one for the dither.
  const float exposure = exposed.state().shading.exposure;
  for (std::size_t pixel = 0; pixel < exposed.target.rgba.size(); ++pixel)
    for (std::size_t c = 0; c < 3; ++c) {
      const auto code = static_cast<double>(exposed.target.rgba[pixel] >> (8 * c) & 255);
      EXPECT_NEAR(code, code_of(static_cast<double>(sum[3 * pixel + c] * exposure)), 1.1);
    }
}

TEST(Exposure, MovesWithTheCameraOnlyIfItsViewsAreGiven) {
  const World world(moving_scene());
  const std::vector<View> views = views_of_moments(world);
  const Shot still(world, views[0], kOpening_s), moving(world, views[0], kOpening_s, [&] {
    FrameOptions options;
    options.exposed_views = views;
    return options;
  }());
  EXPECT_NE(picture_hash(still.target), picture_hash(moving.target));
}

TEST(Exposure, HasTheSameBitsOnAnyNumberOfThreadsAndAmongOtherViews) {
  const World world(moving_scene());
  const std::vector<View> views = views_of_moments(world);
  FrameOptions options;
  options.exposed_views = views;
  options.labels = LabelSet::all();
  const Shot two(world, views[0], kOpening_s, options, 2),
      three(world, views[0], kOpening_s, options, 3);
  EXPECT_EQ(picture_hash(two.target), picture_hash(three.target));
  EXPECT_TRUE(two.target.linear.empty());

  Workers workers(2);
  Workspaces workspaces;
  std::vector<Target> targets(3);
  std::vector<FrameRequest> requests;
  for (Target& target : targets) requests.push_back({views[0], options, &target});
  render_many(world, requests, kOpening_s, workspaces, workers);
  for (const Target& target : targets) {
    EXPECT_EQ(picture_hash(target), picture_hash(two.target));
    EXPECT_EQ(target.labels.id, two.target.labels.id);
  }
}

// Labels are exact at the picture's own time.
TEST(Exposure, HasTheLabelsOfItsFirstMoment) {
  const World world(moving_scene()), instants(instant_scene(), world, 2);
  const std::vector<View> views = views_of_moments(world);
  FrameOptions options;
  options.labels = LabelSet::all();
  const Shot instant(instants, views[0], kOpening_s, options);
  options.exposed_views = views;
  const Shot exposed(world, views[0], kOpening_s, options);
  EXPECT_EQ(exposed.target.labels.depth_m, instant.target.labels.depth_m);
  EXPECT_EQ(exposed.target.labels.id, instant.target.labels.id);
  EXPECT_EQ(exposed.target.labels.normal, instant.target.labels.normal);
  EXPECT_EQ(exposed.target.labels.foam, instant.target.labels.foam);
}

TEST(ExposureDeathTest, RefusesViewsOfOtherMoments) {
  const World world(moving_scene());
  std::vector<View> views = views_of_moments(world);
  views.pop_back();
  FrameOptions options;
  options.exposed_views = views;
  EXPECT_DEATH(Shot(world, views[0], kOpening_s, options), "3 views of 4 moments");
}

}  // namespace
}  // namespace swell::render
