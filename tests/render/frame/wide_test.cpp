// Wide pictures: what they are put together from, and that it does not show.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "math/elementary.h"
#include "math/projection.h"
#include "math/random.h"
#include "render/picture/wide_plan.h"
#include "render/shot.h"
#include "render/wide_frame.h"

namespace swell::render {
namespace {

constexpr double kWideTime_s = 5.0;
const Projection kAllRound = {.kind = ProjectionKind::kEquirectangular};

Projection fisheye(double fov_deg, glm::ivec2 size_px) {
  return fisheye_of_fov(radians(fov_deg), {0.02, -0.003, 0.0, 0.0}, size_px.x, size_px.y);
}

View wide_view(const Projection& projection, glm::ivec2 size_px, glm::dvec3 eye_m,
               double heading_deg, double pitch_deg, double roll_deg = 0.0) {
  View view =
      make_view(eye_m, camera_axes(radians(heading_deg), radians(pitch_deg), radians(roll_deg)),
                lens_of_fov(radians(90.0), size_px.x, size_px.y), 0.25f, size_px.x, size_px.y);
  view.projection = projection;
  return view;
}

glm::dvec3 ray_of_pixel(const WidePlan& plan, const WidePixel& pixel) {
  const WideFace& face = plan.faces[pixel.face];
  return glm::normalize(face.wide_from_face *
                        glm::dvec3((static_cast<double>(pixel.x_px) - face.k.cx) / face.k.fx,
                                   (static_cast<double>(pixel.y_px) - face.k.cy) / face.k.fy, 1.0));
}

TEST(WidePlan, LooksAPixelsRayUpWellWithinOneFace) {
  Workers workers(2);
  const glm::ivec2 size_px(160, 120);
  for (const Projection& projection :
       {kAllRound, fisheye(60, size_px), fisheye(180, size_px), fisheye(220, size_px)}) {
    const WidePlan plan = plan_wide(projection, size_px, workers);
    for (int y = 0; y < size_px.y; ++y)
      for (int x = 0; x < size_px.x; ++x) {
        const WidePixel& pixel = plan.pixels[static_cast<std::size_t>(y * size_px.x + x)];
        const auto ray = ray_at(projection, size_px, {x + 0.5, y + 0.5});
        ASSERT_EQ(pixel.face != kNoFace, ray.has_value());
        if (!ray) continue;
        EXPECT_LT(glm::distance(ray_of_pixel(plan, pixel), *ray), 1e-5);
        // Mirrored things come from a tenth of a picture's height beyond.
        const WideFace& face = plan.faces[pixel.face];
        const float margin_px = 0.09f * static_cast<float>(face.k.fx);
        EXPECT_GT(pixel.x_px, margin_px + pixel.reach_x_px);
        EXPECT_LT(pixel.x_px, static_cast<float>(face.width_px) - margin_px - pixel.reach_x_px);
        EXPECT_GT(pixel.y_px, margin_px + pixel.reach_y_px);
        EXPECT_LT(pixel.y_px, static_cast<float>(face.height_px) - margin_px - pixel.reach_y_px);
        EXPECT_GE(pixel.reach_x_px, 1.0f);
      }
  }
}

TEST(WidePlan, HasOnlyTheFacesThatThePictureMeets) {
  Workers workers(1);
  const auto faces = [&](const Projection& projection) {
    return plan_wide(projection, {64, 64}, workers).faces.size();
  };
  EXPECT_EQ(faces(fisheye(60, {64, 64})), 1u);
  EXPECT_EQ(faces(fisheye(180, {64, 64})), 5u);
  EXPECT_EQ(faces(fisheye(220, {64, 64})), 5u);
  EXPECT_EQ(faces(fisheye(350, {64, 64})), 6u);
  EXPECT_EQ(faces(kAllRound), 6u);
}

TEST(WidePlan, KeepsTheFacesOfTheLargestPicturesWithinBounds) {
  Workers workers(2);
  Projection narrow = fisheye(8, {64, 64});
  narrow.k = {460000.0, 460000.0, 32.0, 32.0};
  for (const WideFace& face : plan_wide(narrow, {64, 64}, workers).faces)
    EXPECT_LE(std::max(face.width_px, face.height_px), 8192);
}

TEST(WidePicture, HasTheLabelsOfTheNearestPixelsOfItsFaces) {
  const World& world = shipped_world("buoys");
  const glm::ivec2 size_px(96, 64);
  FrameOptions options;
  options.labels = LabelSet::all();
  for (const Projection& projection : {kAllRound, fisheye(200, size_px)}) {
    const View view = wide_view(projection, size_px, {0, -20, 3}, 20, -5, 3);
    const Shot wide(world, view, kWideTime_s, options);
    Workers workers(2);
    WideFrame parts;
    Target target;
    const auto requests = face_requests(world.scene(), {view, options, &target}, parts, workers);
    const WidePlan& plan = parts.plan;
    std::set<std::uint32_t> ids;
    for (std::size_t n = 0; n < plan.faces.size(); ++n) {
      const View& seen = requests[n].view;
      const Shot face(world, seen, kWideTime_s, requests[n].options);
      for (std::size_t i = 0; i < plan.pixels.size(); ++i) {
        const WidePixel& pixel = plan.pixels[i];
        if (pixel.face != n) continue;
        const int x = static_cast<int>(pixel.x_px), y = static_cast<int>(pixel.y_px);
        const std::size_t at = face.at(x, y);
        const Labels &from = face.target.labels, &to = wide.target.labels;
        EXPECT_EQ(to.id[i], from.id[at]);
        EXPECT_EQ(to.klass[i], from.klass[at]);
        EXPECT_EQ(to.normal[i], from.normal[at]);
        EXPECT_EQ(to.elevation_m[i], from.elevation_m[at]);
        EXPECT_EQ(to.flags[i], from.flags[at]);
        ids.insert(to.id[i]);
        if (!std::isfinite(from.depth_m[at])) {
          EXPECT_EQ(to.depth_m[i], from.depth_m[at]);
          continue;
        }
        // The distance of the nearest pixel's point, and a place that far along the pixel's ray.
        const double distance_m = distance_of(seen, x, y, from.depth_m[at]);
        EXPECT_NEAR(static_cast<double>(to.depth_m[i]), distance_m, 1e-6 * distance_m);
        const int u = static_cast<int>(i) % size_px.x, v = static_cast<int>(i) / size_px.x;
        const glm::dvec3 p = position_of(view, u, v, to.depth_m[i]);
        EXPECT_NEAR(glm::distance(p, view.eye_world), distance_m, 2e-6 * distance_m);
      }
    }
    EXPECT_GE(ids.size(), 3u);
  }
}

TEST(WidePicture, ShowsNothingOutsideItsCone) {
  const World& world = shipped_world("open_ocean");
  FrameOptions options;
  options.labels = LabelSet::all();
  const Shot wide(world, wide_view(fisheye(180, {64, 48}), {64, 48}, {0, 0, 5}, 0, 0), kWideTime_s,
                  options);
  EXPECT_EQ(wide.target.rgba[0] & 0xffffff, 0u);
  EXPECT_EQ(wide.target.labels.id[0], kSkyId);
  EXPECT_TRUE(std::isinf(wide.target.labels.depth_m[0]));
  EXPECT_EQ(wide.target.labels.flags[0], 0);
  EXPECT_NE(wide.codes(32, 40), glm::ivec3(0));
  EXPECT_TRUE(wide.target.linear.empty());
}

// The clear sky away from the sun is smooth, so that the nearest pixel of either has its light.
TEST(WidePicture, HasTheLightOfAPerspectiveOne) {
  const World& world = shipped_world("open_ocean");
  FrameOptions options;
  options.keep_linear = true;
  options.without.add(Part::kClouds);
  const glm::ivec2 size_px(256, 128);
  const View view = wide_view(kAllRound, size_px, {0, 0, 5}, 0, 0);
  const Shot wide(world, view, kWideTime_s, options);
  for (const double heading_deg : {135.0, 225.0, 260.0}) {
    const View pinhole =
        make_view({0, 0, 5}, radians(heading_deg), radians(30.0), radians(30.0), 0.25f, 33, 33);
    const Shot one(world, pinhole, kWideTime_s, options);
    const glm::vec3 d = one.direction(16, 16);
    const auto place = place_of(kAllRound, size_px, {d.x, -d.z, d.y});
    const glm::vec3 expected = one.linear(16, 16);
    const glm::vec3 found = wide.linear(static_cast<int>(place->x), static_cast<int>(place->y));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 0.04f * expected[c]);
  }
}

// Turned by 45 degrees, the same picture lies an eighth of its width aside, with its seams where
// the other's faces have their middles.
TEST(WidePicture, ShowsNoSeams) {
  const World& world = shipped_world("buoys");
  const glm::ivec2 size_px(512, 256);
  FrameOptions options;
  options.keep_linear = true;
  const Shot one(world, wide_view(kAllRound, size_px, {0, -20, 3}, 0, 0), kWideTime_s, options);
  const Shot turned(world, wide_view(kAllRound, size_px, {0, -20, 3}, 45, 0), kWideTime_s, options);
  // The mean square of the step to the next column, there and in the middle of faces.
  const auto steps = [&](const Shot& shot, int middle) {
    double sum = 0.0;
    for (int quarter = 0; quarter < 4; ++quarter)
      for (int y = 135; y < 250; ++y)
        for (int x = middle - 1; x <= middle; ++x) {
          const int at = (x + 128 * quarter) % 512;
          const glm::vec3 step =
              glm::min(shot.linear((at + 1) % 512, y), 1.0f) - glm::min(shot.linear(at, y), 1.0f);
          sum += static_cast<double>(glm::dot(step, step));
        }
    return sum;
  };
  // Seams of the one lie at columns 64 + 128 n; there the turned one has columns 0 + 128 n.
  EXPECT_LT(steps(one, 64), 1.3 * steps(turned, 0) + 1e-4);
  EXPECT_LT(steps(turned, 64), 1.3 * steps(one, 128) + 1e-4);
}

// The mean step of the picture's codes from a pixel to the next one, right or below: across seams,
// and some pixels beside them.
struct SeamSteps {
  double across = 0.0, beside = 0.0;
};

SeamSteps seam_steps(const Shot& shot) {
  Workers workers(1);
  const glm::ivec2 size_px(shot.view.width_px, shot.view.height_px);
  const WidePlan plan = plan_wide(shot.view.projection, size_px, workers);
  const auto face_at = [&](glm::ivec2 p) {
    return plan.pixels[static_cast<std::size_t>(p.y * size_px.x + p.x)].face;
  };
  const auto is_inside = [&](glm::ivec2 p) {
    return p.x >= 0 && p.y >= 0 && p.x < size_px.x && p.y < size_px.y;
  };
  const auto step = [&](glm::ivec2 a, glm::ivec2 b) {
    const glm::ivec3 off = glm::abs(shot.codes(a.x, a.y) - shot.codes(b.x, b.y));
    return static_cast<double>(off.x + off.y + off.z);
  };
  SeamSteps sum;
  std::size_t seams = 0, others = 0;
  for (int y = 0; y < size_px.y; ++y)
    for (int x = 0; x < size_px.x; ++x)
      for (const glm::ivec2& next : {glm::ivec2(1, 0), glm::ivec2(0, 1)}) {
        const glm::ivec2 p(x, y);
        if (!is_inside(p + next) || face_at(p) == face_at(p + next)) continue;
        if (face_at(p) == kNoFace || face_at(p + next) == kNoFace) continue;
        sum.across += step(p, p + next);
        ++seams;
        for (const int aside : {-5, -4, -3, 3, 4, 5}) {
          const glm::ivec2 a = p + aside * next, b = a + next;
          if (!is_inside(a) || !is_inside(b) || face_at(a) != face_at(b)) continue;
          sum.beside += step(a, b);
          ++others;
        }
      }
  return {sum.across / static_cast<double>(seams), sum.beside / static_cast<double>(others)};
}

TEST(WidePicture, StepsNoFurtherAcrossSeamsThanBesideThem) {
  const struct {
    const char* scene;
    glm::dvec3 eye_m;
  } places[] = {
      {"harbour", {-12, -18, 3}}, {"harbour", {-12, -18, -2}}, {"sea_state_8", {0, -900, 14}}};
  for (const auto& place : places) {
    const World& world = shipped_world(place.scene);
    for (const double pitch_deg : {0.0, -65.0}) {  // no seam lies on the horizon
      const glm::ivec2 size_px(640, 320);
      const Shot all(world, wide_view(kAllRound, size_px, place.eye_m, 29, pitch_deg), kWideTime_s);
      const SeamSteps steps = seam_steps(all);
      EXPECT_LT(steps.across / steps.beside, 1.3)
          << place.scene << " " << place.eye_m.z << " " << pitch_deg;
    }
  }
}

TEST(WidePicture, HasTheSameBitsOnAnyNumberOfThreadsAndAmongOtherViews) {
  const World& world = shipped_world("buoys");
  const glm::ivec2 size_px(120, 60);
  FrameOptions options;
  options.labels = LabelSet::all();
  const View all = wide_view(kAllRound, size_px, {0, -20, 3}, 0, 0);
  const View up = wide_view(fisheye(180, size_px), size_px, {0, -20, 3}, 0, 89);
  const View ahead = view_of(world, kWideTime_s, 80, 60);
  Shot alone(world, all, kWideTime_s, options, 1);
  const std::uint64_t hash = picture_hash(alone.target);
  const std::vector<glm::vec2> motion = alone.target.labels.motion_px;
  EXPECT_EQ(picture_hash(Shot(world, all, kWideTime_s, options, 3).target), hash);
  // Another in between leaves no trace.
  alone.draw(world, up, kWideTime_s, options);
  const std::uint64_t hash_up = picture_hash(alone.target);
  EXPECT_EQ(picture_hash(alone.draw(world, all, kWideTime_s, options)), hash);

  Workers workers(2);
  Workspaces workspaces;
  std::vector<Target> targets(3);
  const std::vector<FrameRequest> requests = {
      {up, options, &targets[0]}, {ahead, options, &targets[1]}, {all, options, &targets[2]}};
  const auto statistics = render_many(world, requests, kWideTime_s, workspaces, workers);
  EXPECT_EQ(picture_hash(targets[0]), hash_up);
  EXPECT_EQ(picture_hash(targets[1]),
            picture_hash(Shot(world, ahead, kWideTime_s, options).target));
  EXPECT_EQ(picture_hash(targets[2]), hash);
  EXPECT_EQ(targets[2].labels.motion_px, motion);
  EXPECT_EQ(statistics[2].visible_pixels, alone.statistics.visible_pixels);
}

// What is far turns as the camera does; a turn to the right moves it to the left, across the edge.
TEST(WidePicture, MovesAsItsProjectionSays) {
  const World& world = shipped_world("open_ocean");
  const glm::ivec2 size_px(180, 90);
  FrameOptions options;
  options.labels.add(Label::kMotion);
  options.labels.add(Label::kId);
  options.next_view = wide_view(kAllRound, size_px, {0, 0, 5}, 3, 0);
  const Shot all(world, wide_view(kAllRound, size_px, {0, 0, 5}, 0, 0), kWideTime_s, options);
  const Projection lens = fisheye(200, {64, 64});
  options.next_view = wide_view(lens, {64, 64}, {0, 0, 5}, 0, 60, 0);
  const Shot up(world, wide_view(lens, {64, 64}, {0, 0, 5}, 0, 50, 0), kWideTime_s, options);
  for (std::size_t i = 0; i < all.target.rgba.size(); ++i) {
    if (all.target.labels.id[i] != kSkyId) continue;
    EXPECT_NEAR(all.target.labels.motion_px[i].x, -3.0f / 360.0f * 180.0f, 1e-3f);
    EXPECT_NEAR(all.target.labels.motion_px[i].y, 0.0f, 1e-3f);
  }
  // The middle goes down by ten degrees.
  const double moved_px = lens.k.fy * fisheye_radius(lens.bend, radians(10.0));
  EXPECT_NEAR(up.target.labels.motion_px[up.at(32, 32)].y, moved_px, 0.05 * moved_px);
  EXPECT_NEAR(up.target.labels.motion_px[up.at(32, 32)].x, 0.0, 0.1);
}

TEST(WidePicture, HasTheMeanLightOfItsMoments) {
  scene::Scene scene = load_shipped("buoys");
  const World instant(scene);
  scene.camera.exposure_s = 0.5;
  scene.camera.shutter_samples = 2;
  const World world(scene, instant, 2);
  const glm::ivec2 size_px(96, 48);
  std::vector<View> views;
  for (const double heading_deg : {0.0, 2.0})
    views.push_back(wide_view(kAllRound, size_px, {0, -20, 3}, heading_deg, 0));
  FrameOptions options;
  options.keep_linear = true;
  const Shot first(instant, views[0], kWideTime_s, options);
  const Shot second(instant, views[1], kWideTime_s + 0.25, options);
  options.exposed_views = views;
  const Shot both(world, views[0], kWideTime_s, options);
  for (std::size_t i = 0; i < both.target.linear.size(); ++i) {
    const float mean = 0.5f * (first.target.linear[i] + second.target.linear[i]);
    EXPECT_NEAR(both.target.linear[i], mean, 1e-5f * (1.0f + mean));
  }
}

TEST(WidePictureDeathTest, RefusesWhatItCannotDraw) {
  const World& world = shipped_world("open_ocean");
  View view = wide_view(fisheye(180, {32, 32}), {32, 32}, {0, 0, 5}, 0, 0);
  EXPECT_DEATH(Shot(world, view, 0.0, {.wireframe = true}), "a wireframe of a wide view");
  view.projection.bend[0] = -1.0;
  EXPECT_DEATH(Shot(world, view, 0.0), "half_fov_rad");
}

}  // namespace
}  // namespace swell::render
