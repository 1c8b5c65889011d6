// Scenes made in code pass the same checks as files, at the doors of World and Water.
#include "scene/check_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "constants.h"
#include "scene/file/parameters.h"
#include "scene/water.h"

namespace swell::scene {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::string key_of_fault(const Scene& scene) {
  const auto fault = find_fault(scene);
  return fault ? fault->key : "";
}

// What a Scene in code can hold that its key does not allow.
template <class Object>
std::vector<ParameterValue> values_outside(const Parameter<Object>& parameter) {
  using Numbers = std::vector<double>;
  std::vector<ParameterValue> values;
  const double low = parameter.zero_too ? -1.0 : parameter.low;
  const std::vector<double> wrong = {kNan, kInf, -kInf, low - 0.001,
                                     parameter.high * 1.001 + 0.001};
  const double good = parameter.high;
  switch (parameter.kind) {
    case ParameterKind::kNumber:
      for (const double x : wrong) values.emplace_back(Numbers{x});
      break;
    case ParameterKind::kNumbers:
      for (const double x : wrong) {
        Numbers numbers(static_cast<std::size_t>(parameter.count_low), good);
        numbers.back() = x;
        values.emplace_back(numbers);
      }
      if (parameter.count_low < parameter.count_high) {
        values.emplace_back(Numbers{});
        values.emplace_back(Numbers(static_cast<std::size_t>(parameter.count_high) + 1, good));
      }
      break;
    case ParameterKind::kPoints:
      for (const double x : wrong) values.emplace_back(Numbers{good, 0.0, 0.0, x});
      values.emplace_back(Numbers{0.0, 0.0});
      break;
    case ParameterKind::kInteger:
      values.emplace_back(static_cast<std::int64_t>(parameter.low) - 1);
      values.emplace_back(static_cast<std::int64_t>(parameter.high) + 1);
      break;
    case ParameterKind::kPowerOfTwo:
      values.emplace_back(static_cast<std::int64_t>(parameter.low) / 2);
      values.emplace_back(static_cast<std::int64_t>(parameter.high) - 1);
      values.emplace_back(static_cast<std::int64_t>(parameter.high) * 2);
      break;
    case ParameterKind::kText:
      values.emplace_back(std::string(kMaxTextBytes + 1, 'x'));
      break;
    case ParameterKind::kBoolean:
    case ParameterKind::kChoice:
    case ParameterKind::kPath:
      break;
  }
  return values;
}

TEST(CheckScene, NamesEveryKeyOutsideItsRange) {
  int checked = 0;
  for (const auto& parameter : scene_parameters())
    for (const ParameterValue& value : values_outside(parameter)) {
      Scene scene;
      scene.terrain.emplace();
      parameter.set(scene, value);
      EXPECT_TRUE(key_of_fault(scene).starts_with(parameter.key))
          << parameter.key << ": " << key_of_fault(scene);
      ++checked;
    }
  EXPECT_GT(checked, 200);
}

template <class Object, class Add>
void expect_named(std::string_view table, const std::vector<Parameter<Object>>& parameters,
                  const Add& add) {
  for (const auto& parameter : parameters)
    for (const ParameterValue& value : values_outside(parameter)) {
      Object object;
      parameter.set(object, value);
      if (parameter.is_set && !parameter.is_set(object)) continue;  // as without the key
      Scene scene;
      add(scene, Object{});
      add(scene, object);
      const std::string key = std::string(table) + "[1]." + std::string(parameter.key);
      EXPECT_TRUE(key_of_fault(scene).starts_with(key)) << key << ": " << key_of_fault(scene);
    }
}

TEST(CheckScene, NamesEveryKeyOfTablesOutsideItsRange) {
  expect_named(kSwellKey, swell_parameters(),
               [](Scene& scene, const auto& swell) { scene.sea.swells.push_back(swell); });
  expect_named(kSinesKey, sine_parameters(),
               [](Scene& scene, const auto& sine) { scene.sea.sines.push_back(sine); });
  expect_named(kMapsKey, map_parameters(),
               [](Scene& scene, const auto& map) { scene.sea.maps.push_back(map); });
  expect_named(kCumulusKey, cumulus_parameters(),
               [](Scene& scene, const auto& cloud) { scene.clouds.cumulus.push_back(cloud); });
  expect_named(kObjectsKey, object_parameters(),
               [](Scene& scene, const auto& object) { scene.objects.push_back(object); });
  expect_named(kDisturbancesKey, disturbance_parameters(),
               [](Scene& scene, const auto& d) { scene.disturbances.push_back(d); });
  expect_named(kRiversKey, river_parameters(),
               [](Scene& scene, const auto& river) { scene.rivers.push_back(river); });
  expect_named(kLakesKey, lake_parameters(),
               [](Scene& scene, const auto& lake) { scene.lakes.push_back(lake); });
  expect_named(kTreesKey, tree_parameters(),
               [](Scene& scene, const auto& stand) { scene.trees.push_back(stand); });
  expect_named(kPathKey, waypoint_parameters(),
               [](Scene& scene, const auto& waypoint) { scene.camera.path.push_back(waypoint); });
}

TEST(CheckScene, NamesWordsThatDoNotExist) {
  Scene scene;
  scene.detail.triangulation = static_cast<Triangulation>(3);
  EXPECT_EQ(key_of_fault(scene), "detail.triangulation");
  scene = {};
  scene.coast.model = static_cast<CoastModel>(200);
  EXPECT_EQ(key_of_fault(scene), "coast.model");
  scene = {};
  scene.objects.push_back({.kind = static_cast<ObjectKind>(9)});
  EXPECT_EQ(key_of_fault(scene), "object[0].kind");
}

TEST(CheckScene, LimitsTables) {
  Scene scene;
  scene.objects.resize(kMaxObjects);
  scene.sea.sines.resize(ocean::kMaxSines);
  scene.sea.swells.resize(ocean::kMaxSwells);
  for (std::size_t i = 0; i < kMaxWaypoints; ++i)
    scene.camera.path.push_back({.t_s = static_cast<double>(i)});
  EXPECT_EQ(key_of_fault(scene), "");
  Scene one_more = scene;
  one_more.objects.emplace_back();
  EXPECT_EQ(key_of_fault(one_more), "object");
  one_more = scene;
  one_more.sea.sines.emplace_back();
  EXPECT_EQ(key_of_fault(one_more), "sea.sines");
  one_more = scene;
  one_more.sea.swells.emplace_back();
  EXPECT_EQ(key_of_fault(one_more), "sea.swell");
  one_more = scene;
  one_more.camera.path.push_back({.t_s = 1000.0});
  EXPECT_EQ(key_of_fault(one_more), "camera.path");
}

TEST(CheckScene, WantsValuesThatAgree) {
  Scene scene;
  scene.sea.patch_lengths_m = {10.0, 20.0};
  EXPECT_EQ(key_of_fault(scene), "sea.patch_lengths_m");
  scene = {};
  scene.douglas = scene.beaufort = 3;
  EXPECT_EQ(key_of_fault(scene), "sea.beaufort");
  scene = {};
  scene.camera.path = {{.t_s = 1.0}, {.t_s = 1.0}};
  EXPECT_EQ(key_of_fault(scene), "camera.path[1].t_s");
  scene = {};
  scene.camera.quaternion = glm::dvec4(0.0);
  EXPECT_EQ(key_of_fault(scene), "camera.quaternion");
  scene = {};
  scene.camera.size_px = glm::dvec2(640.0, 480.0);
  EXPECT_EQ(key_of_fault(scene), "camera.size_px");
  scene = {};
  scene.clouds.kind = CloudKind::kLayer;
  EXPECT_EQ(key_of_fault(scene), "");
  scene.clouds.top_m = scene.clouds.base_m;
  EXPECT_EQ(key_of_fault(scene), "clouds.top_m");
  scene = {};
  scene.clouds.kind = CloudKind::kPlaced;
  EXPECT_EQ(key_of_fault(scene), "clouds.kind");
  scene.clouds.cumulus = {{.position_m = {-20000.0, 0.0}}, {.position_m = {20000.0, 0.0}}};
  EXPECT_EQ(key_of_fault(scene), "clouds.cumulus");
  scene.clouds.cumulus.pop_back();
  EXPECT_EQ(key_of_fault(scene), "");
  scene = {};
  scene.camera.mount = "boat";
  EXPECT_EQ(key_of_fault(scene), "camera.mount");
  scene.objects.resize(2);
  scene.objects[1].name = "boat";
  EXPECT_EQ(key_of_fault(scene), "");
  scene.objects[0].name = "boat";
  EXPECT_EQ(key_of_fault(scene), "object[1].name");
  scene.objects.erase(scene.objects.begin());
  scene.camera.path.emplace_back();
  EXPECT_EQ(key_of_fault(scene), "camera.mount");
  scene = {};
  scene.terrain.emplace().coast_m = {{0.0, 0.0}, {0.0, 1e-4}};
  EXPECT_EQ(key_of_fault(scene), "terrain.coast_m[1]");
  scene.terrain->coast_m = {{0.0, 0.0}, {0.0, 1.0}};
  scene.terrain->height_image = "bay.png";
  EXPECT_EQ(key_of_fault(scene), "terrain.coast_m");
}

// 1.15 horizon - 0.15 zenith is what the sky has at the horizon.
TEST(CheckScene, WantsASkyThatIsNotBlackAtTheHorizon) {
  Scene scene;
  scene.sky.zenith = glm::vec3(0.0f, 0.0f, 1.0f);
  scene.sky.horizon = glm::vec3(0.2f, 0.2f, 0.131f);
  EXPECT_EQ(key_of_fault(scene), "");
  scene.sky.horizon->z = 0.130f;
  EXPECT_EQ(key_of_fault(scene), "sky.zenith[2]");
}

TEST(CheckScene, WantsTheSunWhereItsAnglesSay) {
  Scene scene;
  scene.sky.sun_elevation_rad = 1.0;
  EXPECT_EQ(key_of_fault(scene), "sky.sun_direction");
  scene.sky.sun_direction = {0.0f, std::cos(1.0f), std::sin(1.0f)};
  EXPECT_EQ(key_of_fault(scene), "");
  scene.sky.sun_direction.x = NAN;
  EXPECT_EQ(key_of_fault(scene), "sky.sun_direction");
}

TEST(CheckScene, FindsNothingInScenesThatCanBeDrawn) {
  EXPECT_EQ(key_of_fault({}), "");
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(SWELL_SOURCE_DIR) / "scenes")) {
    if (entry.path().extension() != ".toml") continue;
    EXPECT_EQ(key_of_fault(load_scene(entry.path())), "") << entry.path();
  }
}

// The words are those of a file's error, with the scene's name for the place.
TEST(CheckScene, ThrowsOneLineAsForFiles) {
  Scene scene;
  scene.camera.near_m = 0.0;
  const auto message = [&] {
    try {
      const Water water(scene);
    } catch (const SceneError& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  EXPECT_EQ(message(), "scene: camera.near_m, got 0, allowed 0.01 to 10 m");
  scene.name = "two\nlines";
  EXPECT_EQ(message(), "two lines: camera.near_m, got 0, allowed 0.01 to 10 m");
}

}  // namespace
}  // namespace swell::scene
