// A scene: everything that decides a picture except its size and its time. Loaded from TOML
// (docs/look_up/scene.md lists every key with unit, default and range); angles are degrees in files
// and radians here.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ocean/inland/river.h"
#include "ocean/open_sea/sea.h"
#include "ocean/sea_area.h"
#include "ocean/wakes/disturbance.h"
#include "scene/camera.h"
#include "scene/clouds.h"
#include "scene/objects.h"
#include "scene/scene_error.h"
#include "scene/water_types.h"
#include "sky/sky.h"
#include "terrain/terrain.h"
#include "terrain/trees.h"

namespace swell::scene {

using sky::FoggyAir;
using sky::FogMethod;
using sky::FogProfile;
using sky::FogScattering;
using sky::Sky;
using sky::SkyModel;

// What the displacement of lookups is multiplied by, so that far, small things hold together.
enum class DistortionFactor : std::uint8_t {
  kBounded,  // grows as the elevation of the eye over the water up to 10 degrees
  kPaper,    // the place in the picture, from the horizon down, in picture heights
};

// How the sun glitters on the water.
enum class Glitter : std::uint8_t {
  kSlopes,      // by the statistics of the slopes that a pixel does not show
  kProjective,  // by a picture that the mirrored sun throws on the water
};

// Where what lies under water appears to an eye above it.
enum class RefractionModel : std::uint8_t {
  kExact,  // by Snell's law
  kPaper,  // by two straight lines (render/view/refracted_image.h)
};

struct WaterOptics {
  double refraction_index = 1.333;
  WaterType type = WaterType::kNone;
  // A type's, where a file leaves them out.
  glm::vec3 body_colour{0.004f, 0.030f, 0.045f};  // linear radiance factor of deep water
  std::string texture;             // a picture of it that repeats itself; empty: one colour
  double texture_length_m = 20.0;  // of the sea that the picture covers, [0.1, 10000]
  glm::vec3 absorption_per_m{0.35f, 0.07f, 0.05f};  // Beer-Lambert, linear RGB
  double distortion = 0.06;  // C0 of the lookups' displacement, in picture heights
  DistortionFactor distortion_factor = DistortionFactor::kBounded;
  double lookup_scale = 0.5;         // size of reflection and refraction images against the window
  double bump_strength = 1.0;        // of the two scrolling layers
  double uv_noise_amplitude = 0.35;  // of the Perlin perturbation of their coordinates, in metres
  double caustics = 1.0;             // contrast of the sun's light under water, [0, 1]
  // Back sides of waves that nothing hides: drawn as those of the slopes that are seen there, or
  // with normals tilted to the eye.
  bool tilted_backs = false;
  double caustic_distortion = 0.0;  // Cc: by how much ripples move it, in metres
  Glitter glitter = Glitter::kSlopes;
  double glitter_distortion = 2.0;  // Cp of the projected glitter, in radians
  RefractionModel refraction = RefractionModel::kExact;
  std::optional<double> reflection_weight;  // of what it mirrors, [0, 1]; none: Fresnel's
  double refraction_weight = 1.0;           // of what lies under it against its own light, [0, 1]
};

// How waves too short for the wave patches are made.
enum class RippleKind : std::uint8_t {
  kLayers,    // two layers of a still map that drift across each other
  kSequence,  // a looping sequence of bump images
};

// How those of a sequence are lit.
enum class RippleLighting : std::uint8_t {
  kOptics,  // as all slopes
  kPaper,   // and the water's own colour by dot(normal, light) times a picture of details
};

// What the files of a sequence hold.
enum class RipplePictures : std::uint8_t { kHeights, kNormals };

struct Ripples {
  RippleKind kind = RippleKind::kLayers;
  RippleLighting lighting = RippleLighting::kOptics;
  std::string sequence;  // files, as "waves_%04d.png"; empty: waves of our own
  RipplePictures pictures = RipplePictures::kHeights;
  std::string detail;     // files of colours beside them; empty: made from the heights
  int frames = 128;       // of the sequence, [2, 256]
  double loop_s = 4.0;    // after which it begins anew, [0.1, 1000]
  double length_m = 6.0;  // of the sea that a frame covers, [0.1, 1000]

