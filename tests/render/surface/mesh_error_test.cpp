// The measure of a mesh's error on seas and meshes whose errors are known.
#include "render/measure/mesh_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lod/plane.h"
#include "scene/water.h"

namespace swell::render {
namespace {

constexpr int kWidth_px = 160, kHeight_px = 90;
constexpr double kFov_rad = 1.0;
const double kFocal_px = 0.5 * kHeight_px / std::tan(0.5 * kFov_rad);
const scene::SeaArea kArea;

View level_view(double eye_z) {
  return make_view({0.0, 0.0, eye_z}, 0.0, 0.0, kFov_rad, 0.25f, kWidth_px, kHeight_px);
}

// A sea from scene text, at t = 0, and a view of it.
struct Sea {
  explicit Sea(const char* text, double eye_z)
      : water(scene::parse_scene(text, "test.toml")),
        surface(water.at(0.0, frame, workers)),
        reference(look_at_sea(level_view(eye_z), surface, kArea, 4, workers)) {}

  MeshError error_of(const lod::Mesh& mesh, const std::vector<float>& height_m) {
    return measure_mesh_error(reference, domain, mesh, height_m, workers);
  }

  Workers workers{1};
  ocean::SeaFrame frame;
  scene::Water water;
  scene::WaterSurface surface;
  SeaReference reference;
  lod::Domain domain{.min_world = {-32768.0, -32768.0}, .size_m = 65536.0, .lattice_bits = 16};
};

constexpr const char* kCalm = "[sea]\nspectrum = false\n";

// A calm sea's plane, lifted by `lift_m`.
MeshError lifted_plane_error(float lift_m) {
  Sea sea(kCalm, 10.0);
  lod::Mesh mesh;
  lod::write_plane(sea.domain, mesh);
  return sea.error_of(mesh, std::vector<float>(4, lift_m));
}

TEST(MeshError, IsNothingForAPlaneOnACalmSea) {
  const MeshError error = lifted_plane_error(0.0f);
  EXPECT_GT(error.height_px.size(), 300u);
  EXPECT_EQ(error.silhouette_px.size(), static_cast<std::size_t>(kWidth_px));
  EXPECT_LT(std::ranges::max(error.height_px), 1e-6);
  EXPECT_LT(std::ranges::max(error.silhouette_px), 1e-6);
}

// A level eye 10 m up sees the mean level at y px below the middle at depth 10 focal / y, where a
// metre is y / 10 px high.
TEST(MeshError, OfALiftedPlaneIsItsHeightInPixels) {
  const Sea sea(kCalm, 10.0);
  const MeshError error = lifted_plane_error(1.0f);
  ASSERT_EQ(error.height_px.size(), sea.reference.pixel.size());
  for (std::size_t i = 0; i < error.height_px.size(); ++i) {
    const double below_px = sea.reference.pixel[i].y + 0.5 - 0.5 * kHeight_px;
    ASSERT_NEAR(error.height_px[i], below_px / 10.0, 1e-4);
  }
}

// A wall 5 m above the eye and 100 m away, from 50 m left to 50 m right.
TEST(MeshError, OfAWallIsWhatStandsAboveTheHorizon) {
  Sea sea(kCalm, 10.0);
  lod::Mesh mesh;
  mesh.lattice = {{32718, 32868}, {32818, 32868}, {32768, 32968}};
  mesh.indices = {0, 1, 2};
  mesh.level = {0};
  const MeshError error = sea.error_of(mesh, {15.0f, 15.0f, 15.0f});
  for (int x = 0; x < kWidth_px; ++x) {
    const bool on_wall = std::abs(x + 0.5 - 0.5 * kWidth_px) <= 0.5 * kFocal_px;
    ASSERT_NEAR(error.silhouette_px[static_cast<std::size_t>(x)], on_wall ? 0.05 * kFocal_px : 0.0,
                1e-3)
        << "column " << x;
  }
}

// In the trough of a wave of 5 m that runs along the line of sight: its crest hides the horizon,
// as high in all columns.
TEST(MeshError, SeesTheCrestAboveATrough) {
  const Sea sea(
      "[sea]\nspectrum = false\n[[sea.sines]]\namplitude_m = 5.0\nwavelength_m = 400.0\n"
      "to_deg = 0.0\nphase_deg = -90.0\n",
      1.0);
  double steepest = 0.0;
  for (double y_m = 1.0; y_m < 500.0; y_m += 0.01) {
    const double z = -5.0 * std::cos(2.0 * std::numbers::pi * y_m / 400.0);
    steepest = std::max(steepest, (z - 1.0) / y_m);
  }
  for (const double y_px : sea.reference.horizon_y_px)
    ASSERT_NEAR(y_px, 0.5 * kHeight_px - kFocal_px * steepest, 0.01);
}

}  // namespace
}  // namespace swell::render
