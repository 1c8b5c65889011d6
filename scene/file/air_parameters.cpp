// Keys of [air].
#include <array>

#include "scene/file/parameter_row.h"
#include "scene/file/parameters.h"

namespace swell::scene {
namespace {

struct FogProfileName {
  using enum FogProfile;
  static constexpr auto words =
      enum_words<FogProfile>({{kSlab, "slab"}, {kExponential, "exponential"}});
  auto& operator()(auto& scene) const { return scene.air.profile; }
};

struct FogScatteringName {
  using enum FogScattering;
  static constexpr auto words = enum_words<FogScattering>({{kExact, "exact"}, {kPaper, "paper"}});
  auto& operator()(auto& scene) const { return scene.air.scattering; }
};

struct FogMethodName {
  using enum FogMethod;
  static constexpr auto words =
      enum_words<FogMethod>({{kPixel, "pixel"}, {kVertex, "vertex"}, {kTable, "table"}});
  auto& operator()(auto& scene) const { return scene.air.method; }
};

#define SWELL_FIELD(PATH) \
  [](auto& object) -> auto& { return object.PATH; }

}  // namespace

std::vector<Parameter<Scene>> air_parameters() {
  return {
      Row<Scene>::optional_number(
          "air.visibility_m", {10, 1e6, "m"}, SWELL_FIELD(air.visibility_m),
          "of fog over the sea, at sea level: 2 % of the contrast are left "
          "at this range (Koschmieder); without it and the next there is none"),
      Row<Scene>::optional_vector(
          "air.attenuation_per_m", {0, 1, "1/m"}, SWELL_FIELD(air.attenuation_per_m),
          "B of fog: linear RGB, after 1/B metres 1/e of the light is left; "
          "excludes `visibility_m`"),
      Row<Scene>::number("air.rain_mm_h", {0, 300, "mm/h"}, SWELL_FIELD(air.rain_mm_h),
                         "rain as the air shows it, besides fog: 2 % of the contrast are left at "
                         "11.6 R^-0.63 km (Atlas); up to 1500 m, where fog then reaches too"),
      Row<Scene>::number("air.fog_top_m", {0, 1e5, "m"}, SWELL_FIELD(air.fog_top_m),
                         "H, over mean sea level; 0: no fog"),
      Row<Scene>::choice("air.profile", FogProfileName{},
                         "how fog thins with height: even up to its top, or 1/e left at its top"),
      Row<Scene>::choice(
          "air.scattering", FogScatteringName{},
          "of the sun's light in fog: each point lit through the fog above it, or as "
          "the ground is (Klassen)"),
      Row<Scene>::choice("air.method", FogMethodName{},
                         "where fog is found: at each pixel, at triangles' vertices and "
                         "interpolated between them, or in a table by the depth alone"),
      Row<Scene>::number("air.forward", {-0.99, 0.99}, SWELL_FIELD(air.forward),
                         "l of Blinn's phase function: 0 scatters evenly, towards 1 straight on"),
      Row<Scene>::number("air.banks", {0, 1}, SWELL_FIELD(air.banks),
                         "how much thicker and thinner the fog is in places, which drift with the "
                         "wind"),
      Row<Scene>::number("air.bank_length_m", {10, 1e5, "m"}, SWELL_FIELD(air.bank_length_m),
                         "about how far such places are apart"),
  };
}

#undef SWELL_FIELD

}  // namespace swell::scene
