// Rigs: bodies with their poses, and the sensors on them or at places, of a simulation in a scene.
//
//   const scene::Rig rig = scene::load_rig("boat.toml", {});
//   scene::check_mounts(rig, scene);
//
// Frames are those of ROS (REP 103, 105). "map" has the scene's axes: east, north, up. A body's has
// x ahead, y to the left, z up; its parent is "odom", which lies on "map". A sensor's frame is
// given in its body's, or in "map"; a camera looks along its x.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "math/elementary.h"
#include "math/enum_table.h"
#include "scene/camera.h"
#include "scene/file/key_places.h"

namespace swell::scene {

struct Scene;

// One of mount, position_m and path says where it is, or its pose comes from outside; then a mount
// is the object that is put there.
struct RigBody {
  std::string frame = "base_link";
  double rate_hz = 50.0;                   // of its transform, where it moves
  std::string mount{};                     // name of an object of the scene, whose pose it has
  std::optional<glm::dvec3> position_m{};  // it stays there: east, north, up
  double heading_rad = 0.0, pitch_rad = 0.0, roll_rad = 0.0;  // there: as Waypoint has them
  std::vector<Waypoint> path{};  // it goes along these as a camera does (scene/camera.h)
  bool is_input = false;

  bool moves() const { return !position_m; }
};

enum class SensorKind : std::uint8_t {
  kCamera,
  kLidar,
  kAltimeter,
  kEchoSounder,
  kWaveProbe,
  kImu,
  kGnss,
  kOdometry,
  kPose,
};

// What beams a lidar has: those of a model that turns, as render::find_spinning_model() has it, or
// an even grid.
enum class LidarPattern : std::uint8_t { kVlp16, kHdl32e, kOs1x64, kOs1x128, kGrid };
inline constexpr auto kLidarPatterns =
    enum_words<LidarPattern>({{LidarPattern::kVlp16, "vlp-16"},
                              {LidarPattern::kHdl32e, "hdl-32e"},
                              {LidarPattern::kOs1x64, "os1-64"},
                              {LidarPattern::kOs1x128, "os1-128"},
                              {LidarPattern::kGrid, "grid"}});

// What a camera's picture is published as besides.
enum class PictureCoding : std::uint8_t { kNone, kJpeg, kPng };
inline constexpr auto kPictureCodings = enum_words<PictureCoding>(
    {{PictureCoding::kNone, "none"}, {PictureCoding::kJpeg, "jpeg"}, {PictureCoding::kPng, "png"}});

// As render::LidarScan has them.
struct LidarSettings {
  LidarPattern pattern = LidarPattern::kHdl32e;
  int columns = 1024, rows = 16;                                // rows: of grids
  double fov_x_rad = radians(70.0), fov_y_rad = radians(25.0);  // of grids
  double reach_m = 0.0, range_noise_m = 0.0;
  std::uint64_t seed = 1;
  bool rolling_shutter = false;  // beams leave one after the other until the next scan begins
  int moments = 1;               // of the world in that time
};

struct Sensor {
  SensorKind kind = SensorKind::kCamera;
  std::string name{};  // of its topics and its frame
  std::string body{};  // the body's frame; empty: it stands in "map"
  glm::dvec3 position_m{0.0};
  glm::dvec3 rpy_rad{0.0};  // roll, pitch, yaw about the fixed axes x, y, z, in this order
  double rate_hz = 10.0;

  // These are for cameras.
  int width_px = 640, height_px = 360;
  double fov_y_rad = radians(50.0);
  double near_m = 0.25;
  std::vector<double> distortion = std::vector<double>(5);  // k1, k2, p1, p2, k3
  bool raw = true;                                          // the picture as it is
  PictureCoding compressed = PictureCoding::kNone;
  int jpeg_quality = 95;
  bool depth = false;                                        // a picture of it besides
  ProjectionKind projection = ProjectionKind::kPerspective;  // as Camera has the next four
  double fisheye_fov_rad = radians(180.0);
  glm::dvec4 fisheye_k{0.0};
  SensorNoise noise{};
  double f_number = 0.0;  // as Camera has it, with the scene's exposure_s; 0: the scene's

  // For cameras and lidars: labels besides.
  bool classes = false, ids = false;

  LidarSettings lidar{};

  // These are for lidars, and for altimeters and echo sounders, which measure along x.
  double nearest_m = 0.2, farthest_m = 100.0;
  double beam_rad = 0.0;  // as the message has it: one ray is measured
};

// What all sensors of a kind have in common. One more kind is an enumerator, a row here, its keys
// in rig_parameters.cpp and a row of apps/sim/sensors.cpp, which names what makes its messages.
struct SensorKindFacts {
  std::string_view name;    // of its tables in rigs
  double rate_hz = 10.0;    // if the rig gives none
  glm::dvec3 rpy_rad{0.0};  // likewise
  bool needs_body = false;  // it tells of a body
  bool has_place = true;    // it has a frame of its own
};

inline constexpr glm::dvec3 kLooksDown{0.0, 0.5 * kPi, 0.0};
inline constexpr auto kSensorKinds = enum_table<SensorKind, SensorKindFacts>({
    {SensorKind::kCamera, {.name = "camera", .rate_hz = 20.0}},
    {SensorKind::kLidar, {.name = "lidar"}},
    {SensorKind::kAltimeter, {.name = "altimeter", .rpy_rad = kLooksDown}},
    {SensorKind::kEchoSounder, {.name = "echo_sounder", .rpy_rad = kLooksDown}},
    {SensorKind::kWaveProbe, {.name = "wave_probe"}},
    {SensorKind::kImu, {.name = "imu", .rate_hz = 100.0}},
    {SensorKind::kGnss, {.name = "gnss"}},
    {SensorKind::kOdometry,
     {.name = "odometry", .rate_hz = 50.0, .needs_body = true, .has_place = false}},
    {SensorKind::kPose, {.name = "pose", .rate_hz = 50.0}},
});

struct Rig {
  // Where the scene's origin lies on WGS 84's ellipsoid, and how far over it.
  double latitude_rad = 0.0, longitude_rad = 0.0, altitude_m = 0.0;
  double clock_hz = 0.0;  // of /clock; 0: none
  std::vector<RigBody> bodies;
  std::vector<Sensor> sensors;  // in the order of the kinds, each in the file's
  KeyPlaces places;             // "body[0].mount", "camera[1].width_px"

  const RigBody* find_body(std::string_view frame) const;
};

// The frames of a sensor: its own, if its kind has a place, and a camera's optical one (x right, y
// down, z ahead).
std::string sensor_frame(const Sensor& sensor);
std::string optical_frame_name(const Sensor& camera);

// The key of a sensor's table, for its places: "camera[1]".
std::string sensor_key(const Rig& rig, const Sensor& sensor);

// Throws SceneError 'FILE:LINE: column N: KEY, TEXT'.
[[noreturn]] void refuse_key(const Rig& rig, const std::string& key, const std::string& text);

// Reads a rig in TOML, or JSON of the same schema, changed by settings as scenes are
// (scene/settings.h). Throws SceneError of the first fault.
Rig load_rig(const std::filesystem::path& path, std::span<const std::string> settings);
Rig parse_rig(std::string_view text, const std::filesystem::path& file_name,
              std::span<const std::string> settings);

// Throws SceneError for a body on an object that the scene does not have.
void check_mounts(const Rig& rig, const Scene& scene);

// Every key of rigs, a line each: unit, what is allowed, default, meaning.
std::string rig_keys_text();

}  // namespace swell::scene
