#include <gtest/gtest.h>

#include <clocale>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "constants.h"
#include "scene/scene_text.h"
#include "scratch_folder.h"

namespace swell::scene {
namespace {

namespace fs = std::filesystem;

std::string load_error(const fs::path& path) {
  try {
    load_scene(path);
  } catch (const SceneError& error) {
    return error.what();
  }
  return {};
}

constexpr const char* kEveryKey = R"(
name = "every key"
[camera]
eye_m = [1.5, -2, 3.25]
heading_deg = 90
pitch_deg = -12.5
roll_deg = 7
fov_y_deg = 60
near_m = 0.5
velocity_mps = [4, 5, 6]
turn_deg_s = 3
projection = "fisheye"
fisheye_fov_deg = 190
fisheye_k = [0.01, -0.02, 0.003, 0]
full_well_e = 12000
iso = 400
read_noise_e = 2.5
noise_seed = 77
[sky]
sun_azimuth_deg = 90.0
sun_elevation_deg = 60.0
sun_radiance = [3, 2.5, 2]
zenith = [0.1, 0.2, 0.3]
horizon = [0.4, 0.5, 0.6]
haze_distance_m = 9000
haze_height_m = 800
cloud_cover = 0.75
cloud_seed = 123456789012345
exposure = 1.25
[sea]
spectrum = false
patch_lengths_m = [300, 40.5]
resolution = 256
amplitude_scale = 1.5
seed = 42
gravity_mps2 = 3.7
loop_s = 25
whitecaps = 0.5
choppiness = 0.75
map_set = "lake"
map_heights = "packed"
centre_m = [10, 20]
size_m = [500, 600]
earth = "flat"
[[sea.sines]]
amplitude_m = 0.5
wavelength_m = 30
to_deg = 45
phase_deg = 90
period_s = 4
[[sea.sines]]
wavelength_m = 12
[wind]
speed_mps = 7.5
from_deg = 270
[water]
refraction_index = 1.34
body_colour = [0.01, 0.02, 0.03]
absorption_per_m = [0.5, 0.25, 0.125]
distortion = 0.1
lookup_scale = 1
bump_strength = 2
uv_noise_amplitude_m = 0.5
caustics = 0.75
back_sides = "tilted"
distortion_factor = "paper"
caustic_distortion = 0.25
glitter = "projective"
refraction = "paper"
reflection_weight = 0.5
refraction_weight = 0.25
texture_length_m = 15
glitter_distortion = 1.5
[ripples]
kind = "sequence"
lighting = "paper"
pictures = "normals"
frames = 32
loop_s = 2.5
length_m = 3
[coast]
model = "trains"
trains = 7
method = "straight"
grid_spacing_m = 2.5
seed = 12
[detail]
water_triangles = 1500
terrain_triangles = 2000
priority = "inverse_distance"
[terrain]
metres_per_pixel = 3
low_m = -5
high_m = 55
sea_level_m = 1
centre_m = [7, 8]
island_radius_m = 90
island_height_m = 20
floor_depth_m = 11
coast_m = [[-1, 2.5], [3, 4], [30, -4]]
beach_slope = 0.05
beach_size_m = 700
seed = 99
checker_m = 0.25
)";

TEST(SceneFile, EveryKeyReachesItsField) {
  const Scene scene = parse_scene(kEveryKey, "test.toml");
  EXPECT_EQ(scene.name, "every key");
  EXPECT_EQ(scene.camera.eye_m, glm::dvec3(1.5, -2.0, 3.25));
  EXPECT_EQ(scene.camera.heading_rad, 90 * kDegree);
  EXPECT_EQ(scene.camera.pitch_rad, -12.5 * kDegree);
  EXPECT_EQ(scene.camera.roll_rad, 7 * kDegree);
  EXPECT_EQ(scene.camera.fov_y_rad, 60 * kDegree);
  EXPECT_EQ(scene.camera.near_m, 0.5);
  EXPECT_EQ(scene.camera.velocity_mps, glm::dvec3(4, 5, 6));
  EXPECT_EQ(scene.camera.turn_rad_s, 3 * kDegree);
  EXPECT_EQ(scene.camera.projection, ProjectionKind::kFisheye);
  EXPECT_EQ(scene.camera.fisheye_fov_rad, 190 * kDegree);
  EXPECT_EQ(scene.camera.fisheye_k, glm::dvec4(0.01, -0.02, 0.003, 0.0));
  EXPECT_EQ(scene.camera.noise,
            (SensorNoise{.full_well_e = 12000.0, .iso = 400.0, .read_noise_e = 2.5, .seed = 77}));
  EXPECT_EQ(scene.sky.sun_azimuth_rad, 90 * kDegree);
  EXPECT_EQ(scene.sky.sun_elevation_rad, 60 * kDegree);
  EXPECT_EQ(scene.sky.sun_radiance, glm::vec3(3.0f, 2.5f, 2.0f));
  EXPECT_EQ(scene.sky.zenith, glm::vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(scene.sky.horizon, glm::vec3(0.4f, 0.5f, 0.6f));
  EXPECT_EQ(scene.sky.haze_distance_m, 9000.0);
  EXPECT_EQ(scene.sky.haze_height_m, 800.0);
  EXPECT_EQ(scene.sky.cloud_cover, 0.75);
  EXPECT_EQ(scene.sky.cloud_seed, 123456789012345u);
  EXPECT_EQ(scene.sky.exposure, 1.25);
  EXPECT_FALSE(scene.sea.spectrum);
  EXPECT_EQ(scene.sea.patch_lengths_m, (std::vector<double>{300.0, 40.5}));
  EXPECT_EQ(scene.sea.resolution, 256);
  EXPECT_EQ(scene.sea.amplitude_scale, 1.5);
  EXPECT_EQ(scene.sea.seed, 42u);
  EXPECT_EQ(scene.sea.gravity_mps2, 3.7);
  EXPECT_EQ(scene.sea.loop_s, 25.0);
  EXPECT_EQ(scene.sea.whitecaps, 0.5);
  EXPECT_EQ(scene.sea.choppiness, 0.75);
  EXPECT_EQ(scene.area.centre_m, glm::dvec2(10, 20));
  EXPECT_EQ(scene.area.size_m, glm::dvec2(500, 600));
  EXPECT_FALSE(scene.round_earth);
  ASSERT_EQ(scene.sea.sines.size(), 2u);
  EXPECT_EQ(scene.sea.sines[0].amplitude_m, 0.5);
  EXPECT_EQ(scene.sea.sines[0].wavelength_m, 30.0);
  EXPECT_EQ(scene.sea.sines[0].to_rad, 45 * kDegree);
  EXPECT_EQ(scene.sea.sines[0].phase_rad, 90 * kDegree);
  EXPECT_EQ(scene.sea.sines[0].period_s, 4.0);
  EXPECT_EQ(scene.sea.sines[1].wavelength_m, 12.0);
  EXPECT_EQ(scene.sea.sines[1].period_s, 0.0);
  EXPECT_EQ(scene.sea.wind_speed_mps, 7.5);
  EXPECT_EQ(scene.sea.wind_from_rad, 270 * kDegree);
  EXPECT_EQ(scene.water.refraction_index, 1.34);
  EXPECT_EQ(scene.water.body_colour, glm::vec3(0.01f, 0.02f, 0.03f));
  EXPECT_EQ(scene.water.absorption_per_m, glm::vec3(0.5f, 0.25f, 0.125f));
  EXPECT_EQ(scene.water.distortion, 0.1);
  EXPECT_EQ(scene.water.lookup_scale, 1.0);
  EXPECT_EQ(scene.water.bump_strength, 2.0);
  EXPECT_EQ(scene.water.uv_noise_amplitude, 0.5);
  EXPECT_EQ(scene.water.caustics, 0.75);
  EXPECT_TRUE(scene.water.tilted_backs);
  EXPECT_EQ(scene.sea.map_set, ocean::MapSet::kLake);
  EXPECT_EQ(scene.sea.map_heights, ocean::MapHeights::kPacked);
  EXPECT_EQ(scene.water.distortion_factor, DistortionFactor::kPaper);
  EXPECT_EQ(scene.water.caustic_distortion, 0.25);
  EXPECT_EQ(scene.water.glitter, Glitter::kProjective);
  EXPECT_EQ(scene.water.glitter_distortion, 1.5);
  EXPECT_EQ(scene.ripples.kind, RippleKind::kSequence);
  EXPECT_EQ(scene.ripples.lighting, RippleLighting::kPaper);
  EXPECT_EQ(scene.ripples.pictures, RipplePictures::kNormals);
  EXPECT_EQ(scene.ripples.frames, 32);
  EXPECT_EQ(scene.ripples.loop_s, 2.5);
  EXPECT_EQ(scene.ripples.length_m, 3.0);
  EXPECT_EQ(scene.water.refraction, RefractionModel::kPaper);
  EXPECT_EQ(scene.water.reflection_weight, 0.5);
  EXPECT_EQ(scene.water.refraction_weight, 0.25);
  EXPECT_EQ(scene.water.texture_length_m, 15.0);
  EXPECT_EQ(scene.coast.model, CoastModel::kTrains);
  EXPECT_EQ(scene.coast.trains, 7);
  EXPECT_FALSE(scene.coast.eikonal);
  EXPECT_EQ(scene.coast.grid_spacing_m, 2.5);
  EXPECT_EQ(scene.coast.seed, 12u);
  EXPECT_EQ(scene.detail.water_triangles, 1500);
  EXPECT_EQ(scene.detail.terrain_triangles, 2000);
  EXPECT_TRUE(scene.detail.inverse_distance_priority);
  ASSERT_TRUE(scene.terrain.has_value());
  EXPECT_TRUE(scene.terrain->height_image.empty());
  EXPECT_EQ(scene.terrain->metres_per_pixel, 3.0);
  EXPECT_EQ(scene.terrain->low_m, -5.0);
  EXPECT_EQ(scene.terrain->high_m, 55.0);
  EXPECT_EQ(scene.terrain->sea_level_m, 1.0);
  EXPECT_EQ(scene.terrain->centre_m, glm::dvec2(7, 8));
  EXPECT_EQ(scene.terrain->island_radius_m, 90.0);
  EXPECT_EQ(scene.terrain->island_height_m, 20.0);
  EXPECT_EQ(scene.terrain->floor_depth_m, 11.0);
  EXPECT_EQ(scene.terrain->coast_m, (std::vector<glm::dvec2>{{-1, 2.5}, {3, 4}, {30, -4}}));
  EXPECT_EQ(scene.terrain->beach_slope, 0.05);
  EXPECT_EQ(scene.terrain->beach_size_m, 700.0);
  EXPECT_EQ(scene.terrain->seed, 99u);
}

TEST(SceneFile, SunDirectionFollowsFromTheAngles) {
  const Scene scene = parse_scene(kEveryKey, "test.toml");  // east, 60 degrees up
  EXPECT_NEAR(scene.sky.sun_direction.x, 0.5, 1e-7);
  EXPECT_NEAR(scene.sky.sun_direction.y, 0.0, 1e-7);
  EXPECT_NEAR(scene.sky.sun_direction.z, 0.8660254, 1e-7);
}

TEST(SceneFile, EmptyFileIsTheDefaultsUnderTheFilesName) {
  Scene expected;
  expected.name = "calm";
  Scene scene = parse_scene("", "folder/calm.toml");
  EXPECT_NEAR(scene.sky.sun_direction.z, 0.5, 1e-7);  // 30 degrees up
  expected.sky.sun_direction = scene.sky.sun_direction;
  EXPECT_EQ(differences(scene, expected), "");
}

TEST(SceneFile, EmptyTerrainTableIsTheDefaultIsland) {
  EXPECT_TRUE(parse_scene("[terrain]\n", "test.toml").terrain.has_value());
  EXPECT_FALSE(parse_scene("[sea]\n", "test.toml").terrain.has_value());
}

constexpr const char* kCoast = "[terrain]\ncoast_m = [[0, 0], [9, 0]]\n";

TEST(SceneFile, CoastWavesAreBlendedInBesideACoastLineOnly) {
  const auto model = [](const std::string& text) {
    return parse_scene(text, "test.toml").coast.model;
  };
  EXPECT_EQ(model(""), CoastModel::kNone);
  EXPECT_EQ(model("[terrain]\n"), CoastModel::kNone);
  EXPECT_EQ(model(kCoast), CoastModel::kBlend);
  EXPECT_EQ(model(std::string(kCoast) + "[coast]\nseed = 2\n"), CoastModel::kBlend);
}

TEST(SceneFile, TheCoastModelOfTheFileStays) {
  const auto model = [](const std::string& before, const std::string& name) {
    return parse_scene(before + "[coast]\nmodel = \"" + name + "\"\n", "test.toml").coast.model;
  };
  EXPECT_EQ(model(kCoast, "none"), CoastModel::kNone);
  EXPECT_EQ(model(kCoast, "trains"), CoastModel::kTrains);
  EXPECT_EQ(model("[terrain]\n", "blend"), CoastModel::kBlend);
  EXPECT_EQ(model(kCoast, "fronts"), CoastModel::kFronts);
}

TEST(SceneFile, ACamerasPathIsReadAndDumped) {
  const Scene scene = parse_scene(
      "[camera]\nfov_y_deg = 40\n[[camera.path]]\n[[camera.path]]\nt_s = 2.5\n"
      "eye_m = [1, 2, 3]\nheading_deg = 90\npitch_deg = -30\nroll_deg = 4\n",
      "test.toml");
  for (const Scene& read : {scene, parse_scene(dump_scene(scene), "dump.toml")}) {
    ASSERT_EQ(read.camera.path.size(), 2u);
    EXPECT_EQ(read.camera.path[0].eye_m, glm::dvec3(0, 0, 10));
    const Waypoint& second = read.camera.path[1];
    EXPECT_EQ(second.t_s, 2.5);
    EXPECT_EQ(second.eye_m, glm::dvec3(1, 2, 3));
    EXPECT_EQ(second.heading_rad, 90 * kDegree);
    EXPECT_EQ(second.pitch_rad, -30 * kDegree);
    EXPECT_EQ(second.roll_rad, 4 * kDegree);
  }
}

TEST(SceneFile, ACameraOfRoboticsIsReadAndDumped) {
  const Scene scene = parse_scene(
      "[camera]\nquaternion = [0.5, -0.5, 0.5, 0.5]\nfocal_px = [800, 790.5]\n"
      "principal_px = [322, 239.5]\nsize_px = [640, 480]\nf_number = 5.6\nexposure_s = 0.01\n",
      "test.toml");
  EXPECT_EQ(scene.camera.quaternion, glm::dvec4(0.5, -0.5, 0.5, 0.5));
  EXPECT_EQ(scene.camera.focal_px, glm::dvec2(800.0, 790.5));
  EXPECT_EQ(scene.camera.principal_px, glm::dvec2(322.0, 239.5));
  EXPECT_EQ(scene.camera.size_px, glm::dvec2(640.0, 480.0));
  EXPECT_EQ(scene.camera.f_number, 5.6);
  EXPECT_EQ(differences(scene, parse_scene(dump_scene(scene), "b.toml")), "");
}

TEST(SceneFile, ACameraOnAnObjectIsReadAndDumped) {
  const Scene scene = parse_scene(
      "[camera]\nmount = \"skiff\"\nmount_offset_m = [0, 1, 2]\nheading_deg = 90\n"
      "[[object]]\n[[object]]\nname = \"skiff\"\nclass = \"boat\"\n",
      "test.toml");
  EXPECT_EQ(scene.camera.mount, "skiff");
  EXPECT_EQ(scene.camera.mount_offset_m, glm::dvec3(0, 1, 2));
  EXPECT_EQ(scene.objects[0].name, "");
  EXPECT_EQ(object_class(scene.objects[0]), "object");
  EXPECT_EQ(scene.objects[1].name, "skiff");
  EXPECT_EQ(object_class(scene.objects[1]), "boat");
  EXPECT_EQ(camera_mount(scene), &scene.objects[1]);
  EXPECT_EQ(differences(scene, parse_scene(dump_scene(scene), "b.toml")), "");
}

TEST(SceneFile, ADrifterAndAWaterBoundaryAreReadAndDumped) {
  const std::string file = SWELL_SOURCE_DIR "/README.md";  // only the land looks into it
  const Scene scene = parse_scene(
      "[terrain]\nboundary = \"" + file +
          "\"\nground = \"boundary\"\n[[river]]\npath_m = [[0, 0], [90, 0]]\nsurface_m = [1, "
          "0]\n[[object]]\nposition_m = [30, 1]\ndrift = true\n",
      "test.toml");
  EXPECT_EQ(scene.terrain->boundary, file);
  EXPECT_TRUE(scene.terrain->ground_from_boundary);
  EXPECT_TRUE(scene.objects[0].drift);
  EXPECT_EQ(differences(scene, parse_scene(dump_scene(scene), "b.toml")), "");
}

TEST(SceneFile, MapsAreReadAndDumpedAndTakeTheSpectrumsPlace) {
  const std::string file = SWELL_SOURCE_DIR "/README.md";  // only the sea looks into it
  const std::string text =
      "[[sea.maps]]\nfile = \"" + file + "\"\nlength_m = 40.5\nperiod_s = 12.5\nhs_m = 0.25\n" +
      "offset_m = [3, -4]\noffset_s = -7\n[[sea.maps]]\nfile = \"" + file + "\"\n";
  const Scene scene = parse_scene(text, "test.toml");
  ASSERT_EQ(scene.sea.maps.size(), 2u);
  const ocean::MapLayer expected{file, glm::dvec2(40.5), 12.5, 0.25, {3.0, -4.0}, -7.0};
  EXPECT_EQ(scene.sea.maps[0], expected);
  EXPECT_FALSE(scene.sea.spectrum);
  EXPECT_EQ(differences(scene, parse_scene(dump_scene(scene), "b.toml")), "");
  const Scene both = parse_scene("[sea]\nspectrum = true\n" + text, "test.toml");
  EXPECT_TRUE(both.sea.spectrum);
}

TEST(SceneFile, AMapHasOneLengthOrOneAlongEachAxis) {
  const auto dump = [](std::string_view length, glm::dvec2 expected) {
    const std::string file = SWELL_SOURCE_DIR "/README.md";  // only the sea looks into it
    const Scene scene = parse_scene(
        "[[sea.maps]]\nfile = \"" + file + "\"\nlength_m = " + std::string(length) + "\n",
        "test.toml");
    EXPECT_EQ(scene.sea.maps[0].length_m, expected) << length;
    EXPECT_EQ(differences(scene, parse_scene(dump_scene(scene), "b.toml")), "");
    return dump_scene(scene);
  };
  EXPECT_NE(dump("40", glm::dvec2(40.0)).find("\nlength_m = 40.0\n"), std::string::npos);
  EXPECT_NE(dump("[40, 40.0]", glm::dvec2(40.0)).find("\nlength_m = 40.0\n"), std::string::npos);
  EXPECT_NE(dump("[40, 17.5]", {40.0, 17.5}).find("\nlength_m = [40.0, 17.5]\n"),
            std::string::npos);
}

TEST(SceneFile, ASetOfMapsHasAWindOfItsOwn) {
  const auto wind_mps = [](const char* text) {
    return parse_scene(text, "test.toml").sea.wind_speed_mps;
  };
  EXPECT_EQ(wind_mps("[sea]\nmap_set = \"lake\"\n"), 4.5);
  EXPECT_EQ(wind_mps("[sea]\nmap_set = \"lake\"\n[wind]\nspeed_mps = 2\n"), 2.0);
}

TEST(SceneFile, AnIslandsDumpHasNoCoastLine) {
  const std::string dump = dump_scene(parse_scene("[terrain]\n", "test.toml"));
  EXPECT_EQ(dump.find("coast_m"), std::string::npos) << dump;
}

TEST(SceneFile, DumpComesBackAsTheSameScene) {
  const Scene scene = parse_scene(kEveryKey, "test.toml");
  const Scene again = parse_scene(dump_scene(scene), "dump.toml");
  EXPECT_EQ(differences(scene, again), "");
}

TEST(SceneFile, DumpOfTheDefaultsIsReadable) {
  const std::string dump = dump_scene(parse_scene("", "calm.toml"));
  EXPECT_NE(dump.find("name = \"calm\"\n"), std::string::npos) << dump;
  EXPECT_NE(dump.find("\n[camera]\neye_m = [0.0, 0.0, 10.0]\n"), std::string::npos) << dump;
  EXPECT_NE(dump.find("\nfov_y_deg = 50.0\n"), std::string::npos) << dump;
  EXPECT_NE(dump.find("\nturbidity = 2.2\n"), std::string::npos) << dump;
  EXPECT_EQ(dump.find("[terrain]"), std::string::npos) << dump;
}

TEST(SceneFile, DumpEscapesText) {
  Scene scene;
  scene.name = "a \"b\" \\ c\n\x01";
  EXPECT_EQ(parse_scene(dump_scene(scene), "x.toml").name, scene.name);
}

TEST(SceneFile, WindowsLineEndsAndByteOrderMarkAreFine) {
  const Scene scene = parse_scene("\xef\xbb\xbf[camera]\r\nnear_m = 0.5\r\n", "test.toml");
  EXPECT_EQ(scene.camera.near_m, 0.5);
}

TEST(SceneFile, HugeFilesAreRefused) {
  const ScratchFolder folder;
  const std::string huge(100u << 20, '#');
  const std::string message =
      ":1: column 1: scene file, got more than 1048576 bytes, allowed 1048576";
  const fs::path path = folder.write("huge.toml", huge);
  EXPECT_EQ(load_error(path), path.string() + message);
  EXPECT_EQ(error_of(std::string(1u << 20, '#')), "");
}

TEST(SceneFile, FilesThatAreNotThereOrNotFilesAreRefused) {
  const ScratchFolder folder;
  const std::string path = folder.path().string();
  EXPECT_EQ(load_error(path), path + ": scene file, got a directory, allowed a readable TOML file");
  EXPECT_EQ(load_error(path + "/none.toml"),
            path +
                "/none.toml: scene file, got 'No such file or directory', allowed a readable "
                "TOML file");
  EXPECT_EQ(load_error("/dev/null"),
            "/dev/null: scene file, got a special file, allowed a readable TOML file");
}

TEST(SceneFile, PicturePathsAreRelativeToTheSceneFile) {
  const ScratchFolder folder;
  folder.write("heights.png", "any");
  const fs::path path = folder.write("a.toml", "[terrain]\nheight_image = \"./heights.png\"\n");
  const Scene scene = load_scene(path);
  EXPECT_EQ(scene.terrain->height_image, folder.path() / "heights.png");
  EXPECT_EQ(differences(parse_scene(dump_scene(scene), "elsewhere/b.toml"), scene), "");
}

TEST(SceneFile, ATerrainIsMadeFromAPictureOrFromACoastLine) {
  const ScratchFolder folder;
  folder.write("heights.png", "any");
  const std::string coast = "coast_m = [[0, 0], [9, 0]]\n";
  const fs::path both =
      folder.write("a.toml", "[terrain]\nheight_image = \"heights.png\"\n" + coast);
  EXPECT_EQ(load_error(both),
            both.string() +
                ":3: column 11: terrain.coast_m, got it besides terrain.height_image in line 2, "
                "allowed one of terrain.height_image, terrain.coast_m");
  EXPECT_EQ(error_of("[terrain]\nheight_image = \"\"\n" + coast), "");
}

TEST(SceneFile, PicturesThatAreNotThereAreNamedWithTheLineThatNamesThem) {
  const ScratchFolder folder;
  const std::string prefix = ":2: column 16: terrain.height_image, got \"";
  const std::string allowed = ", allowed a readable picture file";
  const fs::path a = folder.write("a.toml", "[terrain]\nheight_image = \"none.png\"\n");
  EXPECT_EQ(load_error(a), a.string() + prefix + (folder.path() / "none.png").string() +
                               "\" (No such file or directory)" + allowed);
  const fs::path b = folder.write("b.toml", "[terrain]\nheight_image = \"..\"\n");
  EXPECT_NE(load_error(b).find("(not a file)" + allowed), std::string::npos) << load_error(b);
}

TEST(SceneFile, FramesOfASequenceHaveTheirNumberInTheName) {
  const ScratchFolder folder;
  folder.write("wave_0000.png", "any");
  const auto scene_of = [&](const std::string& name) {
    return folder.write("a.toml", "[ripples]\nsequence = \"" + name + "\"\nkind = \"sequence\"\n");
  };
  const Scene scene = load_scene(scene_of("./wave_%04d.png"));
  EXPECT_EQ(scene.ripples.sequence, (folder.path() / "wave_%04d.png").string());
  EXPECT_EQ(differences(parse_scene(dump_scene(scene), "elsewhere/b.toml"), scene), "");

  const std::string where =
      (folder.path() / "a.toml").string() + ":2: column 12: ripples.sequence, ";
  for (const std::string name : {"wave_0000.png", "wave_%d.png", "%04d_%04d.png", "%s%04d.png"})
    EXPECT_EQ(
        load_error(scene_of(name)),
        where + "got \"" + name + "\", allowed the path of readable picture files, with one %04d");
  EXPECT_EQ(load_error(scene_of("none_%04d.png")),
            where + "got \"" + (folder.path() / "none_0000.png").string() +
                "\" (No such file or directory), allowed a readable picture file");
  const fs::path layers =
      folder.write("a.toml", "[ripples]\nsequence = \"wave_%04d.png\"\nkind = \"layers\"\n");
  EXPECT_EQ(load_error(layers),
            where + "got it with kind = \"layers\", allowed it with kind = \"sequence\"");
  const fs::path alone =
      folder.write("b.toml", "[ripples]\ndetail = \"wave_%04d.png\"\nkind = \"sequence\"\n");
  EXPECT_EQ(load_error(alone), alone.string() +
                                   ":2: column 10: ripples.detail, got it without "
                                   "ripples.sequence, allowed both");
}

TEST(SceneFile, NumbersDoNotDependOnTheLocale) {
  const ScratchFolder folder;  // Debian's minimal image has no comma locale: compile one
  const std::string locale = folder.path().string() + "/de_DE.UTF-8";
  const std::string compile = "localedef -i de_DE -f UTF-8 " + locale + " >/dev/null 2>&1";
  const bool compiled = std::system(compile.c_str()) == 0;
  if (compiled) setenv("LOCPATH", folder.path().c_str(), 1);
  if (!std::setlocale(LC_ALL, "de_DE.UTF-8")) GTEST_SKIP() << "no locale with decimal commas";
  ASSERT_STREQ(std::localeconv()->decimal_point, ",");
  const Scene scene = parse_scene("[camera]\nnear_m = 0.5\neye_m = [1.5, 2, 3e-1]\n", "a.toml");
  const std::string dump = dump_scene(scene);
  std::setlocale(LC_ALL, "C");
  EXPECT_EQ(scene.camera.near_m, 0.5);
  EXPECT_EQ(scene.camera.eye_m, glm::dvec3(1.5, 2.0, 0.3));
  EXPECT_NE(dump.find("eye_m = [1.5, 2.0, 0.3]"), std::string::npos);
}

TEST(SceneFile, EveryDeliveredSceneLoadsAndComesBackFromItsDump) {
  const auto count_good = [](const char* folder) {
    int count = 0;
    for (const auto& entry : fs::directory_iterator(fs::path(SWELL_SOURCE_DIR) / folder)) {
      if (entry.path().extension() != ".toml") continue;
      ++count;
      const Scene scene = load_scene(entry.path());
      EXPECT_EQ(scene.name, entry.path().stem().string());
      EXPECT_EQ(differences(parse_scene(dump_scene(scene), entry.path().string()), scene), "")
          << entry.path();
    }
    return count;
  };
  EXPECT_GE(count_good("scenes"), 4);
  EXPECT_GE(count_good("tests/scenes"), 27);
}

TEST(SceneFile, AKeyOfThePaintedSkyMakesItOne) {
  EXPECT_EQ(parse_scene("[sky]\nhorizon = [1, 1, 1]\n", "a.toml").sky.model, SkyModel::kGradient);
  EXPECT_EQ(parse_scene("[sky]\nturbidity = 3\n", "a.toml").sky.model, SkyModel::kAtmosphere);
}

}  // namespace
}  // namespace swell::scene
