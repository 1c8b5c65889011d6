// What a World holds: everything about a scene that does not change from frame to frame.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "lod/relief_bounds.h"
#include "math/earth.h"
#include "ocean/coast.h"
#include "ocean/coast_map.h"
#include "ocean/inland_water.h"
#include "ocean/sea.h"
#include "ocean/water_surface.h"
#include "ocean/whitecaps.h"
#include "render/frame.h"
#include "render/world/cloud_volume.h"
#include "render/world/forest.h"
#include "render/world/ground_cover.h"
#include "render/world/land_rays.h"
#include "render/world/land_shadow.h"
#include "render/world/sun_texture.h"
#include "scene/atmosphere.h"
#include "scene/mesh_file.h"
#include "scene/object_mesh.h"
#include "scene/scene.h"
#include "terrain/height_grid.h"
#include "terrain/shore_map.h"
#include "texture/bump_sequence.h"
#include "texture/packed_map.h"
#include "texture/smooth_image.h"

namespace swell::render {

// Cover and light of the clouds, constants of a world.
struct CloudLight {
  float threshold = 0.0f;  // of the noise over its deviation: what is above is cloud
  float overcast = 0.0f;   // 0 as a rule, 1 where no gap is left
  float loss = 0.15f;      // 1 / (1 + loss depth) of the light that falls on clouds comes through
  float mean_opacity = 0.0f, direct_part = 1.0f;  // means over the sky
  glm::vec3 to_light{0, 0, 1};
  // Linear RGB radiances.
  glm::vec3 base{0.0f};     // of a bright side, where light comes through
  glm::vec3 tops{0.0f};     // of the same, seen from above
  glm::vec3 forward{0.0f};  // times the phase function: light that goes straight on
  glm::vec3 mean_radiance{0.0f};
};

// Radiance in the blurred sky is stored as sqrt(radiance / kSoftSkyRange) * 255; what is brighter
// keeps its hue.
inline constexpr float kSoftSkyRange = 4.0f;
inline constexpr int kSoftSkySize = 128;

// The map of a clear sky, kSkyColumns x (kSkyRows + kAirRows). It is the same on both sides of the
// light's azimuth: column 0 has that azimuth, the last one the opposite, and the root of
// sin(azimuth / 2) grows evenly. Row 0 is the zenith and row kSkyRows - 1 the horizon, where the
// rows are closest; the rows after that go from the horizon to straight down, and hold the air
// before the sea (scene::sky_radiance). render/tile/sky_map-inl.h says where a direction lies.
inline constexpr int kSkyColumns = 128, kSkyRows = 192, kAirRows = 64;

// The clear sky as an eye at a height sees it, exposed.
struct SkyAtHeight {
  double height_m = 0.0;
  texture::SmoothImage map;
  glm::vec3 disc_radiance{0.0f};      // of the light
  glm::vec3 sun_disc_radiance{0.0f};  // of the sun
  // What the eye adapts to over what it does at sea level, at least 1: from high up the sun may
  // still shine, or the sky glow, when it is night below.
  float exposure = 1.0f;
};

// The sky, exposed. The blurred map shows the upper hemisphere: direction d of length 1 lies at
// r = |d.xy| / (1 + d.z) from its middle, and the horizon is the circle of radius size / 2.
struct SkyMaps {
  std::vector<SkyAtHeight> heights;  // what the eye sees behind the clouds, sea level first
  glm::vec2 azimuth{0, 1};           // the light's, of length 1
  std::vector<float> soft_clear;     // blurred at sea level, kSoftSkySize^2 reds, greens, blues
  texture::RgbMap soft;              // the same as a map, for a sky without clouds
  texture::PackedMap2 clouds;        // noise
  float cloud_variance = 0.0f;
  CloudLight cloud_light;
  glm::vec3 ambient{0.0f};  // mean radiance of the upper hemisphere, cosine-weighted
  glm::vec3 horizon{0.0f};  // mean radiance round the horizon
  // The light is the sun, or the moon when the sun is down.
  glm::vec3 to_light{0, 0, 1};
  glm::vec3 irradiance{0.0f};       // under the clouds
  glm::vec3 to_sun{0, 0, 1};        // also when it is down
  glm::vec3 molecules_per_m{0.0f};  // what air alone scatters at sea level
  float exposure = 1.0f;            // that is still to be applied: a gradient's
  float stored_exposure = 1.0f;     // that has been applied
};

// What fog makes of the light over it: scene::FogLight of each channel, exposed.
struct FogLights {
  glm::vec3 even{0.0f}, ambient{0.0f};
  glm::vec3 even_sun{0.0f}, ambient_sun{0.0f};  // the parts that are the sun's
};

// Over the terrain's square, and coarser over the square with its apron.
struct TerrainMaps {
  texture::PackedMap2 slopes, slopes_around;
  texture::RgbaImage albedo, albedo_around;  // sqrt-encoded reflectance
  CoverMaps ground, ground_around;
};

// Over a coast's square, kCoastMapSize points a side.
struct CoastMaps {
  ocean::CoastMap waves;
  std::vector<float> ceded;  // what the sea's own waves give up to the trains, in [0, 1]
};

// What a shore does to the sea before it, of a world with shelter: over the terrain's square with
// its apron, kNearShoreSize points a side: the part of the open sea's waves that land takes away,
// in [0, 1], and the distance to the shore over the surf's reach, [-1, 1].
struct NearShoreMap {
  texture::PackedMap2 map;
  glm::dvec2 min_world{0.0};
  double size_m = 0.0;
  double reach_m = 0.0, reach_s = 0.0;  // waves need so long from there to the shore
  double period_s = 1.0;                // of waves that break
};

// A shape with its levels of detail, finest first. Worlds share those of files.
using ObjectShape = std::shared_ptr<const scene::MeshOfFile>;

// The shapes of a scene's objects.
struct ObjectMeshes {
  std::vector<ObjectShape> of_object;
  std::vector<std::vector<scene::MeshPart>> parts;  // of each object's finest level, at its draught
};

// Textures that lie over the water and the ground. Worlds share them.
struct Textures {
  std::shared_ptr<const texture::PackedMap2> bump = {};  // ripples, slopes of a map with period 1
  std::shared_ptr<const texture::BumpSequence> ripple_sequence = {};  // none: the bump map
  std::shared_ptr<const SunTexture> sun_texture = {};                 // none: glitter by slopes
  // Thresholds of foam, stretched to [-1, 1]: its lace, and how patches of it are torn. The map
  // repeats and may have any size. It is the same in every world.
  std::shared_ptr<const texture::PackedMap2> foam = {};
  // The ground's pattern: thresholds of what covers it, and how its shade varies, both evenly
  // spread over [-1, 1]. The map repeats and may have any size. It is the same in every world.
  std::shared_ptr<const texture::PackedMap2> ground = {};
};

// Parts are shared by worlds whose scenes describe them alike.
struct World::State {
  scene::Scene scene;
  std::shared_ptr<const ocean::Sea> sea = {};
  std::shared_ptr<const ocean::Whitecaps> whitecaps = {};    // of the sea
  std::shared_ptr<const ocean::CoastSea> coast = {};         // none: no wave trains
  std::shared_ptr<const CoastMaps> coast_maps = {};          // there is one if there is a coast
  std::shared_ptr<const scene::Atmosphere> atmosphere = {};  // empty: a painted sky
  std::shared_ptr<const SkyMaps> sky = {};
  FogLights fog_light = {};
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

