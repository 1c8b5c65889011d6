// The base paper's distorted lookup of caustics: T' = T + Cc N.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "render/measures.h"
#include "render/shot.h"
#include "render/under_water/flat_floor.h"
#include "texture/bump_sequence.h"

namespace swell::render {
namespace {

constexpr double kBendEye_m = 4.0, kDepth_m = 0.5, kHalfFov_rad = 0.25;
constexpr int kBendSize_px = 128;

// Half a metre of water over a flat floor under a sun straight above. Its ripples are waves of a
// kilometre along x, so that their slope is the same all over the picture.
class CausticBend : public FlatFloor {
 protected:
  void SetUp() override {
    FlatFloor::SetUp();
    texture::Image8 wave{32, 32, 1, {}};
    for (int i = 0; i < 32 * 32; ++i) {
      const double sine = std::sin(2.0 * std::numbers::pi * (i % 32) / 32.0);
      wave.pixels.push_back(static_cast<std::uint8_t>(std::lround(127.5 + 127.0 * sine)));
    }
    write("wave_0000.png", wave);
    write("wave_0001.png", wave);
  }

  scene::Scene shallow_water() const {
    scene::Scene scene = flat_floor(kDepth_m, 0.3);
    scene.detail.triangulation = scene::Triangulation::kPlane;
    scene.ripples.kind = scene::RippleKind::kSequence;
    scene.ripples.sequence = (folder_ / "wave_%04d.png").string();
    scene.ripples.frames = 2;
    scene.ripples.length_m = 1000.0;
    return scene;
  }
};

// What caustics add to the green light of each pixel, seen from straight above, north on top.
std::vector<double> added_light(const World& world) {
  const View view = make_view({0.0, 0.0, kBendEye_m}, 0.0, -0.5 * std::numbers::pi,
                              2.0 * kHalfFov_rad, 0.25f, kBendSize_px, kBendSize_px);
  const auto green = [&](PartSet without) {
    return green_light(Shot(world, view, 7.0, {.keep_linear = true, .without = without}).target);
  };
  const std::vector<float> with = green({}), without = green({Part::kCaustics});
  std::vector<double> added(with.begin(), with.end());
  for (std::size_t i = 0; i < added.size(); ++i) added[i] -= without[i];
  return added;
}

// The ripples' slope at the eye, each layer's largest: root 2 times its deviation.
double ripple_slope(const World& world) {
  const Shot shot(world, make_view({0.0, 0.0, kBendEye_m}, 0.0, -1.0, 1.0, 0.25f, 16, 16), 7.0, {},
                  1);
  const Water& water = shot.state().shading.material<Water>();
  double slope = 0.0;
  for (int i = water.first_ripples; i < water.layer_count; ++i)
    slope += std::sqrt(2.0) * static_cast<double>(texture::kBumpSlope) *
             static_cast<double>(water.layers[static_cast<std::size_t>(i)].gain);
  return slope;
}

// Returns the correlation of `a` with `b` so many pixels further right.
double correlation(const std::vector<double>& a, const std::vector<double>& b, int right_px) {
  double n = 0.0, sum_a = 0.0, sum_b = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
  for (int y = 0; y < kBendSize_px; ++y)
    for (int x = 0; x + right_px < kBendSize_px; ++x) {
      const double p = a[static_cast<std::size_t>(y * kBendSize_px + x)];
      const double q = b[static_cast<std::size_t>(y * kBendSize_px + x + right_px)];
      n += 1.0, sum_a += p, sum_b += q, aa += p * p, bb += q * q, ab += p * q;
    }
  return (n * ab - sum_a * sum_b) / std::sqrt((n * aa - sum_a * sum_a) * (n * bb - sum_b * sum_b));
}

// N is minus the slope: what the light of the place x falls on lies at x + Cc slope.
TEST_F(CausticBend, MovesTheLightByTheSlopeOfTheRipples) {
  constexpr int kMoved_px = 10;
  scene::Scene scene = shallow_water();
  const World straight = world_of(scene);
  const double pixel_m = 2.0 * std::tan(kHalfFov_rad) *
                         (kBendEye_m + kDepth_m / scene.water.refraction_index) / kBendSize_px;
  scene.water.caustic_distortion = kMoved_px * pixel_m / ripple_slope(straight);
  ASSERT_LT(scene.water.caustic_distortion, 10.0);
  const World bent(scene, straight, 1);
  const std::vector<double> before = added_light(straight), after = added_light(bent);
  const double moved = correlation(before, after, kMoved_px);
  EXPECT_GT(moved, 0.95);
  EXPECT_LT(correlation(before, after, kMoved_px - 2), moved - 0.05);
  EXPECT_LT(correlation(before, after, kMoved_px + 2), moved - 0.05);
}

}  // namespace
}  // namespace swell::render
