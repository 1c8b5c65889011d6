// A sea without wind mirrors the sky as it is, and the shapes of the clouds.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "render/linear_renderer.h"

namespace swell::render {
namespace {

constexpr int kMirrorSide_px = 160;
constexpr double kMirrorEye_m = 2.0, kFov_deg = 40.0;

scene::Scene sea_of(double wind_mps, double sun_deg, double cloud_cover, double azimuth_deg) {
  scene::Scene scene = calm_scene(sun_deg, cloud_cover, azimuth_deg);
  scene.sea.spectrum = true;
  scene.sea.wind_speed_mps = wind_mps;
  scene.sea.resolution = 32;
  return scene;
}

// Along the water, northwards: the sun is behind the eye.
struct CalmPicture : LinearRenderer {
  explicit CalmPicture(double wind_mps) : CalmPicture(sea_of(wind_mps, 35.0, 0.5, 180.0)) {}
  explicit CalmPicture(const scene::Scene& scene, PartSet without = {}) : LinearRenderer(scene) {
    options.without = without;
    draw_view(make_view({0.0, 0.0, kMirrorEye_m}, 0.0, 0.0, radians(kFov_deg), 0.25f,
                        kMirrorSide_px, kMirrorSide_px),
              0.0);
  }
};

// Green light of a row so many pixels over the horizon, or under it.
std::vector<double> row_of(const LinearRenderer& picture, int over_px) {
  std::vector<double> row(kMirrorSide_px);
  const int y = over_px > 0 ? kMirrorSide_px / 2 - over_px : kMirrorSide_px / 2 - 1 - over_px;
  for (int x = 0; x < kMirrorSide_px; ++x)
    row[static_cast<std::size_t>(x)] = picture.linear(x, y).y;
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

// Returns the reflectance of level water, at the sine of a ray's elevation. Source: Fresnel 1823.
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
    const double sine =
        double{picture.direction(kMirrorSide_px / 2, kMirrorSide_px / 2 - over_px).z};
    EXPECT_GT(line.correlation, 0.95) << over_px;
    EXPECT_NEAR(line.slope / fresnel(sine), 1.0, 0.15) << over_px;
  }
}

// A clear sky and a low sun ahead, over water without light of its own. Beside the sun's disc,
// whose own image is wider, the sky falls to half within a degree or two.
TEST(CalmMirror, IsAsSharpAsTheSkyUnderALowSun) {
  constexpr float kBesideTheDisc = 0.9976f;  // cosine of 4 degrees
  for (const double elevation_deg : {1.0, 4.0, 10.0}) {
    scene::Scene scene = sea_of(0.0, elevation_deg, 0.0, 0.0);
    scene.water.body_colour = glm::vec3(0.0f);
    const CalmPicture picture(scene, {Part::kHaze});
    for (int over_px = 6; over_px <= 72; over_px += 6)
      for (int x = 0; x < kMirrorSide_px; x += 4) {
        const glm::vec3 up = picture.direction(x, kMirrorSide_px / 2 - over_px);
        if (glm::dot(up, scene.sky.sun_direction) > kBesideTheDisc) continue;
        const double sky = double{picture.linear(x, kMirrorSide_px / 2 - over_px).y};
        const double water = double{picture.linear(x, kMirrorSide_px / 2 - 1 + over_px).y};
        EXPECT_NEAR(water / (sky * fresnel(double{up.z})), 1.0, 0.03)
            << elevation_deg << " " << over_px << " " << x;
      }
  }
}

// Deviations along the rows of the water, over those of the sky.
double mirrored_contrast(const LinearRenderer& picture) {
  double water = 0.0, sky = 0.0;
  for (int over_px = 16; over_px <= 72; over_px += 4) {
    const std::vector<double> above = row_of(picture, over_px), below = row_of(picture, -over_px);
    const double sine =
        double{picture.direction(kMirrorSide_px / 2, kMirrorSide_px / 2 - over_px).z};
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
