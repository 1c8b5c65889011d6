// A sea without wind mirrors the shapes of the clouds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/elementary.h"
#include "render/linear_renderer.h"
#include "render/workspace.h"

namespace swell::render {
namespace {

constexpr int kSize_px = 160;
constexpr double kEye_m = 2.0, kFov_deg = 40.0;

scene::Scene calm_clouds(double wind_mps) {
  scene::Scene scene = calm_scene(35.0, 0.5, 180.0);
  scene.sea.spectrum = true;
  scene.sea.wind_speed_mps = wind_mps;
  scene.sea.resolution = 32;
  return scene;
}

// Along the water, northwards: the sun is behind the eye.
struct CalmPicture : LinearRenderer {
  explicit CalmPicture(double wind_mps) : LinearRenderer(calm_clouds(wind_mps)) {
    draw_view(make_view({0.0, 0.0, kEye_m}, 0.0, 0.0, scene::radians(kFov_deg), 0.25f, kSize_px,
                        kSize_px),
              0.0);
  }
};

// Green light of a row so many pixels over the horizon, or under it.
std::vector<double> row_of(const LinearRenderer& picture, int over_px) {
  std::vector<double> row(kSize_px);
  const int y = over_px > 0 ? kSize_px / 2 - over_px : kSize_px / 2 - 1 - over_px;
  for (int x = 0; x < kSize_px; ++x) row[static_cast<std::size_t>(x)] = double{picture.at(x, y).y};
  return row;
}

struct Line {
  double slope, correlation, deviation;  // of y over x; of x
};
Line fit_line(const std::vector<double>& x, const std::vector<double>& y) {
  double sx = 0.0, sy = 0.0, sxx = 0.0, syy = 0.0, sxy = 0.0;
  const auto n = static_cast<double>(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    sx += x[i] / n, sy += y[i] / n;
    sxx += x[i] * x[i] / n, syy += y[i] * y[i] / n, sxy += x[i] * y[i] / n;
  }
  const double vx = sxx - sx * sx, vy = syy - sy * sy, c = sxy - sx * sy;
  return {c / vx, c / std::sqrt(vx * vy), std::sqrt(vx)};
}

// Of level water, at the sine of a ray's elevation. Source: Fresnel 1823.
double fresnel(double c) {
  const double t = std::sqrt(1.0 - (1.0 - c * c) / (1.333 * 1.333));
  const double s = (c - 1.333 * t) / (c + 1.333 * t), p = (1.333 * c - t) / (1.333 * c + t);
  return 0.5 * (s * s + p * p);
}

// Each row of water is the sky's as far over the horizon, times the reflectance, and the light of
// the water body, which is the same all along it. Glass spreads rays by 0.7 degrees, which takes
// some of the contrast.
TEST(CalmMirror, IsTheSkyTurnedOver) {
  const CalmPicture picture(0.0);
  for (int over_px = 16; over_px <= 72; over_px += 8) {
    const Line line = fit_line(row_of(picture, over_px), row_of(picture, -over_px));
    const double sine = double{picture.direction(kSize_px / 2, kSize_px / 2 - over_px).z};
    EXPECT_GT(line.correlation, 0.95) << over_px;
    EXPECT_NEAR(line.slope / fresnel(sine), 1.0, 0.15) << over_px;
  }
}

// Deviations along the rows of the water, over those of the sky.
double mirrored_contrast(const LinearRenderer& picture) {
  double water = 0.0, sky = 0.0;
  for (int over_px = 16; over_px <= 72; over_px += 4) {
    const std::vector<double> above = row_of(picture, over_px), below = row_of(picture, -over_px);
    const double sine = double{picture.direction(kSize_px / 2, kSize_px / 2 - over_px).z};
    sky += fit_line(above, below).deviation * fresnel(sine);
    water += fit_line(below, above).deviation;
  }
  return water / sky;
}

// Little by little, though ripples grow with the square of such winds.
TEST(CalmMirror, BlursAsTheWindRises) {
  const double calm = mirrored_contrast(CalmPicture(0.0));
  double before = calm;
  EXPECT_GT(calm, 0.85);
  for (double wind_mps = 0.02; wind_mps < 0.61; wind_mps += 0.02) {
    const double now = mirrored_contrast(CalmPicture(wind_mps));
    EXPECT_NEAR(now, before, 0.1) << wind_mps;
    before = now;
  }
  EXPECT_LT(before, 0.75 * calm);
}

}  // namespace
}  // namespace swell::render
