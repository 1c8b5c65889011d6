#include "scene/file/rig_parameters.h"

#include <fmt/format.h>

#include "scene/file/parameter_row.h"
#include "scene/file/scene_choices.h"

namespace swell::scene {
namespace {

#define SWELL_FIELD(PATH) \
  [](auto& object) -> auto& { return object.PATH; }

struct PoseName {
  static constexpr auto words = enum_words<bool>({{false, "rig"}, {true, "input"}});
  auto& operator()(auto& body) const { return body.is_input; }
};

using SensorRow = Row<Sensor>;
using Keys = std::vector<Parameter<Sensor>>;

struct SensorProjectionName {
  static constexpr auto words = ProjectionName::words;
  auto& operator()(auto& sensor) const { return sensor.projection; }
};

// Three angles in radians.
Parameter<Sensor> rpy_parameter() {
  Parameter<Sensor> row = SensorRow::vector(
      "rpy_deg", {-360, 360, "deg"}, SWELL_FIELD(rpy_rad),
      "roll, pitch, yaw of its frame, about its parent's x, y and z in turn, as URDF has them");
  row.get = [](const Sensor& sensor) -> ParameterValue {
    std::vector<double> degrees;
    for (int i = 0; i < 3; ++i) {
      const double rad = sensor.rpy_rad[i];
      degrees.push_back(shortest_preimage(rad, rad / kRadPerDeg, radians));
    }
    return degrees;
  };
  row.set = [](Sensor& sensor, const ParameterValue& value) {
    const auto& degrees = std::get<std::vector<double>>(value);
    for (int i = 0; i < 3; ++i) sensor.rpy_rad[i] = radians(degrees[static_cast<std::size_t>(i)]);
  };
  return row;
}

void add_labels(Keys& keys, std::string_view classes, std::string_view ids) {
  keys.push_back(
      SensorRow::plain<bool>("class", ParameterKind::kBoolean, SWELL_FIELD(classes), classes));
  keys.push_back(SensorRow::plain<bool>("id", ParameterKind::kBoolean, SWELL_FIELD(ids), ids));
}

struct PictureCodingName {
  static constexpr auto words = kPictureCodings;
  auto& operator()(auto& sensor) const { return sensor.compressed; }
};

// How the picture is published.
void add_pictures(Keys& keys) {
  keys.push_back(SensorRow::plain<bool>("raw", ParameterKind::kBoolean, SWELL_FIELD(raw),
                                        "publish the picture as it is, image_raw"));
  keys.push_back(SensorRow::choice(
      "compressed", PictureCodingName{},
      "publish it as a CompressedImage too, image_raw/compressed, as image_transport does; "
      "Gazebo has no such message"));
  keys.push_back(SensorRow::integer("jpeg_quality", ParameterKind::kInteger, {1, 100},
                                    SWELL_FIELD(jpeg_quality), "of compressed = \"jpeg\""));
}

// What a scene's camera has as well.
void add_projection(Keys& keys) {
  keys.push_back(SensorRow::choice(
      "projection", SensorProjectionName{},
      "camera_info has of a fisheye the model \"equidistant\" with k1 to k4 and K; of an "
      "equirectangular camera the model \"equirectangular\", no D, and K and P of zeros"));
  keys.push_back(SensorRow::angle(
      "fisheye_fov_deg", {1, 360, "deg"}, SWELL_FIELD(fisheye_fov_rad),
      "cone that a fisheye shows, which touches the picture's nearer edges; black outside"));
  keys.push_back(SensorRow::vector("fisheye_k", {-10, 10}, SWELL_FIELD(fisheye_k),
                                   "k1 to k4 of a fisheye, as OpenCV has them"));
}

void add_noise(Keys& keys) {
  keys.push_back(SensorRow::or_zero(SensorRow::number(
      "full_well_e", {100, 1e7, "electrons"}, SWELL_FIELD(noise.full_well_e),
      "that a pixel's channel holds: eight times those of light that is shown at 0.7; 0: no "
      "noise")));
  keys.push_back(SensorRow::number("iso", {100, 1e6}, SWELL_FIELD(noise.iso),
                                   "at 200 the picture is made of half as many electrons as at "
                                   "100, and with f_number exposed twice as much"));
  keys.push_back(SensorRow::number("read_noise_e", {0, 10000, "electrons"},
                                   SWELL_FIELD(noise.read_noise_e),
                                   "standard deviation, beside that of the light"));
  keys.push_back(SensorRow::integer("noise_seed", ParameterKind::kInteger, {0, kMaxSeed},
                                    SWELL_FIELD(noise.seed), "another number, other noise"));
}

void add_exposure(Keys& keys) {
  keys.push_back(SensorRow::or_zero(SensorRow::number(
      "f_number", {0.5, 128}, SWELL_FIELD(f_number),
      "of the lens: exposes the picture with it, iso and the scene's camera.exposure_s, where the "
      "light is physical; in place of sky.exposure; 0: as the scene's camera is exposed")));
}

void add_camera(Keys& keys) {
  keys.push_back(SensorRow::integer("width_px", ParameterKind::kInteger, {1, 8192, "px"},
                                    SWELL_FIELD(width_px), "of the picture"));
  keys.push_back(SensorRow::integer("height_px", ParameterKind::kInteger, {1, 8192, "px"},
                                    SWELL_FIELD(height_px), "of the picture"));
  keys.push_back(SensorRow::angle(
      "fov_y_deg", {1, 170, "deg"}, SWELL_FIELD(fov_y_rad),
      "from the picture's top to its bottom, without the lens; not of wide cameras"));
  keys.push_back(SensorRow::number("near_m", {0.001, 100, "m"}, SWELL_FIELD(near_m),
                                   "nearer things are cut off"));
  keys.push_back(SensorRow::list("distortion", {-100, 100}, 5, 5, SWELL_FIELD(distortion),
                                 "k1, k2, p1, p2, k3 of the lens, as OpenCV has them"));
  add_pictures(keys);
  keys.push_back(
      SensorRow::plain<bool>("depth", ParameterKind::kBoolean, SWELL_FIELD(depth),
                             "publish depth along the view axis, of wide cameras distance, "
                             "in metres, 32FC1"));
  add_labels(keys, "publish the label \"class\", 16UC1", "publish the label \"id\", 32SC1");
  add_projection(keys);
  add_noise(keys);
  add_exposure(keys);
}

struct LidarPatternName {
  static constexpr auto words = kLidarPatterns;
  auto& operator()(auto& sensor) const { return sensor.lidar.pattern; }
};

void add_lidar(Keys& keys) {
  const auto add_size = [&](std::string_view key, double most, auto field,
                            std::string_view meaning) {
    keys.push_back(SensorRow::integer(key, ParameterKind::kInteger, {1, most}, field, meaning));
  };
  keys.push_back(SensorRow::choice("pattern", LidarPatternName{},
                                   "its beams: a model that turns clockwise, or an even grid"));
  add_size("columns", 4096, SWELL_FIELD(lidar.columns), "of a turn or a grid");
  add_size("rows", 512, SWELL_FIELD(lidar.rows), "of a grid, from the top");
  keys.push_back(SensorRow::angle("fov_x_deg", {0.001, 360, "deg"}, SWELL_FIELD(lidar.fov_x_rad),
                                  "width of a grid, whose beams are the middles of even cells"));
  keys.push_back(SensorRow::angle("fov_y_deg", {0.001, 180, "deg"}, SWELL_FIELD(lidar.fov_y_rad),
                                  "height of a grid"));
  keys.push_back(SensorRow::number("nearest_m", {0, 10000, "m"}, SWELL_FIELD(nearest_m),
                                   "what is nearer has no return"));
  keys.push_back(SensorRow::number("farthest_m", {0.01, 10000, "m"}, SWELL_FIELD(farthest_m),
                                   "what is farther has no return"));
  keys.push_back(SensorRow::number(
      "reach_m", {0, 10000, "m"}, SWELL_FIELD(lidar.reach_m),
      "where a surface of reflectance 0.1 is seen half of the time; 0: all that is met is seen"));
  keys.push_back(SensorRow::number("range_noise_m", {0, 10, "m"}, SWELL_FIELD(lidar.range_noise_m),
                                   "standard deviation"));
  keys.push_back(SensorRow::integer("seed", ParameterKind::kInteger, {0, kMaxSeed},
                                    SWELL_FIELD(lidar.seed),
                                    "of noise and losses, with the beam and the stamp"));
  keys.push_back(SensorRow::plain<bool>(
      "rolling_shutter", ParameterKind::kBoolean, SWELL_FIELD(lidar.rolling_shutter),
      "beams leave one column (of a grid: row) after the other until the next scan begins"));
  add_size("moments", 64, SWELL_FIELD(lidar.moments),
           "with it: how many times the world is moved in a scan; 1: it stands as at the stamp");
  add_labels(keys, "points have the label \"class\", uint16",
             "points have the label \"id\", uint32");
}

void add_ranges(Keys& keys) {
  keys.push_back(SensorRow::number("nearest_m", {0, 10000, "m"}, SWELL_FIELD(nearest_m),
                                   "what is nearer gives -infinity"));
  keys.push_back(SensorRow::number("farthest_m", {0.01, 10000, "m"}, SWELL_FIELD(farthest_m),
                                   "where nothing is nearer than this it gives infinity"));
  keys.push_back(SensorRow::angle("beam_deg", {0, 180, "deg"}, SWELL_FIELD(beam_rad),
                                  "width of the beam, for the message: one ray is measured"));
}

}  // namespace

std::vector<Parameter<Rig>> rig_parameters() {
  using RigRow = Row<Rig>;
  return {
      RigRow::angle("origin.latitude_deg", {-90, 90, "deg"}, SWELL_FIELD(latitude_rad),
                    "of the scene's origin on WGS 84, north positive"),
      RigRow::angle("origin.longitude_deg", {-180, 180, "deg"}, SWELL_FIELD(longitude_rad),
                    "likewise, east positive"),
      RigRow::number("origin.altitude_m", {-1000, 10000, "m"}, SWELL_FIELD(altitude_m),
                     "of the mean sea level over the ellipsoid"),
      RigRow::or_zero(RigRow::number("clock_hz", {0.001, 10000, "Hz"}, SWELL_FIELD(clock_hz),
                                     "how often /clock is published; 0: never")),
  };
}

std::vector<Parameter<RigBody>> body_parameters() {
  using BodyRow = Row<RigBody>;
  return {
      BodyRow::plain<std::string>("frame", ParameterKind::kText, SWELL_FIELD(frame),
                                  "name of its frame; no two alike"),
      BodyRow::number("rate_hz", {0.001, 10000, "Hz"}, SWELL_FIELD(rate_hz),
                      "how often /tf has its pose, if it moves"),
      BodyRow::optional_text("mount", SWELL_FIELD(mount),
                             "name of an object of the scene that it is"),
      BodyRow::optional_vector("position_m", {-1e6, 1e6, "m"}, SWELL_FIELD(position_m),
                               "where it stays: east, north, up from mean sea level"),
      BodyRow::angle("heading_deg", {-360, 360, "deg"}, SWELL_FIELD(heading_rad),
                     "where it points at position_m, clockwise from north"),
      BodyRow::angle("pitch_deg", {-89, 89, "deg"}, SWELL_FIELD(pitch_rad), "there: up positive"),
      BodyRow::angle("roll_deg", {-180, 180, "deg"}, SWELL_FIELD(roll_rad),
                     "there: positive lowers its right side"),
      BodyRow::choice(
          "pose", PoseName{},
          "\"input\": it comes from outside (swell-sim --inputs, --dds on) as \"map\" has it; "
          "sensors on "
          "the body wait for the first one, IMU and odometry are of differences of the "
          "last poses, 40 ms apart or as far as poses are; an object that it mounts goes "
          "with it"),
  };
}

std::vector<Parameter<Waypoint>> body_path_parameters() {
  using WaypointRow = Row<Waypoint>;
  return {
      WaypointRow::number("t_s", {-1e6, 1e6, "s"}, SWELL_FIELD(t_s),
                          "when the body is there; more than that of the table before"),
      WaypointRow::vector("position_m", {-1e6, 1e6, "m"}, SWELL_FIELD(eye_m),
                          "east, north, up from mean sea level"),
      WaypointRow::angle("heading_deg", {-360, 360, "deg"}, SWELL_FIELD(heading_rad),
                         "clockwise from north; turns the shorter way"),
      WaypointRow::angle("pitch_deg", {-89, 89, "deg"}, SWELL_FIELD(pitch_rad), "up positive"),
      WaypointRow::angle("roll_deg", {-180, 180, "deg"}, SWELL_FIELD(roll_rad),
                         "positive lowers its right side"),
  };
}

std::vector<Parameter<Sensor>> sensor_parameters(SensorKind kind) {
  Keys keys = {
      SensorRow::optional_text("name", SWELL_FIELD(name), "of its topics and frames; no two alike"),
      SensorRow::optional_text("body", SWELL_FIELD(body),
                               "frame of the body that it is on; left out: it stands in \"map\""),
      SensorRow::number("rate_hz", {0.001, 10000, "Hz"}, SWELL_FIELD(rate_hz),
                        "message k has the stamp k / rate_hz, to the nanosecond"),
  };
  if (kSensorKinds[kind].has_place) {
    keys.push_back(SensorRow::vector("position_m", {-1e6, 1e6, "m"}, SWELL_FIELD(position_m),
                                     "in its parent's frame: ahead, left, up of a body; east, "
                                     "north, up of \"map\""));
    keys.push_back(rpy_parameter());
  }
  switch (kind) {
    case SensorKind::kCamera:
      add_camera(keys);
      break;
    case SensorKind::kLidar:
      add_lidar(keys);
      break;
    case SensorKind::kAltimeter:
    case SensorKind::kEchoSounder:
      add_ranges(keys);
      break;
    default:
      break;
  }
  return keys;
}

#undef SWELL_FIELD

Waypoint common_waypoint() {
  Waypoint waypoint;
  waypoint.eye_m = glm::dvec3(0.0);
  return waypoint;
}

Sensor common_sensor(SensorKind kind) {
  const SensorKindFacts& facts = kSensorKinds[kind];
  Sensor sensor;
  sensor.kind = kind;
  sensor.rate_hz = facts.rate_hz;
  sensor.rpy_rad = facts.rpy_rad;
  return sensor;
}

namespace {

template <class Object>
std::string keys_text(std::string_view table, const std::vector<Parameter<Object>>& parameters,
                      const Object& standard) {
  std::string text = fmt::format("\n{}\n", table);
  for (const Parameter<Object>& parameter : parameters) {
    const std::string value = toml_text(parameter, standard);
    text += fmt::format("  {:<21} {}{}: {}\n", parameter.key, allowed_text(parameter),
                        value.empty() ? "" : fmt::format(" [{}]", value), parameter.meaning);
  }
  return text;
}

}  // namespace

std::string rig_keys_text() {
  std::string text = "The keys of rigs: what is allowed [default]: meaning\n";
  text += keys_text("at the top", rig_parameters(), Rig());
  text += keys_text("[[body]]: one of mount, position_m, [[body.path]] and pose = \"input\"",
                    body_parameters(), RigBody());
  text += keys_text("[[body.path]]", body_path_parameters(), common_waypoint());
  for (std::size_t k = 0; k < kSensorKinds.size(); ++k) {
    const auto kind = static_cast<SensorKind>(k);
    text += keys_text(fmt::format("[[{}]]", kSensorKinds[kind].name), sensor_parameters(kind),
                      common_sensor(kind));
  }
  return text;
}

}  // namespace swell::scene
