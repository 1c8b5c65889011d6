// Reads scene files: tables of the text -> values checked against the table of parameters -> Scene.
#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "math/parallel.h"
#include "ocean/open_sea/map_sets.h"
#include "ocean/spectrum/sea_scale.h"
#include "scene/check_scene.h"
#include "scene/file/checked_values.h"
#include "scene/file/implicit_file.h"
#include "scene/file/parameters.h"
#include "scene/file/scene_tables.h"
#include "scene/file/sea_state.h"
#include "scene/file/spelling.h"
#include "scene/scene.h"
#include "scene/settings.h"
#include "sky/celestial.h"
#include "sky/sky_light.h"

namespace swell::scene {
namespace {

namespace fs = std::filesystem;

constexpr double kMaxWind_mps = 60.0;

// Where else a file has something, for messages.
std::string line_text(const Place& place) {
  if (!place.setting.empty()) return " in a " + place.setting;
  return place.line > 0 ? fmt::format(" in line {}", place.line) : "";
}

// Reads one file's tables into a scene.
class Reader {
 public:
  explicit Reader(const fs::path& file)
      : file_(file),
        parameters_(scene_parameters()),
        swell_parameters_(swell_parameters()),
        sine_parameters_(sine_parameters()),
        map_parameters_(map_parameters()),
        cumulus_parameters_(cumulus_parameters()),
        waypoint_parameters_(waypoint_parameters()),
        object_parameters_(object_parameters()),
        disturbance_parameters_(disturbance_parameters()),
        river_parameters_(river_parameters()),
        lake_parameters_(lake_parameters()),
        tree_parameters_(tree_parameters()) {}

  Scene read(const toml::table& root) {
    scene_.name = file_.stem().string();
    read_table(root, "");
    check_replacements();
    apply_maps();
    apply_sea_state();
    apply_water_type();
    finish_coast();
    if (sky::is_gradient(scene_.sky)) scene_.sky.model = SkyModel::kGradient;
    apply_time();
    scene_.sky.sun_direction =
        sky::sun_direction(scene_.sky.sun_azimuth_rad, scene_.sky.sun_elevation_rad);
    if (const auto fault = find_disagreement(scene_))
      fail(file_, place_of_key(given_, fault->key), fault_text(*fault));
    scene_.places = std::make_shared<const KeyPlaces>(file_, std::move(given_));
    return std::move(scene_);
  }

 private:
  void read_table(const toml::table& table, const std::string& prefix) {
    for (const auto& [key, node, key_place] : in_file_order(table)) {
      const std::string path = prefix + std::string(key);
      const auto parameter = std::ranges::find(parameters_, path, &Parameter<Scene>::key);
      if (key.find('.') != std::string_view::npos) {  // in quotes: no table was begun for it
        fail_unknown(key_place, std::string_view(prefix).substr(0, prefix.find_last_of('.')), key);
      } else if (parameter != parameters_.end()) {
        parameter->set(scene_, values_.value(*node, path, *parameter));
        given_.emplace(path, place_of(node->source()));
      } else if (path == kSwellKey) {
        read_tables(*node, kSwellKey, ocean::kMaxSwells, swell_parameters_, scene_.sea.swells);
      } else if (path == kSinesKey) {
        read_tables(*node, kSinesKey, ocean::kMaxSines, sine_parameters_, scene_.sea.sines);
      } else if (path == kMapsKey) {
        read_tables(*node, kMapsKey, ocean::kMaxPatches, map_parameters_, scene_.sea.maps);
      } else if (path == kCumulusKey) {
        read_tables(*node, kCumulusKey, kMaxCumulus, cumulus_parameters_, scene_.clouds.cumulus);
      } else if (path == kObjectsKey) {
        read_tables(*node, kObjectsKey, kMaxObjects, object_parameters_, scene_.objects);
      } else if (path == kDisturbancesKey) {
        read_tables(*node, kDisturbancesKey, kMaxDisturbances, disturbance_parameters_,
                    scene_.disturbances);
      } else if (path == kRiversKey) {
        read_tables(*node, kRiversKey, kMaxRivers, river_parameters_, scene_.rivers);
      } else if (path == kLakesKey) {
        read_tables(*node, kLakesKey, kMaxLakes, lake_parameters_, scene_.lakes);
      } else if (path == kTreesKey) {
        read_tables(*node, kTreesKey, kMaxTreeStands, tree_parameters_, scene_.trees);
      } else if (path == kPathKey) {
        read_tables(*node, kPathKey, kMaxWaypoints, waypoint_parameters_, scene_.camera.path);
      } else if (path == kImplicitsKey) {
        continue;  // what objects of kind "form" that name this file read in it
      } else if (is_section(path)) {
        read_section(*node, path);
      } else {
        fail_unknown(key_place, std::string_view(prefix).substr(0, prefix.find_last_of('.')), key);
      }
    }
  }

