// Fog at vertices and by depth against equations 14 to 16 of Vyatkin, Dolgovesov, 2019, whose names
// are used: B the attenuation, H the fog's top, h the viewer's height, alpha the angle between the
// look and the ground, beta the sun's, mu that of scattering, l the phase function's parameter.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "render/sky/fog.h"
#include "render/sky/stored_fog_kernels.h"
#include "render/view/render_view.h"
#include "texture/on_every_target.h"

namespace swell::render {
namespace {

class StoredFogKernel : public texture::OnEveryTarget {};
INSTANTIATE_TEST_SUITE_P(Targets, StoredFogKernel, texture::every_target(), texture::target_name);

constexpr double kB = 2e-3, kH_m = 60.0, kh_m = 25.0, kl = 0.6, kSinBeta = 0.4;

// Light I_c = 1 over the fog, and no sky; with S as it is printed in equation 16.
Fog paper_fog() {
  Fog fog;
  fog.on = fog.is_paper = true;
  fog.per_m = glm::vec3(static_cast<float>(kB));
  fog.top_m = static_cast<float>(kH_m);
  fog.sun_sine = static_cast<float>(kSinBeta);
  fog.to_sun = {0.0f, std::sqrt(1.0f - fog.sun_sine * fog.sun_sine), fog.sun_sine};
  fog.forward = static_cast<float>(kl);
  fog.scattered = glm::vec3(static_cast<float>((1.0 - kl) * (1.0 - kl)));
  const auto start_at = [](double height_m) {
    return FogStart{static_cast<float>(height_m), static_cast<float>(kH_m - height_m),
                    glm::vec3(static_cast<float>(std::exp(-kB * (kH_m - height_m) / kSinBeta)))};
  };
  fog.at_eye = start_at(kh_m);
  fog.at_sea = start_at(0.0);
  return fog;
}

// What is left of an object's light, equation 14.
double passes(double way_m) { return std::exp(-kB * way_m); }

// Equations 15 and 16, B in S: the light that the fog scatters to the eye.
double scattered(glm::dvec3 way) {
  const double way_m = glm::length(way);
  const glm::dvec3 to_sun(0.0, std::sqrt(1.0 - kSinBeta * kSinBeta), kSinBeta);
  const double cos_mu = glm::dot(way, to_sun) / way_m;
  const double s = (1.0 - kl) * (1.0 - kl) / std::pow(1.0 + kl * kl - 2.0 * kl * cos_mu, 1.5);
  return std::exp(-kB * kH_m / kSinBeta) * s * (1.0 - passes(way_m));
}

FogAtPlace place_on_ground(double east_m, double north_m) {
  return {{east_m, north_m, -kh_m}, 0.0f};
}

TEST_P(StoredFogKernel, VerticesHaveTheLightOfEquations14To16) {
  std::vector<FogAtPlace> places;
  for (double turn = 0.0; turn < 6.2; turn += 0.7)
    for (const double away_m : {1.0, 40.0, 300.0, 2500.0, 40000.0})
      places.push_back(place_on_ground(away_m * std::sin(turn), away_m * std::cos(turn)));
  see_fog_at(paper_fog(), places);
  for (const FogAtPlace& place : places) {
    const glm::dvec3 way(place.p_seen);
    const double cosec_alpha = glm::length(way) / kh_m;
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(place.passes[c], passes(kh_m * cosec_alpha), 2e-6) << way.x << ' ' << way.y;
      EXPECT_NEAR(place.added[c], scattered(way), 1e-5 + 1e-4 * scattered(way)) << way.x;
    }
  }
}

// Three places, the one triangle between them, and others that the window shows.
struct OneTriangle {
  explicit OneTriangle(std::vector<FogAtPlace> corners) {
    see_fog_at(paper_fog(), corners);
    stored.vertices[SurfaceKind::kTerrain] = std::move(corners);
    draws[SurfaceKind::kTerrain].indices = indices;
    std::array<std::uint32_t, kSurfaceKinds> triangles{};
    triangles[static_cast<std::size_t>(SurfaceKind::kWater)] = 1;
    triangles[static_cast<std::size_t>(SurfaceKind::kTerrain)] = 1;
    stored.primitives = PrimitiveRanges(triangles);
    stored.draws = &draws;
    draws[SurfaceKind::kWater].is_cast = true;  // without vertices
  }
  const std::vector<FogAtPlace>& corners() const { return stored.vertices[SurfaceKind::kTerrain]; }
  std::uint32_t primitive() const { return stored.primitives.begin(SurfaceKind::kTerrain); }
  std::uint32_t without_vertices() const { return stored.primitives.begin(SurfaceKind::kWater); }

