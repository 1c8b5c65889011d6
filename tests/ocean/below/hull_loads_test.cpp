// Forces on hulls: Archimedes, planes, and waves whose pressure has a closed integral.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "constants.h"
#include "ocean/below/sea_below.h"
#include "ocean/simd_targets.h"

namespace swell::ocean {
namespace {

constexpr double kWeight_n_m3 = kSeaDensity_kg_m3 * kG;

struct Solid {
  std::vector<glm::dvec3> p;
  std::vector<glm::uvec3> triangles;

  HullMesh mesh() const { return {p, triangles}; }
  void move(glm::dvec3 by) {
    for (glm::dvec3& q : p) q += by;
  }
};

// A box around the origin, each face of cells x cells squares.
Solid box(glm::dvec3 size, int cells) {
  Solid solid;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const int a = (axis + 1) % 3, b = (axis + 2) % 3;
      const auto first = static_cast<unsigned>(solid.p.size());
      for (int j = 0; j <= cells; ++j)
        for (int i = 0; i <= cells; ++i) {
          glm::dvec3 q;
          q[axis] = 0.5 * side;
          q[a] = side * (static_cast<double>(i) / cells - 0.5);
          q[b] = static_cast<double>(j) / cells - 0.5;
          solid.p.push_back(q * size);
        }
      const auto row = static_cast<unsigned>(cells + 1);
      for (unsigned j = 0; j + 1 < row; ++j)
        for (unsigned i = 0; i + 1 < row; ++i) {
          const unsigned at = first + j * row + i;
          solid.triangles.emplace_back(at, at + 1, at + row + 1);
          solid.triangles.emplace_back(at, at + row + 1, at + row);
        }
    }
  return solid;
}

// An octahedron whose faces are split and pushed out to a sphere.
Solid sphere(double radius, int splits) {
  Solid solid;
  solid.p = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  solid.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                     {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int n = 0; n < splits; ++n) {
    std::map<std::pair<unsigned, unsigned>, unsigned> middle;
    const auto between = [&](unsigned a, unsigned b) {
      const auto [it, is_new] = middle.try_emplace(std::minmax(a, b), solid.p.size());
      if (is_new) solid.p.push_back(glm::normalize(solid.p[a] + solid.p[b]));
      return it->second;
    };
    std::vector<glm::uvec3> split;
    for (const glm::uvec3& t : solid.triangles) {
      const unsigned a = between(t.x, t.y), b = between(t.y, t.z), c = between(t.z, t.x);
      split.insert(split.end(), {{t.x, a, c}, {a, t.y, b}, {c, b, t.z}, {a, b, c}});
    }
    solid.triangles = std::move(split);
  }
  for (glm::dvec3& q : solid.p) q *= radius;
  return solid;
}

// By the theorem of Gauss.
double volume(const Solid& solid) {
  double six = 0.0;
  for (const glm::uvec3& t : solid.triangles)
    six += glm::dot(solid.p[t.x], glm::cross(solid.p[t.y], solid.p[t.z]));
  return six / 6.0;
}

Sea sea_of(const std::vector<SineWave>& sines) {
  SeaDescription description;
  description.spectrum = false;
  description.sines = sines;
  return Sea(description);
}

void expect_near(glm::dvec3 got, glm::dvec3 expected, double off) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(got[c], expected[c], off) << c;
}

