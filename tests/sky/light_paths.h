// The light of the sky by another way than the library's.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

#include "math/elementary.h"
#include "math/random.h"
#include "sky/air.h"
#include "sky/sky_light.h"

namespace swell::sky {

// A second opinion on the sky: paths from the eye that are scattered one by one, each collision
// lit by the sun. Source: Woodcock et al., Techniques used in the GEM code, 1965 (free paths).
class LightPaths {
 public:
  explicit LightPaths(double turbidity) : air_(make_air(turbidity)) {}

  // Returns a channel's radiance (0: red) under a sun of irradiance 1, from so many paths.
  double radiance(int channel, glm::dvec3 direction, glm::dvec3 to_sun, int paths) {
    channel_ = channel;
    double sum = 0.0;
    for (int n = 0; n < paths; ++n) {
      glm::dvec3 p(0.0, 0.0, kEarthRadius_m + 2.0);
      const End end = fly(p, direction);
      sum += follow(p, direction, 1.0, end, to_sun);
    }
    return sum / paths;
  }

  // Returns the radiance at a height, of the air before the sea or space: thin air scatters few
  // paths, so that each is made to scatter first at a place of its own, as if it had. `lost`
  // becomes the part of light from behind it that the air takes.
  double radiance_at_height(int channel, double height_m, glm::dvec3 direction, glm::dvec3 to_sun,
                            int paths, double& lost) {
    channel_ = channel;
    const glm::dvec3 eye(0.0, 0.0, kEarthRadius_m + height_m);
    const double radius_m = kEarthRadius_m + height_m;
    const double length = distance_to_sea_m(radius_m, direction.z)
                              .value_or(distance_to_air_top_m(radius_m, direction.z));
    double depth = 0.0, sum = 0.0;
    for (int n = 0; n < paths; ++n) {
      const glm::dvec3 p = eye + direction * (length * (n + 0.5) / paths);
      const double density = all_density(height(p)), piece = density * length / paths;
      sum += follow(p, direction, std::exp(-depth - 0.5 * piece) * piece, End::kCollision, to_sun);
      depth += piece;
    }
    lost = 1.0 - std::exp(-depth);
    return sum;
  }

 private:
  static constexpr double kAlbedo = 0.92;

  double uniform() { return random_uniform(11, counter_++); }
  static double height(glm::dvec3 p) { return glm::length(p) - kEarthRadius_m; }
  double rayleigh(double h) const { return air_.rayleigh_per_m[channel_] * std::exp(-h / 8000.0); }
  double mie(double h) const { return air_.mie_per_m[channel_] * std::exp(-h / 1200.0); }
  double ozone(double h) const {
    return air_.ozone_per_m[channel_] * std::max(0.0, 1.0 - std::abs(h - 25000.0) / 15000.0);
  }

  // rayleigh + mie + ozone, by one exponential: most of the paths' time goes here.
  double all_density(double h) const {
    const double e = std::exp(-h / 24000.0), e2 = e * e, e3 = e2 * e, e10 = e2 * e3 * e2 * e3;
    return air_.rayleigh_per_m[channel_] * e3 + air_.mie_per_m[channel_] * e10 * e10 + ozone(h);
  }

  // The part of the sun's light that arrives at p.
  double sunlight(glm::dvec3 p, glm::dvec3 to_sun) const {
    const double b = glm::dot(p, to_sun);
    if (b < 0.0 && glm::dot(p, p) - b * b < kEarthRadius_m * kEarthRadius_m) return 0.0;
    const double top = kEarthRadius_m + kAirTop_m;
    const double length = -b + std::sqrt(b * b + top * top - glm::dot(p, p));
    // Simpson's rule, of steps that grow from p: even ones lost a twentieth of a low sun in haze.
    constexpr int kSteps = 32;
    double depth = 0.0;
    for (int i = 1; i < kSteps; ++i) {
      const double x = static_cast<double>(i) / kSteps;
      depth += (i % 2 == 0 ? 2.0 : 4.0) * x * all_density(height(p + to_sun * (length * x * x)));
    }
    return std::exp(-depth * length * 2.0 / (3.0 * kSteps));
  }

  static double phase(double c, double share_of_mie) {
    const auto lobe = [&](double g) {
      return (1.0 - g * g) / (4.0 * kPi * std::pow(1.0 + g * g - 2.0 * g * c, 1.5));
    };
    const double mie = 0.53 * lobe(0.88) + 0.47 * lobe(0.45);
    const double rayleigh = 3.0 / (16.0 * kPi) * (1.0 + c * c);
    return share_of_mie * mie + (1.0 - share_of_mie) * rayleigh;
  }

  // The cosine of an angle of scattering, of the phase functions above.
  double scattered_cosine(double share_of_mie) {
    if (uniform() < share_of_mie) {
      const double g = uniform() < 0.53 ? 0.88 : 0.45;
      const double x = (1.0 - g * g) / (1.0 - g + 2.0 * g * uniform());
      return (1.0 + g * g - x * x) / (2.0 * g);
    }
    for (;;) {
      const double c = 2.0 * uniform() - 1.0;
      if (2.0 * uniform() < 1.0 + c * c) return c;
    }
  }

  glm::dvec3 scattered(glm::dvec3 d, double share_of_mie) {
    const double c = scattered_cosine(share_of_mie), a = 2.0 * kPi * uniform();
    const glm::dvec3 other = std::abs(d.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    const glm::dvec3 x = glm::normalize(glm::cross(d, other)), y = glm::cross(d, x);
    return c * d + std::sqrt(1.0 - c * c) * (std::cos(a) * x + std::sin(a) * y);
  }

  enum class End { kCollision, kSea, kSpace };

  // To the next collision along `d`.
  End fly(glm::dvec3& p, glm::dvec3 d) {
    const double most = rayleigh(0.0) + mie(0.0) + ozone(25000.0);
    for (;;) {
      p += d * (-std::log(1.0 - uniform()) / most);
      const double h = height(p);
      if (h < 0.0) return End::kSea;
      if (h > kAirTop_m) return End::kSpace;
      if (uniform() * most < all_density(h)) return End::kCollision;
    }
  }

  // The sea is white to 8 % from all sides.
  double leave_sea(glm::dvec3& p, glm::dvec3& d, double& weight, glm::dvec3 to_sun) {
    const glm::dvec3 up = glm::normalize(p);
    p = up * (kEarthRadius_m + 0.1);
    weight *= 0.08;
    const double sum = weight / kPi * std::max(glm::dot(up, to_sun), 0.0) * sunlight(p, to_sun);
    do d = scattered(up, 0.0);
    while (glm::dot(d, up) <= 0.0);
    return sum;
  }

  // The light of a path that has come to p along d and `end`s there.
  double follow(glm::dvec3 p, glm::dvec3 d, double weight, End end, glm::dvec3 to_sun) {
    double sum = 0.0;
    for (int order = 0; order < 20 && end != End::kSpace; ++order) {
      if (end == End::kSea) {
        sum += leave_sea(p, d, weight, to_sun);
      } else {
        const double h = height(p), lit = rayleigh(h) + kAlbedo * mie(h);
        weight *= lit / all_density(h);
        const double share_of_mie = kAlbedo * mie(h) / lit;
        sum += weight * phase(glm::dot(d, to_sun), share_of_mie) * sunlight(p, to_sun);
        d = scattered(d, share_of_mie);
      }
      end = fly(p, d);
    }
    return sum;
  }

  Air air_;
  int channel_ = 1;
  std::uint64_t counter_ = 0;
};

}  // namespace swell::sky
