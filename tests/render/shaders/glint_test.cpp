// The sun's glitter on rough water: its energy, the form of its path, and its part in the light
// that the water shader shows.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "constants.h"
#include "render/shaders/plain_sea.h"
#include "render/shaders/shader_kernels.h"
#include "render/sky/sky_maps.h"
#include "texture/on_every_target.h"

namespace swell::render {
namespace {

class Glint : public texture::OnEveryTarget {};
INSTANTIATE_TEST_SUITE_P(Targets, Glint, texture::every_target(), texture::target_name);

constexpr float kLeastArea = 0.02f;  // what SunGlint divides by at least

// Total slope variance of the sea at a wind speed [m/s].
// Source: Cox and Munk, Measurement of the Roughness of the Sea Surface, 1954.
double cox_munk(double wind) { return 0.003 + 0.00512 * wind; }

glm::dvec3 direction(double from_zenith_rad, double azimuth_rad) {
  const double s = std::sin(from_zenith_rad);
  return {s * std::sin(azimuth_rad), s * std::cos(azimuth_rad), std::cos(from_zenith_rad)};
}

glm::dvec3 sun_at(double degrees_from_zenith) {
  return direction(degrees_from_zenith * kPiRef / 180.0, 0.4);
}

// Directions above least_z that stand for equal solid angles: two Gauss points in each of kRings
// rings.
struct Sphere {
  explicit Sphere(double least_z) {
    constexpr int kRings = 750, kTurns = 1000;
    const double step = (1.0 - least_z) / kRings, off = 0.5 / std::sqrt(3.0);
    solid_angle = 0.5 * step * 2.0 * kPiRef / kTurns;
    for (int i = 0; i < 2 * kRings; ++i) {
      const double z = least_z + (i / 2 + 0.5 + (i % 2 ? off : -off)) * step;
      for (int j = 0; j < kTurns; ++j)
        directions.push_back(direction(std::acos(z), 2.0 * kPiRef * (j + 0.5) / kTurns));
    }
  }
  std::vector<glm::vec3> directions;
  double solid_angle;
};

// The integral of radiance times the cosine that it was divided by, over directions above least_z.
double energy(const GlintSurface& surface, const Sphere& sphere) {
  std::vector<float> cosine, glint(sphere.directions.size());
  for (const glm::vec3& v : sphere.directions) cosine.push_back(v.z);
  sun_glint(surface, sphere.directions, cosine, glint);
  double sum = 0.0;
  for (std::size_t i = 0; i < glint.size(); ++i)
    sum += static_cast<double>(glint[i]) * std::max(cosine[i], kLeastArea);
  return sum * sphere.solid_angle;
}

// Returns the energy that facets mirror: those of slope (x, y) that the sun sees take p(x, y)
// (n.s / n.z) of its light to where they mirror it. By quadrature over the slopes, of a Gaussian of
// `variance`; `part(v)` of what goes to v counts.
template <class Part>
double facet_energy(glm::dvec3 sun, double variance, const Part& part) {
  constexpr int kSteps = 1500;
  const double sigma = std::sqrt(0.5 * variance), reach = 7.0 * sigma, step = 2.0 * reach / kSteps;
  double sum = 0.0;
  for (int j = 0; j < kSteps; ++j) {
    for (int i = 0; i < kSteps; ++i) {
      const double x = -reach + (i + 0.5) * step, y = -reach + (j + 0.5) * step;
      const glm::dvec3 facet(-x, -y, 1.0);  // n / n.z
      const double lit = glm::dot(facet, sun);
      const glm::dvec3 mirrored = facet * (2.0 * lit / glm::dot(facet, facet)) - sun;
      if (lit > 0.0) sum += lit * part(mirrored) * std::exp(-(x * x + y * y) / variance);
    }
  }
  return sum * step * step / (kPiRef * variance);
}

constexpr auto kAll = [](glm::dvec3) { return 1.0; };
constexpr auto kUp = [](glm::dvec3 v) { return v.z > 0.0 ? 1.0 : 0.0; };

// With nothing lost, what all facets mirror is what falls on the level surface: E cos(theta_s).
// Reflected rays that go down count too: the formula has no masking. The cosine is divided out
// above its clamp at 0.08 and 0.08 below it. Facets that face away from the sun add 1.6e-5 at most.
TEST_P(Glint, MirrorsAllTheLightThatFallsOnTheWater) {
  const Sphere sphere(-0.75);
  for (const double degrees : {0.0, 30.0, 45.0, 60.0}) {
    for (const double wind : {2.0, 5.0, 10.0}) {
      GlintSurface surface;
      surface.sun_direction = sun_at(degrees);
      surface.variance = static_cast<float>(cox_munk(wind));
      const double all = energy(surface, sphere), falls = std::cos(degrees * kPiRef / 180.0);
      EXPECT_NEAR(all / falls, 1.0, 2e-5) << degrees << " degrees, wind " << wind;
      EXPECT_NEAR(all, facet_energy(sun_at(degrees), surface.variance, kAll), 3e-6) << degrees;
    }
  }
}

// A wave's mean slope turns the surface: E (s.z - slope.s), linear in reflectance.
TEST_P(Glint, MirrorsAsMuchAsFallsOnTiltedWater) {
  const Sphere sphere(-0.5);
  GlintSurface surface;
  surface.sun_direction = sun_at(40.0);
  surface.slope = {0.15f, -0.08f};
  surface.variance = static_cast<float>(cox_munk(7.0));
  surface.reflectance = 0.25f;
  const glm::dvec3 sun(surface.sun_direction);
  const double falls = sun.z - 0.15 * sun.x + 0.08 * sun.y;
  EXPECT_NEAR(energy(surface, sphere), 0.25 * falls, 1e-5);
}

// What goes up, of a low sun: .994 and .976 of the whole at winds of 5 and 10 m/s.
TEST_P(Glint, MirrorsUpwardsWhatTheFacetsDo) {
  const Sphere sphere(0.0);
  const std::vector<std::pair<double, double>> table = {{5.0, 0.994}, {10.0, 0.976}};
  for (const auto& [wind, part] : table) {
    GlintSurface surface;
    surface.sun_direction = sun_at(60.0);
    surface.variance = static_cast<float>(cox_munk(wind));
    const double up = energy(surface, sphere) / 0.5;
    EXPECT_NEAR(up, part, 6e-4) << wind;
    EXPECT_NEAR(up, 2.0 * facet_energy(sun_at(60.0), cox_munk(wind), kUp), 1e-4) << wind;
  }
}

// ---- The path

// At the sun's own elevation eps, the facet that mirrors the sun at azimuth phi from the mirror's
// has the slope sin(phi / 2) / tan(eps) across, and 1 / cos^4 of its tilt weighs it.
TEST_P(Glint, MakesAPathAsWideAsTheSlopesSay) {
  const std::vector<std::pair<double, double>> widths = {
      {5.0, 1.65}, {10.0, 3.33}, {20.0, 6.88}, {30.0, 10.96}};
  const double variance = cox_munk(10.0);
  for (const auto& [elevation, width] : widths) {
    const double eps = elevation * kPiRef / 180.0;
    std::vector<glm::vec3> to_eye;
    std::vector<double> azimuth;
    for (int i = -4000; i <= 4000; ++i) {
      azimuth.push_back(1.4 * i / 4000.0);
      to_eye.push_back(direction(0.5 * kPiRef - eps, kPiRef + azimuth.back()));
    }
    GlintSurface surface;
    surface.sun_direction = direction(0.5 * kPiRef - eps, 0.0);
    surface.variance = static_cast<float>(variance);
    std::vector<float> glint(to_eye.size());
    sun_glint(surface, to_eye, std::vector<float>(to_eye.size(), 0.3f), glint);
    double sum = 0.0, moment = 0.0, exact_sum = 0.0, exact_moment = 0.0;
    for (std::size_t i = 0; i < glint.size(); ++i) {
      const double across = std::sin(0.5 * azimuth[i]) / std::tan(eps), tan2 = across * across;
      const double exact = std::exp(-tan2 / variance) * (1.0 + tan2) * (1.0 + tan2);
      sum += glint[i];
      moment += glint[i] * azimuth[i] * azimuth[i];
      exact_sum += exact;
      exact_moment += exact * azimuth[i] * azimuth[i];
    }
    const double got = std::sqrt(moment / sum) * 180.0 / kPiRef;
    EXPECT_NEAR(got, width, 0.1 * width) << elevation;
    EXPECT_NEAR(got, std::sqrt(exact_moment / exact_sum) * 180.0 / kPiRef, 1e-3 * width)
        << elevation;
  }
}

// Under the sun at the zenith, the facet of one sigma's slope mirrors it 18.7 degrees off the
// vertical at a wind of 10 m/s.
TEST_P(Glint, ReachesAsFarAsTheSlopesSay) {
  const double variance = cox_munk(10.0), sigma = std::sqrt(0.5 * variance);
  const double angle = 2.0 * std::atan(sigma);
  EXPECT_NEAR(angle * 180.0 / kPiRef, 18.7, 0.05);
  GlintSurface surface;
  surface.variance = static_cast<float>(variance);
  const std::vector<glm::vec3> to_eye = {direction(0.0, 0.0), direction(angle, 2.0)};
  std::vector<float> glint(2);
  sun_glint(surface, to_eye, {{1.0f, to_eye[1].z}}, glint);
  EXPECT_NEAR(glint[0], 1.0 / (4.0 * kPiRef * variance), 1e-6);
  const double cos4 = std::pow(std::cos(0.5 * angle), 4);
  EXPECT_NEAR(glint[1] / glint[0], std::exp(-0.5) / (cos4 * std::cos(angle)), 2e-5);
}

// ---- In the water's light

// Unpolarised, by Snell's law and Fresnel's two formulas.
double fresnel(double cos_i, double n) {
  const double cos_t = std::sqrt(1.0 - (1.0 - cos_i * cos_i) / (n * n));
  const double s = (cos_i - n * cos_t) / (cos_i + n * cos_t);
  const double p = (n * cos_i - cos_t) / (n * cos_i + cos_t);
  return 0.5 * (s * s + p * p);
}

// The area that facets turn to the eye over the level's, and the cosine that they reflect under: as
// the shader has them (VisibleSlopes.HaveTheMeansOfTheFacetsThatAreSeen).
double area(double cosine, double variance) {
  const double sigma = std::sqrt(0.5 * variance);
  const double near = std::max(1.0 - std::abs(cosine) / (2.4 * sigma), 0.0);
  return std::max(cosine, 0.0) + sigma / std::sqrt(2.0 * kPiRef) * near * near * near;
}
double reflecting(double cosine, double variance) {
  const double raised = 0.5 * (std::sqrt(cosine * cosine + 2.4 * variance) - cosine);
  return cosine + raised * (1.0 - cosine) * (1.0 - cosine);
}

TEST_P(Glint, IsAddedToTheMirroredSkyAndTheWatersOwnLight) {
  constexpr float kVariance = 0.03f;
  PlainSea sea(128.0, kVariance);
  sea.set_sun(sun_at(50.0), {3.0f, 2.0f, 1.0f});
  sea.shading.media.body = {0.01f, 0.05f, 0.08f};
  std::vector<glm::vec3> to_eye;
  for (const double degrees : {0.0, 20.0, 50.0, 65.0, 80.0, 88.0})
    for (const double azimuth : {0.4, 3.4, 3.6})
      to_eye.push_back(direction(degrees * kPiRef / 180, azimuth));
  const double sky = kSoftSkyRange * (128.0 / 255.0) * (128.0 / 255.0);
  // Rays that go down see the same.
  std::get<Water>(sea.shading.materials).optics.mirrored_sea = glm::vec3(static_cast<float>(sky));
  std::vector<glm::vec3> light(to_eye.size());
  water_light(sea.shading, to_eye, light);
  for (std::size_t i = 0; i < to_eye.size(); ++i) {
    const glm::dvec3 eye(to_eye[i]), half = eye + glm::dvec3(sea.shading.light.sun_direction);
    const double mirrors = fresnel(reflecting(eye.z, kVariance), 1.333);
    const double tan2 = (half.x * half.x + half.y * half.y) / (half.z * half.z);
    const double p = std::exp(-tan2 / kVariance) / (kPiRef * kVariance);
    const double glint = fresnel(0.5 * glm::length(half), 1.333) * p * (1.0 + tan2) * (1.0 + tan2) /
                         (4.0 * area(eye.z, kVariance));
    for (int c = 0; c < 3; ++c) {
      const double expected = mirrors * sky + (1.0 - mirrors) * sea.shading.media.body[c] +
                              glint * sea.shading.light.sun_irradiance[c];
      ASSERT_NEAR(light[i][c], expected, 2e-5 * (1.0 + expected)) << i << " " << c;
    }
  }
}

// More facets are seen than the level's area, so that a little less goes up than what the facets
// mirror: of a surface that mirrors all, these parts of E cos(theta_s), where the facets' are 1,
// .994 and .976 of the last.
TEST_P(Glint, LosesLittleOfTheSunsLightToFacetsBehindFacets) {
  const Sphere sphere(0.0);
  struct Case {
    double degrees, wind, part;
  };
  for (const Case& c : {Case{0.0, 10.0, 1.0}, {60.0, 5.0, 0.987}, {60.0, 10.0, 0.956}}) {
    PlainSea sea(0.0, static_cast<float>(cox_munk(c.wind)));
    sea.shading.media.refraction_index = 1e5f;  // mirrors 1 - 4e-5 at the zenith
    sea.set_sun(sun_at(c.degrees), glm::vec3(1.0f));
    std::vector<glm::vec3> light(sphere.directions.size());
    water_light(sea.shading, sphere.directions, light);
    double sum = 0.0;
    for (std::size_t i = 0; i < light.size(); ++i)
      sum += static_cast<double>(light[i].y) * sphere.directions[i].z;
    const double got = sum * sphere.solid_angle, falls = std::cos(c.degrees * kPiRef / 180.0);
    EXPECT_NEAR(got / falls, c.part, 1e-3) << c.degrees << " degrees, wind " << c.wind;
    const double variance = cox_munk(c.wind);
    const auto part = [&](glm::dvec3 v) { return v.z > 0.0 ? v.z / area(v.z, variance) : 0.0; };
    EXPECT_NEAR(got, facet_energy(sun_at(c.degrees), variance, part), 1e-4 * falls);
  }
}

}  // namespace
}  // namespace swell::render