  bool operator==(const Ripples&) const = default;
};

// How waves near a coast know the floor and the shore. Needs a terrain.
enum class CoastModel : std::uint8_t {
  kNone,    // the open sea's waves, lower over shallow water
  kTrains,  // wave trains that refract and shoal, alone
  kBlend,   // wave trains near the coast, the open sea's waves offshore
  kFronts,  // four fronts of surf near the coast, the open sea's waves offshore
};

// Whether there are wave trains.
constexpr bool has_trains(CoastModel model) {
  return model == CoastModel::kTrains || model == CoastModel::kBlend;
}

struct Coast {
  CoastModel model = CoastModel::kNone;  // parse_scene: kBlend for a terrain from a coast line
  int trains = 5;                        // [1, 16]
  bool eikonal = true;                   // phases bent by the floor; false: straight ones
  double grid_spacing_m = 0.0;           // [0.5, 100]; 0: the terrain's side / 256
  std::uint64_t seed = 1;
  double surf_width = 1.0;  // [0.1, 5]: of the band of surf, over what the waves' height gives

  bool operator==(const Coast&) const = default;
};

// How the sea is cut into triangles.
enum class Triangulation : std::uint8_t {
  kRoam,    // a bintree that follows the view (lod/roam.h)
  kRadial,  // rings around the eye (lod/radial_grid.h)
  kPlane,   // two triangles, flat: waves in the shading only (lod/plane.h)
};

// How the land is found in a picture.
enum class TerrainMethod : std::uint8_t {
  kRoam,  // triangles that follow the view, as the sea's
  kRays,  // a ray a pixel over the map of heights (render/rays/terrain_rays.h)
};

struct Detail {
  TerrainMethod terrain_method = TerrainMethod::kRoam;
  Triangulation triangulation = Triangulation::kRoam;  // of the sea
  int water_triangles = 30000;
  int terrain_triangles = 30000;
  double least_water_triangle_px = 0.0;  // narrower ones are not split
  bool inverse_distance_priority = false;
  double objects = 8.0;  // floating things' places count as this many times nearer, [1, 64]
  // Parts that count as this many times further away, [1, 16]; 1: as they are (lod/request.h).
  double back_facing = 1.0, normal_spread = 1.0, silhouette = 1.0;
  double visibility = 0.0;           // poor visibility counts this much, [0, 4]
  double background_error_px = 0.0;  // far water may be so far from where it should be drawn

  bool normals_count() const {
    return back_facing > 1.0 || normal_spread > 1.0 || silhouette > 1.0;
  }
};

// Which pixels are shaded.
enum class ShadingRate : std::uint8_t {
  kAdaptive,  // those whose neighbours differ; the others get the light between these
  kFull,      // all of them
};

struct Picture {
  ShadingRate shading = ShadingRate::kAdaptive;
  int edge_samples = 0;  // a pixel where surfaces meet: 0, 4 or 8
};

using SeaArea = ocean::SeaArea;
using TerrainDescription = terrain::TerrainDescription;

struct KeyPlaces;

// May be made in code: render::World and scene::Water throw SceneError unless every value is in
// the range that docs/look_up/scene.md states for its key (check_scene.h).
struct Scene {
  std::string name;  // the file's stem
  Camera camera;
  Sky sky;
  FoggyAir air;
  CloudField clouds;
  ocean::SeaDescription sea;
  // The sea state that the file asked for, at most one of them (ocean/spectrum/sea_scale.h). The
  // wind, and the patch lengths if the file has none, follow from it and stand in `sea`.
  std::optional<int> douglas, beaufort;
  SeaArea area;
  bool round_earth = true;  // false: flat, with the horizon at infinity
  WaterOptics water;
  Ripples ripples;
  Coast coast;
  Detail detail;
  Picture picture;
  std::optional<TerrainDescription> terrain;
  std::vector<terrain::TreeStand> trees;         // at most 16; need a terrain
  std::vector<FloatingObject> objects;           // at most 2000
  std::vector<ocean::Disturbance> disturbances;  // at most 256, besides the wakes of objects
  std::vector<ocean::River> rivers;              // at most 64; they and lakes need a terrain
  std::vector<ocean::Lake> lakes;                // at most 64
  // Where the file has its keys, for messages; null: it was made in code.
  std::shared_ptr<const KeyPlaces> places;
};

// The scene's disturbances, then the hulls of its objects that make wakes.
std::vector<ocean::Disturbance> all_disturbances(const Scene& scene);

// Reads and checks a scene file. Relative image paths are relative to the scene file's folder.
// Throws SceneError for: missing file, TOML syntax, unknown key (with those of its table),
// wrong type, NaN, value out of range, unreadable image.
Scene load_scene(const std::filesystem::path& path);

// Parses and checks a scene likewise, from text; `file_name` is used in messages and to resolve
// relative paths.
Scene parse_scene(std::string_view text, const std::filesystem::path& file_name);

// The scene as TOML with every key written out. A scene that was parsed comes back with the same
// bits. Paths are written as the scene has them (parse_scene makes them absolute).
std::string dump_scene(const Scene& scene);

}  // namespace swell::scene