  // Sun and moon as they stand at sky.time_utc.
  void apply_time() {
    if (scene_.sky.time_utc.empty()) return;
    const std::optional<double> days = sky::parse_time_utc(scene_.sky.time_utc);
    if (days) sky::place_sun_and_moon(*days, scene_.sky);
  }

  // Maps take the spectrum's place, and a set has a wind.
  void apply_maps() {
    ocean::SeaDescription& sea = scene_.sea;
    if (!sea.has_maps()) return;
    if (!given_.contains("sea.spectrum")) sea.spectrum = false;
    if (sea.map_set != ocean::MapSet::kNone && !given_.contains("wind.speed_mps"))
      sea.wind_speed_mps = ocean::wind_of_set_mps(sea.map_set);
  }

  // Wind and patch lengths from sea.douglas or sea.beaufort.
  void apply_sea_state() {
    check_only_one_of({"sea.douglas", "sea.beaufort", "wind.speed_mps"});
    check_only_one_of({"sea.douglas", "sea.hs_m"});
    check_only_one_of({"sea.douglas", "sea.tp_s"});
    check_only_one_of({"sea.douglas", "sea.fetch_km"});
    if (scene_.douglas || scene_.beaufort) set_wind();
    fit_patches();
  }

  void apply_water_type() {
    WaterOptics& water = scene_.water;
    if (water.type == WaterType::kNone) return;
    const InherentOptics optics = optics_of(water.type);
    if (!given_.contains("water.body_colour"))
      water.body_colour = glm::vec3(colour_of_deep_water(optics));
    if (!given_.contains("water.absorption_per_m"))
      water.absorption_per_m = glm::vec3(picture_attenuation(optics));
  }

  void set_wind() {
    ocean::SeaDescription& sea = scene_.sea;
    const double gravity = sea.gravity_mps2;
    sea.wind_speed_mps = scene_.douglas ? wind_of_sea_state_mps(*scene_.douglas, gravity)
                                        : ocean::beaufort_step(*scene_.beaufort).preset;
    if (sea.wind_speed_mps > kMaxWind_mps)
      fail(file_, given_.at("sea.douglas"),
           fmt::format("sea.douglas, got {} with a gravity of {} m/s^2, which takes a wind of "
                       "{:.3g} m/s, allowed {} m/s",
                       *scene_.douglas, gravity, sea.wind_speed_mps, kMaxWind_mps));
  }

  // Patches that hold the sea that was asked for, unless they or no more than a wind are given.
  void fit_patches() {
    ocean::SeaDescription& sea = scene_.sea;
    const bool asked = scene_.douglas || scene_.beaufort || sea.hs_m || sea.tp_s || sea.fetch_km ||
                       !sea.swells.empty();
    if (!asked || given_.contains("sea.patch_lengths_m")) return;
    sea.patch_lengths_m = fitting_patch_lengths(sea);
  }

  void finish_coast() {
    if (!scene_.terrain || scene_.terrain->coast_m.empty()) return;
    if (!scene_.terrain->height_image.empty())
      check_only_one_of({"terrain.height_image", "terrain.coast_m"});
    if (!given_.contains("coast.model")) scene_.coast.model = CoastModel::kBlend;
  }

  void check_replacements() const {
    for (const auto& [key, replaced] : kReplacements)
      if (std::ranges::find(parameters_, key, &Parameter<Scene>::key)->is_set(scene_))
        check_only_one_of({std::string(key), std::string(replaced)});
  }

