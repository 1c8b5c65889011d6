#include "sky/fog.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"

namespace swell::sky {
namespace {

constexpr double kMostDepth = 80.0;

double passes(double depth) { return exp(-std::min(depth, kMostDepth)); }

// (1 - e^-x) / x.
double loss_over(double x) {
  if (std::abs(x) < 1e-4) return 1.0 - x * (0.5 - x / 6.0);
  return (1.0 - exp(-std::clamp(x, -kMostDepth, kMostDepth))) / x;
}

// Parts of light that leave a layer.
struct Leaving {
  double up = 0.0, down = 0.0;
};

// The sun's light of irradiance 1 that was scattered once, through level surfaces over and under
// the layer.
Leaving leaving_once(double depth, double forward, double sun_sine) {
  constexpr int kRings = 48, kSectors = 48;
  const double sun_across = std::sqrt(1.0 - sun_sine * sun_sine);
  Leaving sum;
  double phase_sum = 0.0;
  for (int i = 0; i < kRings; ++i) {
    const double z = (i + 0.5) / kRings, across = std::sqrt(1.0 - z * z);
    // Seen from above, down, and from below, up.
    const double seen_down = scattered_once({depth / z, 0.0, -z}, sun_sine);
    const double seen_up = scattered_once({depth / z, depth, z}, sun_sine);
    for (int k = 0; k < kSectors; ++k) {
      const double level = across * sun_across * cos(kPi * (k + 0.5) / kSectors);
      const double up = fog_phase(level - z * sun_sine, forward);
      const double down = fog_phase(level + z * sun_sine, forward);
      sum.up += z * up * seen_down;
      sum.down += z * down * seen_up;
      phase_sum += up + down;
    }
  }
  // Nodes miss some of a narrow peak.
  return {sum.up / phase_sum, sum.down / phase_sum};
}

// What comes through a layer of even light from above, in parts.
double even_passes(double depth) {
  constexpr int kRings = 48;
  double sum = 0.0;
  for (int i = 0; i < kRings; ++i) {
    const double z = (i + 0.5) / kRings;
    sum += 2.0 * z * passes(depth / z);
  }
  return sum / kRings;
}

}  // namespace

double rain_per_m(double rain_mm_h) {
  if (rain_mm_h <= 0.0) return 0.0;
  return -log(kVisibleContrast) / 11600.0 * exp(0.63 * log(rain_mm_h));
}

glm::dvec3 fog_per_m(const FoggyAir& air) {
  glm::dvec3 per_m(rain_per_m(air.rain_mm_h));
  if (air.fog_top_m <= 0.0) return per_m;
  if (air.attenuation_per_m)
    per_m += glm::dvec3(*air.attenuation_per_m);
  else if (air.visibility_m)
    per_m += -log(kVisibleContrast) / *air.visibility_m;
  return per_m;
}

double fog_layer_top_m(const FoggyAir& air) {
  return air.rain_mm_h > 0.0 ? std::max(air.fog_top_m, kRainTop_m) : air.fog_top_m;
}

double fog_above_m(const FoggyAir& air, double height_m) {
  const double z = std::max(height_m, 0.0), top = fog_layer_top_m(air);
  if (air.profile == FogProfile::kSlab) return std::max(top - z, 0.0);
  return top > 0.0 ? top * exp(-std::min(z / top, kMostDepth)) : 0.0;
}

double blinn_phase(double cos_theta, double l) {
  const double base = 1.0 + l * l - 2.0 * l * cos_theta;
  return (1.0 - l) * (1.0 - l) / (base * std::sqrt(base));
}

double fog_phase(double cos_theta, double l) {
  return blinn_phase(cos_theta, l) * (1.0 + l) / (4.0 * kPi * (1.0 - l));
}

double scattered_once(const FogWay& way, double sun_sine) {
  const double before = way.above / sun_sine;
  const double x = way.depth * (1.0 - way.rise / sun_sine);
  // e^-before (1 - e^-x) / x, of which x may be far below 0 where `before` is as large.
  if (x < -1.0) return way.depth * (passes(before) - passes(std::max(before + x, 0.0))) / x;
  return way.depth * passes(before) * loss_over(x);
}

double scattered_by_paper(const FogWay& way, double whole, double sun_sine) {
  return passes(whole / sun_sine) * way.depth * loss_over(way.depth);
}

FogLight light_in_fog(double depth, double forward, double sun_sine, double sun, double sky,
                      double below) {
  FogLight light;
  const double sky_passes = even_passes(depth);
  // An even source of radiance 1 on endless ways lets pi (1 - sky_passes) out on either side.
  const double leaves = 1.0 - sky_passes;
  double once_down = 0.0, often = 0.0;
  if (sun_sine > 0.0) {
    light.sun_passes = passes(depth / sun_sine);
    const Leaving once = leaving_once(depth, forward, sun_sine);
    const double lost = sun_sine * (1.0 - light.sun_passes);
    const double rest = std::max(lost - once.up - once.down, 0.0);
    if (leaves > 1e-9) often = sun * rest / (2.0 * kPi * leaves);
    once_down = sun * once.down / kPi;
  } else {
    light.sun_passes = 0.0;
  }
  light.even = often + 0.5 * (sky + below);
  light.ambient = sky * sky_passes + light.even * leaves + once_down;
  return light;
}

}  // namespace swell::sky