  std::vector<std::uint32_t> indices = {0, 1, 2};
  EnumTable<SurfaceKind, DrawRecord> draws;
  StoredFog stored;
};

const FogSeen kOwn = {glm::vec3(-1.0f), glm::vec3(-2.0f)};

// The ray of depth 1 to a place of these parts of the corners.
glm::vec3 ray_to(const OneTriangle& one, glm::dvec3 parts) {
  glm::dvec3 place(0.0);
  for (int i = 0; i < 3; ++i)
    place += parts[i] * glm::dvec3(one.corners()[static_cast<std::size_t>(i)].p_seen);
  return glm::vec3(place / place.y);
}

TEST_P(StoredFogKernel, PixelsOfVerticesHaveTheirFog) {
  const OneTriangle one(
      {place_on_ground(-50, 80), place_on_ground(90, 120), place_on_ground(10, 700)});
  const std::vector<glm::vec3> rays = {ray_to(one, {1, 0, 0}), ray_to(one, {0, 1, 0}),
                                       ray_to(one, {0, 0, 1})};
  const std::vector<std::uint32_t> primitives(3, one.primitive());
  const auto seen = interpolate_fog(one.stored, rays, primitives, kOwn);
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3 way(one.corners()[i].p_seen);
    EXPECT_NEAR(seen[i].passes.y, passes(glm::length(way)), 1e-5);
    EXPECT_NEAR(seen[i].added.y, scattered(way), 1e-5 + 1e-4 * scattered(way));
  }
}

// "... coefficients at each vertex, interpolated as in ordinary lighting": by how near the seen
// place is to each corner, and not its pixel.
TEST_P(StoredFogKernel, BetweenVerticesTheirCoefficientsAreInterpolated) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const OneTriangle triangles[] = {
      OneTriangle({place_on_ground(-50, 80), place_on_ground(90, 120), place_on_ground(10, 700)}),
      OneTriangle({place_on_ground(5, 9), place_on_ground(7, 9), place_on_ground(6, 11)}),
      // From far ahead to behind the eye, as half of a plane sea has it.
      OneTriangle(
          {place_on_ground(-3e4, -3e4), place_on_ground(3e4, -3e4), place_on_ground(3e4, 3e4)}),
      // A wall.
      OneTriangle({FogAtPlace{{-30, 200, -25}, 0.0f}, FogAtPlace{{40, 220, -25}, 0.0f},
                   FogAtPlace{{0, 210, 35}, 60.0f}}),
  };
  for (const OneTriangle& one : triangles) {
    std::vector<glm::vec3> rays;
    std::vector<glm::dvec3> parts;
    while (rays.size() < 200) {
      const double root = std::sqrt(unit(random)), b = unit(random);
      const glm::dvec3 part(1.0 - root, root * (1.0 - b), root * b);
      const glm::vec3 ray = ray_to(one, part);
      double ahead_m = 0.0;
      for (int i = 0; i < 3; ++i) ahead_m += part[i] * one.corners()[i].p_seen.y;
      if (ahead_m < 1.0) continue;
      rays.push_back(ray);
      parts.push_back(part);
    }
    const std::vector<std::uint32_t> primitives(rays.size(), one.primitive());
    const auto seen = interpolate_fog(one.stored, rays, primitives, kOwn);
    for (std::size_t n = 0; n < rays.size(); ++n) {
      double left = 0.0, added = 0.0;
      for (int i = 0; i < 3; ++i) {
        const glm::dvec3 way(one.corners()[static_cast<std::size_t>(i)].p_seen);
        left += parts[n][i] * passes(glm::length(way));
        added += parts[n][i] * scattered(way);
      }
      EXPECT_NEAR(seen[n].passes.x, left, 1e-4) << n;
      EXPECT_NEAR(seen[n].added.z, added, 1e-4 + 1e-4 * added) << n;
    }
  }
}

