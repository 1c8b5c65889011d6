// Scenes with every value inside its documented range: each makes a picture of finite numbers.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "math/random.h"
#include "render/shot.h"
#include "scene/file/parameters.h"

namespace swell::render {
namespace {

using scene::Parameter, scene::ParameterKind;

constexpr int kScenes = 25, kSize = 64;

// Random numbers of one scene.
class Dice {
 public:
  explicit Dice(std::uint64_t scene) : seed_(scene) {}
  double uniform() { return random_uniform(seed_, next_++); }
  int below(int n) { return static_cast<int>(random_bits(seed_, next_++) % n); }

 private:
  std::uint64_t seed_, next_ = 0;
};

// In the range, its ends included: of every size between 0.01 and the largest number that it
// allows, or evenly spread. Evenly spread places alone would hold no sea.
template <class Object>
double random_number(const Parameter<Object>& parameter, Dice& dice) {
  const int choice = dice.below(10);
  if (choice == 0) return parameter.low;
  if (choice == 1) return parameter.high;
  if (choice == 2 && parameter.zero_too) return 0.0;
  if (choice < 5) return parameter.low + dice.uniform() * (parameter.high - parameter.low);
  const double largest = std::max(std::abs(parameter.low), std::abs(parameter.high));
  const double size = 0.01 * std::pow(largest / 0.01, dice.uniform());
  return std::clamp(dice.below(2) ? size : -size, parameter.low, parameter.high);
}

template <class Object>
std::string random_list(const Parameter<Object>& parameter, Dice& dice) {
  const int spread = parameter.count_high - parameter.count_low;
  std::vector<double> numbers;
  for (int n = parameter.count_low + dice.below(spread + 1); n > 0; --n)
    numbers.push_back(random_number(parameter, dice));
  if (spread) {  // patch lengths go down
    std::ranges::sort(numbers, std::greater{});
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  }
  return fmt::format("[{}]", fmt::join(numbers, ", "));
}

// Two to four points.
template <class Object>
std::string random_points(const Parameter<Object>& parameter, Dice& dice) {
  std::vector<std::string> points;
  for (int n = parameter.count_low + dice.below(3); n > 0; --n)
    points.push_back(
        fmt::format("[{}, {}]", 1000.0 * dice.uniform() - 500.0, random_number(parameter, dice)));
  return fmt::format("[{}]", fmt::join(points, ", "));
}

template <class Object>
std::string random_value(const Parameter<Object>& parameter, Dice& dice) {
  switch (parameter.kind) {
    case ParameterKind::kNumber:
      return fmt::format("{}", random_number(parameter, dice));
    case ParameterKind::kNumbers:
      return random_list(parameter, dice);
    case ParameterKind::kPoints:
      return random_points(parameter, dice);
    case ParameterKind::kInteger:
      return fmt::format("{:.0f}", std::ceil(random_number(parameter, dice)));
    case ParameterKind::kPowerOfTwo:
      return fmt::format("{}", static_cast<int>(parameter.low) << dice.below(2));
    case ParameterKind::kBoolean:
      return dice.below(2) ? "true" : "false";
    case ParameterKind::kChoice:
      return fmt::format("\"{}\"",
                         parameter.choices[dice.below(static_cast<int>(parameter.choices.size()))]);
    case ParameterKind::kText:
    case ParameterKind::kPath:
      return "\"\"";
  }
  return {};
}

// What would take long, made small, and what has to agree with another key.
std::optional<std::string> tame_value(std::string_view key, Dice& dice) {
  if (key == "sea.resolution") return fmt::format("{}", 16 << dice.below(3));
  if (key == "sky.horizon") return "[0.3, 1.0, 1.7]";  // goes with every zenith
  // On the largest island 16 trains need 100 m.
  if (key == "coast.grid_spacing_m") return dice.below(2) ? "100" : "0";
  if (key.ends_with("_triangles")) return fmt::format("{}", 2 + dice.below(4000));
  if (key == "kind") {  // meshes and forms need a file
    const auto kinds = scene::kObjectKindNames;
    const std::string_view kind =
        kinds[static_cast<std::size_t>(dice.below(static_cast<int>(kinds.size())))];
    return fmt::format("\"{}\"", kind == "mesh" || kind == "form" ? "box" : kind);
  }
  if (key == "drift") return "false";                 // wants a river
  if (key == "terrain.ground") return "\"heights\"";  // the other wants a file
  if (key == "clouds.kind") return dice.below(2) ? "\"none\"" : "\"layer\"";
  if (key == "clouds.base_m") return "1000";  // the top lies between 100 and 8000 m above it
  if (key == "clouds.top_m") return "4000";
  if (key == "sky.time_utc") return "\"2031-08-02T04:05:06.5Z\"";
  if (key == "camera.mount") return "\"\"";  // the test of mounted cameras has some
  if (key == "camera.mount_offset_m") return "[0, 0, 0]";
  if (key == "camera.quaternion") {
    const glm::dvec4 q(dice.uniform() - 0.5, dice.uniform() - 0.5, dice.uniform() - 0.5, 0.1);
    const glm::dvec4 unit = q / glm::length(q);
    return fmt::format("[{}, {}, {}, {}]", unit[0], unit[1], unit[2], unit[3]);
  }
  if (key == "camera.focal_px")
    return fmt::format("[{}, {}]", 20 + 200 * dice.uniform(), 20 + 200 * dice.uniform());
  if (key == "camera.principal_px")
    return fmt::format("[{}, {}]", 200 * dice.uniform() - 50, 200 * dice.uniform() - 50);
  if (key == "camera.f_number") return "0";  // others need exposure_s
  if (key == "camera.size_px") return "[100, 90]";
  if (key == "camera.projection") return "\"perspective\"";  // others fit few lenses
  return std::nullopt;
}

// Whether the camera of a scene by a quaternion and a matrix, or of another one, has the key.
bool goes_with(std::string_view key, bool by_matrix) {
  for (const scene::Replacement& r : scene::kReplacements) {
    if (r.key == "camera.mount") continue;
    if (key == r.key) return by_matrix;
    if (key == r.replaced) return !by_matrix;
  }
  return by_matrix || (key != "camera.principal_px" && key != "camera.size_px");
}

// Up to two tables [[key]] with every key.
template <class Object>
void add_random_tables(std::string_view table_key, const std::vector<Parameter<Object>>& parameters,
                       Dice& dice, std::string& text) {
  for (int n = dice.below(3); n > 0; --n) {
    text += fmt::format("[[{}]]\n", table_key);
    for (const auto& parameter : parameters) {
      const std::optional<std::string> tame = tame_value(parameter.key, dice);
      text += fmt::format("{} = {}\n", parameter.key, tame ? *tame : random_value(parameter, dice));
    }
  }
}

// About two of three keys.
std::string random_scene(Dice& dice, bool with_terrain) {
  constexpr std::string_view kWindKeys[] = {"wind.speed_mps", "sea.douglas", "sea.beaufort"};
  const std::string_view wind_key = kWindKeys[dice.below(3)];
  const bool by_matrix = dice.below(3) == 0, has_maps = dice.below(3) == 0;
  std::map<std::string, std::string> tables;
  for (const auto& parameter : scene::scene_parameters()) {
    const std::string_view key = parameter.key;
    std::optional<std::string> value = tame_value(key, dice);
    if (!value && dice.below(3) == 0) continue;
    if (!goes_with(key, by_matrix)) continue;
    // A set of maps has its own wind, and leaves no room for a spectrum's patches.
    const bool is_wave_patches = key == "sea.spectrum" || key == "sea.patch_lengths_m";
    if (has_maps ? is_wave_patches : key == "sea.map_set") continue;
    if (key != wind_key && std::ranges::count(kWindKeys, key)) continue;  // they exclude each other
    // The winds of sea states suit a gravity near the earth's, and their waves are the winds' own.
    constexpr std::string_view kKept[] = {"sea.gravity_mps2", "sea.hs_m", "sea.tp_s",
                                          "sea.fetch_km"};
    if (wind_key == "sea.douglas" && std::ranges::count(kKept, key)) continue;
    const std::size_t dot = key.find('.');
    if (dot == std::string_view::npos) continue;
    const std::string table(key.substr(0, dot));
    if (table == "terrain" && !with_terrain) continue;
    if (!value) value = random_value(parameter, dice);
    tables[table] += fmt::format("{} = {}\n", key.substr(dot + 1), *value);
  }
  std::string text;
  for (const auto& [name, lines] : tables) text += fmt::format("[{}]\n{}", name, lines);
  if (!has_maps) add_random_tables(scene::kSwellKey, scene::swell_parameters(), dice, text);
  add_random_tables(scene::kSinesKey, scene::sine_parameters(), dice, text);
  add_random_tables(scene::kObjectsKey, scene::object_parameters(), dice, text);
  return text;
}

TEST(RandomScenes, GiveFinitePicturesAndShadeEveryVisiblePixelOnce) {
  Shot shot;
  int with_surface = 0, with_sky = 0;
  for (int n = 0; n < kScenes; ++n) {
    Dice dice(n);
    // A terrain takes ten times as long to make as the rest.
    const std::string text = random_scene(dice, n % 4 == 0);
    const double t_s = 0.01 * std::pow(1e8, dice.uniform());
    SCOPED_TRACE(fmt::format("scene {} at {} s:\n{}", n, t_s, text));
    const World world(scene::parse_scene(text, "random.toml"));
    shot.draw(world, view_of(world, t_s, kSize, kSize), t_s, {.keep_linear = true});
    const std::uint64_t visible_pixels = shot.statistics.visible_pixels;
    EXPECT_EQ(shot.statistics.shaded_pixels, visible_pixels);
    ASSERT_EQ(shot.target.linear.size(), 3u * kSize * kSize);
    // A sensor's read noise goes below 0.
    const bool is_noisy = world.scene().camera.noise.full_well_e > 0.0;
    const auto wrong = std::ranges::count_if(shot.target.linear, [&](float value) {
      return !(std::isfinite(value) && (is_noisy || value >= 0.0f));
    });
    EXPECT_EQ(wrong, 0);
    with_surface += visible_pixels > 0;
    with_sky += visible_pixels < kSize * kSize;
  }
  EXPECT_GE(with_surface, kScenes / 4);
  EXPECT_GE(with_sky, kScenes / 4);
}

}  // namespace
}  // namespace swell::render
