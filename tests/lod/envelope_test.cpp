#include "lod/envelope.h"

#include <gtest/gtest.h>

#include <functional>

#include "wavy_mesh.h"

namespace swell::lod {
namespace {

// Calls visit(envelope, parent or null) for all of them.
void for_all(const WavyMesh& wavy,
             const std::function<void(const Envelope&, const Envelope*)>& visit) {
  const std::function<void(const Envelope&, const Envelope*)> down = [&](const Envelope& e,
                                                                         const Envelope* parent) {
    visit(e, parent);
    if (e.is_leaf()) return;
    for (const Envelope& half : halves_of(wavy.envelopes, e)) down(half, &e);
  };
  for (const Envelope& root : roots_of(wavy.envelopes, wavy.domain.lattice_bits))
    down(root, nullptr);
}

TEST(Envelopes, LeavesAreTheMeshesTrianglesInOrder) {
  for (const int triangles : {2, 3, 4, 50, 3000}) {
    const WavyMesh wavy = make_wavy_mesh(1, triangles);
    int next = 0;
    for_all(wavy, [&](const Envelope& e, const Envelope*) {
      if (!e.is_leaf()) return;
      ASSERT_EQ(e.first_leaf, next);
      ASSERT_EQ(e.level, wavy.mesh.level[static_cast<std::size_t>(next)]);
      for (std::size_t k = 0; k < 3; ++k)
        ASSERT_EQ(e.corner[k],
                  wavy.mesh.lattice[wavy.mesh.indices[3 * static_cast<std::size_t>(next) + k]]);
      ++next;
    });
    EXPECT_EQ(next, wavy.triangles());
  }
}

TEST(Envelopes, HalvesLieInTheirWholeAndFillIt) {
  const WavyMesh wavy = make_wavy_mesh(2, 3000);
  for_all(wavy, [&](const Envelope& e, const Envelope* whole) {
    const glm::ivec2 a = e.corner[1] - e.corner[0], b = e.corner[2] - e.corner[0];
    ASSERT_EQ((a.x * b.y - a.y * b.x) << e.level, 1024 * 1024);
    if (!whole) return;
    ASSERT_TRUE(e.low().x >= whole->low().x && e.low().y >= whole->low().y);
    ASSERT_TRUE(e.high().x <= whole->high().x && e.high().y <= whole->high().y);
    ASSERT_GE(e.height.low_m, whole->height.low_m);
    ASSERT_LE(e.height.high_m, whole->height.high_m);
  });
}

TEST(Envelopes, HeightsAreTheLeastAndTheGreatestBelow) {
  const WavyMesh wavy = make_wavy_mesh(3, 500);
  for_all(wavy, [&](const Envelope& e, const Envelope*) {
    double low = 1e9, high = -1e9;
    for (int t = e.first_leaf; t < e.first_leaf + e.leaves; ++t) {
      for (const glm::dvec3& p : wavy.corners(t)) {
        low = std::min(low, p.z);
        high = std::max(high, p.z);
      }
    }
    ASSERT_EQ(static_cast<double>(e.height.low_m), low);
    ASSERT_EQ(static_cast<double>(e.height.high_m), high);
  });
}

// ---- bounds that need no mesh ----

TEST(HeightPyramid, BoundsOfABoxHoldAllItsHeightsAndAreThoseOfFourTimesItsSideAtMost) {
  constexpr int kBits = 6, kSide = (1 << kBits) + 1;
  Dice dice(4);
  std::vector<float> height;
  for (int i = 0; i < kSide * kSide; ++i) height.push_back(static_cast<float>(dice.between(-9, 9)));
  const HeightPyramid pyramid = make_height_pyramid(kBits, height, kSide);
  const auto range_of = [&](int x0, int y0, int x1, int y1) {
    HeightRange range{1e9f, -1e9f};
    for (int y = std::max(y0, 0); y <= std::min(y1, kSide - 1); ++y)
      for (int x = std::max(x0, 0); x <= std::min(x1, kSide - 1); ++x)
        range = join(range, {height[static_cast<std::size_t>(y * kSide + x)],
                             height[static_cast<std::size_t>(y * kSide + x)]});
    return range;
  };
  for (int i = 0; i < 2000; ++i) {
    const int x0 = static_cast<int>(dice.between(0, kSide - 1));
    const int y0 = static_cast<int>(dice.between(0, kSide - 1));
    const int x1 = x0 + 1 + static_cast<int>(dice.between(0, kSide - 1 - x0));
    const int y1 = y0 + 1 + static_cast<int>(dice.between(0, kSide - 1 - y0));
    const int side = std::max(x1 - x0, y1 - y0);
    const HeightRange bound = height_range(pyramid, kBits, {x0, y0}, {x1, y1});
    const HeightRange least = range_of(x0, y0, x1, y1);
    const HeightRange most = range_of(x1 - 4 * side, y1 - 4 * side, x0 + 4 * side, y0 + 4 * side);
    ASSERT_TRUE(bound.low_m <= least.low_m && bound.high_m >= least.high_m);
    ASSERT_TRUE(bound.low_m >= most.low_m && bound.high_m <= most.high_m);
  }
}

TEST(HeightPyramid, SamplesNeedNotFitTheSquares) {
  Dice dice(5);
  for (const int samples : {2, 3, 7, 50}) {
    std::vector<float> height;
    for (int i = 0; i < samples * samples; ++i)
      height.push_back(static_cast<float>(dice.between(-9, 9)));
    const HeightPyramid pyramid = make_height_pyramid(4, height, samples);
    for (int i = 0; i < 500; ++i) {  // bilinear, at a random place of a random lattice square
      const glm::dvec2 p{dice.between(0, 16), dice.between(0, 16)};
      const glm::ivec2 square(p);
      const glm::dvec2 at = p * ((samples - 1) / 16.0);
      const int x = std::min(static_cast<int>(at.x), samples - 2);
      const int y = std::min(static_cast<int>(at.y), samples - 2);
      const float* h = &height[static_cast<std::size_t>(y * samples + x)];
      const double fx = at.x - x, fy = at.y - y;
      const double z = (h[0] * (1 - fx) + h[1] * fx) * (1 - fy) +
                       (h[samples] * (1 - fx) + h[samples + 1] * fx) * fy;
      const HeightRange bound = height_range(pyramid, 4, square, square + 1);
      ASSERT_GE(z, static_cast<double>(bound.low_m) - 1e-9);
      ASSERT_LE(z, static_cast<double>(bound.high_m) + 1e-9);
    }
  }
}

TEST(HeightPyramid, OneRangeStandsForAllOfTheDomain) {
  const HeightRange waves{-3.0f, 4.0f};
  const HeightPyramid pyramid = make_height_pyramid(0, {&waves, 1});
  for (const int corner : {0, 500, 1022}) {
    const HeightRange range = height_range(pyramid, 10, glm::ivec2(corner), glm::ivec2(corner + 2));
    EXPECT_EQ(range.low_m, -3.0f);
    EXPECT_EQ(range.high_m, 4.0f);
  }
}

TEST(Envelopes, FromBoundsTheyHoldThoseOfTheHeights) {
  const WavyMesh wavy = make_wavy_mesh(6, 3000);
  std::vector<HeightRange> squares(16 * 16, {1e9f, -1e9f});
  for (std::size_t v = 0; v < wavy.mesh.lattice.size(); ++v) {
    const glm::ivec2 p = wavy.mesh.lattice[v];  // counts in each square it touches
    for (const int y : {(p.y - 1) / 64, p.y / 64})
      for (const int x : {(p.x - 1) / 64, p.x / 64})
        if (x < 16 && y < 16) {
          HeightRange& square = squares[static_cast<std::size_t>(16 * y + x)];
          square = join(square, {wavy.height_m[v], wavy.height_m[v]});
        }
  }
  Envelopes bounds;
  build_envelopes(wavy.mesh, 10, make_height_pyramid(4, squares), bounds);
  ASSERT_EQ(bounds.leaves, wavy.envelopes.leaves);
  for (std::size_t i = 0; i < bounds.height.size(); ++i) {
    ASSERT_LE(bounds.height[i].low_m, wavy.envelopes.height[i].low_m);
    ASSERT_GE(bounds.height[i].high_m, wavy.envelopes.height[i].high_m);
  }
}

// ---- what a view sees ----

struct Seen {
  std::vector<bool> triangle;
  int tested = 0;
};

Seen find_seen(const WavyMesh& wavy, const View& view) {
  std::vector<TriangleRange> ranges;
  Seen seen{std::vector<bool>(static_cast<std::size_t>(wavy.triangles())),
            find_in_view(wavy.envelopes, wavy.domain, view, ranges)};
  int end = -1;
  for (const TriangleRange& range : ranges) {
    EXPECT_GT(range.begin, end);
    EXPECT_GT(range.end, range.begin);
    end = range.end;
    for (int t = range.begin; t < range.end; ++t) seen.triangle[static_cast<std::size_t>(t)] = true;
  }
  return seen;
}

View random_view(const WavyMesh& wavy, Dice& dice) {
  const glm::dvec2 from_centre{dice.between(-700, 700), dice.between(-700, 700)};
  const double z = dice.between(-20, 60), heading = dice.between(0, 7);
  const double pitch = dice.between(-1.5, 1.0), fov = dice.between(0.05, 2.0);
  return make_view({wavy.centre() + from_centre, z}, heading, pitch, fov, 0.1f, 64, 48);
}

// Is a part of the triangle inside all planes? By clipping it.
bool has_part_inside(std::array<glm::dvec3, 3> corners, const View& view) {
  std::vector<glm::dvec3> polygon(corners.begin(), corners.end());
  for (glm::dvec3& p : polygon) p -= view.eye_world;
  for (const glm::vec4& plane : frustum_planes(view)) {
    const glm::dvec4 n(plane);
    const auto side = [&](glm::dvec3 p) { return glm::dot(glm::dvec3(n), p) + n.w; };
    polygon = clipped(polygon, side);
  }
  return !polygon.empty();
}

TEST(InView, IsWhatATestOfEachTrianglesBoxGives) {
  Dice dice(7);
  for (int i = 0; i < 40; ++i) {
    const WavyMesh wavy = make_wavy_mesh(static_cast<std::uint64_t>(i), 1000);
    const View view = random_view(wavy, dice);
    const Seen seen = find_seen(wavy, view);
    for (int t = 0; t < wavy.triangles(); ++t) {
      const auto [a, b, c] = wavy.corners(t);
      const glm::dvec3 low = glm::min(glm::min(a, b), c) - view.eye_world;
      const glm::dvec3 high = glm::max(glm::max(a, b), c) - view.eye_world;
      double worst = 1e9;  // the box's corner farthest in, against the plane that it does worst at
      for (const glm::vec4& plane : frustum_planes(view)) {
        const glm::dvec4 n(plane);
        double best = -1e9;
        for (int k = 0; k < 8; ++k)
          best = std::max(best, n.x * (k & 1 ? low.x : high.x) + n.y * (k & 2 ? low.y : high.y) +
                                    n.z * (k & 4 ? low.z : high.z) + n.w);
        worst = std::min(worst, best);
      }
      if (std::abs(worst) < 1e-9) continue;  // rounding decides
      ASSERT_EQ(seen.triangle[static_cast<std::size_t>(t)], worst > 0.0) << t;
    }
  }
}

TEST(InView, NothingThatCanBeSeenIsLeftOut) {
  Dice dice(8);
  int inside = 0, seen_count = 0;
  for (int i = 0; i < 60; ++i) {
    const WavyMesh wavy = make_wavy_mesh(static_cast<std::uint64_t>(i), 1000);
    const View view = random_view(wavy, dice);
    const Seen seen = find_seen(wavy, view);
    for (int t = 0; t < wavy.triangles(); ++t) {
      seen_count += seen.triangle[static_cast<std::size_t>(t)];
      if (!has_part_inside(wavy.corners(t), view)) continue;
      ++inside;
      ASSERT_TRUE(seen.triangle[static_cast<std::size_t>(t)]) << t;
    }
  }
  EXPECT_GT(inside, 1000);
  EXPECT_LT(seen_count, 2 * inside);  // and not much else is kept
}

TEST(InView, SubtreesInsideOrOutsideAreNotSearched) {
  const WavyMesh wavy = make_wavy_mesh(9, 20000);
  const glm::dvec3 above(wavy.centre(), 2000.0);
  EXPECT_EQ(find_seen(wavy, make_view(above, 0.0, -kPi / 2, 1.0, 0.1f, 64, 64)).tested, 2);
  EXPECT_EQ(find_seen(wavy, make_view(above, 0.0, kPi / 2, 1.0, 0.1f, 64, 64)).tested, 2);
  Dice dice(10);
  double tested = 0.0;
  for (int i = 0; i < 50; ++i) tested += find_seen(wavy, random_view(wavy, dice)).tested / 50.0;
  EXPECT_LT(tested, 0.05 * 2 * wavy.triangles());
}

}  // namespace
}  // namespace swell::lod
