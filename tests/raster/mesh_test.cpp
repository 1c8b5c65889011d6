// Meshes have no holes and no pixel that two of their triangles cover.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "math/view.h"
#include "raster/clip.h"
#include "raster/picture.h"

namespace swell::raster {
namespace {

struct Mesh {
  std::vector<glm::vec4> p_clip;
  std::vector<std::uint32_t> indices;
  std::vector<float> clip_distance;
};

void add_quads(Mesh& mesh, int columns, int rows, Random& random) {
  const auto stride = static_cast<std::uint32_t>(columns + 1);
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const std::uint32_t a =
          static_cast<std::uint32_t>(y) * stride + static_cast<std::uint32_t>(x);
      const std::uint32_t b = a + 1, c = a + stride, d = c + 1;
      // Either diagonal.
      if (random.integer(0, 1) == 0) {
        for (const std::uint32_t i : {a, b, c, c, b, d}) mesh.indices.push_back(i);
      } else {
        for (const std::uint32_t i : {a, b, d, a, d, c}) mesh.indices.push_back(i);
      }
    }
  }
}

// How many triangles cover each pixel, told apart as 0, 1 and more (2). Of two triangles that
// cover a pixel some bit of the number differs, so if for every bit the triangles with and those
// without it are drawn apart, both pictures hold the pixel for that bit. With one triangle it is
// in exactly one of the two for every bit.
std::vector<int> coverage_counts(const std::vector<Mesh>& meshes, Viewport viewport) {
  std::size_t triangles = 0;
  for (const Mesh& mesh : meshes) triangles += mesh.indices.size() / 3;
  std::vector<int> count(static_cast<std::size_t>(viewport.width_px) * viewport.height_px, 0);
  Workers workers(1);
  for (std::size_t bit = 1; bit < 2 * triangles; bit *= 2) {
    std::vector<int> times(count.size(), 0);
    for (const std::size_t wanted : {std::size_t{0}, bit}) {
      std::vector<std::vector<std::uint32_t>> indices(meshes.size());
      std::vector<Draw> draws;
      std::size_t number = 0;
      for (std::size_t m = 0; m < meshes.size(); ++m) {
        for (std::size_t i = 0; i < meshes[m].indices.size(); i += 3, ++number) {
          if ((number & bit) != wanted) continue;
          indices[m].insert(indices[m].end(), meshes[m].indices.begin() + i,
                            meshes[m].indices.begin() + i + 3);
        }
        draws.push_back({.p_clip = meshes[m].p_clip,
                         .indices = indices[m],
                         .clip_distance = {meshes[m].clip_distance}});
      }
      const Picture picture = draw_picture(draws, viewport, 64, workers);
      for (std::size_t p = 0; p < times.size(); ++p) {
        times[p] += picture.primitive[p] != kNoPrimitive;
      }
    }
    for (std::size_t p = 0; p < times.size(); ++p) count[p] = std::max(count[p], times[p]);
  }
  return count;
}

int pixels_not_covered_once(const std::vector<Mesh>& meshes, Viewport viewport) {
  int wrong = 0;
  for (const int count : coverage_counts(meshes, viewport)) wrong += count != 1;
  return wrong;
}

TEST(MeshCounting, SeesHolesAndOverlaps) {
  constexpr Viewport kView{16, 16};
  Mesh mesh;
  for (const glm::vec4& p : {glm::vec4(-1, -1, 0.5, 1), glm::vec4(1, -1, 0.5, 1),
                             glm::vec4(-1, 1, 0.5, 1), glm::vec4(1, 1, 0.5, 1)}) {
    mesh.p_clip.push_back(p);
  }
  mesh.indices = {0, 1, 2, 1, 3, 2};
  EXPECT_EQ(pixels_not_covered_once({mesh}, kView), 0);
  mesh.indices = {0, 1, 2};
  // All but 16 * 15 / 2: the right edge owns no pixel centre.
  EXPECT_EQ(pixels_not_covered_once({mesh}, kView), 136);
  mesh.indices = {0, 1, 2, 1, 3, 2, 0, 1, 2};
  EXPECT_EQ(pixels_not_covered_once({mesh}, kView), 120);
}

