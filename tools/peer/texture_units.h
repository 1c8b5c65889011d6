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
struct SamplerName {
  TextureUnit unit;
  const char* name;
};
inline constexpr auto kSamplerNames = std::to_array<SamplerName>({
    {kSkySoftUnit, "sky_soft"},
    {kSkyMapUnit, "sky_map"},
    {kNoiseUnit, "noise"},
    {kFoamUnit, "foam_pattern"},
    {kCoastSlopesUnit, "coast_slopes"},
    {kCoastSurfUnit, "coast_surf"},
    {kReflectionUnit, "reflection"},
    {kRefractionUnit, "refraction"},
    {kTerrainSlopesUnit, "terrain_slopes"},
    {kDetailUnit, "detail"},
    {kAlbedoUnit, "albedo_map"},
    {kAroundSlopesUnit, "around_slopes"},
    {kAroundAlbedoUnit, "around_albedo"},
});
static_assert(kSamplerNames.size() == kWindowDistanceUnit);

}  // namespace swell::apps
