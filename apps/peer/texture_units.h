// Which texture unit each of the peer's maps is bound to, for all programs alike.
#pragma once

#include <array>

namespace swell::apps {

enum TextureUnit : int {
  kSkySoftUnit,
  kSkyMapUnit,
  kNoiseUnit,
  kFoamUnit,
  kCoastSlopesUnit,
  kCoastSurfUnit,
  kReflectionUnit,
  kRefractionUnit,
  kTerrainSlopesUnit,
  kDetailUnit,
  kAlbedoUnit,
  kAroundSlopesUnit,
  kAroundAlbedoUnit,
  kWindowDistanceUnit,
  kReflectionDistanceUnit,
  kRefractionDistanceUnit,
  kFirstLayerUnit,  // and those after it: the water's layers
};

// The shaders' names of the units before the distances', which are "distance_map" of their view.
inline constexpr std::array<const char*, kWindowDistanceUnit> kSamplerNames = {
    "sky_soft",   "sky_map",       "noise",        "foam_pattern",   "coast_slopes",
    "coast_surf", "reflection",    "refraction",   "terrain_slopes", "detail",
    "albedo_map", "around_slopes", "around_albedo"};

}  // namespace swell::apps
