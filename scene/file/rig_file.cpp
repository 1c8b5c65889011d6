// Reads rigs: tables of the text -> values checked against the tables of keys -> Rig.
#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>

#include "math/parallel.h"
#include "scene/file/checked_values.h"
#include "scene/file/rig.h"
#include "scene/file/rig_parameters.h"
#include "scene/file/scene_tables.h"
#include "scene/file/spelling.h"
#include "scene/scene.h"
#include "scene/scene_error.h"

namespace swell::scene {
namespace {

namespace fs = std::filesystem;

using Names = std::vector<std::string_view>;

template <class Object>
Names keys_of(const std::vector<Parameter<Object>>& parameters) {
  Names names;
  for (const Parameter<Object>& parameter : parameters) names.push_back(parameter.key);
  return names;
}

// Whether ROS takes it as a name of frames and, with "/" before it, of topics.
bool is_ros_name(std::string_view name) {
  const auto is_letter = [](char c) { return (c | 0x20) >= 'a' && (c | 0x20) <= 'z'; };
  const auto is_right = [&](char before, char c) {
    if (is_letter(c) || (c == '_' && before != '_')) return true;
    return before == '/' ? false : c == '/' || (c >= '0' && c <= '9');
  };
  char before = '/';
  for (const char c : name) {
    if (!is_right(before, c)) return false;
    before = c;
  }
  return before != '/' && name.size() <= 100;
}
constexpr std::string_view kNames =
    "letters, digits and single _, parts with / between them that begin with no digit";

class RigReader {
 public:
  explicit RigReader(const fs::path& file) : file_(file) {}

  Rig read(const toml::table& root) {
    read_top(root, "");
    std::ranges::stable_sort(rig_.sensors, {}, &Sensor::kind);
    rig_.places = {file_, std::move(given_)};
    check_bodies();
    check_sensors();
    return std::move(rig_);
  }

 private:
  // The tables at the top and what stands beside them; `prefix` is "" or "origin.".
  void read_top(const toml::table& table, const std::string& prefix) {
    for (const auto& [key, node, key_place] : in_file_order(table)) {
      const std::string path = prefix + std::string(key);
      const auto parameter = std::ranges::find(top_, path, &Parameter<Rig>::key);
      if (parameter != top_.end())
        take(*node, path, *parameter, rig_);
      else if (path == "origin" && node->is_table())
        read_top(*node->as_table(), "origin.");
      else if (path == kBodiesKey)
        read_tables(*node, path, kMostBodies,
                    [&](const auto& body, const auto& its_path) { read_body(body, its_path); });
      else if (const auto kind = std::ranges::find(kSensorKinds, path, &SensorKindFacts::name);
               kind != kSensorKinds.end())
        read_sensors(*node, static_cast<SensorKind>(kind - kSensorKinds.begin()));
      else
        fail_unknown(key_place, path, known_at_top(), "");
    }
  }

  Names known_at_top() const {
    Names names = keys_of(top_);
    names.push_back(kBodiesKey);
    for (const SensorKindFacts& facts : kSensorKinds) names.push_back(facts.name);
    return names;
  }

  [[noreturn]] void fail_unknown(const Place& place, std::string_view path, const Names& known,
                                 std::string_view table) const {
    const std::string_view key = path.substr(table.empty() ? 0 : path.rfind('.') + 1);
    fail(file_, place,
         fmt::format("unknown key, got '{}'{}, allowed {}", shortened(path),
                     did_you_mean(key, known), fmt::join(known, ", ")));
  }

  template <class Object>
  void take(const toml::node& node, const std::string& path, const Parameter<Object>& parameter,
            Object& object) {
    parameter.set(object, values_.value(node, path, parameter));
    given_.emplace(path, place_of(node.source()));
  }

  // The tables [[key]], of which read() takes each with its path.
  template <class Read>
  void read_tables(const toml::node& node, const std::string& key, std::size_t most,
                   const Read& read) {
    const std::string allowed = fmt::format("at most {} tables [[{}]]", most, key);
    const toml::array* tables = node.as_array();
    if (!tables || tables->size() > most) values_.fail_value(node, key, got_text(node), allowed);
    std::size_t index = 0;
    for (const toml::node& element : *tables) {
      if (!element.is_table()) values_.fail_value(element, key, got_text(element), allowed);
      const std::string path = fmt::format("{}[{}]", key, index++);
      given_.emplace(path, place_of(element.source()));
      read(*element.as_table(), path);
    }
  }

