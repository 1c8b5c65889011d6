#include "scene/water_types.h"

#include <algorithm>
#include <cmath>

#include "math/check.h"
#include "math/elementary.h"
#include "math/enum_table.h"

namespace swell::scene {
namespace {

constexpr glm::dvec3 kWavelength_nm{650.0, 550.0, 450.0};

glm::dvec3 each(glm::dvec3 x, double (*function)(double)) {
  return {function(x.x), function(x.y), function(x.z)};
}

glm::dvec3 scattering_of_pure_water() {
  glm::dvec3 b;
  for (int c = 0; c < 3; ++c) b[c] = 0.005826 * pow(400.0 / kWavelength_nm[c], 4.322);
  return b;
}

// rrs(0-) to Rrs.
glm::dvec3 remote_sensing_reflectance(const InherentOptics& water) {
  const glm::dvec3 bb = backscattering(water);
  const glm::dvec3 u = bb / (water.absorption + bb);
  const glm::dvec3 below = (0.089 + 0.125 * u) * u;
  return 0.52 * below / (1.0 - 1.7 * below);
}

// The parabola with these values at -1, 0 and 1, and where its tangent is level.
double bend(glm::dvec3 values) { return 0.5 * (values.x + values.z) - values.y; }
double rise(glm::dvec3 values) { return 0.5 * (values.z - values.x); }
double parabola(glm::dvec3 values, double x) {
  return (bend(values) * x + rise(values)) * x + values.y;
}
double vertex(glm::dvec3 values) { return -0.5 * rise(values) / bend(values); }

}  // namespace

InherentOptics optics_of(WaterType type) {
  using enum WaterType;
  static constexpr auto kTypes = enum_table<WaterType, InherentOptics>({
      {kNone, {}},
      {kI, {{0.334, 0.062, 0.018}, {0.0009, 0.0017, 0.0038}}},
      {kIA, {{0.334, 0.062, 0.022}, {0.0023, 0.0035, 0.0063}}},
      {kIB, {{0.346, 0.068, 0.039}, {0.118, 0.112, 0.135}}},
      {kII, {{0.353, 0.077, 0.061}, {0.164, 0.187, 0.196}}},
      {kIII, {{0.364, 0.090, 0.107}, {0.271, 0.296, 0.312}}},
      {k1C, {{0.366, 0.100, 0.148}, {0.412, 0.433, 0.437}}},
      {k3C, {{0.375, 0.122, 0.214}, {0.652, 0.696, 0.637}}},
      {k5C, {{0.395, 0.159, 0.302}, {1.24, 1.23, 1.11}}},
      {k7C, {{0.403, 0.195, 0.542}, {1.77, 2.35, 3.30}}},
      {k9C, {{0.456, 0.348, 0.943}, {2.35, 3.12, 4.39}}},
  });
  SWELL_CHECK(type != WaterType::kNone, "no type");
  return kTypes[type];
}

glm::dvec3 backscattering(const InherentOptics& water) {
  const glm::dvec3 pure = scattering_of_pure_water();
  return 0.5 * pure + 0.0183 * glm::max(water.scattering - pure, glm::dvec3(0.0));
}

glm::dvec3 colour_of_deep_water(const InherentOptics& water) {
  return kPi * remote_sensing_reflectance(water);
}

glm::dvec3 diffuse_attenuation(const InherentOptics& water, double sun_zenith_rad) {
  const glm::dvec3 a = water.absorption;
  const double sun = 1.0 + 0.005 * sun_zenith_rad * (180.0 / kPi);
  return sun * a + 4.18 * (1.0 - 0.52 * each(-10.8 * a, exp)) * backscattering(water);
}

glm::dvec3 picture_attenuation(const InherentOptics& water) {
  return water.absorption + backscattering(water) + 0.2 * water.scattering;
}

double secchi_depth_m(const InherentOptics& water) {
  const glm::dvec3 attenuation = diffuse_attenuation(water, kPi / 6.0);
  const glm::dvec3 reflectance = remote_sensing_reflectance(water);
  // The clearest wavelength lies between the three: a parabola through their logarithms.
  const glm::dvec3 logs = each(attenuation, log);
  const double least = std::clamp(vertex(logs), -1.0, 1.0);
  return log(std::abs(0.14 - parabola(reflectance, least)) / 0.013) /
         (2.5 * exp(parabola(logs, least)));
}

}  // namespace swell::scene