TEST(HullLoads, StillWaterLiftsWhatIsUnderItAsArchimedesSays) {
  const Sea sea = sea_of({});
  SeaBelow now({&sea}, 0.0);
  const Solid tetrahedron{{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 4}},
                          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  EXPECT_NEAR(volume(tetrahedron), 4.0, 1e-12);
  for (const auto& [of, centre] : {std::pair(box({2.0, 3.0, 1.5}, 1), glm::dvec3(0.0)),
                                   std::pair(box({2.0, 3.0, 1.5}, 4), glm::dvec3(0.0)),
                                   std::pair(tetrahedron, glm::dvec3(0.5, 0.75, 1.0)),
                                   std::pair(sphere(2.0, 3), glm::dvec3(0.0))}) {
    Solid solid = of;
    const glm::dvec3 place(1234.5, -77.0, -9.0);
    solid.move(place);
    const HullLoads loads = now.loads(solid.mesh(), centre + place);
    const double lift_n = kWeight_n_m3 * volume(of);
    expect_near(loads.buoyancy.force_n, {0.0, 0.0, lift_n}, 1e-7 * lift_n);
    expect_near(loads.buoyancy.moment_nm, glm::dvec3(0.0), 1e-6 * lift_n);
    // About another point.
    const glm::dvec3 arm(3.0, -2.0, 5.0);
    expect_near(now.loads(solid.mesh(), centre + place - arm).buoyancy.moment_nm,
                glm::cross(arm, glm::dvec3(0.0, 0.0, lift_n)), 1e-6 * lift_n);
    EXPECT_EQ(loads.froude_krylov.force_n, glm::dvec3(0.0));
  }
  EXPECT_NEAR(volume(sphere(2.0, 5)), 4.0 / 3.0 * kPiRef * 8.0, 0.06);
}

TEST(HullLoads, WhatFloatsDisplacesThePartUnderTheSurface) {
  const Sea sea = sea_of({});
  SeaBelow now({&sea}, 0.0);
  Solid solid = box({2.0, 3.0, 1.5}, 2);
  solid.move({0.0, 0.0, 0.35});  // 0.4 m deep
  const HullLoads loads = now.loads(solid.mesh(), {0.0, 0.0, -0.2});
  const double lift_n = kWeight_n_m3 * 2.0 * 3.0 * 0.4;
  expect_near(loads.buoyancy.force_n, {0.0, 0.0, lift_n}, 1e-9 * lift_n);
  expect_near(loads.buoyancy.moment_nm, glm::dvec3(0.0), 1e-9 * lift_n);
  Solid ball = sphere(1.0, 5);  // to its middle
  EXPECT_NEAR(now.loads(ball.mesh(), {}).buoyancy.force_n.z, kWeight_n_m3 * 2.0 / 3.0 * kPiRef,
              0.004 * kWeight_n_m3);
  ball.move({0.0, 0.0, 1.5});
  EXPECT_EQ(now.loads(ball.mesh(), {}).buoyancy.force_n, glm::dvec3(0.0));
}

// A wave so long that the surface is a plane of the slope a k and the pressure reaches down all of
// the hull. Both forces together are those of water that presses at right angles to the plane.
TEST(HullLoads, ASlopingPlaneOfWaterPressesAtRightAnglesToIt) {
  const double length_m = 1e5, a = 1000.0, slope = kTurn / length_m * a;
  const Sea sea = sea_of({{a, length_m, kPiRef / 2.0, 0.0, 0.0}});  // a sin(k x) at t = 0
  SeaBelow now({&sea}, 0.0);
  Solid solid = box({2.0, 3.0, 1.5}, 8);
  const HullLoads loads = now.loads(solid.mesh(), {});
  const double volume_m3 = 2.0 * 3.0 * 0.75;  // the plane halves the box
  const double weight_n = kWeight_n_m3 * volume_m3;
  const glm::dvec3 both = loads.buoyancy.force_n + loads.froude_krylov.force_n;
  expect_near(both, {-slope * weight_n, 0.0, weight_n}, 2e-3 * weight_n);
  EXPECT_GT(slope, 0.06);
  // Its wedges bring the middle of the water under the plane to x = slope / 12 width^2 / draught,
  // z = -draught / 2 + slope^2 / 24 width^2 / draught.
  const double x = slope / 12.0 * 4.0 / 0.75, z = -0.375 + slope * slope / 24.0 * 4.0 / 0.75;
  const glm::dvec3 expected = glm::cross(glm::dvec3(x, 0.0, z), both);
  expect_near(loads.buoyancy.moment_nm + loads.froude_krylov.moment_nm, expected, 2e-3 * weight_n);
}