  template <class Object>
  void read_keys(const toml::table& table, const std::string& path,
                 const std::vector<Parameter<Object>>& parameters, Object& object) {
    for (const auto& [key, node, key_place] : in_file_order(table)) {
      const auto parameter = std::ranges::find(parameters, key, &Parameter<Object>::key);
      const std::string its_path = fmt::format("{}.{}", path, key);
      if (parameter == parameters.end())
        fail_unknown(key_place, its_path, keys_of(parameters), path);
      take(*node, its_path, *parameter, object);
    }
  }

  void read_body(const toml::table& table, const std::string& path) {
    RigBody body;
    Names known = keys_of(body_);
    known.push_back(kBodyPathKey);
    for (const auto& [key, node, key_place] : in_file_order(table)) {
      const auto parameter = std::ranges::find(body_, key, &Parameter<RigBody>::key);
      const std::string its_path = fmt::format("{}.{}", path, key);
      if (parameter != body_.end())
        take(*node, its_path, *parameter, body);
      else if (key == kBodyPathKey)
        read_tables(*node, its_path, kMaxWaypoints, [&](const auto& point, const auto& at) {
          read_keys(point, at, waypoint_, body.path.emplace_back(common_waypoint()));
        });
      else
        fail_unknown(key_place, its_path, known, path);
    }
    rig_.bodies.push_back(std::move(body));
  }

  void read_sensors(const toml::node& node, SensorKind kind) {
    const std::vector<Parameter<Sensor>> parameters = sensor_parameters(kind);
    read_tables(node, std::string(kSensorKinds[kind].name), kMostSensorsOfAKind,
                [&](const toml::table& table, const std::string& path) {
                  Sensor sensor = common_sensor(kind);
                  read_keys(table, path, parameters, sensor);
                  rig_.sensors.push_back(std::move(sensor));
                });
  }

  // ---- What does not go together

  void check_name(const std::string& key, const std::string& name, Names& taken) const {
    if (!is_ros_name(name))
      refuse_key(rig_, key, fmt::format("got \"{}\", allowed {}", shortened(name), kNames));
    check_once(key, name, taken);
  }

  void check_once(const std::string& key, const std::string& name, Names& taken) const {
    if (std::ranges::count(taken, name) > 0)
      refuse_key(rig_, key, fmt::format("got \"{}\" twice, allowed once", shortened(name)));
    taken.push_back(name);
  }

  void check_bodies() const {
    Names taken = {"map", "odom"}, moved;
    for (std::size_t n = 0; n < rig_.bodies.size(); ++n) {
      const RigBody& body = rig_.bodies[n];
      const std::string key = fmt::format("{}[{}]", kBodiesKey, n);
      check_name(key + ".frame", body.frame, taken);
      const bool is_object = !body.mount.empty() && !body.is_input;
      const int poses =
          is_object + body.position_m.has_value() + !body.path.empty() + body.is_input;
      if (poses != 1)
        refuse_key(
            rig_, key,
            fmt::format(
                "got {}, allowed one of mount, position_m, [[body.path]] and pose = \"input\"",
                poses == 0 ? "no pose" : "several poses"));
      if (body.is_input && !body.mount.empty()) check_once(key + ".mount", body.mount, moved);
      for (std::size_t i = 1; i < body.path.size(); ++i)
        if (!(body.path[i].t_s > body.path[i - 1].t_s))
          refuse_key(rig_, fmt::format("{}.{}[{}].t_s", key, kBodyPathKey, i),
                     fmt::format("got {} after {}, allowed later times", body.path[i].t_s,
                                 body.path[i - 1].t_s));
    }
  }