// What rays find has no vertices, and the sky shows no triangle; pixels of both share packets with
// those of triangles.
TEST_P(StoredFogKernel, WhereThereIsNoTriangleFogIsThePixels) {
  OneTriangle one({place_on_ground(-50, 80), place_on_ground(90, 120), place_on_ground(10, 700)});
  const glm::vec3 ray = ray_to(one, glm::dvec3(1.0 / 3.0));
  const std::vector<std::uint32_t> primitives = {one.primitive(), one.without_vertices(),
                                                 one.primitive(), 0xffffffffu, one.primitive() + 1};
  const std::vector<glm::vec3> rays(primitives.size(), ray);
  const auto seen = interpolate_fog(one.stored, rays, primitives, kOwn);
  for (const std::size_t i : {1u, 3u, 4u}) EXPECT_EQ(seen[i].passes, kOwn.passes) << i;
  for (const std::size_t i : {0u, 2u}) EXPECT_GT(seen[i].passes.x, 0.0f) << i;
  EXPECT_EQ(seen[0].passes, seen[2].passes);
  // Triangles that stand for something found by rays have no extent.
  for (FogAtPlace& corner : one.stored.vertices[SurfaceKind::kTerrain]) corner = {};
  const std::vector<std::uint32_t> all(rays.size(), one.primitive());
  for (const FogSeen& each : interpolate_fog(one.stored, rays, all, kOwn))
    EXPECT_EQ(each.added, kOwn.added);
}

// A level view of a sea in fog, whose middle column shows the sea at each depth once.
StoredFog table_of_level_view(const View& view) {
  StoredFog stored;
  find_fog_by_depth(paper_fog(), make_rays(view), {view.width_px, view.height_px}, stored);
  return stored;
}

View level_view() { return make_view({0, 0, kh_m}, 0.0, 0.0, 0.9, 0.25f, 96, 64); }

// "... by the first bits of the Z buffer": depths that share them have one coefficient.
TEST_P(StoredFogKernel, ATablesRowsAreTheFirstBitsOfDepth) {
  const StoredFog stored = table_of_level_view(level_view());
  std::vector<float> z;
  // An octave of depths, from 128 to 256 m.
  for (int i = 0; i < 1 << 14; ++i)
    z.push_back(0.25f / 256.0f * (1.0f + static_cast<float>(i) / 16384.0f));
  const auto seen = look_up_fog(stored, z);
  std::set<float> distinct;
  for (std::size_t i = 0; i < z.size(); ++i) {
    distinct.insert(seen[i].passes.x);
    const FogSeen& before = seen[i > 0 ? i - 1 : 0];
    EXPECT_GE(seen[i].passes.x, before.passes.x) << i;
    if (i % 128 != 0) {
      EXPECT_EQ(seen[i].passes, before.passes) << i;
    }
  }
  EXPECT_EQ(distinct.size(), 128u);
}

TEST_P(StoredFogKernel, ATableHasTheLightOfEquations14To16AtTheMiddleOfItsRows) {
  const View view = level_view();
  const StoredFog stored = table_of_level_view(view);
  const double lowest = view.tan_half_y * 63.0 / 64.0;  // of the last row's middle
  for (const double depth_m : {0.3, 12.0, 51.0, 180.0, 900.0, 20000.0}) {
    const double z = 0.25 / depth_m;
    // The row's ends by their definition: powers of two, each in 128 parts.
    const double octave = std::exp2(std::floor(std::log2(z)));
    const double middle_z = octave * (std::floor(z / octave * 128.0) + 0.5) / 128.0;
    const double middle_m = 0.25 / middle_z;
    const double down = std::min(kh_m, middle_m * lowest);
    // The middle column lies between two pixels, at the view's axis.
    const glm::dvec3 way(0.0, middle_m, -down);
    const std::vector<float> one = {static_cast<float>(z)};
    const FogSeen seen = look_up_fog(stored, one)[0];
    EXPECT_NEAR(seen.passes.x, passes(glm::length(way)), 1e-5) << depth_m;
    EXPECT_NEAR(seen.added.x, scattered(way), 1e-5 + 1e-4 * scattered(way)) << depth_m;
  }
}

// Beyond the table's ends depths have its last rows.
TEST_P(StoredFogKernel, ATableReachesFromTheNearPlaneToAllThereIs) {
  const StoredFog stored = table_of_level_view(level_view());
  const std::vector<float> z = {1.0f, 1e-30f, 0x1p-24f};
  const auto seen = look_up_fog(stored, z);
  EXPECT_NEAR(seen[0].passes.x, 1.0f, 2e-3f);
  EXPECT_EQ(seen[1].passes.x, seen[2].passes.x);
  EXPECT_LT(seen[1].passes.x, 1e-6f);
}

}  // namespace
}  // namespace swell::render
