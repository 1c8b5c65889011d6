// Named kinds of sea water, from the clearest ocean to turbid coasts, and what follows from how
// much light they absorb and scatter. Red, green and blue stand for 650, 550 and 450 nm.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <string_view>

#include "math/enum_table.h"

namespace swell::scene {

// Jerlov's types: I to III of the ocean, 1C to 9C of the coast. kNone: numbers of one's own.
enum class WaterType : std::uint8_t { kNone, kI, kIA, kIB, kII, kIII, k1C, k3C, k5C, k7C, k9C };

inline constexpr auto kWaterTypeNames = enum_words<WaterType>({{WaterType::kNone, "none"},
                                                               {WaterType::kI, "I"},
                                                               {WaterType::kIA, "IA"},
                                                               {WaterType::kIB, "IB"},
                                                               {WaterType::kII, "II"},
                                                               {WaterType::kIII, "III"},
                                                               {WaterType::k1C, "1C"},
                                                               {WaterType::k3C, "3C"},
                                                               {WaterType::k5C, "5C"},
                                                               {WaterType::k7C, "7C"},
                                                               {WaterType::k9C, "9C"}});

// What a metre of water does to light [1/m].
struct InherentOptics {
  glm::dvec3 absorption{0.0};
  glm::dvec3 scattering{0.0};  // in all directions, pure water's among it
};

// Returns the optics of a type but kNone. Sources: Williamson, Hollins, Measured IOPs of Jerlov
// water types, Applied Optics 61, 2022 (IB to 5C, interpolated); Solonenko, Mobley, Inherent
// optical properties of Jerlov water types, Applied Optics 54, 2015 (the others).
InherentOptics optics_of(WaterType type);

// The part of the scattering that goes back [1/m]: half of pure water's, 0.0183 of the particles'.
// Sources: Haltrin, 1999 (pure water); Petzold, Volume scattering functions for selected ocean
// waters, 1972 (particles).
glm::dvec3 backscattering(const InherentOptics& water);

// Light that deep water sends back as a part of what falls on it, pi times the remote-sensing
// reflectance. Source: Lee, Carder, Arnone, Deriving inherent optical properties from water color,
// Applied Optics 41, 2002.
glm::dvec3 colour_of_deep_water(const InherentOptics& water);

// How fast daylight fades with depth [1/m] under a sun at that angle from the zenith.
// Source: Lee et al., Diffuse attenuation coefficient of downwelling irradiance, 2005.
glm::dvec3 diffuse_attenuation(const InherentOptics& water, double sun_zenith_rad);

// How fast a picture seen through water fades [1/m]: what is absorbed or thrown back, and a fifth
// of what is scattered, most of which hardly leaves its way.
glm::dvec3 picture_attenuation(const InherentOptics& water);

// The depth at which a white disc is lost to the eye [m], sun at 30 degrees from the zenith.
// Source: Lee et al., Secchi disk depth: A new theory and mechanistic model, 2015.
double secchi_depth_m(const InherentOptics& water);

}  // namespace swell::scene
