// Recipes of data sets: a scene, and what of it differs from sample to sample.
//
//   const Recipe recipe = load_recipe("harbour.toml");
//   const SampleDraw draw = draw_sample(recipe, 17);
//   const Scene scene = load_scene(recipe.scene, draw.settings);  // at draw.t_s
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "math/parallel.h"
#include "scene/scene.h"

namespace swell::scene {

// Numbers of a key, evenly spread over [low, high].
struct RecipeRange {
  std::string key;  // of the scene, or kTimeKey
  double low = 0.0, high = 0.0;
  bool is_whole = false;  // the key takes whole numbers alone
};

// Values of a key, each as likely.
struct RecipeChoice {
  std::string key;
  std::vector<std::string> values;  // as TOML has them
};

// Objects that are put into the camera's view, in addition to the scene's own.
struct RecipeObjects {
  int fewest = 0, most = 0;
  double nearest_m = 0.0, farthest_m = 0.0;  // from the eye, on the map
  std::vector<std::string> settings;         // "kind=\"buoy\"": keys of [[object]]
};

// docs/do/datasets.md has the keys.
struct Recipe {
  std::filesystem::path file, scene;  // `scene` as a path that can be opened
  std::string scene_text;             // the same as the recipe has it
  std::uint64_t seed = 1;
  int count = 0;  // [1, kMostSamples]
  int width_px = 0, height_px = 0;
  std::vector<RecipeRange> ranges;
  std::vector<RecipeChoice> choices;
  std::vector<RecipeObjects> objects;
  std::string labels;             // "depth,motion", "all" or empty
  std::string classes = "swell";  // name of a set of classes
  std::string text;               // what decides a sample: the recipe without its count
};

inline constexpr int kMostSamples = 1'000'000;
inline constexpr std::string_view kTimeKey = "t_s";

// Reads a recipe. Every end of its ranges, each of its choices and one of each of its objects is
// tried on the scene. Throws SceneError of what is wrong with it, or with its scene.
Recipe load_recipe(const std::filesystem::path& path);

// The scene; with the first value of each key of the recipe; with each value and the first of all
// other keys; with one of each of its objects. They name every file that a sample can have.
void for_each_trial(const Recipe& recipe, FunctionRef<void(const Scene&)> visit);

// A number in [0, 1), a multiple of 2^-53: a pure function of the seed, a name and the sample.
double draw_number(std::uint64_t seed, std::string_view name, std::uint64_t sample);

// What ranges and choices come to in one sample, objects left out: a pure function of the recipe
// and the sample in which no key's value depends on the others.
struct SampleDraw {
  double t_s = 0.0;
  std::vector<std::string> settings;  // for load_scene()
};
SampleDraw draw_sample(const Recipe& recipe, int sample);

// Settings that add one object of the recipe's as number `index` of the scene's; `more` are further
// keys, as "position_m=[3, 4]".
std::vector<std::string> object_settings(const RecipeObjects& objects, std::size_t index,
                                         std::span<const std::string> more);

// The scene with one of each of the recipe's objects, and one of each class among its choices: it
// has every class that a sample can have.
Scene scene_of_all(const Recipe& recipe);

}  // namespace swell::scene
