// Properties of the table of parameters on random scene files.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>

#include "math/random.h"
#include "scene/file/parameters.h"
#include "scene/scene_text.h"
#include "trials.h"

namespace swell::scene {
namespace {

constexpr int kFiles = trials(10000);

// Random numbers of one file.
class Dice {
 public:
  explicit Dice(std::uint64_t file) : seed_(file) {}
  double uniform() { return random_uniform(seed_, next_++); }
  int below(int n) { return static_cast<int>(random_bits(seed_, next_++) % n); }

 private:
  std::uint64_t seed_, next_ = 0;
};

std::string number_text(double value) { return fmt::format("{}", value); }

// Inside the range, ends included.
template <class Object>
double number_inside(const Parameter<Object>& parameter, Dice& dice) {
  const int choice = dice.below(10);
  if (choice == 0) return parameter.low;
  if (choice == 1) return parameter.high;
  if (choice == 2 && parameter.zero_too) return 0.0;
  return parameter.low + dice.uniform() * (parameter.high - parameter.low);
}

// Outside the range, far or by little, or no number at all.
template <class Object>
std::string number_outside(const Parameter<Object>& parameter, Dice& dice) {
  const double width = parameter.high - parameter.low;
  const double beyond = width * std::pow(10.0, -9.0 + 12.0 * dice.uniform());
  switch (dice.below(6)) {
    case 0:
      return "nan";
    case 1:
      return dice.below(2) ? "inf" : "-inf";
    case 2:
      return number_text(std::nextafter(parameter.high, HUGE_VAL));
    case 3:
      return number_text(parameter.high + beyond);
    default:
      // Below a range that allows 0 too must not mean 0.
      return number_text(parameter.low - beyond - (parameter.zero_too ? parameter.low : 0.0));
  }
}

template <class Object>
std::string list_text(const Parameter<Object>& parameter, Dice& dice, bool inside) {
  const int spread = parameter.count_high - parameter.count_low;
  int count = parameter.count_low + (spread ? dice.below(spread + 1) : 0);
  if (!inside && dice.below(3) == 0) {
    count = dice.below(2) ? parameter.count_high + 1 : parameter.count_low - 1;
    inside = true;
  }
  std::vector<double> numbers;
  for (int i = 0; i < count; ++i)
    numbers.push_back(spread ? parameter.low + dice.uniform() * (parameter.high - parameter.low)
                             : number_inside(parameter, dice));
  if (spread) std::ranges::sort(numbers, std::greater{});  // patch lengths go down
  std::string text;
  const int wrong = inside ? -1 : dice.below(std::max(count, 1));
  for (int i = 0; i < static_cast<int>(numbers.size()); ++i)
    text +=
        (i ? ", " : "") + (i == wrong ? number_outside(parameter, dice) : number_text(numbers[i]));
  return "[" + text + "]";
}

// Up to five points, if wrong with one number outside, one too many, or one point too few.
template <class Object>
std::string points_text(const Parameter<Object>& parameter, Dice& dice, bool inside) {
  const bool alone = !inside && dice.below(3) == 0;
  const int count = alone ? parameter.count_low - 1 : parameter.count_low + dice.below(4);
  const int wrong = inside || alone ? -1 : dice.below(count);
  std::string text;
  for (int i = 0; i < count; ++i) {
    const double x = parameter.low + dice.uniform() * (parameter.high - parameter.low);
    const std::string y = i != wrong      ? number_text(number_inside(parameter, dice))
                          : dice.below(2) ? number_outside(parameter, dice)
                                          : "1, 2";
    text += fmt::format("{}[{}, {}]", i ? ", " : "", x, y);
  }
  return "[" + text + "]";
}

template <class Object>
std::string integer_text(const Parameter<Object>& parameter, Dice& dice, bool inside) {
  const bool power = parameter.kind == ParameterKind::kPowerOfTwo;
  if (inside && power) {
    const auto low = static_cast<unsigned>(parameter.low),
               high = static_cast<unsigned>(parameter.high);
    return fmt::format("{}", low << dice.below(std::bit_width(high / low)));
  }
  if (inside) return fmt::format("{:.0f}", std::floor(number_inside(parameter, dice)));
  const char* kWrong[] = {"-1", "9007199254740993", "1.5", "true", "\"2\"", "[2]"};
  if (power && dice.below(2)) return "100";
  return kWrong[dice.below(6)];
}

template <class Object>
std::string value_text(const Parameter<Object>& parameter, Dice& dice, bool inside) {
  switch (parameter.kind) {
    case ParameterKind::kNumber:
      return inside ? number_text(number_inside(parameter, dice)) : number_outside(parameter, dice);
    case ParameterKind::kNumbers:
      return list_text(parameter, dice, inside);
    case ParameterKind::kPoints:
      return points_text(parameter, dice, inside);
    case ParameterKind::kInteger:
    case ParameterKind::kPowerOfTwo:
      return integer_text(parameter, dice, inside);
    case ParameterKind::kBoolean:
      return inside ? (dice.below(2) ? "true" : "false") : (dice.below(2) ? "1" : "\"true\"");
    case ParameterKind::kChoice: {
      if (!inside) return "\"other\"";
      auto choices = parameter.choices;
      while (choices.back() == "mesh" || choices.back() == "form")  // take a file
        choices = choices.first(choices.size() - 1);
      return fmt::format("\"{}\"", choices[dice.below(static_cast<int>(choices.size()))]);
    }
    case ParameterKind::kText:
      return inside ? fmt::format("\"{}\"", std::string(dice.below(201), 'x'))
                    : fmt::format("\"{}\"", std::string(201, 'x'));
    case ParameterKind::kPath:
      return inside ? "\"\"" : "\"/none/heights.png\"";
  }
  return {};
}

constexpr std::string_view kWindKeys[] = {"wind.speed_mps", "sea.douglas", "sea.beaufort"};

bool is_wind_key(std::string_view key) { return std::ranges::count(kWindKeys, key) > 0; }

// Whether a file has the key, of those of which it may have only some; `by_matrix`: its camera is
// given by a quaternion and a matrix.
bool goes_with(std::string_view key, bool by_matrix) {
  if (key == "camera.mount_offset_m") return false;  // wants an object of a name
  for (const std::string_view other :
       {"camera.quaternion", "camera.focal_px", "camera.principal_px", "camera.size_px",
        "sea.fetch_km", "air.attenuation_per_m", "sky.time_utc"})
    if (key == other) return by_matrix;
  for (const Replacement& r : kReplacements)
    if (key == r.replaced && r.key != "camera.mount") return !by_matrix;
  return true;
}

// Whether a sea state of its own needs the key's default.
bool is_kept_by_douglas(std::string_view key) {
  return key == "sea.gravity_mps2" || key == "sea.hs_m" || key == "sea.tp_s" ||
         key == "sea.fetch_km";
}

// A value that agrees with those of other keys; empty: any.
std::string agreeing_value(std::string_view key, Dice& dice) {
  // A horizon that goes with every zenith; on the largest island 16 trains need 100 m.
  if (key == "sky.horizon") return "[0.3, 1.0, 1.7]";
  if (key == "coast.grid_spacing_m") return dice.below(2) ? "100" : "0";
  if (key == "camera.quaternion") return "[0.1, -0.7, 0.5, 0.5]";
  if (key == "camera.projection") return "\"perspective\"";  // others fit few lenses
  if (key == "camera.f_number") return "0";                  // others need exposure_s
  if (key == "sky.time_utc") return "\"2031-08-02T04:05:06.5Z\"";
  if (key == "camera.mount") return "\"\"";
  if (key == "clouds.kind") return dice.below(2) ? "\"none\"" : "\"layer\"";
  if (key == "clouds.base_m") return "1000";
  if (key == "clouds.top_m") return "4000";
  if (key == "sea.map_set") return "\"none\"";        // a set leaves the spectrum one patch
  if (key == "terrain.ground") return "\"heights\"";  // the other wants a file
  return "";
}

struct RandomFile {
  std::string text;
  std::string wrong_key;  // as messages name it; empty: none
};

// Up to two tables [[key]] with every key; one more, whose key number `wrong` has a value outside
// its range, if there is such a key.
template <class Object>
void add_random_tables(std::string_view table_key, const std::vector<Parameter<Object>>& parameters,
                       int wrong, Dice& dice, RandomFile& file) {
  const bool any_wrong = wrong >= 0 && wrong < static_cast<int>(parameters.size());
  const int count = dice.below(3) + any_wrong;
  for (int n = 0; n < count; ++n) {
    file.text += fmt::format("[[{}]]\n", table_key);
    for (int i = 0; i < static_cast<int>(parameters.size()); ++i) {
      const bool is_wrong = n == count - 1 && i == wrong;
      const std::string_view key = parameters[i].key;
      if (is_wrong) file.wrong_key = fmt::format("{}[{}].{}", table_key, n, key);
      std::string value = value_text(parameters[i], dice, !is_wrong);
      if (key == "name" && !is_wrong) value = fmt::format("\"number {}\"", n);  // its own
      if (key == "drift" && !is_wrong) value = "false";                         // wants a river
      file.text += fmt::format("{} = {}\n", key, value);
    }
  }
}

// About every second key, in random order within its table; the key number `wrong` of all keys
// (negative: none) has a value outside its range.
RandomFile random_file(Dice& dice, int wrong) {
  RandomFile file;
  std::map<std::string, std::string> sections;
  int index = 0;
  // Keys that exclude each other; the winds of sea states suit a gravity near the earth's.
  const std::string_view wind_key = kWindKeys[dice.below(3)];
  const bool by_matrix = dice.below(2) == 0;
  for (const auto& parameter : scene_parameters()) {
    const bool is_wrong = index++ == wrong;
    const bool needed = by_matrix && (parameter.key == "camera.focal_px" ||  // by each other
                                      parameter.key == "camera.size_px");
    if (!is_wrong && !needed && dice.below(2)) continue;
    if (!is_wrong && !goes_with(parameter.key, by_matrix)) continue;
    if (!is_wrong && parameter.key != wind_key && is_wind_key(parameter.key)) continue;
    if (!is_wrong && wind_key == "sea.douglas" && is_kept_by_douglas(parameter.key)) continue;
    if (is_wrong) file.wrong_key = parameter.key;
    const std::string key(parameter.key);
    const std::size_t dot = key.find('.');
    const std::string section = dot == std::string::npos ? "" : key.substr(0, dot);
    std::string value = value_text(parameter, dice, !is_wrong);
    const std::string agreeing = is_wrong ? "" : agreeing_value(key, dice);
    if (!agreeing.empty()) value = agreeing;
    const std::string line = fmt::format("{} = {}\n", key.substr(dot + 1), value);
    std::string& lines = sections[section];
    lines = dice.below(2) ? line + lines : lines + line;
  }
  for (const auto& [section, lines] : sections)
    file.text += (section.empty() ? "" : "[" + section + "]\n") + lines;
  add_random_tables(kSwellKey, swell_parameters(), wrong - index, dice, file);
  index += static_cast<int>(swell_parameters().size());
  add_random_tables(kSinesKey, sine_parameters(), wrong - index, dice, file);
  index += static_cast<int>(sine_parameters().size());
  add_random_tables(kCumulusKey, cumulus_parameters(), wrong - index, dice, file);
  index += static_cast<int>(cumulus_parameters().size());
  add_random_tables(kObjectsKey, object_parameters(), wrong - index, dice, file);
  return file;
}

TEST(SceneParameters, RandomFilesInsideTheRangesAreAccepted) {
  for (int n = 0; n < kFiles; ++n) {
    Dice dice(n);
    const std::string text = random_file(dice, -1).text;
    ASSERT_EQ(error_of(text), "") << text;
  }
}

TEST(SceneParameters, RandomScenesComeBackFromTheirDump) {
  for (int n = 0; n < 1000; ++n) {
    Dice dice(n);
    const std::string text = random_file(dice, -1).text;
    const Scene scene = parse_scene(text, "a.toml");
    const Scene again = parse_scene(dump_scene(scene), "b.toml");
    ASSERT_EQ(differences(scene, again), "") << text;
  }
}

TEST(SceneParameters, RandomFilesWithOneValueOutsideAreRefusedByItsName) {
  const int keys = static_cast<int>(scene_parameters().size() + swell_parameters().size() +
                                    sine_parameters().size() + cumulus_parameters().size() +
                                    object_parameters().size());
  for (int n = 0; n < kFiles; ++n) {
    Dice dice(n);
    const RandomFile file = random_file(dice, n % keys);
    const std::string error = error_of(file.text);
    ASSERT_TRUE(error.starts_with("test.toml:")) << error << "\n" << file.text;
    ASSERT_NE(error.find(": " + file.wrong_key), std::string::npos) << error << "\n" << file.text;
    ASSERT_NE(error.find(", allowed "), std::string::npos) << error;
  }
}

TEST(SceneParameters, TheSeaTakesWhatTheRangesAllow) {
  for (int n = 0; n < 40; ++n) {
    Dice dice(n);
    const std::string text = random_file(dice, -1).text;
    ocean::SeaDescription sea = parse_scene(text, "a.toml").sea;
    sea.resolution = 16;
    EXPECT_NO_THROW(ocean::Sea{sea}) << text;
  }
}

TEST(SceneParameters, DefaultsLieInsideTheirRanges) {
  Scene scene;
  scene.terrain.emplace();
  EXPECT_EQ(error_of(dump_scene(scene)), "");
}

TEST(SceneParameters, KeysAreUniqueAndExplained) {
  std::set<std::string_view> keys;
  for (const auto& parameter : scene_parameters()) {
    EXPECT_TRUE(keys.insert(parameter.key).second) << parameter.key;
    EXPECT_FALSE(parameter.meaning.empty()) << parameter.key;
    EXPECT_LE(parameter.low, parameter.high) << parameter.key;
    EXPECT_TRUE(std::isfinite(parameter.low) && std::isfinite(parameter.high)) << parameter.key;
  }
}

// Values whose decimal text and radians are hard to bring together.
TEST(SceneParameters, AnglesComeBackFromTheirDumpBitByBit) {
  for (int n = 0; n < 2000; ++n) {
    const double deg = -360.0 + 720.0 * random_uniform(5, n);
    const std::string text = fmt::format("[camera]\nheading_deg = {}\n", deg);
    const Scene scene = parse_scene(text, "a.toml");
    const Scene again = parse_scene(dump_scene(scene), "a.toml");
    ASSERT_EQ(scene.camera.heading_rad, again.camera.heading_rad) << text;
  }
}

}  // namespace
}  // namespace swell::scene