  void check_sensors() const {
    Names taken = {"tf", "tf_static", "clock"};
    for (const Sensor& sensor : rig_.sensors) {
      const std::string key = sensor_key(rig_, sensor);
      check_name(key + ".name", sensor.name, taken);
      check_names_beside(key + ".name", sensor);
      if (sensor.body.empty() && kSensorKinds[sensor.kind].needs_body)
        refuse_key(rig_, key + ".body", "got none, allowed the frame of a body");
      if (!sensor.body.empty() && !rig_.find_body(sensor.body))
        refuse_key(rig_, key + ".body",
                   fmt::format("got \"{}\", allowed the frame of a body{}", shortened(sensor.body),
                               frames_text()));
      if (!(sensor.nearest_m < sensor.farthest_m))
        refuse_key(rig_, key + ".nearest_m",
                   fmt::format("got {}, allowed less than farthest_m, {}", sensor.nearest_m,
                               sensor.farthest_m));
      if (sensor.lidar.moments > 1 && !sensor.lidar.rolling_shutter)
        refuse_key(rig_, key + ".moments",
                   fmt::format("got {} without rolling_shutter, allowed 1", sensor.lidar.moments));
      constexpr double kSlowestTurn_hz = 0.25;  // points have their time in 32 bits
      if (sensor.lidar.rolling_shutter && sensor.rate_hz < kSlowestTurn_hz)
        refuse_key(rig_, key + ".rolling_shutter",
                   fmt::format("got true at {} Hz, allowed at {} Hz and more", sensor.rate_hz,
                               kSlowestTurn_hz));
    }
  }

  // Topics are a name, or lie below it; frames are a name with an ending.
  void check_names_beside(const std::string& key, const Sensor& sensor) const {
    for (const Sensor& other : rig_.sensors)
      if (sensor.name.starts_with(other.name + '/'))
        refuse_key(rig_, key,
                   fmt::format("got \"{}\" below the sensor \"{}\", allowed others", sensor.name,
                               other.name));
    for (const std::string& frame : {sensor_frame(sensor), optical_frame_name(sensor)})
      if (rig_.find_body(frame))
        refuse_key(rig_, key,
                   fmt::format("got \"{}\", whose frame \"{}\" is a body's, allowed others",
                               sensor.name, frame));
  }

  std::string frames_text() const {
    Names frames;
    for (const RigBody& body : rig_.bodies) frames.push_back(body.frame);
    if (frames.empty()) return ", of which there is none";
    return fmt::format(": \"{}\"", fmt::join(frames, "\", \""));
  }

  fs::path file_;
  std::vector<Parameter<Rig>> top_ = rig_parameters();
  std::vector<Parameter<RigBody>> body_ = body_parameters();
  std::vector<Parameter<Waypoint>> waypoint_ = body_path_parameters();
  Rig rig_;
  Places given_;
  CheckedValues values_{file_, given_};
};

}  // namespace

const RigBody* Rig::find_body(std::string_view frame) const {
  const auto found = std::ranges::find(bodies, frame, &RigBody::frame);
  return found == bodies.end() ? nullptr : &*found;
}

std::string sensor_frame(const Sensor& sensor) { return sensor.name + "_link"; }

std::string optical_frame_name(const Sensor& camera) { return camera.name + "_optical_frame"; }

std::string sensor_key(const Rig& rig, const Sensor& sensor) {
  const auto first = std::ranges::find(rig.sensors, sensor.kind, &Sensor::kind);
  return fmt::format("{}[{}]", kSensorKinds[sensor.kind].name, &sensor - &*first);
}

void refuse_key(const Rig& rig, const std::string& key, const std::string& text) {
  fail(rig.places.file, place_of_key(rig.places.places, key), fmt::format("{}, {}", key, text));
}

Rig load_rig(const fs::path& path, std::span<const std::string> settings) {
  return parse_rig(read_tables_text(path, "rig"), path, settings);
}

Rig parse_rig(std::string_view text, const fs::path& file_name,
              std::span<const std::string> settings) {
  const ScopedFloatEnvironment ieee;
  return RigReader(file_name).read(parse_tables(text, file_name, settings));
}

void check_mounts(const Rig& rig, const Scene& scene) {
  for (std::size_t n = 0; n < rig.bodies.size(); ++n) {
    const std::string& mount = rig.bodies[n].mount;
    if (mount.empty() || std::ranges::count(scene.objects, mount, &FloatingObject::name) > 0)
      continue;
    Names names;
    for (const FloatingObject& object : scene.objects)
      if (!object.name.empty()) names.push_back(object.name);
    refuse_key(
        rig, fmt::format("{}[{}].mount", kBodiesKey, n),
        fmt::format("got \"{}\", allowed the name of an object of the scene{}", shortened(mount),
                    names.empty() ? std::string(", which has none")
                                  : fmt::format(": \"{}\"", fmt::join(names, "\", \""))));
  }
}

}  // namespace swell::scene