// RAS-04.
TEST(Watertight, JitteredGridsWithOffScreenBordersCoverEachPixelOnce) {
  constexpr Viewport kView{96, 80};
  Random random(1);
  for (const int cells : {1, 3, 17, 60}) {
    Mesh mesh;
    const double step = 120.0 / cells;
    for (int y = 0; y <= cells; ++y) {
      for (int x = 0; x <= cells; ++x) {
        const double jitter = std::min(0.3 * step, 10.0);
        mesh.p_clip.push_back(clip_from_window(-12 + x * step + jitter * random.between(-1, 1),
                                               -12 + y * step + jitter * random.between(-1, 1), 0.5,
                                               random.between(0.3, 5), kView));
      }
    }
    add_quads(mesh, cells, cells, random);
    EXPECT_EQ(pixels_not_covered_once({mesh}, kView), 0) << cells;
  }
}

TEST(Watertight, FansOf200SlicesMeetingAtAPixelCentreCoverEachPixelOnce) {
  constexpr Viewport kView{64, 64};
  for (const double radius : {100.0, 20000.0, 1e7}) {
    Mesh mesh;
    mesh.p_clip.push_back(clip_from_window(30.5, 33.5, 0.5, 1, kView));
    constexpr std::uint32_t kSlices = 200;
    for (std::uint32_t i = 0; i < kSlices; ++i) {
      const double angle = 2 * std::numbers::pi * i / kSlices;
      mesh.p_clip.push_back(clip_from_window(30.5 + radius * std::cos(angle),
                                             33.5 + radius * std::sin(angle), 0.5, 1, kView));
      for (const std::uint32_t k : {0u, i + 1, (i + 1) % kSlices + 1}) mesh.indices.push_back(k);
    }
    EXPECT_EQ(pixels_not_covered_once({mesh}, kView), 0) << radius;
  }
}

TEST(Watertight, SliversOf1Over256PixelCoverEachPixelOnce) {
  constexpr Viewport kView{16, 16};
  Mesh mesh;
  Random random(2);
  constexpr int kColumns = 16 * 256 / 8;  // groups of 8 steps: 1 + 7
  std::vector<double> xs;
  for (int i = 0; i < kColumns; ++i) {
    xs.push_back(i / 32.0);
    xs.push_back(i / 32.0 + 1.0 / 256.0);
  }
  xs.push_back(16.0);
  for (int y = 0; y < 2; ++y) {
    for (const double x : xs) mesh.p_clip.push_back(clip_from_window(x, 16.0 * y, 0.5, 1, kView));
  }
  add_quads(mesh, static_cast<int>(xs.size()) - 1, 1, random);
  EXPECT_EQ(pixels_not_covered_once({mesh}, kView), 0);
}

struct Pose {
  View view;
  Mesh mesh;
};

constexpr double kHalfSide = 40.0;  // of the ground [m]

// A flat ground that reaches behind the camera, so that the near plane cuts it.
Pose random_pose(Random& random, Viewport viewport) {
  Pose pose;
  const double height = random.between(0.5, 5.0);
  pose.view = make_view({0, 0, height}, random.between(0, 6.2), random.between(-1.5, 0.2),
                        random.between(0.4, 1.8), 0.3f, viewport.width_px, viewport.height_px);
  constexpr int kCells = 24;
  for (int y = 0; y <= kCells; ++y) {
    for (int x = 0; x <= kCells; ++x) {
      const bool border = x % kCells == 0 || y % kCells == 0;
      const auto along = [&](int i) {
        const double jitter = border ? 0.0 : random.between(-0.3, 0.3);
        return (i + jitter) / kCells * 2 * kHalfSide - kHalfSide;
      };
      const glm::vec4 p_rel(along(x), along(y), -height, 1.0);
      pose.mesh.p_clip.push_back(pose.view.clip_from_rel * p_rel);
      pose.mesh.clip_distance.push_back(static_cast<float>(p_rel.x * 0.8 + p_rel.y * 0.3 - 2.0));
    }
  }
  add_quads(pose.mesh, kCells, kCells, random);
  return pose;
}

