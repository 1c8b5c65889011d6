// What a scene says of its sky and of the fog in its air.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "math/elementary.h"

namespace swell::sky {

enum class SkyModel : std::uint8_t {
  kAtmosphere,  // the light of sun, moon and stars in the earth's air (sky/atmosphere.h)
  kGradient,    // painted from two colours
};

struct Sky {
  double sun_azimuth_rad = 0.0;  // where the sun stands, clockwise from north
  double sun_elevation_rad = radians(30.0);
  // Unit, world, towards the sun: the direction of the two angles (sky::sun_direction).
  glm::vec3 sun_direction{0.0f, 0.8660254f, 0.5f};
  SkyModel model = SkyModel::kAtmosphere;
  double turbidity = 2.2;   // of the atmosphere, [1, 10]
  double moon_phase = 1.0;  // lit part of the moon's disc, [0, 1]
  // Where the moon stands; none: opposite the sun.
  std::optional<double> moon_azimuth_rad, moon_elevation_rad;
  // "2026-06-21T12:00:00Z", when sun and moon stand where they do in the file; empty: as given.
  std::string time_utc;
  double latitude_rad = radians(45.0);  // north positive
  double longitude_rad = 0.0;           // east positive
  // The gradient's (sky::gradient_of). A sky that has one of them is a gradient.
  std::optional<glm::vec3> sun_radiance, zenith, horizon;
  double haze_distance_m = 15000.0;  // at sea level 1/e of the contrast is left at this range
  double haze_height_m = 1200.0;     // at this height there is 1/e of the haze
  double cloud_cover = 0.3;          // [0, 1]
  std::uint64_t cloud_seed = 7;
  std::optional<double> exposure;  // none: that of the sky's light, 1 for a gradient

  bool operator==(const Sky&) const = default;
};

// How fog thins with height.
enum class FogProfile : std::uint8_t {
  kSlab,         // evenly thick up to its top, nothing above
  kExponential,  // 1/e of it is left at its top
};

// How fog scatters the sun's light to the eye.
enum class FogScattering : std::uint8_t {
  kExact,  // once, each point lit through the fog above it
  kPaper,  // each point lit as the ground is (Klassen, 1987)
};

// Where it is found what fog does to light on its way to the eye.
enum class FogMethod : std::uint8_t {
  kPixel,   // on the way to each pixel
  kVertex,  // on the ways to triangles' vertices, interpolated between them
  kTable,   // once for each value that the first bits of the depth buffer have
};

// Fog over the sea, and rain (sky/fog.h). None without one of the first three.
struct FoggyAir {
  std::optional<double> visibility_m;          // where 2 % of the contrast are left at sea level
  std::optional<glm::vec3> attenuation_per_m;  // B, at sea level
  double rain_mm_h = 0.0;                      // that falls, [0, 300]
  double fog_top_m = 100.0;                    // H over mean sea level, [0, 1e5]
  FogProfile profile = FogProfile::kSlab;
  FogScattering scattering = FogScattering::kExact;
  FogMethod method = FogMethod::kPixel;
  double forward = 0.75;  // l of Blinn's phase function, (-1, 1)
  double banks = 0.0;     // how much thicker and thinner fog is in places, [0, 1]
  double bank_length_m = 500.0;

  bool operator==(const FoggyAir&) const = default;
};

}  // namespace swell::sky
