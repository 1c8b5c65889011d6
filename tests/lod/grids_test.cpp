// The radial grid and the plane: what their definitions say, in integers where they can be.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "lod/plane.h"
#include "lod/radial_grid.h"
#include "math/random.h"

namespace swell::lod {
namespace {

constexpr int kViews = 30;

struct Shot {
  View view;
  int budget;
};

// Eyes within 1000 km; every third looks steeply down or up, every second is rolled and looks past
// its picture's middle.
Shot random_shot(int n) {
  const auto dice = [&](int i) { return random_uniform(5, static_cast<std::uint64_t>(8 * n + i)); };
  const glm::dvec3 eye(2e6 * (dice(0) - 0.5), 2e6 * (dice(1) - 0.5), 500.0 * dice(2) - 20.0);
  const double steepest = n % 3 == 0 ? 1.5 : 0.4;
  Lens lens = lens_of_fov(0.2 + 1.4 * dice(5), 160, 90);
  const double odd = n % 2;
  lens.tan_middle_x = odd * (3.0 * dice(7) - 1.5);
  lens.tan_middle_y = odd * (1.5 - 3.0 * dice(6));
  const glm::dmat3 axes = camera_axes(12.0 * dice(3) - 6.0, steepest * (2.0 * dice(4) - 1.0),
                                      odd * (6.0 * dice(2) - 3.0));
  const View view = make_view(eye, axes, lens, 0.1f, 160, 90);
  return {view, static_cast<int>(64.0 * std::pow(300.0, dice(6)))};
}

Mesh grid_of(const View& view, int budget) {
  Mesh mesh;
  write_radial_grid(view, budget, mesh);
  return mesh;
}

std::int64_t doubled_area(const Mesh& mesh, std::size_t triangle) {
  const std::uint32_t* v = &mesh.indices[3 * triangle];
  const glm::i64vec2 a(mesh.lattice[v[0]]), b(mesh.lattice[v[1]]), c(mesh.lattice[v[2]]);
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// A vertex's place relative to the eye.
glm::dvec2 offset_m(const View& view, glm::ivec2 lattice) {
  const Domain domain = radial_domain(view);
  return domain.min_world - glm::dvec2(view.eye_world) +
         std::ldexp(domain.size_m, -domain.lattice_bits) * glm::dvec2(lattice);
}

TEST(RadialGrid, UsesItsBudgetAndNeverMore) {
  for (int n = 0; n < kViews; ++n) {
    const Shot shot = random_shot(n);
    Mesh mesh;
    const AdaptStatistics statistics = write_radial_grid(shot.view, shot.budget, mesh);
    EXPECT_EQ(statistics.triangles, static_cast<int>(mesh.level.size()));
    EXPECT_EQ(mesh.indices.size(), 3 * mesh.level.size());
    EXPECT_LE(statistics.triangles, shot.budget);
    EXPECT_GT(statistics.triangles, shot.budget / 2) << "budget " << shot.budget;
    if (shot.budget <= 2000) continue;
    EXPECT_GT(statistics.triangles, shot.budget * 4 / 5) << "budget " << shot.budget;
  }
}

TEST(RadialGrid, HoldsItsBudgetAtTheExtremes) {
  for (const double fov_rad : {0.02, 1.0, 2.9}) {
    for (const double pitch_rad : {-1.57, -0.5, 0.0, 1.57}) {
      const View view = make_view({0, 0, 1}, 1.0, pitch_rad, fov_rad, 0.1f, 8192, 100);
      for (const int budget : {2, 3, 63, 64, 65, 100, 100000}) {
        const Mesh mesh = grid_of(view, budget);
        EXPECT_LE(static_cast<int>(mesh.level.size()), budget);
        for (std::size_t t = 0; t < mesh.level.size(); ++t) ASSERT_GT(doubled_area(mesh, t), 0);
      }
    }
  }
}

// Every inner edge has two sides, no edge is used twice, and V - E + F is that of one disc.
TEST(RadialGrid, IsOneDiscWithoutCracks) {
  for (int n = 0; n < kViews; ++n) {
    const Shot shot = random_shot(n);
    const Mesh mesh = grid_of(shot.view, shot.budget);
    std::set<std::pair<std::uint32_t, std::uint32_t>> sides;
    std::set<std::uint32_t> used;
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
      const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
      ASSERT_TRUE(sides.insert({mesh.indices[i], mesh.indices[next]}).second) << "edge used twice";
      used.insert(mesh.indices[i]);
    }
    std::size_t edges = 0;
    for (const auto& [from, to] : sides) edges += from < to || !sides.contains({to, from});
    ASSERT_EQ(used.size(), mesh.lattice.size());
    ASSERT_EQ(mesh.lattice.size() + mesh.level.size(), edges + 1);
    for (std::size_t t = 0; t < mesh.level.size(); ++t) ASSERT_GT(doubled_area(mesh, t), 0);
  }
}

// r_i = a0 + a1 i^4 with r_0 = 0.1 m and r_(N-1) = 40 km.
TEST(RadialGrid, HasItsRingsWhereTheFormulaPutsThem) {
  const View view = make_view({123.4, -56.7, 10.0}, 0.7, -0.1, 0.9, 0.1f, 160, 90);
  const RadialLayout layout = radial_layout(view, 30000);
  const Mesh mesh = grid_of(view, 30000);
  const double a1 = (40000.0 - 0.1) / std::pow(layout.rings - 1, 4.0);
  const auto kept = static_cast<std::size_t>(layout.rings_kept());
  for (std::size_t v = 1; v < mesh.lattice.size(); ++v) {
    const std::size_t k = (v - 1) % kept;
    const int i = k == 0 ? 0 : layout.first_ring + static_cast<int>(k) - 1;
    const double r_m = glm::length(offset_m(view, mesh.lattice[v]));
    ASSERT_NEAR(r_m, 0.1 + a1 * std::pow(i, 4.0), 1e-4) << "ring " << i;
  }
  EXPECT_LT(0.1 + a1 * std::pow(layout.first_ring - 1, 4.0), 0.2);
  EXPECT_GE(0.1 + a1 * std::pow(layout.first_ring, 4.0), 0.2 - 1e-9);
}

// From higher up than 90 m the rings go on to the horizon, and no triangle is lost to the lattice.
TEST(RadialGrid, ReachesBeyondTheHorizon) {
  for (const double eye_m : {0.3, 80.0, 120.0, 3000.0, 12000.0, 40000.0}) {
    const View view = make_view({123.4, -56.7, eye_m}, 0.7, -0.4, 0.9, 0.1f, 160, 90);
    const Mesh mesh = grid_of(view, 60000);
    double furthest_m = 0.0, nearest_m = 1e9;
    for (std::size_t v = 1; v < mesh.lattice.size(); ++v) {
      const double r_m = glm::length(offset_m(view, mesh.lattice[v]));
      furthest_m = std::max(furthest_m, r_m), nearest_m = std::min(nearest_m, r_m);
    }
    const double horizon_m = 3827.0 * std::sqrt(eye_m);
    EXPECT_NEAR(furthest_m, std::max(1.1 * horizon_m, 40000.0), 1e-3 * furthest_m) << eye_m;
    EXPECT_LE(nearest_m, std::max(0.21, eye_m / 5000.0)) << eye_m;
    for (std::size_t t = 0; t < mesh.level.size(); ++t) ASSERT_GT(doubled_area(mesh, t), 0);
  }
}

// Points on the pixels' rays between 1 m and 30 km from the eye lie in a column that is made.
void expect_columns_seen(const View& view, int budget) {
  const RadialLayout layout = radial_layout(view, budget);
  for (int y = 0; y <= 90; y += 5) {
    for (int x = 0; x <= 160; x += 5) {
      const glm::dvec3 ray(view.ray(static_cast<float>(x), static_cast<float>(y)));
      const double turns = std::atan2(ray.y, ray.x) / (2.0 * std::numbers::pi);
      const double column = std::floor((turns + 1.0) * layout.columns);
      const int from_first =
          (static_cast<int>(column) - layout.first_column + 2 * layout.columns) % layout.columns;
      ASSERT_LT(from_first, layout.columns_seen) << "pixel " << x << ", " << y;
    }
  }
}

TEST(RadialGrid, HasEveryColumnThatTheViewSees) {
  for (int n = 0; n < kViews; ++n) {
    SCOPED_TRACE(n);
    const Shot shot = random_shot(n);
    expect_columns_seen(shot.view, shot.budget);
  }
}

// Far below the axis of a camera that looks ahead lies the nadir, and of one that looks down what
// is behind it.
TEST(RadialGrid, HasEveryColumnOfAViewFarFromItsAxis) {
  const auto view = [](double pitch_rad, double tan_middle_y, double tan_half) {
    const Lens lens = {
        .tan_half_x = tan_half, .tan_half_y = tan_half, .tan_middle_y = tan_middle_y};
    return make_view({0.0, 0.0, 9.0}, camera_axes(0.4, pitch_rad, 0.0), lens, 0.1f, 160, 90);
  };
  expect_columns_seen(view(-0.3, -4.0, 1.0), 2000);
  EXPECT_EQ(radial_layout(view(-0.3, -4.0, 1.0), 2000).columns_seen,
            radial_layout(view(-0.3, -4.0, 1.0), 2000).columns);
  expect_columns_seen(view(-1.55, -3.0, 0.3), 2000);
  EXPECT_LT(radial_layout(view(-1.55, -3.0, 0.3), 2000).columns_seen,
            radial_layout(view(-1.55, -3.0, 0.3), 2000).columns / 2);
}

TEST(RadialGrid, KeepsItsVerticesWhenTheEyeTurns) {
  const auto places = [](double heading_rad) {
    const View view = make_view({1.5, 2.25, 8.0}, heading_rad, -0.2, 0.9, 0.1f, 160, 90);
    std::set<std::pair<int, int>> result;
    const Mesh mesh = grid_of(view, 10000);
    for (const glm::ivec2& p : mesh.lattice) result.emplace(p.x, p.y);
    return result;
  };
  const auto before = places(1.0), after = places(1.2);
  std::size_t both = 0;
  for (const auto& p : before) both += after.contains(p);
  EXPECT_GT(both, before.size() * 3 / 4);
}

TEST(Plane, IsTheSquareInTwoTriangles) {
  const Domain domain{.min_world = {3.0, 4.0}, .size_m = 64.0, .lattice_bits = 5};
  Mesh mesh;
  write_plane(domain, mesh);
  ASSERT_EQ(mesh.level.size(), 2u);
  EXPECT_EQ(doubled_area(mesh, 0) + doubled_area(mesh, 1), 2 * 32 * 32);
  EXPECT_GT(doubled_area(mesh, 0), 0);
  EXPECT_GT(doubled_area(mesh, 1), 0);
}

}  // namespace
}  // namespace swell::lod
