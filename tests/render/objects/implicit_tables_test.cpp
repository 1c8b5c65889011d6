// Tables of heights as objects, against closed formulas (Vyatkin, Dolgovesov, 2019, formulas 11 to
// 13 and figure 3).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "math/simd_target.h"
#include "render/measures.h"
#include "render/objects/height_pictures.h"
#include "render/objects/implicit_shots.h"
#include "render/shot.h"

namespace swell::render {
namespace {

// How two shots differ: pixels that one alone shows, and depths where both do.
struct ShotDifference {
  std::size_t only_one = 0;
  double worst_m = 0.0;
};

ShotDifference difference_of(const ImplicitShot& a, const ImplicitShot& b) {
  ShotDifference result;
  for (std::size_t i = 0; i < a.part.size(); ++i) {
    if ((a.depth_m[i] > 0.0f) != (b.depth_m[i] > 0.0f))
      ++result.only_one;
    else
      result.worst_m = std::max<double>(result.worst_m, std::abs(a.depth_m[i] - b.depth_m[i]));
  }
  return result;
}

// From before and above, aside.
View from_above(double distance_m, double height_m, int size_px) {
  const double fov = 2.0 * std::atan(0.5 * height_m / distance_m);
  const double heading = 0.5, pitch = -0.7;
  const glm::dvec3 along(std::sin(heading) * std::cos(pitch), std::cos(heading) * std::cos(pitch),
                         std::sin(pitch));
  return make_view(-distance_m * along, heading, pitch, fov, 0.25f, size_px, size_px);
}

// A table with rows of another number than columns: what lies beside its square's corner is not
// there.
TEST(ImplicitTables, AConstantRaisesTheFaceOfABox) {
  const HeightPictures pictures;
  pictures.write("flat.exr", 9, 5, [](double, double) { return 0.5; });
  for (const char* const turn : {"[0, 0, 0]", "[30, 0, 0]", "[20, 200, 50]"}) {
    const scene::ImplicitSurface table =
        pictures.parse(fmt::format("[[form]]\nshape = \"box\"\nsize = [2, 3, 1]\nturn_deg = {}\n"
                                   "heights = {{ image = \"flat.exr\" }}",
                                   turn));
    // Half a metre higher: within the box that is cut to its own size but for its top.
    const scene::ImplicitSurface box = pictures.parse(
        fmt::format("[[form]]\nshape = \"box\"\nsize = [2, 3, 2]\nturn_deg = {0}\n"
                    "keep = [{{ shape = \"quadric\", size = [2, 2, 2], turn_deg = {0}, "
                    "quadric = [0, 0, -1, 0, 0, 0, 0, 0, 0.5, 0.5] }}]",
                    turn));
    const View view = from_above(9.0, 5.0, 200);
    const ImplicitShot a = shoot(table, view), b = shoot(box, view);
    const ShotDifference off = difference_of(a, b);
    EXPECT_GT(a.count, 5000u) << turn;
    EXPECT_LE(off.only_one, 2u) << turn;
    EXPECT_LT(off.worst_m, 2e-5) << turn;  // of 9 m
  }
}

// z = 1 - x^2 - y^2 from 257 x 257 posts is off its bilinear surface by (1 / 128)^2 / 2 = 3e-5 at
// most, along the ray at a slant by more.
TEST(ImplicitTables, AParaboloidIsAsFarAsItsQuadric) {
  const HeightPictures pictures;
  pictures.write("tip.exr", 257, 257, [](double u, double v) { return 1.0 - u * u - v * v; });
  const double tilt = 30.0 * kPi / 180.0;
  for (const double tilt_deg : {0.0, 30.0}) {
    const double s = tilt_deg > 0.0 ? std::sin(tilt) : 0.0,
                 c = tilt_deg > 0.0 ? std::cos(tilt) : 1.0;
    const scene::ImplicitSurface table = pictures.parse(
        fmt::format("[[form]]\nshape = \"plane\"\nsize = [2, 2, 2]\nturn_deg = [{0}, 0, 0]\n"
                    "heights = {{ image = \"tip.exr\" }}\n"
                    "keep = [{{ shape = \"box\", size = [4, 4, 2], at = [0, {1}, {2}], "
                    "turn_deg = [{0}, 0, 0] }}]",
                    tilt_deg, -s, c));
    const scene::ImplicitSurface quadric = pictures.parse(
        fmt::format("[[form]]\nshape = \"paraboloid\"\nsize = [2, 2, 1]\nat = [0, {}, {}]\n"
                    "turn_deg = [{}, 0, 0]",
                    -0.5 * s, 0.5 * c, tilt_deg));
    const View view = from_above(6.0, 3.0, 200);
    const ImplicitShot a = shoot(table, view), b = shoot(quadric, view);
    const ShotDifference off = difference_of(a, b);
    EXPECT_GT(a.count, 5000u);
    EXPECT_LT(off.only_one, a.count / 500) << tilt_deg;
    EXPECT_LT(off.worst_m, 6e-3) << tilt_deg;  // at the rim, where rays graze it
    double sum = 0.0;
    for (std::size_t i = 0; i < a.part.size(); ++i)
      if (a.depth_m[i] > 0.0f && b.depth_m[i] > 0.0f) sum += std::abs(a.depth_m[i] - b.depth_m[i]);
    EXPECT_LT(sum / static_cast<double>(a.count), 4e-5) << tilt_deg;
  }
}

// Formula 13: the border is where the heights are the threshold, here a circle, and no square.
TEST(ImplicitTables, AThresholdsBorderIsItsContour) {
  const HeightPictures pictures;
  constexpr double kThreshold_m = 0.4;
  pictures.write("cone.exr", 65, 65,
                 [](double u, double v) { return 1.0 - std::sqrt(u * u + v * v); });
  const scene::ImplicitSurface implicit =
      pictures.parse(fmt::format("[[form]]\nshape = \"plane\"\nsize = [2, 2, 0.2]\n"
                                 "heights = {{ image = \"cone.exr\", threshold_m = {} }}",
                                 kThreshold_m));
  constexpr double kFar_m = 500.0;
  const View view = make_view({0.0, 0.0, kFar_m}, 0.0, -0.5 * kPi, 2.2 / kFar_m, 0.25f, 300, 300);
  const ImplicitShot shot = shoot(implicit, view);
  const double radius_m = 1.0 - kThreshold_m, cell_m = 2.0 / 64.0;
  for (std::size_t i = 0; i < shot.part.size(); ++i) {
    const glm::dvec3 ray = shot.ray(i);
    const double from_middle_m = kFar_m * glm::length(glm::dvec2(ray)) / -ray.z;
    if (std::abs(from_middle_m - radius_m) < cell_m) continue;
    ASSERT_EQ(shot.depth_m[i] > 0.0f, from_middle_m < radius_m) << from_middle_m;
  }
  const double area_m2 = static_cast<double>(shot.count) * shot.pixel_area() * kFar_m * kFar_m;
  EXPECT_NEAR(area_m2, kPi * radius_m * radius_m, 5e-3);
}

// From aside its border is a wall, down to the part's end, as high as the threshold.
TEST(ImplicitTables, AThresholdsBorderIsAWall) {
  const HeightPictures pictures;
  pictures.write("cone.exr", 129, 129,
                 [](double u, double v) { return 1.0 - std::sqrt(u * u + v * v); });
  const ImplicitShot shot =
      shoot(pictures.parse("[[form]]\nshape = \"plane\"\nsize = [2, 2, 0.4]\n"
                           "heights = { image = \"cone.exr\", threshold_m = 0.5 }"),
            from_south(2000.0, 2.4, 600));
  // A rectangle as broad as the circle from -0.2 m to 0.5 m, and the cone over it.
  const double area_m2 = static_cast<double>(shot.count) * shot.pixel_area() * 2000.0 * 2000.0;
  EXPECT_NEAR(area_m2, 0.7 + 0.25, 5e-3);
}

TEST(ImplicitTables, BicubicHeightsAreNearerToWhatWasSampled) {
  const HeightPictures pictures;
  pictures.write("dome.exr", 17, 17,
                 [](double u, double v) { return 0.5 * std::cos(2.0 * u) * std::cos(2.0 * v); });
  const auto worst_m = [&](const char* interpolation) {
    const scene::ImplicitSurface implicit =
        pictures.parse(fmt::format("[[form]]\nshape = \"plane\"\nsize = [2, 2, 2]\n"
                                   "heights = {{ image = \"dome.exr\", interpolation = \"{}\" }}",
                                   interpolation));
    const View view = make_view({0.0, 0.0, 100.0}, 0.0, -0.5 * kPi, 0.01, 0.25f, 200, 200);
    const ImplicitShot shot = shoot(implicit, view);
    double worst = 0.0;
    for (std::size_t i = 0; i < shot.part.size(); ++i) {
      const glm::dvec3 p = view.eye_world + shot.ray(i) * static_cast<double>(shot.depth_m[i]);
      worst = std::max(worst, std::abs(p.z - 0.5 * std::cos(2.0 * p.x) * std::cos(2.0 * p.y)));
    }
    return worst;
  };
  // Bilinear: an eighth of the spacing's square times the curvatures, 4 in all.
  EXPECT_NEAR(worst_m("bilinear"), 4.0 / 8.0 / 64.0, 1e-3);
  EXPECT_LT(worst_m("bicubic"), 1.5e-3);
}

std::string waves(const std::string& image, const char* more) {
  return fmt::format(
      "[[form]]\nshape = \"box\"\nsize = [4, 4, 1]\n"
      "heights = {{ image = \"{}\"{} }}",
      image, more);
}

// All frames have one highest post, in a corner, and so one box: rays begin at its sides.
void write_waves(const HeightPictures& pictures, int frames) {
  for (int frame = 0; frame < frames; ++frame)
    pictures.write(fmt::format("wave_{:04}.exr", frame), 33, 33, [&](double u, double v) {
      if (u > 0.99 && v > 0.99) return 0.4;
      return 0.3 * std::sin(5.0 * u + 2.0 * kPi * frame / frames) * std::cos(3.0 * v);
    });
}

TEST(ImplicitTables, ASequenceIsItsStillFrameAtEachFramesTime) {
  const HeightPictures pictures;
  constexpr int kFrames = 5;
  constexpr double kLoop_s = 0.7;
  write_waves(pictures, kFrames);
  const scene::ImplicitSurface moving =
      pictures.parse(waves("wave_%04d.exr", ", frames = 5, loop_s = 0.7"));
  const View view = from_above(12.0, 7.0, 120);
  ImplicitShot last;
  for (int k = 0; k <= kFrames + 1; ++k) {
    const ImplicitShot still =
        shoot(pictures.parse(waves(fmt::format("wave_{:04}.exr", k % kFrames), "")), view);
    const ImplicitShot now = shoot(moving, view, k * kLoop_s / kFrames);
    EXPECT_EQ(now.part, still.part) << k;
    EXPECT_EQ(now.depth_m, still.depth_m) << k;
    if (k == kFrames) {
      EXPECT_EQ(now.depth_m, shoot(moving, view, 0.0).depth_m);
      EXPECT_EQ(now.depth_m, shoot(moving, view, 100 * kLoop_s).depth_m);
    }
    EXPECT_GT(k > 0 ? difference_of(now, last).worst_m : 1.0, 0.05) << k;
    last = now;
  }
}

// Halfway between two frames each height is their mean.
TEST(ImplicitTables, BetweenFramesHeightsAreBetweenTheirs) {
  const HeightPictures pictures;
  pictures.write("step_0000.exr", 5, 5, [](double, double) { return 0.2; });
  pictures.write("step_0001.exr", 5, 5, [](double u, double) { return 0.6 + 0.2 * u; });
  const scene::ImplicitSurface moving =
      pictures.parse(waves("step_%04d.exr", ", frames = 2, loop_s = 2"));
  const View view = make_view({0.0, 0.0, 50.0}, 0.0, -0.5 * kPi, 0.04, 0.25f, 100, 100);
  const ImplicitShot shot = shoot(moving, view, 0.25);
  ASSERT_EQ(shot.count, shot.part.size());
  for (std::size_t i = 0; i < shot.part.size(); ++i) {
    const glm::dvec3 p = view.eye_world + shot.ray(i) * static_cast<double>(shot.depth_m[i]);
    EXPECT_NEAR(p.z, 0.5 + 0.75 * 0.2 + 0.25 * (0.6 + 0.1 * p.x), 1e-5);
  }
}

TEST(ImplicitTables, AreTheSameBitsOnTilesAndTargets) {
  const HeightPictures pictures;
  write_waves(pictures, 3);
  const scene::ImplicitSurface moving =
      pictures.parse(waves("wave_%04d.exr", ", frames = 3, loop_s = 1, threshold_m = -0.1"));
  const View view = from_above(12.0, 7.0, 150);
  const ImplicitShot reference = shoot(moving, view, 0.1);
  EXPECT_GT(reference.count, 3000u);
  for (const int tile : {16, 32}) {
    const ImplicitShot other = shoot(moving, view, 0.1, true, tile);
    EXPECT_EQ(other.part, reference.part);
    EXPECT_EQ(other.depth_m, reference.depth_m);
  }
  if (!simd_target_available(SimdTarget::kAvx512)) return;
  select_simd_target(simd_targets().front());
  const ImplicitShot narrow = shoot(moving, view, 0.1);
  select_simd_target(SimdTarget::kAvx512);
  EXPECT_EQ(narrow.depth_m, shoot(moving, view, 0.1).depth_m);
}

scene::Scene sea_under(const std::string& file) {
  scene::Scene scene;
  scene.sea.wind_speed_mps = 0.0;
  scene.water.bump_strength = 0.0;
  scene.sky.cloud_cover = 0.0;
  scene.camera.eye_m = {0.0, -16.0, 7.0};
  scene.camera.pitch_rad = radians(-24.0);
  scene::FloatingObject object = scene::common_object(scene::ObjectKind::kImplicit);
  object.motion = scene::Motion::kFixed;
  object.file = file;
  scene.objects = {object};
  return scene;
}

// "At no cost for vertices": neither posts nor frames are triangles.
TEST(ImplicitTables, MoveWithoutATriangle) {
  const HeightPictures pictures;
  write_waves(pictures, 4);
  const auto file =
      pictures.folder().write("moving.toml", waves("wave_%04d.exr", ", frames = 4, loop_s = 1"));
  const World world = world_of(sea_under(file.string()));
  const Shot now = small_shot(world, 0.0), later = small_shot(world, 0.4);
  EXPECT_GT(mean_difference(now.target, later.target), 0.3);
  EXPECT_EQ(now.statistics.object_triangles, 1);
  EXPECT_EQ(later.statistics.object_triangles, 1);
  EXPECT_EQ(now.statistics.water_triangles, later.statistics.water_triangles);
}

// Labels have the normal of the heights: of a plane of slope 0.3 to the right.
TEST(ImplicitTables, NormalIsThatOfTheHeights) {
  const HeightPictures pictures;
  pictures.write("ramp.exr", 9, 9, [](double u, double) { return 2.0 + 0.6 * u; });
  const auto file = pictures.folder().write("ramp.toml", waves("ramp.exr", ""));
  const World world = world_of(sea_under(file.string()));
  FrameOptions options = few_triangles();
  for (const Label label : {Label::kId, Label::kDepth, Label::kGeometricNormal})
    options.labels.add(label);
  const Shot shot = small_shot(world, 1.0, options);
  const glm::dvec3 up = glm::normalize(glm::dvec3(-0.3, 0.0, 1.0));
  int seen = 0;
  for (int y = 0; y < kSmallHeight; ++y)
    for (int x = 0; x < kSmallWidth; ++x) {
      const std::size_t i = shot.at(x, y);
      if (shot.target.labels.id[i] != kFirstObjectId) continue;
      const glm::dvec3 p = position_of(shot.view, x, y, shot.target.labels.depth_m[i]);
      if (std::max(std::abs(p.x), std::abs(p.y)) > 1.9) continue;
      ++seen;
      EXPECT_NEAR(p.z, 2.5 + 0.3 * p.x, 1e-3);
      EXPECT_GT(glm::dot(up, glm::dvec3(shot.target.labels.geometric_normal[i])), 0.9999);
    }
  EXPECT_GT(seen, 150);
}

}  // namespace
}  // namespace swell::render