  // What is on the sea.
  ObjectMeshes objects = {};
  std::vector<std::uint32_t> object_classes = {};  // of labelled pictures
  std::uint32_t tree_class = 0;                    // likewise
  // What disturbs the water: the scene's list and its objects' hulls.
  std::vector<ocean::Disturbance> disturbances = {};

  // more: what disturbs the water besides.
  ocean::WaterParts water(std::span<const ocean::Disturbance> more = {}) const {
    ocean::WakeBounds wakes = ocean::wake_bounds(disturbances, scene.sea.gravity_mps2);
    wakes.include(ocean::wake_bounds(more, scene.sea.gravity_mps2));
    return {sea.get(), scene.area, terrain.get(), coast.get(), wakes, shelter.get(), inland.get()};
  }
  ocean::WaterBounds water_bounds(std::span<const ocean::Disturbance> more = {}) const {
    return ocean::WaterBody(water(more)).bounds();
  }

  // As pictures have it (math/earth.h): infinity if flat. Two triangles cannot bend.
  double earth_radius_m(PartSet without) const {
    const bool bends =
        scene.detail.triangulation != scene::Triangulation::kPlane && !without.has(Part::kEarth);
    return scene.round_earth && bends ? kEarthRadius_m : std::numeric_limits<double>::infinity();
  }
};

// The water's surface at the time of `sea`, a frame of the world's sea.
inline ocean::WaterSurface water_surface(const World::State& world, const ocean::SeaFrame& sea) {
  return {world.water(), sea};
}

// Points a side of the maps that lie over a coast's square.
inline constexpr int kCoastMapSize = 256;

// Points a side of NearShoreMap::map.
inline constexpr int kNearShoreSize = 512;

// Cells a side of what is known of the terrain with its apron: relief and slopes.
inline constexpr int kAroundSize = 512;

// These give the same bits with any workers.
NearShoreMap build_near_shore(const World::State& world, Workers& workers);
// atmosphere: of the sky's turbidity; of a painted sky any.
SkyMaps build_sky_maps(const scene::Sky& sky, const scene::Atmosphere& atmosphere,
                       Workers& workers);
FogLights light_fog(const scene::FoggyAir& air, const SkyMaps& sky);
// Gives objects of files their sizes. like: may be null; a world whose files are not read again.
// Throws SceneError for a file that cannot be drawn.
ObjectMeshes build_object_meshes(scene::Scene& scene, const World::State* like);
// The terrain with its apron, kAroundSize + 1 points a side.
terrain::HeightGrid sample_around(const terrain::HeightGrid& terrain, Workers& workers);
TerrainMaps build_terrain_maps(const terrain::HeightGrid& terrain,
                               const terrain::HeightGrid& around,
                               const terrain::TerrainDescription& description, Workers& workers);

}  // namespace swell::render
