#include "scene/file/recipe.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <array>
#include <cmath>
#include <fstream>
#include <sstream>

#include "math/random.h"
#include "scene/file/parameters.h"
#include "scene/file/scene_tables.h"
#include "scene/file/spelling.h"
#include "scene/settings.h"

namespace swell::scene {
namespace {

namespace fs = std::filesystem;

constexpr int kMostSide_px = 8192;
constexpr double kMostTime_s = 1e6, kMostDistance_m = 1e5;
constexpr int kMostOfAKind = 200;

std::string text_of(const toml::node& node) {
  std::ostringstream text;
  node.visit([&](const auto& value) {
    using Value = std::decay_t<decltype(value)>;
    if constexpr (toml::is_array<Value> || toml::is_table<Value>)
      text << toml::toml_formatter(value, toml::format_flags::none);
    else
      text << value;
  });
  std::string line = text.str();
  for (char& c : line)
    if (c == '\n') c = ' ';
  return line;
}

std::string setting(std::string_view key, std::string_view value) {
  return fmt::format("{}={}", key, value);
}

std::string read_file(const fs::path& path) {
  std::error_code ignored;
  std::ifstream file;
  if (fs::is_regular_file(path, ignored)) file.open(path, std::ios::binary);
  if (!file.is_open())
    throw SceneError(one_line(fmt::format(
        "{}: recipe, got no file that can be read, allowed a TOML file", path.string())));
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

class RecipeReader {
 public:
  explicit RecipeReader(const fs::path& file) { recipe_.file = file; }

  Recipe read(std::string_view text) {
    toml::table root = parse_tables(text, recipe_.file, {});
    known(root, "",
          {"scene", "seed", "count", "size_px", "labels", "classes", "range", "choice", "objects"});
    read_scene(root);
    recipe_.seed = static_cast<std::uint64_t>(whole(root, "seed", 1, 0, INT64_MAX));
    if (!root.contains("count")) fault(root, "count, got none", "how many samples there are");
    recipe_.count = static_cast<int>(whole(root, "count", 0, 1, kMostSamples));
    const auto size = pair(root, "size_px", {640, 360}, 1, kMostSide_px, true);
    recipe_.width_px = static_cast<int>(size[0]);
    recipe_.height_px = static_cast<int>(size[1]);
    recipe_.labels = text_value(root, "labels", "");
    recipe_.classes = text_value(root, "classes", "swell");
    read_leaves(root, "range", [&](const auto& key, const auto& node) { add_range(key, node); });
    read_leaves(root, "choice", [&](const auto& key, const auto& node) { add_choice(key, node); });
    read_objects(root);
    root.erase("count");
    recipe_.text = text_of(root);
    return std::move(recipe_);
  }

 private:
  [[noreturn]] void fault(const toml::node& node, const std::string& what,
                          const std::string& allowed) const {
    fail(recipe_.file, place_of(node.source()),
         fmt::format("{}, allowed {}", shortened(what, 300), allowed));
  }

  void known(const toml::table& table, std::string_view name,
             std::initializer_list<std::string_view> keys) const {
    for (const auto& [key, node] : table)
      if (std::ranges::find(keys, key.str()) == keys.end())
        fail(recipe_.file, place_of(key.source()),
             fmt::format("unknown key, got '{}{}'{}, allowed {}", name, shortened(key.str()),
                         did_you_mean(key.str(), std::vector(keys)), fmt::join(keys, ", ")));
  }

  std::string text_value(const toml::table& table, std::string_view key,
                         std::string_view standard) const {
    const toml::node* node = table.get(key);
    if (!node) return std::string(standard);
    if (!node->is_string()) fault(*node, fmt::format("{}, got {}", key, text_of(*node)), "a text");
    return node->as_string()->get();
  }

  std::int64_t whole(const toml::table& table, std::string_view key, std::int64_t standard,
                     std::int64_t low, std::int64_t high) const {
    const toml::node* node = table.get(key);
    if (!node) return standard;
    const auto* number = node->as_integer();
    if (!number || number->get() < low || number->get() > high)
      fault(*node, fmt::format("{}, got {}", key, text_of(*node)),
            fmt::format("whole numbers from {} to {}", low, high));
    return number->get();
  }

  // Reads two numbers in [low, high].
  std::array<double, 2> numbers(std::string_view key, const toml::node& node, double low,
                                double high, bool is_whole) const {
    const toml::array* array = node.as_array();
    std::array<double, 2> result{};
    bool is_right = array && array->size() == 2;
    for (std::size_t i = 0; is_right && i < 2; ++i) {
      const toml::node& element = *array->get(i);
      is_right = is_whole ? element.is_integer() : element.is_number();
      if (is_right) result[i] = *element.value<double>();
      is_right = is_right && result[i] >= low && result[i] <= high;
    }
    if (!is_right)
      fault(node, fmt::format("{}, got {}", key, text_of(node)),
            fmt::format("[A, B] of {} from {} to {}", is_whole ? "whole numbers" : "numbers", low,
                        high));
    return result;
  }

  // Reads two numbers likewise, where the first may not be over the second.
  std::array<double, 2> ends(std::string_view key, const toml::node& node, double low, double high,
                             bool is_whole) const {
    const auto result = numbers(key, node, low, high, is_whole);
    if (result[0] > result[1])
      fault(node, fmt::format("{}, got {}", key, text_of(node)), "[LOW, HIGH] with LOW <= HIGH");
    return result;
  }

  std::array<double, 2> pair(const toml::table& table, std::string_view key,
                             std::array<double, 2> standard, double low, double high,
                             bool is_whole) const {
    const toml::node* node = table.get(key);
    return node ? numbers(key, *node, low, high, is_whole) : standard;
  }

  void read_scene(const toml::table& root) {
    if (!root.contains("scene")) fault(root, "scene, got none", "the path of a scene file");
    recipe_.scene_text = text_value(root, "scene", "");
    recipe_.scene = recipe_.file.parent_path() / recipe_.scene_text;
  }

  // Keys may be dotted, and so tables in each other, or whole in quotes.
  template <class Add>
  void read_leaves(const toml::table& root, std::string_view name, const Add& add) {
    const toml::node* node = root.get(name);
    if (!node) return;
    if (!node->is_table()) fault(*node, fmt::format("{}, got {}", name, text_of(*node)), "a table");
    add_leaves(*node->as_table(), "", add);
  }

  template <class Add>
  void add_leaves(const toml::table& table, const std::string& prefix, const Add& add) {
    for (const auto& [key, node] : table) {
      const std::string path = prefix + std::string(key.str());
      if (const toml::table* inner = node.as_table())
        add_leaves(*inner, path + ".", add);
      else
        add(path, node);
    }
  }

  void once(const std::string& key, const toml::node& node) {
    if (std::ranges::find(keys_, key) != keys_.end())
      fault(node, fmt::format("{}, got it in [range] and in [choice]", key), "one of them");
    keys_.push_back(key);
  }

  void add_range(const std::string& key, const toml::node& node) {
    once(key, node);
    const double most = key == kTimeKey ? kMostTime_s : 1e15;
    const auto [low, high] = ends(key, node, -most, most, false);
    recipe_.ranges.push_back({key, low, high});
  }

  void add_choice(const std::string& key, const toml::node& node) {
    once(key, node);
    const toml::array* array = node.as_array();
    if (!array || array->empty())
      fault(node, fmt::format("{}, got {}", key, text_of(node)), "a list of one value or more");
    RecipeChoice choice{key, {}};
    for (const toml::node& element : *array) {
      if (key == kTimeKey) {
        const auto time = element.value<double>();
        if (!time || !(std::abs(*time) <= kMostTime_s))
          fault(element, fmt::format("t_s, got {}", text_of(element)),
                fmt::format("numbers up to {} s", kMostTime_s));
      }
      choice.values.push_back(text_of(element));
    }
    recipe_.choices.push_back(std::move(choice));
  }

  void read_objects(const toml::table& root) {
    const toml::node* node = root.get("objects");
    if (!node) return;
    const toml::array* tables = node->as_array();
    if (!tables) fault(*node, "objects, got no list of tables", "tables [[objects]]");
    for (const toml::node& element : *tables) {
      if (!element.is_table()) fault(element, "objects, got no table", "tables [[objects]]");
      add_objects(*element.as_table());
    }
  }

  void add_objects(const toml::table& table) {
    for (const std::string_view key : {"kind", "number", "distance_m"})
      if (!table.contains(key))
        fault(table, fmt::format("objects.{}, got none", key),
              "kind, number and distance_m in each");
    for (const std::string_view key : {"position_m", "path_m"})
      if (const toml::node* node = table.get(key))
        fault(*node, fmt::format("objects.{}, got it in a recipe", key),
              "none: the program finds places");
    RecipeObjects objects;
    const auto number = ends("objects.number", *table.get("number"), 0, kMostOfAKind, true);
    objects.fewest = static_cast<int>(number[0]);
    objects.most = static_cast<int>(number[1]);
    const auto distance =
        ends("objects.distance_m", *table.get("distance_m"), 1, kMostDistance_m, false);
    objects.nearest_m = distance[0];
    objects.farthest_m = distance[1];
    for (const auto& [key, node] : table)
      if (key.str() != "number" && key.str() != "distance_m")
        objects.settings.push_back(setting(key.str(), text_of(node)));
    recipe_.objects.push_back(std::move(objects));
  }

  Recipe recipe_;
  std::vector<std::string> keys_;
};

std::string number_text(const RecipeRange& range, double number) {
  return range.is_whole ? fmt::format("{}", static_cast<std::int64_t>(number))
                        : fmt::format("{}", number);
}

// What a key of the recipe may be, and the first of it.
struct Trial {
  std::string key;
  std::vector<std::string> values;
};

std::vector<Trial> trials_of(const Recipe& recipe) {
  std::vector<Trial> trials;
  for (const RecipeRange& r : recipe.ranges)
    if (r.key != kTimeKey)
      trials.push_back({r.key, {number_text(r, r.low), number_text(r, r.high)}});
  for (const RecipeChoice& c : recipe.choices)
    if (c.key != kTimeKey) trials.push_back({c.key, c.values});
  return trials;
}

std::vector<std::string> first_values(const std::vector<Trial>& trials) {
  std::vector<std::string> settings;
  for (const Trial& trial : trials) settings.push_back(setting(trial.key, trial.values[0]));
  return settings;
}

Scene scene_with_objects(const Recipe& recipe) {
  const std::size_t own = load_scene(recipe.scene).objects.size();
  std::vector<std::string> settings;
  for (std::size_t k = 0; k < recipe.objects.size(); ++k)
    for (std::string& one : object_settings(recipe.objects[k], own + k, {}))
      settings.push_back(std::move(one));
  return load_scene(recipe.scene, settings);
}

// Whether the scene takes whole numbers alone for a range whose ends it takes.
bool takes_whole_numbers(const Recipe& recipe, const RecipeRange& range) {
  const bool may_be = range.low < range.high && range.low == std::floor(range.low) &&
                      range.high == std::floor(range.high) && range.key != kTimeKey;
  if (!may_be) return false;
  std::vector<std::string> settings = first_values(trials_of(recipe));
  settings.push_back(setting(range.key, fmt::format("{}", range.low + 0.5)));
  try {
    load_scene(recipe.scene, settings);
    return false;
  } catch (const SceneError&) {
    return true;
  }
}

}  // namespace

Recipe load_recipe(const fs::path& path) {
  Recipe recipe = RecipeReader(path).read(read_file(path));
  for_each_trial(recipe, [](const Scene&) {});
  for (RecipeRange& range : recipe.ranges) range.is_whole = takes_whole_numbers(recipe, range);
  scene_of_all(recipe);
  return recipe;
}

void for_each_trial(const Recipe& recipe, FunctionRef<void(const Scene&)> visit) {
  visit(load_scene(recipe.scene));
  const std::vector<Trial> trials = trials_of(recipe);
  const std::vector<std::string> first = first_values(trials);
  visit(load_scene(recipe.scene, first));
  for (std::size_t k = 0; k < trials.size(); ++k)
    for (const std::string& value : trials[k].values) {
      std::vector<std::string> settings = first;
      settings[k] = setting(trials[k].key, value);
      visit(load_scene(recipe.scene, settings));
    }
  visit(scene_with_objects(recipe));
}

double draw_number(std::uint64_t seed, std::string_view name, std::uint64_t sample) {
  // FNV-1a. Source: Fowler, Noll, Vo, Eastlake, The FNV Non-Cryptographic Hash Algorithm, 2019.
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return random_uniform(random_bits(seed, hash), sample);
}

SampleDraw draw_sample(const Recipe& recipe, int sample) {
  SampleDraw draw;
  const auto number = [&](const std::string& key) {
    return draw_number(recipe.seed, key, static_cast<std::uint64_t>(sample));
  };
  const auto take = [&](const std::string& key, const std::string& value) {
    if (key == kTimeKey)
      draw.t_s = toml::parse("t = " + value)["t"].value<double>().value();
    else
      draw.settings.push_back(setting(key, value));
  };
  for (const RecipeRange& r : recipe.ranges) {
    const double u = number(r.key);
    const double value = r.is_whole ? r.low + std::floor(u * (r.high - r.low + 1.0))
                                    : std::min(r.low + u * (r.high - r.low), r.high);
    take(r.key, number_text(r, value));
  }
  for (const RecipeChoice& c : recipe.choices)
    take(c.key,
         c.values[static_cast<std::size_t>(number(c.key) * static_cast<double>(c.values.size()))]);
  return draw;
}

std::vector<std::string> object_settings(const RecipeObjects& objects, std::size_t index,
                                         std::span<const std::string> more) {
  std::vector<std::string> settings;
  for (const std::span<const std::string> some :
       {std::span<const std::string>(objects.settings), more})
    for (const std::string& key_value : some)
      settings.push_back(fmt::format("{}[{}].{}", kObjectsKey, index, key_value));
  return settings;
}

Scene scene_of_all(const Recipe& recipe) {
  Scene scene = scene_with_objects(recipe);
  for (const RecipeChoice& choice : recipe.choices) {
    if (!choice.key.starts_with("object[") || !choice.key.ends_with("].class")) continue;
    for (const std::string& value : choice.values) {
      FloatingObject object;
      object.label = toml::parse("t = " + value)["t"].value_or(std::string());
      scene.objects.push_back(object);
    }
  }
  return scene;
}

}  // namespace swell::scene
