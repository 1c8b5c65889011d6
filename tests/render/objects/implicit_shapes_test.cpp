// Implicit surfaces against closed formulas: how large they are in a picture, and how far away.
#include <gtest/gtest.h>

#include "render/objects/implicit_shots.h"

namespace swell::render {
namespace {

// Area of the silhouette, of what is seen nearly along parallel rays [m^2].
double silhouette_m2(const char* toml, double height_m) {
  constexpr double kFar_m = 4000.0;
  const ImplicitShot shot = shoot(implicit_of(toml), from_south(kFar_m, height_m, 1000));
  return static_cast<double>(shot.count) * shot.pixel_area() * kFar_m * kFar_m;
}

TEST(ImplicitShapes, SphereIsTheDiscOfItsAngle) {
  const ImplicitShot shot =
      shoot(implicit_of("[[form]]\nsize = [2, 2, 2]"), from_south(5.0, 2.4, 1000));
  const double tangent = std::tan(std::asin(1.0 / 5.0));
  const double area = static_cast<double>(shot.count) * shot.pixel_area();
  EXPECT_NEAR(area, kPi * tangent * tangent, 1e-3 * kPi * tangent * tangent);
}

TEST(ImplicitShapes, SphereIsAsFarAsItsQuadraticSays) {
  const ImplicitShot shot =
      shoot(implicit_of("[[form]]\nsize = [2, 2, 2]"), from_south(5.0, 2.4, 300));
  double worst = 0.0;
  for (std::size_t i = 0; i < shot.part.size(); ++i) {
    const glm::dvec3 ray = shot.ray(i);
    const double a = glm::dot(ray, ray), b = -5.0 * ray.y, inside = b * b - a * 24.0;
    if (std::abs(inside) < 1e-4) continue;  // the rim
    ASSERT_EQ(inside > 0.0, shot.depth_m[i] > 0.0f) << i;
    if (inside > 0.0)
      worst = std::max(worst, std::abs((-b - std::sqrt(inside)) / a - shot.depth_m[i]));
  }
  EXPECT_LT(worst, 2e-4);  // of 5 m; 5e-6 but for the rim
}

TEST(ImplicitShapes, EllipsoidHasTheSilhouetteOfItsAxes) {
  // Turned so that the rays go along n = (sin 40 deg, cos 40 deg, 0) of its axes.
  const double s = std::sin(40.0 * kPi / 180.0), c = std::cos(40.0 * kPi / 180.0);
  const double a = 1.0, b = 2.0, h = 3.0;
  const double area = kPi * std::sqrt(b * b * h * h * s * s + a * a * h * h * c * c);
  EXPECT_NEAR(silhouette_m2("[[form]]\nsize = [2, 4, 6]\nturn_deg = [0, 0, 40]", 6.6), area,
              1e-3 * area);
}

TEST(ImplicitShapes, CylinderConeAndBoxHaveTheirSides) {
  EXPECT_NEAR(silhouette_m2("[[form]]\nshape = \"cylinder\"\nsize = [2, 2, 3]", 4.0), 6.0, 6e-3);
  EXPECT_NEAR(silhouette_m2("[[form]]\nshape = \"cone\"\nsize = [2, 2, 3]", 4.0), 3.0, 3e-3);
  EXPECT_NEAR(silhouette_m2("[[form]]\nshape = \"cone\"\ntop = 0.5\nsize = [2, 2, 3]", 4.0), 4.5,
              4.5e-3);
  EXPECT_NEAR(silhouette_m2("[[form]]\nshape = \"box\"\nsize = [2, 2, 3]", 4.0), 6.0, 6e-3);
  // y = 1 - x^2 over [-1, 1], of height 3: 3 (2 - 2 / 3).
  EXPECT_NEAR(silhouette_m2("[[form]]\nshape = \"paraboloid\"\nsize = [2, 2, 3]", 4.0), 4.0, 4e-3);
}

TEST(ImplicitShapes, CylinderOnItsSideIsADiscSquarelyBeforeTheEye) {
  const ImplicitShot shot = shoot(implicit_of("[[form]]\nshape = \"cylinder\"\naxis = \"y\"\n"
                                              "size = [2, 3, 2]"),
                                  from_south(10.0, 3.0, 400));
  const double radius = 1.0 / 8.5;  // of its near end
  EXPECT_NEAR(static_cast<double>(shot.count) * shot.pixel_area(), kPi * radius * radius,
              1e-3 * kPi * radius * radius);
  EXPECT_NEAR(shot.depth_m[200 * 400 + 200], 8.5f, 1e-5f);
}

TEST(ImplicitShapes, TwoSpheresUnite) {
  EXPECT_NEAR(silhouette_m2("[[form]]\nsize = [2, 2, 2]\nat = [-0.5, 0, 0]\n"
                            "[[form]]\nsize = [2, 2, 2]\nat = [0.5, 0, 0]",
                            3.4),
              5.054816, 5e-3);
}

TEST(ImplicitShapes, SpheresIntersectAndSubtract) {
  // The lens of two unit discs whose middles are 1 apart.
  const double lens = 2.0 * kPi / 3.0 - 0.5 * std::sqrt(3.0);
  EXPECT_NEAR(silhouette_m2("[[form]]\nsize = [2, 2, 2]\nat = [-0.5, 0, 0]\n"
                            "keep = [{ size = [2, 2, 2], at = [0.5, 0, 0] }]",
                            2.4),
              lens, 1e-3 * lens);
  // What a cylinder bores out along the view leaves a ring.
  const double ring = kPi * (1.0 - 0.25);
  EXPECT_NEAR(silhouette_m2("[[form]]\nsize = [2, 2, 2]\n"
                            "cut = [{ shape = \"cylinder\", axis = \"y\", size = [1, 1, 1] }]",
                            2.4),
              ring, 1e-3 * ring);
}

TEST(ImplicitShapes, PerturbedSphereHasTheRadiusOfItsRoot) {
  // F = 1 - s + (2 - s)^3 where s < 2, s = r^2: the shape's own Q is 1 - s / 2, its cube an eighth.
  const double radius = 1.1478990358;
  const double area = silhouette_m2(
      "[[form]]\nsize = [2, 2, 2]\n"
      "bend = [{ size = [2.8284271247, 2.8284271247, 2.8284271247], factor = 8 }]",
      2.6);
  EXPECT_NEAR(area, kPi * radius * radius, 1e-3 * area);
}

// A thousand times nearer by the lens: the rim stays a circle, with no sides.
TEST(ImplicitShapes, ThousandTimesZoomShowsTheSameCircle) {
  const scene::ImplicitSurface implicit = implicit_of("[[form]]\nsize = [12, 12, 12]");
  const double distance_m = 30.0, sine = 6.0 / distance_m;
  const double pitch = std::asin(sine), fov = 1e-3 * 2.2 * pitch;
  const View view = make_view({0.0, -distance_m, 0.0}, 0.0, pitch, fov, 0.25f, 400, 400);
  const ImplicitShot shot = shoot(implicit, view);
  // Rays within the angle of the sphere meet it.
  double worst_px = 0.0;
  for (std::size_t x = 0; x < 400; x += 7) {
    double drawn = 400.0, right = 400.0;
    for (std::size_t y = 400; y-- > 0;) {
      const glm::dvec3 ray = shot.ray(y * 400 + x);
      if (shot.depth_m[y * 400 + x] > 0.0f) drawn = static_cast<double>(y);
      if (ray.y >= std::sqrt(1.0 - sine * sine) * glm::length(ray)) right = static_cast<double>(y);
    }
    worst_px = std::max(worst_px, std::abs(drawn - right));
  }
  EXPECT_LE(worst_px, 2.0);
  EXPECT_GT(shot.count, 1000u);
}

}  // namespace
}  // namespace swell::render
