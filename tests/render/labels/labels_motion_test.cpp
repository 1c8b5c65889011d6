// Motion in the picture, against points that the tests move and project themselves, in doubles.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "math/ray_triangle.h"
#include "ocean/water_surface.h"
#include "render/labelled_frame.h"
#include "scene/water.h"

namespace swell::render {
namespace {

constexpr glm::ivec2 kMotionSize_px(320, 180);
constexpr double kTime_s = 6.0, kStep_s = 0.125;

View view_at(glm::dvec3 eye, double heading, double pitch, double roll) {
  return make_view(eye, camera_axes(heading, pitch, roll),
                   lens_of_fov(0.9, kMotionSize_px.x, kMotionSize_px.y), 0.25f, kMotionSize_px.x,
                   kMotionSize_px.y);
}

FrameOptions motion_to(std::optional<View> next) {
  return {.next_view = next, .next_frame_s = kStep_s};
}

glm::dvec2 motion(const LabelledFrame& frame, glm::ivec2 p) {
  return glm::dvec2(frame.labels().motion_px[frame.at(p)]);
}

// What the pixel's point does in the picture when it moves to p_next.
glm::dvec2 motion_to_point(const View& next, glm::ivec2 p, glm::dvec3 p_next) {
  return project(next, p_next) - centre_of(p);
}

TEST(LabelMotion, WhatStandsStillHasExactlyNone) {
  const World& world = shipped_world("lagoon");
  const View view = view_of(world, kTime_s, kMotionSize_px.x, kMotionSize_px.y);
  for (const std::optional<View>& next : {std::optional<View>(), std::optional<View>(view)}) {
    const LabelledFrame frame(world, view, kTime_s, motion_to(next));
    int land = 0, sky = 0, moving_water = 0;
    frame.for_pixels(1, [&](glm::ivec2 p) {
      const std::uint32_t id = frame.labels().id[frame.at(p)];
      if (id == kWaterId) return void(moving_water += glm::length(motion(frame, p)) > 0.0);
      ASSERT_EQ(motion(frame, p), glm::dvec2(0.0));
      ++(id == kSkyId ? sky : land);
    });
    EXPECT_GT(land, 1000);
    EXPECT_GT(sky, 1000);
    EXPECT_GT(moving_water, 1000);
  }
}

// OUT-03: the homography of the plane z = 0, by its rays.
TEST(LabelMotion, APlaneMovesByItsHomographyAndTheSkyByTheRotation) {
  const World& world = shipped_world("open_ocean_plane");
  const View view = view_at({1000.0, -300.0, 9.0}, 0.4, -0.15, 0.05);
  for (const View& next : {view_at({1000.5, -299.0, 9.2}, 0.43, -0.16, 0.0),
                           view_at({1008.0, -301.0, 8.0}, 0.2, -0.1, 0.3)}) {
    const LabelledFrame frame(world, view, kTime_s, motion_to(next));
    double worst = 0.0;
    int water = 0, sky = 0;
    frame.for_pixels(1, [&](glm::ivec2 p) {
      const bool is_sky = frame.labels().id[frame.at(p)] == kSkyId;
      const glm::dvec3 ray = (position_of(view, p.x, p.y, 1.0f) - view.eye_world);
      const glm::dvec3 place =
          is_sky ? next.eye_world + ray : view.eye_world - (view.eye_world.z / ray.z) * ray;
      const glm::dvec2 expected = motion_to_point(next, p, place);
      if (std::isnan(expected.x)) return;
      if (is_sky || place.y > -270.0) {
        ++(is_sky ? sky : water);
        // The plane is drawn to within 0.01 pixels, which tells in large steps.
        const double size = 1.0 + 0.01 * glm::length(expected);
        worst = std::max(worst, glm::distance(motion(frame, p), expected) / size);
      }
    });
    EXPECT_LT(worst, 1e-3);
    EXPECT_GT(water, 5000);
    EXPECT_GT(sky, 5000);
  }
}

TEST(LabelMotion, IsZeroOfWhatLiesBehindTheNextCamera) {
  const World& world = shipped_world("open_ocean");
  const View view = view_at({0.0, 0.0, 9.0}, 0.0, -0.2, 0.0);
  const LabelledFrame frame(world, view, kTime_s,
                            motion_to(view_at({0.0, 0.0, 9.0}, 3.1, -0.2, 0.0)));
  frame.for_pixels(1, [&](glm::ivec2 p) { ASSERT_EQ(motion(frame, p), glm::dvec2(0.0)); });
}

// The next places of what a frame shows, from the scene alone.
struct NextPlaces {
  NextPlaces(const scene::Scene& drawn, double now_s)
      : scene(drawn),
        water(drawn),
        now(water.at(now_s, frames[0], workers)),
        next(water.at(now_s + kStep_s, frames[1], workers)),
        poses_now(drawn.objects.size()),
        poses_next(drawn.objects.size()) {
    scene::object_poses(scene.objects, now, poses_now);
    scene::object_poses(scene.objects, next, poses_next);
  }

