// Where labels say that a surface is, and what they say it is, against rays through what was drawn.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "render/labelled_frame.h"
#include "render/measure/pick.h"
#include "trials.h"

namespace swell::render {
namespace {

constexpr glm::ivec2 kSurfaceSize_px(200, 120);
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// OUT-04: the inverse of the view's own projection, a matrix of floats.
TEST(Labels, PositionAndDistanceAreTheDepthUnprojected) {
  const View view = make_view({120.0, -60.0, 9.0}, camera_axes(0.7, -0.2, 0.1),
                              {0.7, 0.4, 0.13, -0.05}, 0.25f, 640, 360);
  const glm::dmat4 rel_from_clip = glm::inverse(glm::dmat4(view.clip_from_rel));
  for (int i = 0; i < 1000; ++i) {
    const auto dice = [&](int k) {
      return random_uniform(5, static_cast<std::uint64_t>(3 * i + k));
    };
    const int x = static_cast<int>(640 * dice(0)), y = static_cast<int>(360 * dice(1));
    const auto depth = static_cast<float>(std::exp(12.0 * dice(2) - 1.0));
    const double w = depth;
    const glm::dvec4 clip(w * ((x + 0.5) / 320.0 - 1.0), w * (1.0 - (y + 0.5) / 180.0),
                          static_cast<double>(view.near_m), w);
    const glm::dvec3 rel(rel_from_clip * clip);
    ASSERT_LT(glm::distance(position_of(view, x, y, depth), view.eye_world + rel),
              1e-6 * glm::length(rel));
    ASSERT_NEAR(distance_of(view, x, y, depth), glm::length(rel), 1e-6 * glm::length(rel));
  }
}

TEST(Labels, TheSkyIsEndlesslyFarInItsDirection) {
  const View view = make_view({3.0, 4.0, 5.0}, 0.0, 0.0, 1.0, 0.25f, 3, 3);
  EXPECT_EQ(position_of(view, 1, 1, kInfinity), glm::dvec3(0.0, kInfinity, 0.0));
  EXPECT_EQ(position_of(view, 0, 2, kInfinity), glm::dvec3(-kInfinity, kInfinity, -kInfinity));
  EXPECT_EQ(distance_of(view, 0, 2, kInfinity), kInfinity);
}

// By hand: the eye's height over the ray's fall.
TEST(Labels, APlaneHasTheDepthOfItsRays) {
  const World& world = shipped_world("open_ocean_plane");
  const View view = make_view({10.0, 20.0, 8.0}, camera_axes(0.3, -0.2, 0.2),
                              lens_of_fov(0.9, 320, 180), 0.25f, 320, 180);
  const LabelledFrame frame(world, view, 2.0);
  int water = 0, sky = 0;
  frame.for_pixels(1, [&](glm::ivec2 p) {
    const float depth = frame.labels().depth_m[frame.at(p)];
    const glm::dvec3 ray(view.ray(static_cast<float>(p.x) + 0.5f, static_cast<float>(p.y) + 0.5f));
    const bool is_water = frame.labels().id[frame.at(p)] == kWaterId;
    ASSERT_EQ(depth == kInfinity, !is_water);
    if (!is_water) return void(++sky);
    ++water;
    // Vertices, far out of the window here, snap to 1/256 of a pixel; their depths are floats.
    const double pixel = 2.0 * view.tan_half_y / view.height_px;
    ASSERT_NEAR(-8.0 / depth, ray.z, 0.01 * pixel) << p.x << " " << p.y;
    ASSERT_NEAR(frame.labels().elevation_m[frame.at(p)], 0.0, 0.01 * depth * pixel + 1e-5);
    ASSERT_EQ(frame.labels().geometric_normal[frame.at(p)], glm::vec3(0.0f, 0.0f, 1.0f));
  });
  EXPECT_GT(water, 20000);
  EXPECT_GT(sky, 5000);
}

// The first object is behind the camera and is not drawn.
TEST(Labels, AnObjectHasTheNumberOfItsPlaceInTheScene) {
  scene::Scene scene = load_shipped("open_ocean_plane");
  scene.objects.resize(3);
  scene.objects[0].position_m = {0.0, -500.0};
  scene.objects[1].position_m = {-4.0, 30.0};
  scene.objects[2].position_m = {4.0, 30.0};
  scene.objects[0].label = "boat";
  scene.objects[2].label = "beacon";
  const World world = world_of(scene);
  const View view =
      make_view({0.0, 0.0, 4.0}, 0.0, 0.0, 0.6, 0.25f, kSurfaceSize_px.x, kSurfaceSize_px.y);
  const LabelledFrame frame(world, view, 2.0);
  int left = 0, right = 0;
  frame.for_pixels(1, [&](glm::ivec2 p) {
    const std::uint32_t id = frame.labels().id[frame.at(p)];
    if (id < kFirstObjectId) return;
    const bool is_left = p.x < kSurfaceSize_px.x / 2;
    ++(is_left ? left : right);
    ASSERT_EQ(id, kFirstObjectId + (is_left ? 1 : 2));
    ASSERT_EQ(frame.labels().klass[frame.at(p)], is_left ? kObjectClass : kFirstOwnClass + 1);
  });
  EXPECT_GT(std::min(left, right), 200);
}

class LabelsOfScene : public testing::TestWithParam<const char*> {
 protected:
  const World& world = shipped_world(GetParam());
};
INSTANTIATE_TEST_SUITE_P(Scenes, LabelsOfScene,
                         testing::Values("lagoon", "beach", "buoys", "harbour", "open_ocean"),
                         [](const auto& test) { return std::string(test.param); });

// What a ray through the picture meets, as labels name it.
struct Traced {
  LabelledFrame& frame;
  PickScratch scratch = {};

