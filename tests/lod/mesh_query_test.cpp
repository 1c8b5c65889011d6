// Each query against a test of every triangle by other formulas.
#include "lod/mesh_query.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <vector>

#include "wavy_mesh.h"

namespace swell::lod {
namespace {

constexpr int kMeshes = 12;
constexpr double kFar_m = 1e5;

WavyMesh mesh_number(int i) {
  const int triangles = i == 0 ? 2 : i == 1 ? 9 : 1500;
  return make_wavy_mesh(static_cast<std::uint64_t>(i), triangles, i % 3 == 0 ? 0.0 : 8.0);
}

glm::dvec3 at(const WavyMesh& wavy, int triangle, glm::dvec3 weight) {
  const auto [a, b, c] = wavy.corners(triangle);
  return weight.x * a + weight.y * b + weight.z * c;
}

glm::dvec3 random_place(const WavyMesh& wavy, Dice& dice, double most_z = 30.0) {
  const glm::dvec2 from_centre{dice.coarse(-540, 540), dice.coarse(-540, 540)};
  return {wavy.centre() + from_centre, dice.coarse(-most_z, most_z)};
}

// ---- rays ----

// Moller, Trumbore, 1997, on every triangle. `margin`: the least weight or distance on the way, how
// far the answer is from another one.
struct Reference {
  int triangle = kNoTriangle;
  double distance_m = 0.0, margin = 1.0;
};

Reference hit_of_all(const WavyMesh& wavy, glm::dvec3 origin, glm::dvec3 direction) {
  Reference hit;
  const glm::dvec3 d = glm::normalize(direction);
  double margin = 1.0;
  for (int t = 0; t < wavy.triangles(); ++t) {
    const auto [a, b, c] = wavy.corners(t);
    const glm::dvec3 ab = b - a, ac = c - a, p = glm::cross(d, ac);
    const double det = glm::dot(ab, p);
    const double u = glm::dot(origin - a, p) / det;
    const glm::dvec3 q = glm::cross(origin - a, ab);
    const double v = glm::dot(d, q) / det, s = glm::dot(ac, q) / det;
    const double least = std::min({u, v, 1.0 - u - v});
    if (s > -1e-9) margin = std::min(margin, std::abs(least));
    if (least > -1e-9) margin = std::min(margin, std::abs(s));
    if (!(least >= 0.0) || s < 0.0 || (hit.triangle >= 0 && s >= hit.distance_m)) continue;
    hit = {t, s, 1.0};
  }
  hit.margin = margin;
  return hit;
}

TEST(RayQuery, HitsWhatATestOfEveryTriangleHits) {
  Dice dice(1);
  int hits = 0, compared = 0;
  for (int i = 0; i < kMeshes; ++i) {
    const WavyMesh wavy = mesh_number(i);
    for (int ray = 0; ray < 150; ++ray) {
      const glm::dvec3 origin = random_place(wavy, dice);
      glm::dvec3 direction = dice.direction();
      if (ray % 2 == 0) direction.z *= 0.02;  // grazing: hits waves after passing others by
      const Reference expected = hit_of_all(wavy, origin, direction);
      const RayHit hit = intersect_ray(wavy.surface(), origin, direction, kFar_m);
      const RayHit same = intersect_ray_in_all(wavy.surface(), origin, direction, kFar_m);
      ASSERT_EQ(hit.triangle, same.triangle);  // always, and to the bit
      ASSERT_EQ(hit.distance_m, same.distance_m);
      if (expected.margin < 1e-9) continue;  // rounding decides
      ++compared;
      ASSERT_EQ(hit.triangle, expected.triangle) << "mesh " << i << " ray " << ray;
      if (hit.triangle == kNoTriangle) continue;
      ++hits;
      const glm::dvec3 p = origin + hit.distance_m * glm::normalize(direction);
      ASSERT_NEAR(hit.distance_m, expected.distance_m, 1e-8 * (1.0 + expected.distance_m));
      ASSERT_LT(glm::distance(at(wavy, hit.triangle, hit.weight), p), 1e-8 * (1 + hit.distance_m));
    }
  }
  EXPECT_GT(hits, 500);
  EXPECT_GT(compared, 1500);
}

// Gentle waves and steep rays: no vertex stands on the outline, where a ray may pass.
TEST(RayQuery, DoesNotSlipThroughVerticesAndEdges) {
  Dice dice(2);
  for (int i = 0; i < kMeshes; ++i) {
    const WavyMesh wavy = make_wavy_mesh(static_cast<std::uint64_t>(i), 1500, 0.125);
    for (int ray = 0; ray < 500; ++ray) {
      const auto corner = wavy.corners(static_cast<int>(dice.between(0, wavy.triangles())));
      const glm::dvec3 target = ray % 2 == 0 ? corner[0] : 0.5 * (corner[0] + corner[2]);
      const glm::dvec2 from_centre = glm::abs(glm::dvec2(target) - wavy.centre());
      if (std::max(from_centre.x, from_centre.y) == 512.0) continue;  // the sheet's edge
      const glm::dvec3 down{dice.between(-20, 20), dice.between(-20, 20), -dice.between(30, 60)};
      const RayHit hit = intersect_ray(wavy.surface(), target - down, down, kFar_m);
      ASSERT_NE(hit.triangle, kNoTriangle) << "mesh " << i << " ray " << ray;
      ASSERT_NEAR(hit.distance_m, glm::length(down), 1e-9);
    }
  }
}

TEST(RayQuery, StraightDownFindsTheTriangleBelowAndItsHeight) {
  Dice dice(3);
  for (int i = 0; i < kMeshes; ++i) {
    const WavyMesh wavy = mesh_number(i);
    for (int ray = 0; ray < 200; ++ray) {
      const glm::dvec2 p =
          wavy.centre() + glm::dvec2{dice.coarse(-512, 512), dice.coarse(-512, 512)};
      const TriangleAt below = triangle_at(wavy.surface(), p);
      const RayHit hit = intersect_ray(wavy.surface(), {p, 64.0}, {0, 0, -3}, kFar_m);
      ASSERT_EQ(hit.triangle, below.triangle);
      ASSERT_NEAR(64.0 - hit.distance_m, below.height_m, 1e-10);
      const RayHit from_below = intersect_ray(wavy.surface(), {p, -64.0}, {0, 0, 1}, kFar_m);
      ASSERT_EQ(from_below.triangle, below.triangle);
    }
  }
}

TEST(RayQuery, EndsAtItsLengthAndBeginsAtItsOrigin) {
  const WavyMesh flat = make_wavy_mesh(1, 500, 0.0);
  const glm::dvec3 origin(flat.centre() + 0.3, 10.0);
  const auto hits = [&](glm::dvec3 from, glm::dvec3 direction, double length_m) {
    return intersect_ray(flat.surface(), from, direction, length_m).triangle != kNoTriangle;
  };
  EXPECT_TRUE(hits(origin, {0, 0, -1}, 10.0));
  EXPECT_FALSE(hits(origin, {0, 0, -1}, 9.999));
  EXPECT_FALSE(hits(origin, {0, 0, 1}, kFar_m));
  EXPECT_TRUE(hits({glm::dvec2(origin), 0.0}, {0, 0, 1}, 0.0));      // on the surface
  EXPECT_FALSE(hits({glm::dvec2(origin), 0.0}, {1, 0, 0}, kFar_m));  // in its plane
  EXPECT_FALSE(hits({flat.domain.min_world - 1.0, 10.0}, {0, 0, -1}, kFar_m));
}

TEST(RayQuery, OfTwoTrianglesAtOneDistanceTheLowerNumberCounts) {
  const WavyMesh flat = make_wavy_mesh(4, 300, 0.0);
  for (std::size_t v = 0; v < flat.mesh.lattice.size(); ++v) {
    int lowest = flat.triangles();
    for (std::size_t i = 0; i < flat.mesh.indices.size(); ++i)
      if (flat.mesh.indices[i] == v) lowest = std::min(lowest, static_cast<int>(i / 3));
    const glm::dvec3 p = vertex_world(flat.surface(), v);
    EXPECT_EQ(intersect_ray(flat.surface(), p + glm::dvec3(0, 0, 4), {0, 0, -1}, 8.0).triangle,
              lowest);
    EXPECT_EQ(triangle_at(flat.surface(), glm::dvec2(p)).triangle, lowest);
  }
}

// ---- places ----

TEST(PlaceQuery, FindsTheFirstTriangleThatHoldsThePlace) {
  Dice dice(5);
  for (int i = 0; i < kMeshes; ++i) {
    const WavyMesh wavy = mesh_number(i);
    for (int place = 0; place < 100; ++place) {
      const glm::dvec2 p(random_place(wavy, dice));
      int first = kNoTriangle;
      for (int t = wavy.triangles() - 1; t >= 0; --t) {
        const auto c = wavy.corners(t);
        bool holds = true;
        for (std::size_t k = 0; k < 3; ++k) {
          const glm::dvec2 side(c[(k + 1) % 3] - c[k]), from = p - glm::dvec2(c[k]);
          holds = holds && side.x * from.y - side.y * from.x >= 0.0;  // exact
        }
        if (holds) first = t;
      }
      const TriangleAt found = triangle_at(wavy.surface(), p);
      ASSERT_EQ(found.triangle, first);
      if (first == kNoTriangle) continue;
      const glm::dvec3 on = at(wavy, first, found.weight);
      ASSERT_LT(glm::distance(on, glm::dvec3(p, found.height_m)), 1e-9);
      ASSERT_LE(found.visited, 1 + wavy.mesh.level[static_cast<std::size_t>(first)]);
    }
  }
}

// ---- nearest ----

TEST(NearestQuery, VertexIsTheFirstOfTheNearest) {
  Dice dice(6);
  for (int i = 0; i < kMeshes; ++i) {
    const WavyMesh wavy = mesh_number(i);
    for (int place = 0; place < 100; ++place) {
      glm::dvec3 p = random_place(wavy, dice);
      if (place % 2 == 0) p = glm::floor(p / 2.0) * 2.0;  // as near to several
      std::uint32_t nearest = 0;
      const auto distance2_of = [&](std::size_t v) {
        const glm::dvec3 d = vertex_world(wavy.surface(), v) - p;
        return glm::dot(d, d);  // exact
      };
      for (std::uint32_t v = 1; v < wavy.mesh.lattice.size(); ++v)
        if (distance2_of(v) < distance2_of(nearest)) nearest = v;
      const NearestVertex found = nearest_vertex(wavy.surface(), p);
      ASSERT_EQ(found.vertex, nearest);
      ASSERT_EQ(found.distance_m, std::sqrt(distance2_of(nearest)));
    }
  }
}

// By the two ends' distances and the line's.
double distance_to_edge(glm::dvec3 p, glm::dvec3 a, glm::dvec3 b) {
  const glm::dvec3 ab = b - a;
  if (glm::dot(p - a, ab) <= 0.0) return glm::distance(p, a);
  if (glm::dot(p - b, ab) >= 0.0) return glm::distance(p, b);
  return glm::length(glm::cross(p - a, ab)) / glm::length(ab);
}

TEST(NearestQuery, EdgeIsNoFartherThanAnyOther) {
  Dice dice(7);
  for (int i = 0; i < kMeshes; ++i) {
    const WavyMesh wavy = mesh_number(i);
    for (int place = 0; place < 60; ++place) {
      const glm::dvec3 p = random_place(wavy, dice);
      const NearestEdge found = nearest_edge(wavy.surface(), p);
      const glm::dvec3 a = vertex_world(wavy.surface(), found.vertex[0]);
      const glm::dvec3 b = vertex_world(wavy.surface(), found.vertex[1]);
      ASSERT_NEAR(distance_to_edge(p, a, b), found.distance_m, 1e-9);
      ASSERT_NEAR(glm::distance(p, found.p_world), found.distance_m, 1e-9);
      ASSERT_LT(distance_to_edge(found.p_world, a, b), 1e-9);
      double nearest = std::numeric_limits<double>::infinity();
      bool is_an_edge = false;
      for (std::size_t side = 0; side < wavy.mesh.indices.size(); ++side) {
        const std::uint32_t v = wavy.mesh.indices[side];
        const std::uint32_t w = wavy.mesh.indices[side % 3 == 2 ? side - 2 : side + 1];
        nearest = std::min(nearest, distance_to_edge(p, vertex_world(wavy.surface(), v),
                                                     vertex_world(wavy.surface(), w)));
        is_an_edge =
            is_an_edge || (std::min(v, w) == found.vertex[0] && std::max(v, w) == found.vertex[1]);
      }
      ASSERT_TRUE(is_an_edge);
      ASSERT_NEAR(found.distance_m, nearest, 1e-9);
    }
  }
}

TEST(NearestQuery, OfEdgesThatMeetInTheNearestPointTheLowestCounts) {
  const WavyMesh flat = make_wavy_mesh(8, 300, 0.0);
  for (std::uint32_t v = 0; v < flat.mesh.lattice.size(); ++v) {
    std::array<std::uint32_t, 2> lowest{~0u, ~0u};
    for (std::size_t side = 0; side < flat.mesh.indices.size(); ++side) {
      const std::uint32_t a = flat.mesh.indices[side];
      const std::uint32_t b = flat.mesh.indices[side % 3 == 2 ? side - 2 : side + 1];
      if (a == v || b == v) lowest = std::min(lowest, {std::min(a, b), std::max(a, b)});
    }
    EXPECT_EQ(nearest_edge(flat.surface(), vertex_world(flat.surface(), v)).vertex, lowest);
  }
}

// ---- boxes ----

// By clipping the triangle at each face; everything is exact where faces and corners are coarse and
// cuts are at halves, and else not near enough to matter.
bool clipped_is_left(std::array<glm::dvec3, 3> corners, glm::dvec3 low, glm::dvec3 high) {
  std::vector<glm::dvec3> polygon(corners.begin(), corners.end());
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    const auto side = [&](glm::dvec3 p) {
      return face % 2 == 0 ? p[axis] - low[axis] : high[axis] - p[axis];
    };
    polygon = clipped(polygon, side);
  }
  return !polygon.empty();
}

TEST(BoxQuery, FindsTheTrianglesThatReachIntoTheBox) {
  Dice dice(9);
  std::size_t found_count = 0;
  for (int i = 0; i < kMeshes; ++i) {
    const WavyMesh wavy = mesh_number(i);
    std::vector<int> found;
    for (int box = 0; box < 60; ++box) {
      const glm::dvec3 low = random_place(wavy, dice, 10.0);
      const glm::dvec3 size{dice.coarse(0, 60), dice.coarse(0, 60), dice.coarse(0, 8)};
      find_in_box(wavy.surface(), low, low + size, found);
      std::vector<int> smaller, larger;  // by a hair: what rounding may decide lies between
      for (int t = 0; t < wavy.triangles(); ++t) {
        if (clipped_is_left(wavy.corners(t), low + 1e-9, low + size - 1e-9)) smaller.push_back(t);
        if (clipped_is_left(wavy.corners(t), low - 1e-9, low + size + 1e-9)) larger.push_back(t);
      }
      ASSERT_TRUE(std::is_sorted(found.begin(), found.end()));
      ASSERT_TRUE(std::includes(found.begin(), found.end(), smaller.begin(), smaller.end()));
      ASSERT_TRUE(std::includes(larger.begin(), larger.end(), found.begin(), found.end()));
      found_count += found.size();
    }
  }
  EXPECT_GT(found_count, 500u);
}

TEST(BoxQuery, TouchingIsEnoughAndPassingByIsNot) {
  const WavyMesh flat = make_wavy_mesh(1, 2, 0.0);  // two triangles, cut along x - y = const
  const glm::dvec2 corner = flat.domain.min_world;
  std::vector<int> found;
  const auto find = [&](glm::dvec3 low, glm::dvec3 high) {
    find_in_box(flat.surface(), glm::dvec3(corner, 0.0) + low, glm::dvec3(corner, 0.0) + high,
                found);
    return found;
  };
  using Triangles = std::vector<int>;
  EXPECT_EQ(find({5, 2, 0}, {6, 3, 1}), Triangles{0});
  EXPECT_EQ(find({5, 2, 0.25}, {6, 3, 1}), Triangles{});
  EXPECT_EQ(find({2, 5, -1}, {3, 6, 0}), Triangles{1});
  EXPECT_EQ(find({5, 4, -1}, {6, 5, 1}), (Triangles{0, 1}));    // its corner on the cut
  EXPECT_EQ(find({-2, -2, -1}, {0, 0, 1}), (Triangles{0, 1}));  // at the domain's corner
  EXPECT_EQ(find({-2, -2, -1}, {-1, -1, 1}), Triangles{});
  EXPECT_EQ(find({4, 4, 0}, {4, 4, 0}), (Triangles{0, 1}));  // a point
}

// ---- cost ----

// Envelopes met by a query, the mean over many.
struct MeanVisits {
  double ray = 0, vertex = 0, edge = 0, box = 0;
};

MeanVisits mean_visits(int triangles) {
  constexpr int kQueries = 200;
  const WavyMesh wavy = make_wavy_mesh(11, triangles, 1.0);
  Dice dice(12);
  MeanVisits mean;
  std::vector<int> found;
  for (int i = 0; i < kQueries; ++i) {
    const glm::dvec3 p = random_place(wavy, dice, 2.0);
    const glm::dvec3 eye(glm::dvec2(p), 30.0), at_sea = random_place(wavy, dice, 0.0);
    mean.ray += intersect_ray(wavy.surface(), eye, at_sea - eye, kFar_m).visited;
    mean.vertex += nearest_vertex(wavy.surface(), p).visited;
    mean.edge += nearest_edge(wavy.surface(), p).visited;
    mean.box += find_in_box(wavy.surface(), p - 0.5, p + 0.5, found);
  }
  mean.ray /= kQueries;
  mean.vertex /= kQueries;
  mean.edge /= kQueries;
  mean.box /= kQueries;
  return mean;
}

TEST(QueryCost, GrowsWithTheDepthOfTheBintreeNotWithTheMesh) {
  for (const int triangles : {500, 2000, 8000, 32000}) {
    const MeanVisits mean = mean_visits(triangles);
    const double depth = std::bit_width(static_cast<unsigned>(triangles));
    EXPECT_LT(mean.ray, 3.0 * depth) << triangles;
    EXPECT_LT(mean.box, 3.0 * depth) << triangles;
    EXPECT_LT(mean.edge, 10.0 * depth) << triangles;
    EXPECT_LT(mean.vertex, 10.0 * depth) << triangles;
  }
}

}  // namespace
}  // namespace swell::lod
