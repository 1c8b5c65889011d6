// What a World holds: everything about a scene that does not change from frame to frame. Who reads
// a part includes its header.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "math/earth.h"
#include "ocean/wakes/disturbance.h"
#include "render/frame/parts.h"
#include "render/world/kept_parts.h"
#include "render/world/object_meshes.h"
#include "render/world/world.h"
#include "scene/scene.h"

namespace swell {
namespace lod {
class ReliefBounds;
}
namespace ocean {
class InlandWater;
class Sea;
class WaterSurface;
struct CoastSea;
struct SeaFrame;
struct Shelter;
struct WaterBounds;
struct WaterParts;
struct Whitecaps;
}  // namespace ocean
namespace sky {
struct Atmosphere;
}
namespace terrain {
class ShoreMap;
struct HeightGrid;
}  // namespace terrain
namespace texture {
struct BumpSequence;
struct PackedMap2;
}  // namespace texture
}  // namespace swell

namespace swell::render {

struct CloudVolume;
struct CoastMaps;
struct FogLights;
struct Forest;
struct LandRays;
struct LandShadow;
struct NearShoreMap;
class PartCache;
struct SkyMaps;
struct SunTexture;
struct TerrainMaps;
struct WaterTexture;

// Textures that lie over the water and the ground. Worlds share them.
struct Textures {
  std::shared_ptr<const texture::PackedMap2> bump = {};  // ripples, slopes of a map with period 1
  std::shared_ptr<const texture::BumpSequence> ripple_sequence = {};  // none: the bump map
  std::shared_ptr<const SunTexture> sun_texture = {};                 // none: glitter by slopes
  std::shared_ptr<const WaterTexture> water = {};                     // none: one colour
  // Thresholds of foam, stretched to [-1, 1]: its lace, and how patches of it are torn. The map
  // repeats and may have any size. It is the same in every world.
  std::shared_ptr<const texture::PackedMap2> foam = {};
  // The ground's pattern: thresholds of what covers it, and how its shade varies, both evenly
  // spread over [-1, 1]. The map repeats and may have any size. It is the same in every world.
  std::shared_ptr<const texture::PackedMap2> ground = {};
};

// Parts are shared by worlds whose scenes describe them alike (render/world/part_maker.h).
struct WorldState {
  scene::Scene scene;
  std::shared_ptr<const ocean::Sea> sea = {};
  std::shared_ptr<const ocean::Whitecaps> whitecaps = {};  // of the sea
  std::shared_ptr<const ocean::CoastSea> coast = {};       // none: no wave trains
  std::shared_ptr<const CoastMaps> coast_maps = {};        // there is one if there is a coast
  std::shared_ptr<const sky::Atmosphere> atmosphere = {};  // empty: a painted sky
  std::shared_ptr<const SkyMaps> sky = {};
  std::shared_ptr<const FogLights> fog_light = {};
  std::shared_ptr<const CloudVolume> cloud_volume = {};     // none: no volumetric clouds
  std::shared_ptr<const terrain::HeightGrid> terrain = {};  // none: deep water everywhere
  std::shared_ptr<const ocean::InlandWater> inland = {};    // none: no rivers, no lakes
  std::shared_ptr<const TerrainMaps> terrain_maps = {};
  std::shared_ptr<const LandShadow> land_shadow = {};   // none: no land, or no sun
  std::shared_ptr<const LandRays> land_rays = {};       // none: the land is drawn as triangles
  std::shared_ptr<const Forest> forest = {};            // none: no trees
  std::shared_ptr<const terrain::ShoreMap> shore = {};  // of the terrain
  std::shared_ptr<const ocean::Shelter> shelter = {};   // none: the sea is open everywhere
  std::shared_ptr<const NearShoreMap> near_shore = {};  // there is one if there is shelter
  std::shared_ptr<const lod::ReliefBounds> relief_bounds = {};  // of the terrain with its apron
  Textures textures = {};
  KeptParts parts = {};                   // all of these, as other worlds look for them
  std::shared_ptr<PartCache> cache = {};  // that keeps them

  // What is on the sea.
  ObjectMeshes objects = {};
  std::vector<std::uint32_t> object_classes = {};  // of labelled pictures
  std::uint32_t tree_class = 0;                    // likewise
  // What disturbs the water: the scene's list and its objects' hulls.
  std::vector<ocean::Disturbance> disturbances = {};

  // more: what disturbs the water besides.
  ocean::WaterParts water(std::span<const ocean::Disturbance> more = {}) const;
  ocean::WaterBounds water_bounds(std::span<const ocean::Disturbance> more = {}) const;

  // As pictures have it (math/earth.h): infinity if flat. Two triangles cannot bend.
  double earth_radius_m(PartSet without) const {
    const bool bends =
        scene.detail.triangulation != scene::Triangulation::kPlane && !without.has(Part::kEarth);
    return scene.round_earth && bends ? kEffectiveEarthRadius_m
                                      : std::numeric_limits<double>::infinity();
  }
};

// The water's surface at the time of `sea`, a frame of the world's sea.
ocean::WaterSurface water_surface(const WorldState& world, const ocean::SeaFrame& sea);

}  // namespace swell::render