  // The keys set the same thing.
  void check_only_one_of(std::initializer_list<std::string> keys) const {
    const std::string* first = nullptr;
    for (const std::string& key : keys) {
      if (!given_.contains(key)) continue;
      if (first)
        fail(file_, given_.at(key),
             fmt::format("{}, got it besides {}{}, allowed one of {}", key, *first,
                         line_text(given_.at(*first)), fmt::join(keys, ", ")));
      first = &key;
    }
  }

  bool is_section(std::string_view path) const {
    const std::string prefix = std::string(path) + ".";
    return std::ranges::any_of(parameters_,
                               [&](const auto& p) { return p.key.starts_with(prefix); });
  }

  void read_section(const toml::node& node, const std::string& path) {
    if (!node.is_table()) values_.fail_value(node, path, got_text(node), "a table");
    given_.emplace(path, place_of(node.source()));
    if (path == "terrain") scene_.terrain.emplace();
    read_table(*node.as_table(), path + ".");
  }

  // The tables [[key]], one object each.
  template <class Object>
  void read_tables(const toml::node& node, std::string_view key, std::size_t count_high,
                   const std::vector<Parameter<Object>>& parameters, std::vector<Object>& objects) {
    const std::string allowed = fmt::format("at most {} tables [[{}]]", count_high, key);
    const toml::array* tables = node.as_array();
    if (!tables || tables->size() > count_high)
      values_.fail_value(node, std::string(key), got_text(node), allowed);
    given_.emplace(key, place_of(node.source()));
    for (const toml::node& element : *tables) {
      if (!element.is_table())
        values_.fail_value(element, std::string(key), got_text(element), allowed);
      given_.emplace(fmt::format("{}[{}]", key, objects.size()), place_of(element.source()));
      objects.push_back(
          read_object(*element.as_table(), key, static_cast<int>(objects.size()), parameters));
    }
  }

  // `index` is the table's number among those of its key.
  template <class Object>
  Object read_object(const toml::table& table, std::string_view table_key, int index,
                     const std::vector<Parameter<Object>>& parameters) {
    Object object = object_for<Object>(table);
    for (const auto& [key, node, key_place] : in_file_order(table)) {
      const auto parameter = std::ranges::find(parameters, key, &Parameter<Object>::key);
      if (parameter == parameters.end()) fail_unknown(key_place, table_key, key);
      const std::string path = fmt::format("{}[{}].{}", table_key, index, key);
      parameter->set(object, values_.value(*node, path, *parameter));
      given_.emplace(path, place_of(node->source()));
      if constexpr (std::is_same_v<Object, FloatingObject>)
        if (parameter->kind == ParameterKind::kPath)
          object.file_place = place_text(file_, place_of(node->source()));
    }
    return object;
  }

  // Makes an object of the defaults that the other keys change.
  template <class Object>
  static Object object_for(const toml::table& table) {
    if constexpr (std::is_same_v<Object, FloatingObject>) {
      const auto name = table["kind"].value<std::string_view>();
      const auto kind = std::ranges::find(kObjectKindNames, name.value_or(""));
      if (kind != kObjectKindNames.end())
        return common_object(static_cast<ObjectKind>(kind - kObjectKindNames.begin()));
    }
    return Object();
  }

  // `table` is the path of the key's table, or empty.
  [[noreturn]] void fail_unknown(const Place& place, std::string_view table,
                                 std::string_view key) const {
    const std::string shown = shortened(key, 100);
    const std::string prefix = table.empty() ? "" : fmt::format("{}.", table);
    const std::string where = table.empty() ? "" : fmt::format(" in [{}]", table);
    const std::vector<std::string> known = known_in_table(table, shown);
    fail(file_, place,
         fmt::format("unknown key, got '{}{}'{}, allowed{} {}", prefix, shown,
                     meant_key(key, known), where, fmt::join(known, ", ")));
  }

