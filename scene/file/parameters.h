// Every key of a scene file in one table, which drives parsing, checks, defaults, the dump of the
// effective scene and docs/look_up/scene.md (tests/scene compares it with the table).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "math/value_hash.h"
#include "scene/scene.h"

namespace swell::scene {

enum class ParameterKind : std::uint8_t {
  kNumber,      // one finite number; an integer will do
  kNumbers,     // an array of numbers, each in the range
  kPoints,      // an array of arrays of two such numbers
  kInteger,     // no decimal point
  kPowerOfTwo,  // an integer
  kBoolean,
  kChoice,  // one of `choices`
  kText,    // at most kMaxTextBytes
  kPath,    // text; relative to the scene file's folder
};

// A value as the file has it: degrees, not radians. The kinds above map to double lists (kNumber
// has one element, kPoints two a point), integers, booleans and text (kChoice, kText, kPath).
using ParameterValue = std::variant<std::vector<double>, std::int64_t, bool, std::string>;

template <class Object>
struct Parameter {
  std::string_view key;  // dotted: "camera.eye_m"
  ParameterKind kind;
  std::string_view unit;  // empty: none
  double low = 0.0, high = 0.0;
  bool zero_too = false;              // 0 is allowed although low > 0
  int count_low = 1, count_high = 1;  // of kNumbers and kPoints
  bool one_for_all = false;           // of kNumbers: one without an array stands for all of them
  std::span<const std::string_view> choices;
  std::string_view path_of = "picture";  // what a path is the name of
  bool is_of_frames = false;             // a path with one %04d, the number of the frame from 0
  std::string_view meaning;
  // get() gives a value that set() turns back into the same bits, with as few digits as possible.
  ParameterValue (*get)(const Object&);
  void (*set)(Object&, const ParameterValue&);
  void (*add_value)(const Object&, ValueBytes&);  // as the object holds it
  // False if the object has no value, nor a default. Null: always true.
  bool (*is_set)(const Object&) = nullptr;
};

// Keys of the scene, in the order of docs/look_up/scene.md. Those of "terrain." need scene.terrain.
std::vector<Parameter<Scene>> scene_parameters();

// Those of them that stand under [sky], [air] and [clouds].
std::vector<Parameter<Scene>> sky_parameters();
std::vector<Parameter<Scene>> air_parameters();
std::vector<Parameter<Scene>> cloud_parameters();

// Keys of one table of [[sea.swell]].
std::vector<Parameter<ocean::Swell>> swell_parameters();

// Keys of one table of [[sea.sines]].
std::vector<Parameter<ocean::SineWave>> sine_parameters();

// Keys of one table of [[sea.maps]].
std::vector<Parameter<ocean::MapLayer>> map_parameters();

// Keys of one table of [[clouds.cumulus]].
std::vector<Parameter<Cumulus>> cumulus_parameters();

// Keys of one table of [[camera.path]].
std::vector<Parameter<Waypoint>> waypoint_parameters();

// Keys of one table of [[object]].
std::vector<Parameter<FloatingObject>> object_parameters();

// Keys of one table of [[disturbance]].
std::vector<Parameter<ocean::Disturbance>> disturbance_parameters();

// Keys of one table of [[river]], and of [[lake]].
std::vector<Parameter<ocean::River>> river_parameters();
std::vector<Parameter<ocean::Lake>> lake_parameters();

// Keys of one table of [[trees]].
std::vector<Parameter<terrain::TreeStand>> tree_parameters();

inline constexpr std::size_t kMaxWaypoints = 200, kMaxObjects = 2000, kMaxDisturbances = 256,
                             kMaxTreeStands = 16;
inline constexpr std::size_t kMaxRivers = 64, kMaxLakes = 64;
inline constexpr int kMaxRiverPoints = 200;
inline constexpr int kMaxCoastPoints = 200, kMaxPathPoints = 100;
inline constexpr std::size_t kMaxTextBytes = 200;
inline constexpr std::string_view kSwellKey = "sea.swell", kSinesKey = "sea.sines",
                                  kMapsKey = "sea.maps", kPathKey = "camera.path",
                                  kCumulusKey = "clouds.cumulus", kObjectsKey = "object",
                                  kDisturbancesKey = "disturbance", kTreesKey = "trees",
                                  kRiversKey = "river", kLakesKey = "lake";

// A key that may be without a value, and one whose place it takes: a file has only one of them.
struct Replacement {
  std::string_view key, replaced;
};
inline constexpr std::array<Replacement, 15> kReplacements = {{
    {"air.attenuation_per_m", "air.visibility_m"},
    {"sky.time_utc", "sky.sun_azimuth_deg"},
    {"sky.time_utc", "sky.sun_elevation_deg"},
    {"sky.time_utc", "sky.moon_azimuth_deg"},
    {"sky.time_utc", "sky.moon_elevation_deg"},
    {"sky.time_utc", "sky.moon_phase"},
    {"camera.quaternion", "camera.heading_deg"},
    {"camera.quaternion", "camera.pitch_deg"},
    {"camera.quaternion", "camera.roll_deg"},
    {"camera.quaternion", "camera.turn_deg_s"},
    {"camera.focal_px", "camera.fov_y_deg"},
    {"camera.mount", "camera.eye_m"},
    {"camera.mount", "camera.velocity_mps"},
    {"sea.fetch_km", "sea.hs_m"},
    {"sea.fetch_km", "sea.tp_s"},
}};

// Whether the parameter allows a number, an integer, a choice or text; a list's number of numbers
// or points. Not NaN.
template <class Object>
bool allows(const Parameter<Object>& parameter, double number) {
  return (number >= parameter.low && number <= parameter.high) ||
         (parameter.zero_too && number == 0.0);
}
template <class Object>
bool allows(const Parameter<Object>& parameter, std::int64_t number) {
  // Not as doubles, which have 2^53 + 1 for 2^53.
  const auto low = static_cast<std::int64_t>(parameter.low);
  const auto high = static_cast<std::int64_t>(parameter.high);
  const bool fits = parameter.kind == ParameterKind::kInteger || (number & (number - 1)) == 0;
  return (number >= low && number <= high && fits) || (parameter.zero_too && number == 0);
}
template <class Object>
bool allows(const Parameter<Object>& parameter, std::string_view text) {
  if (parameter.kind == ParameterKind::kText) return text.size() <= kMaxTextBytes;
  return std::ranges::count(parameter.choices, text) > 0;
}
template <class Object>
bool allows_count(const Parameter<Object>& parameter, std::size_t count) {
  return count >= static_cast<std::size_t>(parameter.count_low) &&
         count <= static_cast<std::size_t>(parameter.count_high);
}

// One line without control characters, at most 600 bytes, cut between UTF-8 characters.
std::string one_line(std::string text);

// "1 to 170 deg", "true or false", ...
template <class Object>
std::string allowed_text(const Parameter<Object>& parameter);

// The parameter's value in `object` as TOML text that parses to the same value; empty if not set.
template <class Object>
std::string toml_text(const Parameter<Object>& parameter, const Object& object);

}  // namespace swell::scene