TEST(HullLoads, ALongWavePushesASmallBodyAsItsOwnWater) {
  const double length_m = 80.0, a = 0.01;
  const Sea sea = sea_of({{a, length_m, 1.0, 0.3, 0.0}});
  for (const double t_s : {0.0, 1.7, 4.0}) {
    SeaBelow now({&sea}, t_s);
    Solid solid = box({0.5, 0.8, 0.4}, 2);
    const glm::dvec3 centre(7.0, 3.0, -2.5);
    solid.move(centre);
    const double mass_kg = kSeaDensity_kg_m3 * volume(box({0.5, 0.8, 0.4}, 2));
    const HullLoads loads = now.loads(solid.mesh(), centre);
    const glm::dvec3 expected = mass_kg * glm::dvec3(now.motion(centre).acceleration_mps2);
    const double largest_n = mass_kg * kG * kTurn / length_m * a;
    expect_near(loads.froude_krylov.force_n, expected, 0.02 * largest_n);
    EXPECT_GT(glm::length(expected), 0.5 * largest_n);
  }
}

// A low wave a sin(k x - w t) that runs east, over the faces of a box: closed integrals of
// rho g a e^(kz) sin(kx - wt).
TEST(HullLoads, ARegularWaveOnABoxIsTheClosedIntegral) {
  const double length_m = 20.0, a = 1e-3, k = kTurn / length_m, omega = std::sqrt(kG * k);
  const Sea sea = sea_of({{a, length_m, kPiRef / 2.0, 0.0, 0.0}});
  const glm::dvec3 size(9.0, 4.0, 3.0);
  const double top = -0.5, bottom = top - size.z, east = 5.0, west = east - size.x;
  Solid solid = box(size, 36);
  solid.move({0.5 * (east + west), 0.0, 0.5 * (top + bottom)});
  const double down = (std::exp(k * top) - std::exp(k * bottom)) / k;  // of e^(kz) over z
  for (const double t_s : {0.0, 0.4, 1.1}) {
    SeaBelow now({&sea}, t_s);
    const auto wave = [&](double x) { return kWeight_n_m3 * a * std::sin(k * x - omega * t_s); };
    const auto along = [&](double x) {
      return -kWeight_n_m3 * a * std::cos(k * x - omega * t_s) / k;
    };
    const double force_x = size.y * down * (wave(west) - wave(east));
    const double force_z =
        size.y * (along(east) - along(west)) * (std::exp(k * bottom) - std::exp(k * top));
    const HullLoads loads = now.loads(solid.mesh(), {});
    const double largest_n = kWeight_n_m3 * a * size.y * size.x;
    expect_near(loads.froude_krylov.force_n, {force_x, 0.0, force_z}, 0.003 * largest_n);
    // About y: of the sides -z p, of top and bottom x p.
    const auto z_down = [&](double z) { return std::exp(k * z) * (z / k - 1.0 / (k * k)); };
    const auto x_along = [&](double x) {
      return kWeight_n_m3 * a *
             (std::sin(k * x - omega * t_s) / (k * k) - x * std::cos(k * x - omega * t_s) / k);
    };
    const double moment_y =
        size.y * (z_down(top) - z_down(bottom)) * (wave(west) - wave(east)) -
        size.y * (x_along(east) - x_along(west)) * (std::exp(k * bottom) - std::exp(k * top));
    EXPECT_NEAR(loads.froude_krylov.moment_nm.y, moment_y, 0.006 * largest_n * size.z);
    EXPECT_GT(std::abs(force_x) + std::abs(force_z), 0.1 * largest_n);
  }
}

TEST(HullLoads, AnyThreadsGiveTheSameBitsAndAHullWithoutTrianglesNone) {
  SeaDescription windy;
  windy.resolution = 64;
  const Sea sea(windy);
  const Solid solid = sphere(2.0, 4);
  SeaBelow one({&sea}, 3.0, 1), three({&sea}, 3.0, 3);
  const HullLoads a = one.loads(solid.mesh(), {}), b = three.loads(solid.mesh(), {});
  EXPECT_EQ(a.buoyancy.force_n, b.buoyancy.force_n);
  EXPECT_EQ(a.froude_krylov.force_n, b.froude_krylov.force_n);
  EXPECT_EQ(a.froude_krylov.moment_nm, b.froude_krylov.moment_nm);
  EXPECT_GT(glm::length(a.froude_krylov.force_n), 100.0);
  EXPECT_EQ(one.loads({}, {}).buoyancy.force_n, glm::dvec3(0.0));
}

}  // namespace
}  // namespace swell::ocean
