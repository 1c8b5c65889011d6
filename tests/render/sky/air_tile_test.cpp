// The air below an eye aloft, which pictures of small pixels find at nodes, against that of pixels
// just too large for it.
#include <gtest/gtest.h>

#include <cmath>

#include "render/linear_renderer.h"

namespace swell::render {
namespace {

constexpr int kTileWidth_px = 70, kTileHeight_px = 90;  // tiles that are cut, too

TEST(AirOverATile, IsThatOfItsPixels) {
  scene::Scene scene = calm_scene(35.0, 0.0, 200.0);
  scene.detail.water_triangles = 500;
  LinearRenderer renderer(scene);
  for (const auto& [height_m, pitch_deg] :
       {std::pair(60.0, -6.0), {1500.0, -7.0}, {1500.0, -50.0}, {9000.0, -9.0}}) {
    const auto draw = [&](double pixel_rad) {
      renderer.draw_view(
          make_view({0.0, 0.0, height_m}, 0.0, radians(pitch_deg), pixel_rad * kTileHeight_px,
                    0.25f, kTileWidth_px, kTileHeight_px),
          5.0);
      return renderer.target.linear;
    };
    const auto on = draw(0.00149), off = draw(0.00151);
    double most = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < on.size(); ++i) {
      const double error = std::abs(on[i] - off[i]) / (0.05 + off[i]);
      most = std::max(most, error);
      sum += error;
    }
    // The pictures differ by half a pixel at their rims, which is most of what is allowed.
    EXPECT_LT(most, 0.02) << height_m << " m " << pitch_deg;
    EXPECT_LT(sum / static_cast<double>(on.size()), 0.003) << height_m << " m " << pitch_deg;
  }
}

}  // namespace
}  // namespace swell::render