  // Asks for the nearest of the table's keys, as they are listed, or for one of another table with
  // this name.
  std::string meant_key(std::string_view key, std::span<const std::string> known) const {
    std::vector<std::string_view> names;  // without brackets and the table's
    for (std::string_view text : known) {
      text.remove_prefix(std::min(text.find_first_not_of('['), text.size()));
      text = text.substr(0, text.find(']'));
      names.push_back(text.substr(text.find_last_of('.') + 1));
    }
    if (const std::string meant = did_you_mean(key, names); !meant.empty()) return meant;
    const std::string end = fmt::format(".{}", key);
    const auto elsewhere = std::ranges::find_if(
        parameters_, [&](const auto& parameter) { return parameter.key.ends_with(end); });
    return elsewhere == parameters_.end() ? "" : did_you_mean(elsewhere->key);
  }

  // The keys of a table and, in brackets, the tables in it; those most like `key` first.
  std::vector<std::string> known_in_table(std::string_view table, const std::string& key) const {
    struct Known {
      std::string text;
      int unlikeness;
    };
    // Edits; those that the lengths take count half, for keys that were cut short.
    const auto unlikeness = [&](std::string_view name) {
      return 2 * edit_distance(key, name) -
             std::abs(static_cast<int>(std::ssize(key) - std::ssize(name)));
    };
    std::vector<Known> known;
    const std::string prefix = table.empty() ? "" : fmt::format("{}.", table);
    const auto add = [&](std::string_view path, bool is_array) {
      if (!path.starts_with(prefix)) return;
      const std::string_view rest = path.substr(prefix.size());
      const std::string_view name = is_array ? rest : rest.substr(0, rest.find('.'));
      std::string text(name);
      if (is_array || name != rest) text = fmt::format("[{}{}]", prefix, name);
      if (is_array) text = '[' + text + ']';
      if (std::ranges::find(known, text, &Known::text) == known.end())
        known.push_back({text, unlikeness(name)});
    };
    const auto add_tables = [&](std::string_view path, const auto& parameters) {
      if (table != path) return add(path, true);
      for (const auto& p : parameters) known.push_back({std::string(p.key), unlikeness(p.key)});
    };
    for (const auto& parameter : parameters_) add(parameter.key, false);
    add_tables(kSwellKey, swell_parameters_);
    add_tables(kSinesKey, sine_parameters_);
    add_tables(kMapsKey, map_parameters_);
    add_tables(kCumulusKey, cumulus_parameters_);
    add_tables(kPathKey, waypoint_parameters_);
    add_tables(kObjectsKey, object_parameters_);
    add_tables(kDisturbancesKey, disturbance_parameters_);
    add_tables(kRiversKey, river_parameters_);
    add_tables(kLakesKey, lake_parameters_);
    add_tables(kTreesKey, tree_parameters_);
    std::ranges::stable_sort(known, {}, &Known::unlikeness);
    std::vector<std::string> texts;
    for (Known& one : known) texts.push_back(std::move(one.text));
    return texts;
  }

  fs::path file_;
  std::vector<Parameter<Scene>> parameters_;
  std::vector<Parameter<ocean::Swell>> swell_parameters_;
  std::vector<Parameter<ocean::SineWave>> sine_parameters_;
  std::vector<Parameter<ocean::MapLayer>> map_parameters_;
  std::vector<Parameter<Cumulus>> cumulus_parameters_;
  std::vector<Parameter<Waypoint>> waypoint_parameters_;
  std::vector<Parameter<FloatingObject>> object_parameters_;
  std::vector<Parameter<ocean::Disturbance>> disturbance_parameters_;
  std::vector<Parameter<ocean::River>> river_parameters_;
  std::vector<Parameter<ocean::Lake>> lake_parameters_;
  std::vector<Parameter<terrain::TreeStand>> tree_parameters_;
  Scene scene_;
  Places given_;
  CheckedValues values_{file_, given_};
};

}  // namespace

Scene load_scene(const fs::path& path) { return load_scene(path, {}); }

Scene load_scene(const fs::path& path, std::span<const std::string> settings) {
  return parse_scene(read_tables_text(path, "scene file"), path, settings);
}

Scene parse_scene(std::string_view text, const fs::path& file_name) {
  return parse_scene(text, file_name, {});
}

Scene parse_scene(std::string_view text, const fs::path& file_name,
                  std::span<const std::string> settings) {
  const ScopedFloatEnvironment ieee;
  return Reader(file_name).read(parse_tables(text, file_name, settings));
}

}  // namespace swell::scene
