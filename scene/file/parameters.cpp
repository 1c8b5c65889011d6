#include "scene/file/parameters.h"

#include "ocean/spectrum/sea_scale.h"
#include "scene/file/parameter_row.h"
#include "scene/file/scene_choices.h"

namespace swell::scene {
namespace {

using Kind = ParameterKind;

#define SWELL_FIELD(PATH) \
  [](auto& object) -> auto& { return object.PATH; }

using SceneRow = Row<Scene>;
using Rows = std::vector<Parameter<Scene>>;

Rows camera_rows() {
  return {
      SceneRow::vector("camera.eye_m", {-1e6, 1e6, "m"}, SWELL_FIELD(camera.eye_m),
                       "at t = 0: east, north, up from mean sea level"),
      SceneRow::angle("camera.heading_deg", {-360, 360, "deg"}, SWELL_FIELD(camera.heading_rad),
                      "clockwise from north"),
      SceneRow::angle("camera.pitch_deg", {-89, 89, "deg"}, SWELL_FIELD(camera.pitch_rad),
                      "up positive"),
      SceneRow::angle("camera.roll_deg", {-180, 180, "deg"}, SWELL_FIELD(camera.roll_rad),
                      "positive lowers its right side"),
      SceneRow::angle("camera.fov_y_deg", {1, 170, "deg"}, SWELL_FIELD(camera.fov_y_rad),
                      "from lower to upper edge, of perspective cameras"),
      SceneRow::number("camera.near_m", {0.01, 10, "m"}, SWELL_FIELD(camera.near_m),
                       "what is nearer is cut off"),
      SceneRow::vector("camera.velocity_mps", {-1000, 1000, "m/s"},
                       SWELL_FIELD(camera.velocity_mps), "constant, in world axes"),
      SceneRow::angle("camera.turn_deg_s", {-360, 360, "deg/s"}, SWELL_FIELD(camera.turn_rad_s),
                      "of the heading, not of the velocity"),
      SceneRow::optional_vector("camera.quaternion", {-1, 1}, SWELL_FIELD(camera.quaternion),
                                "[w, x, y, z] of length 1: to the world from the "
                                "optical frame (right, down, "
                                "ahead); excludes angles and turn_deg_s"),
      SceneRow::optional_vector("camera.focal_px", {1, 1e6, "pixels"}, SWELL_FIELD(camera.focal_px),
                                "[fx, fy] for a picture of size_px; excludes fov_y_deg"),
      SceneRow::optional_vector(
          "camera.principal_px", {-1e5, 1e5, "pixels"}, SWELL_FIELD(camera.principal_px),
          "[cx, cy] from the upper left corner (OpenCV's are less by 0.5); the middle if "
          "left out"),
      SceneRow::optional_vector("camera.size_px", {1, 65536, "pixels"}, SWELL_FIELD(camera.size_px),
                                "[width, height] of those"),
      SceneRow::optional_text(
          "camera.mount", SWELL_FIELD(camera.mount),
          "name of the object that carries it, in whose axes directions then are; "
          "excludes eye_m and velocity_mps"),
      SceneRow::vector("camera.mount_offset_m", {-1000, 1000, "m"},
                       SWELL_FIELD(camera.mount_offset_m),
                       "from the object's middle at its waterline: right, ahead, up"),
      SceneRow::number("camera.exposure_s", {0, 10, "s"}, SWELL_FIELD(camera.exposure_s),
                       "how long the shutter stays open, from the picture's time on"),
      SceneRow::integer("camera.shutter_samples", Kind::kInteger, {1, 16},
                        SWELL_FIELD(camera.shutter_samples), "moments of it whose light is added"),
      SceneRow::or_zero(SceneRow::number(
          "camera.f_number", {0.5, 128}, SWELL_FIELD(camera.f_number),
          "exposes physical light, with exposure_s and iso; excludes sky.exposure; 0: the sky "
          "does")),
      SceneRow::choice("camera.projection", ProjectionName{}, "how the picture shows directions"),
      SceneRow::angle("camera.fisheye_fov_deg", {1, 360, "deg"},
                      SWELL_FIELD(camera.fisheye_fov_rad),
                      "cone shown; touches the nearer edges unless focal_px is given"),
      SceneRow::vector("camera.fisheye_k", {-10, 10}, SWELL_FIELD(camera.fisheye_k),
                       "k1 to k4, as OpenCV's"),
      SceneRow::or_zero(SceneRow::number("camera.full_well_e", {100, 1e7, "electrons"},
                                         SWELL_FIELD(camera.noise.full_well_e),
                                         "that a pixel holds; 0: no noise")),
      SceneRow::number("camera.iso", {100, 1e6}, SWELL_FIELD(camera.noise.iso),
                       "divides them; see f_number"),
      SceneRow::number("camera.read_noise_e", {0, 10000, "electrons"},
                       SWELL_FIELD(camera.noise.read_noise_e), "beside the light's own"),
      SceneRow::integer("camera.noise_seed", Kind::kInteger, {0, kMaxSeed},
                        SWELL_FIELD(camera.noise.seed), "another number, other noise"),
  };
}

Rows sea_rows() {
  return {
      SceneRow::optional_integer(
          "sea.douglas", {0, ocean::kMaxDouglas}, SWELL_FIELD(douglas),
          "WMO sea state: sets the wind and, if they are left out, the patch lengths"),
      SceneRow::optional_integer(
          "sea.beaufort", {0, ocean::kMaxBeaufort}, SWELL_FIELD(beaufort),
          "wind force: sets the wind and, if they are left out, the patch lengths"),
      SceneRow::optional_number(
          "sea.hs_m", {0, 30, "m"}, SWELL_FIELD(sea.hs_m),
          "significant height of the wind's waves; that of `tp_s` or of the wind if left out"),
      SceneRow::optional_number("sea.tp_s", {0.5, 40, "s"}, SWELL_FIELD(sea.tp_s),
                                "period of their spectrum's peak; that of a fully developed sea of "
                                "`hs_m` or of the wind if left out"),
      SceneRow::optional_number(
          "sea.fetch_km", {0.01, 10000, "km"}, SWELL_FIELD(sea.fetch_km),
          "water that the wind has blown over (JONSWAP); if left out, enough; excludes `hs_m` and "
          "`tp_s`"),
      SceneRow::optional_number(
          "sea.gamma", {1, 20}, SWELL_FIELD(sea.gamma),
          "enhancement of the spectrum's peak; 3.3 beside `fetch_km`, else 1, "
          "if left out"),
      SceneRow::plain<bool>(
          "sea.spectrum", Kind::kBoolean, SWELL_FIELD(sea.spectrum),
          "the wind's waves; false leaves [[sea.swell]], [[sea.sines]] and [[sea.maps]], "
          "and is the default beside `map_set` or [[sea.maps]]"),
      SceneRow::choice("sea.map_set", MapSetName{},
                       "seven layers of a periodic map that look like this water; sets the wind "
                       "if that is left out"),
      SceneRow::choice("sea.map_heights", MapHeightsName{},
                       "of maps; packed: in 16 bits, which makes queries faster and is off by 2e-5 "
                       "of the highest at most"),
      SceneRow::list("sea.patch_lengths_m", {0.5, 50000, "m"}, 1, ocean::kMaxPatches,
                     SWELL_FIELD(sea.patch_lengths_m),
                     "periods of the patches that hold the wind waves, longest first"),
      SceneRow::integer("sea.resolution", Kind::kPowerOfTwo, {16, 512}, SWELL_FIELD(sea.resolution),
                        "samples along each side of a patch"),
      SceneRow::plain<bool>("sea.tiling", Kind::kBoolean, SWELL_FIELD(sea.tiling),
                            "the longest patch covers the sea by tiles that differ"),
      SceneRow::number("sea.choppiness", {0, 1}, SWELL_FIELD(sea.choppiness),
                       "how much crests are sharper than troughs: 0 for linear waves, 1 for waves "
                       "of second order"),
      SceneRow::number("sea.amplitude_scale", {0, 4}, SWELL_FIELD(sea.amplitude_scale),
                       "multiplies the heights of the wind waves, of swells and maps"),
      SceneRow::integer("sea.seed", Kind::kInteger, {0, kMaxSeed}, SWELL_FIELD(sea.seed),
                        "another number, another sea of the same state"),
      SceneRow::number("sea.gravity_mps2", {0.1, 100, "m/s^2"}, SWELL_FIELD(sea.gravity_mps2),
                       "acceleration of free fall"),
      SceneRow::or_zero(SceneRow::number(
          "sea.loop_s", {1, 100000, "s"}, SWELL_FIELD(sea.loop_s),
          "after this time the sea and all that moves with it repeat exactly; 0: never")),
      SceneRow::number("sea.whitecaps", {0, 10}, SWELL_FIELD(sea.whitecaps),
                       "multiplies the part of the open sea that foam covers"),
      SceneRow::vector("sea.centre_m", {-1e6, 1e6, "m"}, SWELL_FIELD(area.centre_m),
                       "middle of the rectangle that `size_m` limits waves to: east, north"),
      SceneRow::or_zero(SceneRow::vector(
          "sea.size_m", {1, 200000, "m"}, SWELL_FIELD(area.size_m),
          "its size, west to east and south to north; outside, waves are in the shading alone; "
          "0: no limit")),
      SceneRow::choice("sea.earth", EarthName{},
                       "round: what is far sinks by r^2 / 14646 km and behind the horizon"),
      SceneRow::number("wind.speed_mps", {0, 60, "m/s"}, SWELL_FIELD(sea.wind_speed_mps),
                       "at 10 m above the sea"),
      SceneRow::angle("wind.from_deg", {-360, 360, "deg"}, SWELL_FIELD(sea.wind_from_rad),
                      "where the wind comes from, clockwise from north"),
  };
}

Rows water_rows() {
  return {
      SceneRow::number("water.refraction_index", {1, 3}, SWELL_FIELD(water.refraction_index),
                       "of water against air"),
      SceneRow::choice("water.type", WaterTypeName{},
                       "Jerlov's kind of sea water: sets the next two where they are left out"),
      SceneRow::vector("water.body_colour", {0, 1}, SWELL_FIELD(water.body_colour),
                       "linear RGB that deep water sends back, as a part of the light"),
      SceneRow::plain<std::string>(
          "water.texture", Kind::kPath, SWELL_FIELD(water.texture),
          "picture of that colour, in its place: square, a power of two of 32 to 512 pixels a "
          "side, repeated over the sea, relative to the scene file; empty: one colour"),
      SceneRow::number("water.texture_length_m", {0.1, 10000, "m"},
                       SWELL_FIELD(water.texture_length_m), "side of the square that it covers"),
      SceneRow::vector("water.absorption_per_m", {0, 100, "1/m"},
                       SWELL_FIELD(water.absorption_per_m),
                       "linear RGB; after 1/absorption metres 1/e of the light is left"),
      SceneRow::number("water.distortion", {0, 1, "picture heights"}, SWELL_FIELD(water.distortion),
                       "C0: how far a wave's slope moves mirrored and sunken things"),
      SceneRow::choice("water.distortion_factor", DistortionFactorName{},
                       "what that is multiplied by: six times "
                       "the sine of the angle at which the eye meets the water, 0.1 to 1; or "
                       "picture heights below the horizon"),
      SceneRow::number("water.lookup_scale", {0.1, 1}, SWELL_FIELD(water.lookup_scale),
                       "size of the mirror and underwater pictures against the window"),
      SceneRow::number("water.bump_strength", {0, 10}, SWELL_FIELD(water.bump_strength),
                       "of the ripples"),
      SceneRow::number("water.uv_noise_amplitude_m", {0, 10, "m"},
                       SWELL_FIELD(water.uv_noise_amplitude),
                       "how far noise moves the layers' coordinates"),
      SceneRow::number("water.caustics", {0, 1}, SWELL_FIELD(water.caustics),
                       "contrast of the light that waves gather under water"),
      SceneRow::choice("water.back_sides", BackSidesName{},
                       "of waves, where nothing hides them: drawn as the slopes that are seen "
                       "there, or with normals tilted to the eye"),
      SceneRow::number("water.caustic_distortion", {0, 10, "m"},
                       SWELL_FIELD(water.caustic_distortion),
                       "Cc: how far a ripple's slope moves that light"),
      SceneRow::choice("water.glitter", GlitterName{},
                       "how the sun glitters on the water: by the statistics of its slopes, or by "
                       "a picture that the mirrored sun throws on it"),
      SceneRow::number("water.glitter_distortion", {0, 10, "rad"},
                       SWELL_FIELD(water.glitter_distortion),
                       "Cp: how far a slope moves that picture"),
      SceneRow::choice("water.refraction", RefractionName{},
                       "where things under water appear from above: by Snell's law, or by two "
                       "straight lines for apparent over true depth, 0.75 - 0.16 theta up to 0.8 "
                       "rad of the ray in air, 1.26 - 0.8 theta from there"),
      SceneRow::optional_number("water.reflection_weight", {0, 1},
                                SWELL_FIELD(water.reflection_weight),
                                "of mirrored against sunken things, seen from above: one number "
                                "for all angles in place of Fresnel's reflectance"),
      SceneRow::number("water.refraction_weight", {0, 1}, SWELL_FIELD(water.refraction_weight),
                       "of the picture of what lies under the water, against the water's own "
                       "colour or texture"),
      SceneRow::integer("detail.water_triangles", Kind::kInteger, {2, 1e6},
                        SWELL_FIELD(detail.water_triangles), "most triangles of the sea"),
      SceneRow::integer("detail.terrain_triangles", Kind::kInteger, {2, 1e6},
                        SWELL_FIELD(detail.terrain_triangles), "most triangles of the terrain"),
      SceneRow::number("detail.least_water_triangle_px", {0, 64, "pixels"},
                       SWELL_FIELD(detail.least_water_triangle_px),
                       "triangles of the sea that look narrower are not split: 4 for many "
                       "small pictures"),
      SceneRow::choice(
          "detail.triangulation", TriangulationName{},
          "how the sea is cut into triangles: a bintree that follows the view, rings around "
          "the camera, or two flat triangles, with waves in the shading only"),
      SceneRow::number("detail.background_error_px", {0, 8, "pixels"},
                       SWELL_FIELD(detail.background_error_px),
                       "far water may leave out waves that move it by less than this"),
      SceneRow::choice("detail.priority", Priority{}, "which triangles are split first"),
      SceneRow::number("detail.objects", {1, 64}, SWELL_FIELD(detail.objects),
                       "the sea under floating objects counts as this many times nearer"),
      SceneRow::number(
          "detail.back_facing", {1, 16}, SWELL_FIELD(detail.back_facing),
          "surfaces that face away from the camera count as this many times further away"),
      SceneRow::number("detail.normal_spread", {1, 16}, SWELL_FIELD(detail.normal_spread),
                       "smooth areas count as up to this many times further away"),
      SceneRow::number("detail.silhouette", {1, 16}, SWELL_FIELD(detail.silhouette),
                       "what is no part of an outline, a crest or a hill against what lies behind "
                       "it, counts as this many times further away"),
      SceneRow::number("detail.visibility", {0, 4}, SWELL_FIELD(detail.visibility),
                       "how far haze, fog, rain and the night coarsen what they hide: 1 in "
                       "proportion to the contrast that is lost, 0 not at all"),
      SceneRow::or_zero(SceneRow::integer(
          "picture.edge_samples", Kind::kPowerOfTwo, {4, 8}, SWELL_FIELD(picture.edge_samples),
          "samples of a pixel where surfaces meet, for smooth edges; 0: its centre alone")),
      SceneRow::choice("picture.shading", ShadingRateName{},
                       "which pixels are shaded: those whose neighbours differ, or all; the others "
                       "get the light between their neighbours'"),
  };
}

Rows ripple_rows() {
  return {
      SceneRow::choice("ripples.kind", RippleKindName{},
                       "how waves too short for the wave patches are made: two layers of a still "
                       "map that drift across each other, or a looping sequence of bump images"),
      SceneRow::choice("ripples.lighting", RippleLightingName{},
                       "how a sequence is lit: as all slopes, or besides the water's own colour by "
                       "dot(normal, light) times a picture of details"),
      SceneRow::frame_paths(
          "ripples.sequence", SWELL_FIELD(ripples.sequence),
          "pictures of waves, square and of one size, with their number from 0 in place of "
          "`%04d`, relative to the scene file; empty: waves of our own that the wind drives"),
      SceneRow::choice("ripples.pictures", RipplePicturesName{},
                       "what they hold: heights, or normals in red (east), green (north) and blue "
                       "(up)"),
      SceneRow::frame_paths(
          "ripples.detail", SWELL_FIELD(ripples.detail),
          "pictures of the colours that go with them, as many and as large, which with lighting = "
          "\"paper\" tint the water; empty: details in grey, made from the heights"),
      SceneRow::integer("ripples.frames", Kind::kInteger, {2, 256}, SWELL_FIELD(ripples.frames),
                        "pictures of the sequence"),
      SceneRow::number("ripples.loop_s", {0.1, 1000, "s"}, SWELL_FIELD(ripples.loop_s),
                       "after which the sequence begins anew; of a sea that loops, the nearest "
                       "whole part of its loop"),
      SceneRow::number("ripples.length_m", {0.1, 1000, "m"}, SWELL_FIELD(ripples.length_m),
                       "side of the square that a picture of the sequence covers"),
  };
}

Rows coast_rows() {
  return {
      SceneRow::choice("coast.model", CoastModelName{},
                       "waves near the shore of a terrain: those of the open sea; trains that "
                       "refract and shoal; such trains there and the open sea's offshore; or four "
                       "fronts of surf there that follow the water boundary; \"blend\" if left "
                       "out beside terrain.coast_m"),
      SceneRow::integer("coast.trains", Kind::kInteger, {1, 16}, SWELL_FIELD(coast.trains),
                        "number of wave trains"),
      SceneRow::choice("coast.method", CoastMethod{}, "whether the floor bends the trains' crests"),
      SceneRow::integer("coast.seed", Kind::kInteger, {0, kMaxSeed}, SWELL_FIELD(coast.seed),
                        "another number, other trains of the same sea"),
      SceneRow::number("coast.surf_width", {0.1, 5}, SWELL_FIELD(coast.surf_width),
                       "multiplies the width of the band of surf before a shore, with trains or "
                       "without: how deep the water is in which foam begins; the waves stay"),
      SceneRow::or_zero(SceneRow::number(
          "coast.grid_spacing_m", {0.5, 100, "m"}, SWELL_FIELD(coast.grid_spacing_m),
          "most distance between the points that the trains are worked out at, which may make at "
          "most 2048 cells a side of the terrain, and in all 2^24 cells times trains; 0: the "
          "terrain's side / 256")),
  };
}

Rows terrain_rows() {
  return {
      SceneRow::plain<std::string>(
          "terrain.height_image", Kind::kPath, SWELL_FIELD(terrain->height_image),
          "square picture of heights, north on top, relative to the scene file; empty: an island "
          "from noise. EXR and HDR hold metres; of PNG, PNM and TIFF black is low_m and "
          "white is high_m"),
      SceneRow::plain<std::string>(
          "terrain.boundary", Kind::kPath, SWELL_FIELD(terrain->boundary),
          "EXR file of the water boundary, relative to the scene file, as swell-bench terrain "
          "--make-boundary writes it: distance to the shore, depth, height of the bank, part of "
          "surf; empty: made from the heights. Shelter, surf and wakes follow it"),
      SceneRow::choice("terrain.ground", GroundName{},
                       "where the ground's heights are from: what the terrain is made of, or over "
                       "its square the depths and banks of terrain.boundary; trees and covers "
                       "follow the ground"),
      SceneRow::number("terrain.metres_per_pixel", {0.01, 1000, "m"},
                       SWELL_FIELD(terrain->metres_per_pixel), "of the picture"),
      SceneRow::number("terrain.low_m", {-12000, 12000, "m"}, SWELL_FIELD(terrain->low_m),
                       "height of black"),
      SceneRow::number("terrain.high_m", {-12000, 12000, "m"}, SWELL_FIELD(terrain->high_m),
                       "height of white"),
      SceneRow::number("terrain.sea_level_m", {-12000, 12000, "m"},
                       SWELL_FIELD(terrain->sea_level_m),
                       "height in the picture that becomes z = 0"),
      SceneRow::vector("terrain.centre_m", {-1e6, 1e6, "m"}, SWELL_FIELD(terrain->centre_m),
                       "middle of the terrain: east, north"),
      SceneRow::number("terrain.island_radius_m", {5, 20000, "m"},
                       SWELL_FIELD(terrain->island_radius_m),
                       "mean distance from the middle to the beach"),
      SceneRow::number("terrain.island_height_m", {0, 5000, "m"},
                       SWELL_FIELD(terrain->island_height_m), "of the hills above the beach"),
      SceneRow::number("terrain.floor_depth_m", {0.5, 10000, "m"},
                       SWELL_FIELD(terrain->floor_depth_m), "of the sea around"),
      SceneRow::integer("terrain.islands", Kind::kInteger, {1, 200}, SWELL_FIELD(terrain->islands),
                        "how many, of which the first has the measures above and the others are "
                        "0.2 to 0.8 times as large; those that find no room are left out"),
      SceneRow::number("terrain.archipelago_size_m", {100, 100000, "m"},
                       SWELL_FIELD(terrain->archipelago_size_m),
                       "side of the square on which several islands lie"),
      SceneRow::points("terrain.coast_m", {-1e6, 1e6, "m"}, 2, kMaxCoastPoints,
                       SWELL_FIELD(terrain->coast_m),
                       "a beach along this line instead of an island: [east, north] of its points, "
                       "the sea on the left when walking from the first to the last, beyond which "
                       "the line goes straight on; excludes height_image"),
      SceneRow::number("terrain.beach_slope", {0.001, 1}, SWELL_FIELD(terrain->beach_slope),
                       "depth per distance from coast_m, down to floor_depth_m"),
      SceneRow::number("terrain.beach_size_m", {50, 20000, "m"}, SWELL_FIELD(terrain->beach_size_m),
                       "side of the terrain along coast_m"),
      SceneRow::integer("terrain.seed", Kind::kInteger, {0, kMaxSeed}, SWELL_FIELD(terrain->seed),
                        "another number, another island or other dunes"),
      SceneRow::or_zero(SceneRow::number("terrain.checker_m", {0.01, 1000, "m"},
                                         SWELL_FIELD(terrain->checker_m),
                                         "side of white and black squares in place of the "
                                         "ground's colours; 0: none")),
      SceneRow::vector("terrain.sand_colour", {0, 1}, SWELL_FIELD(terrain->ground.sand),
                       "reflectance of dry sand, linear RGB"),
      SceneRow::vector("terrain.grass_colour", {0, 1}, SWELL_FIELD(terrain->ground.grass),
                       "of what grows where it is wet"),
      SceneRow::vector("terrain.dry_colour", {0, 1}, SWELL_FIELD(terrain->ground.dry),
                       "of reeds and dry grass"),
      SceneRow::vector("terrain.soil_colour", {0, 1}, SWELL_FIELD(terrain->ground.soil),
                       "of bare ground above the beach"),
      SceneRow::vector("terrain.rock_colour", {0, 1}, SWELL_FIELD(terrain->ground.rock), "of rock"),
      SceneRow::number("terrain.grass_from_m", {0, 10000, "m"},
                       SWELL_FIELD(terrain->ground.grass_from_m),
                       "height above the sea from which things grow"),
      SceneRow::number("terrain.rock_slope", {0.05, 100}, SWELL_FIELD(terrain->ground.rock_slope),
                       "rise over way from which the ground is rock"),
      SceneRow::choice("terrain.method", TerrainMethodName{},
                       "how the land is drawn: triangles, or a ray for every pixel"),
      SceneRow::choice("terrain.interpolation", InterpolationName{},
                       "of the heights between samples; bicubic: with method = \"rays\""),
      SceneRow::optional_number("terrain.outline_m", {-11000, 9000, "m"},
                                SWELL_FIELD(terrain->outline_m),
                                "land and floor lower than this are not drawn, so that heights cut "
                                "an outline; with method = \"rays\""),
  };
}

}  // namespace

Rows scene_parameters() {
  Rows rows = {
      SceneRow::plain<std::string>("name", Kind::kText, SWELL_FIELD(name),
                                   "of the scene in reports; the file's stem if left out")};
  for (const Rows& part : {camera_rows(), sky_parameters(), air_parameters(), cloud_parameters(),
                           sea_rows(), water_rows(), ripple_rows(), coast_rows(), terrain_rows()})
    rows.insert(rows.end(), part.begin(), part.end());
  return rows;
}

std::vector<Parameter<ocean::SineWave>> sine_parameters() {
  using SineRow = Row<ocean::SineWave>;
  return {
      SineRow::number("amplitude_m", {0, 50, "m"}, SWELL_FIELD(amplitude_m),
                      "half the height from trough to crest"),
      SineRow::number("wavelength_m", {0.05, 10000, "m"}, SWELL_FIELD(wavelength_m),
                      "from crest to crest"),
      SineRow::angle("to_deg", {-360, 360, "deg"}, SWELL_FIELD(to_rad),
                     "where the wave goes to, clockwise from north"),
      SineRow::angle("phase_deg", {-360, 360, "deg"}, SWELL_FIELD(phase_rad),
                     "at the origin at t = 0; 90 is a crest"),
      SineRow::or_zero(SineRow::number("period_s", {0.05, 1000, "s"}, SWELL_FIELD(period_s),
                                       "from crest to crest at one place; 0: that of deep water")),
  };
}

std::vector<Parameter<ocean::MapLayer>> map_parameters() {
  using MapRow = Row<ocean::MapLayer>;
  auto file =
      MapRow::plain<std::string>("file", Kind::kPath, SWELL_FIELD(file),
                                 "of swell-bench waves --make-map, relative to the scene file");
  file.path_of = "map";
  return {
      file,
      MapRow::number_or_vector("length_m", {0.5, 50000, "m"}, SWELL_FIELD(length_m),
                               "after which it repeats itself, along x and along y"),
      MapRow::or_zero(MapRow::number("period_s", {0.1, 100000, "s"}, SWELL_FIELD(period_s),
                                     "after which it repeats itself in time; 0: so that its mean "
                                     "wave is as fast as in deep water")),
      MapRow::number("hs_m", {0, 30, "m"}, SWELL_FIELD(hs_m), "significant height"),
      MapRow::vector("offset_m", {-1e6, 1e6, "m"}, SWELL_FIELD(offset_m),
                     "place of the map that lies at the world's origin, to whole samples"),
      MapRow::number("offset_s", {-1e6, 1e6, "s"}, SWELL_FIELD(offset_s),
                     "time of the map at t = 0"),
  };
}

std::vector<Parameter<ocean::Swell>> swell_parameters() {
  using SwellRow = Row<ocean::Swell>;
  return {
      SwellRow::number("hs_m", {0, 30, "m"}, SWELL_FIELD(hs_m), "significant height"),
      SwellRow::number("tp_s", {1, 40, "s"}, SWELL_FIELD(tp_s), "period of the spectrum's peak"),
      SwellRow::angle("from_deg", {-360, 360, "deg"}, SWELL_FIELD(from_rad),
                      "where it comes from, clockwise from north"),
      SwellRow::number("gamma", {1, 20}, SWELL_FIELD(gamma), "enhancement of the peak"),
      SwellRow::angle("spread_deg", {1, 60, "deg"}, SWELL_FIELD(spread_rad),
                      "standard deviation of the directions"),
  };
}

std::vector<Parameter<Waypoint>> waypoint_parameters() {
  using WaypointRow = Row<Waypoint>;
  return {
      WaypointRow::number("t_s", {-1e6, 1e6, "s"}, SWELL_FIELD(t_s),
                          "when the camera is there; more than that of the table before"),
      WaypointRow::vector("eye_m", {-1e6, 1e6, "m"}, SWELL_FIELD(eye_m),
                          "position: east, north, up from mean sea level"),
      WaypointRow::angle("heading_deg", {-360, 360, "deg"}, SWELL_FIELD(heading_rad),
                         "where the camera looks, clockwise from north; turns the shorter way"),
      WaypointRow::angle("pitch_deg", {-89, 89, "deg"}, SWELL_FIELD(pitch_rad), "up positive"),
      WaypointRow::angle("roll_deg", {-180, 180, "deg"}, SWELL_FIELD(roll_rad),
                         "positive lowers its right side"),
  };
}

#undef SWELL_FIELD

}  // namespace swell::scene
