#include "apps/dataset/class_sets.h"

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <numeric>

#include "math/enum_table.h"
#include "render/labels/classes.h"

namespace swell::apps {
namespace {

using scene::ObjectKind;

// The ids of kinds of objects; 0: none. The rows name what a set has a class for. Other kinds that
// commonly float are `floating`, and what stands on the ground is no thing.
using KindIds = EnumTable<ObjectKind, int>;
constexpr KindIds kind_ids(std::initializer_list<EnumRow<ObjectKind, int>> rows, int floating) {
  KindIds ids{};
  for (std::size_t i = 0; i < ids.size(); ++i)
    ids[i] = scene::kObjectKinds[i].motion == scene::Motion::kFloat ? floating : 0;
  for (const auto& [kind, id] : rows) ids[kind] = id;
  return ids;
}
constexpr KindIds kLarsKinds =
    kind_ids({{ObjectKind::kBuoy, 14}, {ObjectKind::kBoat, 12}, {ObjectKind::kSailboat, 11}}, 19);
constexpr KindIds kWaterScenesKinds = kind_ids({{ObjectKind::kBuoy, 2},
                                                {ObjectKind::kBoat, 5},
                                                {ObjectKind::kSailboat, 5},
                                                {ObjectKind::kPier, 1}},
                                               0);
constexpr KindIds kObstacleKinds = [] {
  KindIds ids{};
  ids.fill(1);
  return ids;
}();
constexpr KindIds kSwellKinds = [] {  // as swell_categories() numbers them
  KindIds ids{};
  std::iota(ids.begin(), ids.end(), 1);
  return ids;
}();

// Source: Zust, Pers, Kristan, LaRS, 2023 (panoptic ids); Yao et al., WaterScenes, 2023 (names).
const std::vector<Category> kLarsThings = {
    {11, "boat/ship"}, {12, "row boat"}, {13, "paddle board"}, {14, "buoy"},
    {15, "swimmer"},   {16, "animal"},   {17, "float"},        {19, "other"}};
const std::vector<Category> kWaterScenesThings = {
    {1, "pier"}, {2, "buoy"}, {3, "sailor"}, {4, "ship"}, {5, "boat"}, {6, "vessel"}, {7, "kayak"}};
const std::vector<Category> kSegments = {{0, "obstacle"}, {1, "water"}, {2, "sky"}};

constexpr std::uint8_t kObstacle = 0, kWater = 1, kSky = 2, kMastrIgnored = 4, kLarsIgnored = 255;

std::vector<Category> with(std::vector<Category> categories, const Category& more) {
  categories.insert(more.id == 0 ? categories.begin() : categories.end(), more);
  return categories;
}

// Whether a name is one of a category's: "boat" is one of "boat/ship".
bool is_called(std::string_view category, std::string_view name) {
  std::string lower(name);
  std::ranges::transform(lower, lower.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (std::size_t begin = 0; begin <= category.size();) {
    const std::size_t end = std::min(category.find('/', begin), category.size());
    if (category.substr(begin, end - begin) == lower) return true;
    begin = end + 1;
  }
  return false;
}

std::vector<Category> numbered(std::span<const std::string> names) {
  std::vector<Category> categories;
  for (const std::string& name : names)
    categories.push_back({static_cast<int>(categories.size()), name});
  return categories;
}

// The kinds of objects, then the classes that objects name.
std::vector<Category> swell_categories(std::span<const std::string> class_names,
                                       const scene::Scene& all) {
  std::vector<Category> categories;
  const auto add = [&](std::string_view name) {
    categories.push_back({static_cast<int>(categories.size()) + 1, std::string(name)});
  };
  for (const std::string_view name : scene::kObjectKindNames) add(name);
  for (std::size_t i = render::kFirstOwnClass; i < class_names.size(); ++i)
    if (std::ranges::find(all.objects, class_names[i], &scene::FloatingObject::label) !=
            all.objects.end() &&
        std::ranges::find(categories, class_names[i], &Category::name) == categories.end())
      add(class_names[i]);
  return categories;
}

// Number of the object that a pixel shows; nothing if it shows none.
std::optional<std::size_t> object_of(std::uint32_t id) {
  if (id < render::kFirstObjectId || id >= render::kFirstTreeId) return std::nullopt;
  return id - render::kFirstObjectId;
}

}  // namespace

std::string ClassSet::names() { return "lars, mastr1325, waterscenes or swell"; }

std::optional<ClassSet> ClassSet::find(std::string_view name, const scene::Scene& all) {
  constexpr auto kNames = enum_words<Kind>({
      {Kind::kLars, "lars"},
      {Kind::kMastr1325, "mastr1325"},
      {Kind::kWaterScenes, "waterscenes"},
      {Kind::kSwell, "swell"},
  });
  const auto place = std::ranges::find(kNames, name);
  if (place == kNames.end()) return std::nullopt;
  ClassSet set;
  set.kind_ = static_cast<Kind>(place - kNames.begin());
  switch (set.kind_) {
    case Kind::kLars:
      set.pixel_classes_ = with(kSegments, {kLarsIgnored, "ignore"});
      set.categories_ = kLarsThings;
      break;
    case Kind::kMastr1325:
      set.pixel_classes_ = with(kSegments, {kMastrIgnored, "ignore"});
      set.categories_ = {{1, "obstacle"}};
      break;
    case Kind::kWaterScenes:
      set.pixel_classes_ = with(kWaterScenesThings, {0, "none"});
      set.categories_ = kWaterScenesThings;
      break;
    case Kind::kSwell: {
      const std::vector<std::string> class_names = render::class_names(all);
      set.pixel_classes_ = numbered(class_names);
      set.categories_ = swell_categories(class_names, all);
      break;
    }
  }
  return set;
}

std::optional<int> ClassSet::category_of(const scene::FloatingObject& object) const {
  for (const Category& category : categories_)
    if (!object.label.empty() && is_called(category.name, object.label)) return category.id;
  const KindIds* const ids = kind_ == Kind::kLars          ? &kLarsKinds
                             : kind_ == Kind::kMastr1325   ? &kObstacleKinds
                             : kind_ == Kind::kWaterScenes ? &kWaterScenesKinds
                                                           : &kSwellKinds;
  const int id = (*ids)[object.kind];
  return id == 0 ? std::nullopt : std::optional(id);
}

std::uint8_t ClassSet::class_of_pixel(std::uint32_t id, std::uint32_t klass,
                                      const scene::Scene& scene) const {
  const std::optional<std::size_t> object = object_of(id);
  if (kind_ == Kind::kWaterScenes)
    return object ? static_cast<std::uint8_t>(category_of(scene.objects[*object]).value_or(0)) : 0;
  const bool is_own_hull =
      object && !scene.camera.mount.empty() && scene.objects[*object].name == scene.camera.mount;
  if (is_own_hull) return kind_ == Kind::kLars ? kLarsIgnored : kMastrIgnored;
  if (klass == render::kSkyClass) return kSky;
  return klass == render::kWaterClass || klass == render::kFoamClass ? kWater : kObstacle;
}

std::vector<std::uint8_t> ClassSet::class_map(const render::Labels& labels,
                                              const scene::Scene& scene) const {
  std::vector<std::uint8_t> map;
  map.reserve(labels.id.size());
  if (kind_ != Kind::kSwell) {
    for (std::size_t i = 0; i < labels.id.size(); ++i)
      map.push_back(class_of_pixel(labels.id[i], labels.klass[i], scene));
    return map;
  }
  // The scene's numbers of classes are those of what is in it.
  std::vector<std::uint8_t> numbers;
  for (const std::string& name : render::class_names(scene)) {
    const auto place = std::ranges::find(pixel_classes_, name, &Category::name);
    numbers.push_back(static_cast<std::uint8_t>(
        place == pixel_classes_.end() ? static_cast<int>(render::kObjectClass) : place->id));
  }
  for (const std::uint32_t klass : labels.klass) map.push_back(numbers[klass]);
  return map;
}

}  // namespace swell::apps
