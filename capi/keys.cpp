// The keys of scene files.
#include <string>
#include <vector>

#include "capi/call.h"
#include "scene/file/parameters.h"

namespace swell::capi {
namespace {

struct KeyTexts {
  std::string table, name, unit, allowed, meaning;
};

template <class Object>
void add_keys(std::string_view table, const std::vector<scene::Parameter<Object>>& parameters,
              std::vector<KeyTexts>& keys) {
  for (const auto& p : parameters)
    keys.push_back({std::string(table), std::string(p.key), std::string(p.unit),
                    scene::allowed_text(p), std::string(p.meaning)});
}

std::vector<KeyTexts> make_keys() {
  std::vector<KeyTexts> keys;
  add_keys("", scene::scene_parameters(), keys);
  add_keys(scene::kSwellKey, scene::swell_parameters(), keys);
  add_keys(scene::kSinesKey, scene::sine_parameters(), keys);
  add_keys(scene::kMapsKey, scene::map_parameters(), keys);
  add_keys(scene::kCumulusKey, scene::cumulus_parameters(), keys);
  add_keys(scene::kPathKey, scene::waypoint_parameters(), keys);
  add_keys(scene::kObjectsKey, scene::object_parameters(), keys);
  add_keys(scene::kDisturbancesKey, scene::disturbance_parameters(), keys);
  add_keys(scene::kTreesKey, scene::tree_parameters(), keys);
  add_keys(scene::kRiversKey, scene::river_parameters(), keys);
  add_keys(scene::kLakesKey, scene::lake_parameters(), keys);
  return keys;
}

const std::vector<KeyTexts>& all_keys() {
  static const std::vector<KeyTexts> keys = make_keys();
  return keys;
}

}  // namespace
}  // namespace swell::capi

using namespace swell::capi;

size_t swell_key_count() {
  size_t count = 0;
  guarded([&] { count = all_keys().size(); });
  return count;
}

swell_status swell_key_info(size_t key, swell_key* info) {
  return guarded([&] {
    const std::vector<KeyTexts>& keys = all_keys();
    if (key >= keys.size()) refuse("key, got {}, allowed below {}", key, keys.size());
    const KeyTexts& k = keys[key];
    swell_key found{};
    found.table = k.table.c_str();
    found.name = k.name.c_str();
    found.unit = k.unit.c_str();
    found.allowed = k.allowed.c_str();
    found.meaning = k.meaning.c_str();
    give(found, info, "info");
  });
}
