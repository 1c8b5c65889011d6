// Values of a scene's keys, by which parts of a world are found again.
#include "scene/file/key_values.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <initializer_list>
#include <string>

#include "scene/file/parameters.h"

namespace swell::scene {
namespace {

ValueHash hash_of(const Scene& scene, std::initializer_list<std::string_view> keys) {
  ValueBytes bytes;
  add_key_values(scene, {keys.begin(), keys.size()}, bytes);
  return bytes.hash();
}

// Gives the object another value than it has, in the parameter's range or not.
template <class Object>
void change(const Parameter<Object>& parameter, Object& object) {
  ParameterValue value = parameter.get(object);
  if (auto* const numbers = std::get_if<std::vector<double>>(&value)) {
    if (numbers->empty()) *numbers = {1.0, 2.0};
    numbers->back() = numbers->back() == 0.0 ? 1.0 : 0.75 * numbers->back();
  } else if (auto* const number = std::get_if<std::int64_t>(&value)) {
    *number += 1;
  } else if (auto* const is_so = std::get_if<bool>(&value)) {
    *is_so = !*is_so;
  } else {
    auto& text = std::get<std::string>(value);
    text = parameter.choices.empty()           ? text + "x"
           : text == parameter.choices.front() ? std::string(parameter.choices.back())
                                               : std::string(parameter.choices.front());
  }
  parameter.set(object, value);
}

std::string_view table_of(std::string_view key) { return key.substr(0, key.find('.')); }

TEST(KeyValues, KnowEveryKeyAndItsTable) {
  Scene before;
  before.terrain.emplace();
  int keys = 0;
  for (const Parameter<Scene>& parameter : scene_parameters()) {
    Scene after = before;
    change(parameter, after);
    const std::string_view table = table_of(parameter.key);
    EXPECT_NE(hash_of(before, {parameter.key}), hash_of(after, {parameter.key})) << parameter.key;
    EXPECT_NE(hash_of(before, {table}), hash_of(after, {table})) << parameter.key;
    const std::string without = fmt::format("-{}", parameter.key);
    EXPECT_EQ(hash_of(before, {table, without}), hash_of(after, {table, without})) << parameter.key;
    ++keys;
  }
  EXPECT_GT(keys, 100);
}

template <class Object>
void expect_rows_known(std::string_view key, const std::vector<Parameter<Object>>& parameters,
                       std::vector<Object> Scene::*objects) {
  Scene before;
  EXPECT_NE(hash_of(before, {key}), [&] {
    Scene one;
    (one.*objects).emplace_back();
    return hash_of(one, {key});
  }());
  (before.*objects).resize(2);
  for (const Parameter<Object>& parameter : parameters) {
    Scene after = before;
    change(parameter, (after.*objects).back());
    EXPECT_NE(hash_of(before, {key}), hash_of(after, {key})) << key << " " << parameter.key;
  }
}

TEST(KeyValues, KnowTheRowsOfTables) {
  expect_rows_known(kRiversKey, river_parameters(), &Scene::rivers);
  expect_rows_known(kLakesKey, lake_parameters(), &Scene::lakes);
  expect_rows_known(kTreesKey, tree_parameters(), &Scene::trees);
  expect_rows_known(kDisturbancesKey, disturbance_parameters(), &Scene::disturbances);
  Scene before, after;
  after.sea.swells.emplace_back();
  EXPECT_NE(hash_of(before, {"sea"}), hash_of(after, {"sea"}));
  after = before;
  after.clouds.cumulus.emplace_back();
  EXPECT_NE(hash_of(before, {"clouds"}), hash_of(after, {"clouds"}));
}

TEST(KeyValues, OfATerrainAreThereOnlyWithOne) {
  Scene without, with;
  with.terrain.emplace();
  EXPECT_NE(hash_of(without, {"terrain"}), hash_of(with, {"terrain"}));
  EXPECT_EQ(hash_of(without, {"sky"}), hash_of(with, {"sky"}));
}

TEST(KeyValues, AreFoundOnlyUnderKeysThatThereAre) {
  EXPECT_DEATH(hash_of(Scene{}, {"se"}), "no key is meant");
}

}  // namespace
}  // namespace swell::scene