  glm::dvec3 of_object(std::size_t n, glm::dvec3 p) const {
    const scene::ObjectPose &a = poses_now[n], &b = poses_next[n];
    const glm::dvec3 own = glm::inverse(a.world_from_object) * (p - a.position_world);
    return b.position_world + b.world_from_object * own;
  }
  // What the column under p rises by.
  double rise(glm::dvec2 p) const {
    return static_cast<double>(next.height(p)) - static_cast<double>(now.height(p));
  }
  // What the drawn triangle rises by where a ray meets it: its vertices rise as the water does, or
  // as much of it as they show far out.
  static double rise_of_triangle(const LabelledFrame& frame, std::uint32_t i, const Ray& ray) {
    const FrameState& drawn = frame.state();
    const Surface& surface = drawn.meshes.water;
    std::array<glm::dvec3, 3> corner;
    glm::dvec3 rises;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = surface.mesh.indices[3 * i + static_cast<std::uint32_t>(k)];
      corner[static_cast<std::size_t>(k)] = {vertex_world(surface, v), surface.height_m[v]};
      rises[k] = static_cast<double>(drawn.labels.next_height_m[v] - surface.height_m[v]);
    }
    const auto crossing = cross_triangle(ray, corner);
    return crossing ? glm::dot(crossing->weight, rises) : std::nan("");
  }

  scene::Scene scene;
  scene::Water water;
  Workers workers{2};
  std::array<ocean::SeaFrame, 2> frames;
  scene::WaterSurface now, next;
  std::vector<scene::ObjectPose> poses_now, poses_next;
};

class MotionOfScene : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scenes, MotionOfScene,
                         testing::Values("lagoon", "beach", "buoys", "open_ocean"),
                         [](const auto& test) { return std::string(test.param); });

// Places of depth from the picture itself: it is the move that is judged here.
TEST_P(MotionOfScene, TakesPointsToWhereTheNextFrameHasThem) {
  const scene::Scene scene = load_shipped(GetParam());
  const World& world = shipped_world(GetParam());
  const NextPlaces places(scene, kTime_s);
  int water = 0, others = 0;
  for (int n = 0; n < 6; ++n) {
    const View view = random_view(scene, n, kMotionSize_px);
    View next = random_view(scene, n, kMotionSize_px);
    next.eye_world += glm::dvec3(0.3, -0.2, 0.1);
    const LabelledFrame frame(world, view, kTime_s, motion_to(next));
    const FrameState& drawn = frame.state();
    const Surface& sea = drawn.meshes.water;
    for (std::size_t v = 0; v < drawn.labels.next_height_m.size(); v += 7) {
      const glm::dvec3 p(vertex_world(sea, v), 0.0);
      // Further out waves fade.
      if (glm::distance(p, view.eye_world) > 0.79 * sea.statistics.reach_m) continue;
      ASSERT_EQ(drawn.labels.next_height_m[v], places.next.height(glm::dvec2(p)));
    }
    frame.for_pixels(3, [&](glm::ivec2 p) {
      const std::uint32_t id = frame.labels().id[frame.at(p)];
      if (id == kSkyId) return;
      glm::dvec3 place = frame.position(p);
      if (id == kWaterId) {
        const glm::dvec3 flat = place + glm::dvec3(0.0, 0.0, frame.sunk_m(place));
        const Ray ray = make_ray(view.eye_world, flat - view.eye_world);
        place.z += NextPlaces::rise_of_triangle(frame, frame.primitive(p), ray);
      }
      if (id >= kFirstObjectId) place = places.of_object(id - kFirstObjectId, place);
      const glm::dvec2 expected = motion_to_point(next, p, place);
      if (std::isnan(expected.x)) return;  // behind, or a ray beside its triangle's edge
      ++(id == kWaterId ? water : others);
      ASSERT_LT(glm::distance(motion(frame, p), expected), 0.01) << p.x << " " << p.y << " " << id;
    });
  }
  EXPECT_GT(water, 5000);
  EXPECT_GE(others, scene.objects.empty() && !scene.terrain ? 0 : 100);
}

