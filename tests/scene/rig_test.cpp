// Rigs: what their keys say, what is said of those that are not as they should be, and that none of
// many damaged ones does more than be refused by a line.
#include "scene/file/rig.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <random>
#include <sstream>
#include <string>

#include "math/elementary.h"
#include "scene/scene.h"
#include "scene/scene_error.h"

namespace swell::scene {
namespace {

std::string rig_error(const std::string& text) {
  try {
    parse_rig(text, "rig.toml", {});
    return "";
  } catch (const SceneError& error) {
    return error.what();
  }
}

std::string harbour_boat() {
  std::ostringstream text;
  text << std::ifstream(SWELL_SOURCE_DIR "/scenes/rigs/harbour_boat.toml").rdbuf();
  return text.str();
}

constexpr const char* kBody = "[[body]]\nposition_m = [1, 2, 3]\n";

struct RigFaultCase {
  std::string text;
  const char* message;  // the whole of it
};

class RigFault : public ::testing::TestWithParam<RigFaultCase> {};

TEST_P(RigFault, IsNamedWithPlaceAndAllowedValues) {
  EXPECT_EQ(rig_error(GetParam().text), GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    Values, RigFault,
    ::testing::Values(
        RigFaultCase{"[[camra]]\n",
                     "rig.toml:1: column 3: unknown key, got 'camra' (did you mean 'camera'?), "
                     "allowed origin.latitude_deg, origin.longitude_deg, origin.altitude_m, "
                     "clock_hz, body, camera, lidar, altimeter, echo_sounder, wave_probe, imu, "
                     "gnss, odometry, pose"},
        RigFaultCase{"[[imu]]\nname = \"imu\"\nrate_h = 3\n",
                     "rig.toml:3: column 1: unknown key, got 'imu[0].rate_h' (did you mean "
                     "'rate_hz'?), allowed name, body, rate_hz, position_m, rpy_deg"},
        RigFaultCase{"[[imu]]\nname = \"imu\"\nfov_y_deg = 3\n",
                     "rig.toml:3: column 1: unknown key, got 'imu[0].fov_y_deg', allowed name, "
                     "body, rate_hz, position_m, rpy_deg"},
        RigFaultCase{"[[imu]]\nname = \"imu\"\nrate_hz = 0\n",
                     "rig.toml:3: column 11: imu[0].rate_hz, got 0, allowed 0.001 to 10000 Hz"},
        RigFaultCase{"[[camera]]\nname = \"c\"\nwidth_px = 9000\n",
                     "rig.toml:3: column 12: camera[0].width_px, got 9000, allowed an integer, 1 "
                     "to 8192 px"},
        RigFaultCase{"[[camera]]\nname = \"c\"\nwidth_px = 64.5\n",
                     "rig.toml:3: column 12: camera[0].width_px, got 64.5, allowed an integer, 1 "
                     "to 8192 px"},
        RigFaultCase{"[[camera]]\nname = \"c\"\nfov_y_deg = nan\n",
                     "rig.toml:3: column 13: camera[0].fov_y_deg, got nan, allowed 1 to 170 deg"},
        RigFaultCase{"[[camera]]\nname = \"c\"\ndepth = 1\n",
                     "rig.toml:3: column 9: camera[0].depth, got 1, allowed true or false"},
        RigFaultCase{"[[camera]]\nname = \"c\"\ncompressed = \"webp\"\n",
                     "rig.toml:3: column 14: camera[0].compressed, got \"webp\", allowed \"none\", "
                     "\"jpeg\" or \"png\""},
        RigFaultCase{"[[camera]]\nname = \"c\"\njpeg_quality = 0\n",
                     "rig.toml:3: column 16: camera[0].jpeg_quality, got 0, allowed an integer, 1 "
                     "to 100"},
        RigFaultCase{"[[camera]]\nname = \"c\"\ndistortion = [0.1]\n",
                     "rig.toml:3: column 14: camera[0].distortion, got an array of 1 values, "
                     "allowed 5 numbers, each -100 to 100"},
        RigFaultCase{"camera = 3\n",
                     "rig.toml:1: column 10: camera, got 3, allowed at most 500 tables [[camera]]"},
        RigFaultCase{"origin = 3\n",
                     "rig.toml:1: column 1: unknown key, got 'origin', allowed "
                     "origin.latitude_deg, origin.longitude_deg, origin.altitude_m, clock_hz, "
                     "body, camera, lidar, altimeter, echo_sounder, wave_probe, imu, gnss, "
                     "odometry, pose"},
        RigFaultCase{"[origin]\nlatitude_deg = 91\n",
                     "rig.toml:2: column 16: origin.latitude_deg, got 91, allowed -90 to 90 deg"},
        RigFaultCase{"\n[[body]]\n",
                     "rig.toml:2: column 1: body[0], got no pose, allowed one of mount, "
                     "position_m, [[body.path]] and pose = \"input\""},
        RigFaultCase{"[[body]]\nmount = \"a\"\nposition_m = [1, 2, 3]\n",
                     "rig.toml:1: column 1: body[0], got several poses, allowed one of mount, "
                     "position_m, [[body.path]] and pose = \"input\""},
        RigFaultCase{std::string(kBody) + kBody,
                     "rig.toml:3: column 1: body[1].frame, got \"base_link\" twice, allowed once"},
        RigFaultCase{"[[body]]\nposition_m = [1, 2, 3]\nframe = \"odom\"\n",
                     "rig.toml:3: column 9: body[0].frame, got \"odom\" twice, allowed once"},
        RigFaultCase{"[[body]]\nmount = \"a\"\npose = \"input\"\n[[body]]\nframe = \"b\"\nmount = "
                     "\"a\"\npose = \"input\"\n",
                     "rig.toml:6: column 9: body[1].mount, got \"a\" twice, allowed once"},
        RigFaultCase{"[[body]]\nposition_m = [1, 2, 3]\npose = \"input\"\n",
                     "rig.toml:1: column 1: body[0], got several poses, allowed one of mount, "
                     "position_m, [[body.path]] and pose = \"input\""},
        RigFaultCase{"[[body]]\nposition_m = [1, 2, 3]\nheadng_deg = 2\n",
                     "rig.toml:3: column 1: unknown key, got 'body[0].headng_deg' (did you mean "
                     "'heading_deg'?), allowed frame, rate_hz, mount, position_m, heading_deg, "
                     "pitch_deg, roll_deg, pose, path"},
        RigFaultCase{"[[body]]\n[[body.path]]\nt_s = 1\n[[body.path]]\nt_s = 1\n",
                     "rig.toml:5: column 7: body[0].path[1].t_s, got 1 after 1, allowed later "
                     "times"},
        RigFaultCase{"[[body]]\n[[body.path]]\neye_m = 1\n",
                     "rig.toml:3: column 1: unknown key, got 'body[0].path[0].eye_m', allowed "
                     "t_s, position_m, heading_deg, pitch_deg, roll_deg"},
        RigFaultCase{"[[imu]]\n",
                     "rig.toml:1: column 1: imu[0].name, got \"\", allowed letters, digits and "
                     "single _, parts with / between them that begin with no digit"},
        RigFaultCase{"[[imu]]\nname = \"../../etc\"\n",
                     "rig.toml:2: column 8: imu[0].name, got \"../../etc\", allowed letters, "
                     "digits and single _, parts with / between them that begin with no digit"},
        RigFaultCase{"[[imu]]\nname = \"a\"\n[[gnss]]\nname = \"a\"\n",
                     "rig.toml:4: column 8: gnss[0].name, got \"a\" twice, allowed once"},
        RigFaultCase{"[[camera]]\nname = \"a\"\n[[pose]]\nname = \"a/depth\"\n",
                     "rig.toml:4: column 8: pose[0].name, got \"a/depth\" below the sensor \"a\", "
                     "allowed others"},
        RigFaultCase{std::string(kBody) + "[[imu]]\nname = \"base\"\n",
                     "rig.toml:4: column 8: imu[0].name, got \"base\", whose frame \"base_link\" "
                     "is a body's, allowed others"},
        RigFaultCase{"[[imu]]\nname = \"a\"\nbody = \"boat\"\n",
                     "rig.toml:3: column 8: imu[0].body, got \"boat\", allowed the frame of a "
                     "body, of which there is none"},
        RigFaultCase{std::string(kBody) + "[[imu]]\nname = \"a\"\nbody = \"boat\"\n",
                     "rig.toml:5: column 8: imu[0].body, got \"boat\", allowed the frame of a "
                     "body: \"base_link\""},
        RigFaultCase{"[[odometry]]\nname = \"a\"\n",
                     "rig.toml:1: column 1: odometry[0].body, got none, allowed the frame of a "
                     "body"},
        RigFaultCase{"[[altimeter]]\nname = \"a\"\nfarthest_m = 0.1\n",
                     "rig.toml:1: column 1: altimeter[0].nearest_m, got 0.2, allowed less than "
                     "farthest_m, 0.1"},
        RigFaultCase{"[[lidar]]\nname = \"a\"\npattern = \"vlp\"\n",
                     "rig.toml:3: column 11: lidar[0].pattern, got \"vlp\", allowed \"vlp-16\", "
                     "\"hdl-32e\", \"os1-64\", \"os1-128\" or \"grid\""},
        RigFaultCase{"[[lidar]]\nname = \"a\"\nmoments = 2\n",
                     "rig.toml:3: column 11: lidar[0].moments, got 2 without rolling_shutter, "
                     "allowed 1"},
        RigFaultCase{"[[lidar]]\nname = \"a\"\nrolling_shutter = true\nrate_hz = 0.1\n",
                     "rig.toml:3: column 19: lidar[0].rolling_shutter, got true at 0.1 Hz, "
                     "allowed at 0.25 Hz and more"},
        RigFaultCase{"[[imu]\n",
                     "rig.toml:1: column 7: syntax error, got 'Error while parsing table header: "
                     "expected ']', saw '\\n'', allowed TOML 1.0"}));

TEST(Rig, OfTheHarbourHasItsBoatAndItsSensors) {
  const Rig rig = parse_rig(harbour_boat(), "rig.toml", {});
  ASSERT_EQ(rig.bodies.size(), 1u);
  EXPECT_EQ(rig.bodies[0].mount, "launch");
  EXPECT_TRUE(rig.bodies[0].moves());
  ASSERT_FALSE(rig.sensors.empty());
  const Sensor& camera = rig.sensors[0];
  EXPECT_EQ(sensor_key(rig, camera), "camera[0]");
  EXPECT_EQ(camera.width_px, 640);
  EXPECT_DOUBLE_EQ(camera.rpy_rad.y, radians(5.0));
  EXPECT_TRUE(camera.depth && camera.classes && camera.ids);
  check_mounts(rig, load_scene(SWELL_SOURCE_DIR "/scenes/harbour.toml"));
  try {
    check_mounts(rig, load_scene(SWELL_SOURCE_DIR "/scenes/open_ocean.toml"));
    ADD_FAILURE() << "a body on an object that is not there";
  } catch (const SceneError& error) {
    EXPECT_STREQ(error.what(),
                 "rig.toml:11: column 9: body[0].mount, got \"launch\", allowed the name of an "
                 "object of the scene, which has none");
  }
}

TEST(Rig, TakesSettingsAndHasDefaultsByKind) {
  const std::string text = "[[imu]]\nname = \"a\"\n[[altimeter]]\nname = \"b\"\n";
  const std::string settings[] = {"imu[0].rate_hz=12.5", "altimeter[0].rpy_deg=[0, 30, 0]"};
  const Rig plain = parse_rig(text, "rig.toml", {}), set = parse_rig(text, "rig.toml", settings);
  ASSERT_EQ(plain.sensors.size(), 2u);  // in the order of the kinds
  EXPECT_EQ(plain.sensors[0].kind, SensorKind::kAltimeter);
  EXPECT_EQ(plain.sensors[1].rate_hz, 100.0);
  EXPECT_EQ(set.sensors[1].rate_hz, 12.5);
  EXPECT_DOUBLE_EQ(plain.sensors[0].rpy_rad.y, radians(90.0));  // it looks down
  EXPECT_DOUBLE_EQ(set.sensors[0].rpy_rad.y, radians(30.0));
}

TEST(Rig, EveryKeyThatItsTextListsIsTaken) {
  std::istringstream lines(rig_keys_text());
  std::string table;
  int keys = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("[[")) table = line.substr(2, line.find("]]") - 2);
    if (!line.starts_with("  ") || table.empty() || table == "body.path") continue;
    const std::string key = line.substr(2, line.find(' ', 2) - 2);
    const std::string error = rig_error(fmt::format("[[{}]]\n{} = []\n", table, key));
    EXPECT_NE(error.find(fmt::format("{}[0].{}, got", table, key)), std::string::npos) << error;
    ++keys;
  }
  EXPECT_GT(keys, 40);
}

// Bytes changed, lines left out, doubled and put elsewhere, values of other keys.
TEST(Rig, TenThousandDamagedOnesAreTakenOrRefusedByALine) {
  const std::string whole = harbour_boat();
  std::mt19937_64 random(5);
  const auto below = [&](std::size_t most) { return static_cast<std::size_t>(random() % most); };
  constexpr std::string_view kPieces[] = {"\"", "[[", "]]", "[", "]", "=", "nan", "-1e309", "1e300",
                                          "\n", "#",  "0",  "{", "}", ".", "'",   "path",   "true"};
  int refused = 0;
  for (int trial = 0; trial < 10000; ++trial) {
    std::string text = whole;
    for (std::size_t edit = below(4) + 1; edit > 0; --edit) {
      const std::size_t at = below(text.size()), length = below(40);
      switch (below(4)) {
        case 0:
          text[at] = static_cast<char>(random());
          break;
        case 1:
          text.erase(at, length);
          break;
        case 2:
          text.insert(below(text.size()), text.substr(at, length));
          break;
        default:
          text.insert(at, kPieces[below(std::size(kPieces))]);
      }
    }
    const std::string error = rig_error(text);
    refused += !error.empty();
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  }
  EXPECT_GT(refused, 5000);
}

}  // namespace
}  // namespace swell::scene
