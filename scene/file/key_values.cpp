#include "scene/file/key_values.h"

#include <algorithm>
#include <vector>

#include "math/check.h"
#include "scene/file/parameters.h"

namespace swell::scene {
namespace {

// Whether "a.b" lies under "a", or is it.
bool lies_under(std::string_view key, std::string_view whole) {
  return key.starts_with(whole) && (key.size() == whole.size() || key[whole.size()] == '.');
}

class KeySet {
 public:
  explicit KeySet(std::span<const std::string_view> keys) : keys_(keys) {}
  bool holds(std::string_view key) {
    bool is_in = false, is_out = false;
    for (const std::string_view whole : keys_) {
      if (whole.starts_with('-'))
        is_out |= lies_under(key, whole.substr(1));
      else
        is_in |= lies_under(key, whole);
    }
    found_ += is_in;
    return is_in && !is_out;
  }
  int found() const { return found_; }

 private:
  std::span<const std::string_view> keys_;
  int found_ = 0;
};

template <class Object>
void add_tables(std::string_view key, const std::vector<Parameter<Object>>& parameters,
                const std::vector<Object>& objects, KeySet& keys, ValueBytes& to) {
  if (!keys.holds(key)) return;
  to.add(key).add(objects.size());
  for (const Object& object : objects)
    for (const Parameter<Object>& parameter : parameters) parameter.add_value(object, to);
}

}  // namespace

void add_key_values(const Scene& scene, std::span<const std::string_view> keys, ValueBytes& to) {
  KeySet set(keys);
  for (const Parameter<Scene>& parameter : scene_parameters()) {
    if (!set.holds(parameter.key)) continue;
    to.add(parameter.key);
    if (scene.terrain || !lies_under(parameter.key, "terrain")) parameter.add_value(scene, to);
  }
  add_tables(kSwellKey, swell_parameters(), scene.sea.swells, set, to);
  add_tables(kSinesKey, sine_parameters(), scene.sea.sines, set, to);
  add_tables(kMapsKey, map_parameters(), scene.sea.maps, set, to);
  add_tables(kCumulusKey, cumulus_parameters(), scene.clouds.cumulus, set, to);
  add_tables(kPathKey, waypoint_parameters(), scene.camera.path, set, to);
  add_tables(kObjectsKey, object_parameters(), scene.objects, set, to);
  add_tables(kDisturbancesKey, disturbance_parameters(), scene.disturbances, set, to);
  add_tables(kRiversKey, river_parameters(), scene.rivers, set, to);
  add_tables(kLakesKey, lake_parameters(), scene.lakes, set, to);
  add_tables(kTreesKey, tree_parameters(), scene.trees, set, to);
  SWELL_CHECK(set.found() > 0, "no key is meant");
}

}  // namespace swell::scene