// The trees of this frame and of the next, both as they are drawn: a point of a triangle goes to
// the same point of the triangle.
TEST(LabelMotion, TreesMoveAsTheySway) {
  const World world = world_of(scene::parse_scene(R"(
    [wind]
    speed_mps = 18.0
    from_deg = 300.0
    [sky]
    model = "gradient"
    [terrain]
    island_radius_m = 130.0
    island_height_m = 30.0
    [[trees]]
    density_per_m2 = 0.02
    height_m = [6.0, 14.0]
)",
                                                  "windy_trees.toml"));
  const View view = view_at({0.0, -120.0, 9.0}, 0.1, 0.05, 0.0);
  constexpr double kSwing_s = 1.0;
  const LabelledFrame frame(world, view, kTime_s, {.next_frame_s = kSwing_s});
  const LabelledFrame later(world, view, kTime_s + kSwing_s);
  const auto trees_of = [](const LabelledFrame& f) -> const TreeDraws& {
    return f.state().meshes.trees.drawn_in(ViewKind::kWindow);
  };
  const std::vector<glm::vec3>&now = trees_of(frame).p_rel, &next = trees_of(later).p_rel;
  ASSERT_EQ(now.size(), next.size());
  const PrimitiveRanges& ranges = frame.state().window.primitives;
  int trees = 0;
  double fastest = 0.0;
  frame.for_pixels(1, [&](glm::ivec2 p) {
    if (!ranges.holds(SurfaceKind::kTrees, frame.primitive(p))) return;
    const std::size_t first = 3u * (frame.primitive(p) - ranges.begin(SurfaceKind::kTrees));
    const glm::dvec3 ray = position_of(view, p.x, p.y, 1.0f) - view.eye_world;
    const auto crossing = cross_triangle(make_ray(glm::dvec3(0.0), ray),
                                         {now[first], now[first + 1], now[first + 2]});
    if (!crossing) return;  // beside an edge, to rounding
    glm::dvec3 place = view.eye_world;
    for (int k = 0; k < 3; ++k)
      place += crossing->weight[k] * glm::dvec3(next[first + static_cast<std::size_t>(k)]);
    const glm::dvec2 expected = motion_to_point(view, p, place);
    ASSERT_LT(glm::distance(motion(frame, p), expected), 2e-3) << p.x << " " << p.y;
    ++trees;
    fastest = std::max(fastest, glm::length(expected));
  });
  EXPECT_GT(trees, 3000);
  EXPECT_GT(fastest, 0.5);
}

// Where triangles are small against the waves, pixels move as the columns of the water that is
// asked: what the triangles cut off of its rise bounds the difference.
TEST(LabelMotion, WaterMovesAsItsColumnsDo) {
  scene::Scene scene = load_shipped("sines");
  scene.sea.sines.resize(2);  // of 90 and 37 m
  const World world = world_of(scene);
  const NextPlaces places(scene, kTime_s);
  const View view = view_at({0.0, -60.0, 14.0}, 0.3, -0.4, 0.0);
  const LabelledFrame frame(world, view, kTime_s,
                            {.water_triangles = 100000, .next_frame_s = kStep_s});
  double fastest = 0.0;
  frame.for_pixels(1, [&](glm::ivec2 p) {
    if (frame.labels().id[frame.at(p)] != kWaterId) return;
    glm::dvec3 place = frame.position(p);
    place.z += places.rise(glm::dvec2(place));
    const glm::dvec2 expected = motion_to_point(view, p, place);
    ASSERT_LT(glm::distance(motion(frame, p), expected), 0.05) << p.x << " " << p.y;
    fastest = std::max(fastest, glm::length(expected));
  });
  EXPECT_GT(fastest, 1.0);
}

}  // namespace
}  // namespace swell::render