  std::optional<Pick> at(glm::dvec2 p) {
    return pick(frame.world, frame.view, frame.workspace, glm::vec2(p), scratch);
  }
  static std::uint32_t id_of(const std::optional<Pick>& found) {
    if (!found) return kSkyId;
    switch (found->what) {
      case Shown::kWater:
        return kWaterId;
      case Shown::kLand:
        return kLandId;
      case Shown::kObject:
        break;
    }
    return kFirstObjectId + static_cast<std::uint32_t>(found->object);
  }
  double depth_of(const std::optional<Pick>& found) const {
    if (!found) return static_cast<double>(kInfinity);
    return glm::dot(found->p_world - frame.view.eye_world, glm::dvec3(frame.view.forward));
  }
};

constexpr std::array<glm::dvec2, 8> kAround = {
    {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, 1}, {1, -1}, {-1, -1}}};

// Vertices snap to 1/256 of a pixel: beside an edge the neighbour may be drawn, and a surface that
// is seen edge-on is as deep as it is so far up or down. Two surfaces that meet at a small angle,
// as a beach and its water, are each so much off, too: either may be drawn where they are that
// close.
struct IdErrors {
  int pixels = 0, beside_edge = 0, shallow = 0;
};

struct DepthRange {
  double nearest = 1e30, farthest = 0.0;

  void add(double depth) {
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
  }
  bool is_narrow() const { return farthest < 1.001 * nearest; }
  bool holds(double depth) const {
    return depth > nearest * (1.0 - 1e-5) && depth < farthest * (1.0 + 1e-5);
  }
};

void compare_pixel(Traced& traced, glm::ivec2 p, IdErrors& errors) {
  const LabelledFrame& frame = traced.frame;
  const std::uint32_t id = frame.labels().id[frame.at(p)];
  const double depth = frame.labels().depth_m[frame.at(p)];
  const auto centre = traced.at(centre_of(p));
  ++errors.pixels;
  const bool is_same = Traced::id_of(centre) == id;
  if (is_same && (id == kSkyId || std::abs(traced.depth_of(centre) - depth) < 1e-5 * depth)) return;
  bool is_beside = is_same;
  DepthRange own, all;  // of what was drawn, of all that is met around
  const auto meet = [&](const std::optional<Pick>& found) {
    if (found) all.add(traced.depth_of(found));
    if (Traced::id_of(found) != id) return;
    is_beside = true;
    own.add(traced.depth_of(found));
  };
  meet(centre);
  for (const glm::dvec2& step : kAround) meet(traced.at(centre_of(p) + step / 128.0));
  errors.beside_edge += !is_same;
  if (!is_beside && id != kSkyId && all.is_narrow() && all.holds(depth)) return;
  errors.shallow += is_beside && id != kSkyId && !own.holds(depth);
  EXPECT_TRUE(is_beside) << "at " << p.x << ", " << p.y << ": " << id << " of depth " << depth
                         << ", traced " << Traced::id_of(centre) << " of " << all.nearest << " to "
                         << all.farthest;
}

TEST_P(LabelsOfScene, AreOfWhatARayThroughThePixelMeets) {
  constexpr int kViews = 10, kPixels = 250;
  const FrameOptions options = {.water_triangles = 4000,
                                .terrain_triangles = 4000,
                                .without = {Part::kEarth}};  // picks ask a flat world
  IdErrors errors;
  for (int n = 0; n < trials(kViews); ++n) {
    LabelledFrame frame(world, random_view(world.scene(), n, kSurfaceSize_px), 3.0 + 7.0 * n,
                        options);
    Traced traced{frame};
    for (int i = 0; i < kPixels; ++i) {
      const auto dice = [&](int k) {
        return random_uniform(9, static_cast<std::uint64_t>(2 * (kPixels * n + i) + k));
      };
      compare_pixel(traced, glm::ivec2(glm::dvec2(kSurfaceSize_px) * glm::dvec2(dice(0), dice(1))),
                    errors);
    }
  }
  EXPECT_LE(errors.beside_edge, errors.pixels / 200);
  EXPECT_LE(errors.shallow, errors.pixels / 500);
}

}  // namespace
}  // namespace swell::render