// True if the pixel's ray hits the ground well beyond the near plane and well within its border.
bool sees_ground(const View& view, int x, int y) {
  const glm::vec3 ray = view.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
  if (ray.z > -1e-3f) return false;
  const double depth = view.eye_world.z / -double{ray.z};
  const double gx = ray.x * depth, gy = ray.y * depth;
  return depth > 1.1 * double{view.near_m} && std::abs(gx) < 0.9 * kHalfSide &&
         std::abs(gy) < 0.9 * kHalfSide;
}

// RAS-04 under perspective, RAS-05, RAS-06.
TEST(Watertight, GroundsCutByTheNearPlaneCoverEachPixelOnce) {
  constexpr Viewport kView{96, 64};
  Random random(3);
  int seen = 0;
  for (int n = 0; n < 50; ++n) {
    Pose pose = random_pose(random, kView);
    Mesh whole = pose.mesh, other = pose.mesh;
    whole.clip_distance.clear();
    for (float& d : other.clip_distance) d = -d;
    for (const std::vector<Mesh>& meshes :
         {std::vector<Mesh>{whole}, std::vector<Mesh>{pose.mesh, other}}) {
      const std::vector<int> count = coverage_counts(meshes, kView);
      for (int y = 0; y < kView.height_px; ++y) {
        for (int x = 0; x < kView.width_px; ++x) {
          const int c = count[y * kView.width_px + x];
          ASSERT_LE(c, 1) << "pose " << n << " meshes " << meshes.size() << " at " << x << "," << y;
          if (!sees_ground(pose.view, x, y)) continue;
          ASSERT_EQ(c, 1) << "pose " << n << " meshes " << meshes.size() << " at " << x << "," << y;
          ++seen;
        }
      }
    }
  }
  EXPECT_GT(seen, 100'000);
}

TEST(Clipping, ACutIsTheSameBitsFromBothTrianglesAndBothSides) {
  Random random(4);
  for (int n = 0; n < 10'000; ++n) {
    const auto vertex = [&] {
      const double size = std::exp2(random.between(-20, 20));
      return ClipVertex{{random.between(-size, size), random.between(-size, size),
                         random.between(-size, size), random.between(-size, size)},
                        {random.between(-1, 1), random.between(-1, 1)}};
    };
    const ClipVertex a = vertex(), b = vertex();
    const double da = random.between(0, 1), db = -random.between(0, 1);
    const ClipVertex cut = cut_edge(a, da, b, db);
    for (const ClipVertex& same : {cut_edge(b, db, a, da), cut_edge(a, -da, b, -db)}) {
      ASSERT_EQ(cut.p_clip, same.p_clip);
      ASSERT_EQ(cut.user, same.user);
    }
  }
}

TEST(Clipping, ACutLiesWhereTheDistancesMeet) {
  const ClipVertex a{{0, 0, 0, 4}, {3.0, 5.0}}, b{{8, -4, 4, 0}, {-1.0, 1.0}};
  const ClipVertex cut = cut_edge(a, 3.0, b, -1.0);
  EXPECT_EQ(cut.p_clip, glm::dvec4(6, -3, 3, 1));
  EXPECT_EQ(cut.user, (std::array{0.0, 2.0}));
}

// The part with clip distance >= 0 of a triangle that covers the screen is a half-plane.
TEST(Clipping, TheUserPlaneKeepsItsPositiveSide) {
  constexpr Viewport kView{32, 16};
  Mesh mesh;
  mesh.p_clip = {glm::vec4(-4, -4, 0.5, 1), glm::vec4(8, -4, 0.5, 1), glm::vec4(-4, 8, 0.5, 1)};
  mesh.indices = {0, 1, 2};
  for (const glm::vec4& p : mesh.p_clip) mesh.clip_distance.push_back(p.x);  // x_ndc >= 0
  const Picture picture = draw_picture(
      {.p_clip = mesh.p_clip, .indices = mesh.indices, .clip_distance = {mesh.clip_distance}},
      kView);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 32; ++x) EXPECT_EQ(picture.primitive_at(x, y) == 0u, x >= 16);
  }
  EXPECT_EQ(picture.statistics.clipped, 1u);
}

}  // namespace
}  // namespace swell::raster
