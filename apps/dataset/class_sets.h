// The sets of classes that data sets use: what a pixel counts as, and what an object does.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/labels/labels.h"
#include "scene/scene.h"

namespace swell::apps {

struct Category {
  int id = 0;
  std::string name;
};

// One of lars, mastr1325, waterscenes and swell (docs/do/datasets.md has their tables). The numbers
// are those of the sets themselves where these have numbers.
class ClassSet {
 public:
  // `all` has every class that a scene of the data set can have (scene::scene_of_all). Nothing for
  // a name of no set.
  static std::optional<ClassSet> find(std::string_view name, const scene::Scene& all);
  static std::string names();  // "lars, mastr1325, waterscenes or swell"

  // What values the pixels of class_map() have, and what objects count as.
  const std::vector<Category>& pixel_classes() const { return pixel_classes_; }
  const std::vector<Category>& categories() const { return categories_; }

  // The id of an object's category: that of its own class if a category has that name, else that of
  // its kind. Nothing for what is no thing but part of the shore, and for what the set lacks.
  std::optional<int> category_of(const scene::FloatingObject& object) const;

  // A value a pixel, of labels with ids and classes of the scene.
  std::vector<std::uint8_t> class_map(const render::Labels& labels,
                                      const scene::Scene& scene) const;

 private:
  enum class Kind : std::uint8_t { kLars, kMastr1325, kWaterScenes, kSwell };
  std::uint8_t class_of_pixel(std::uint32_t id, std::uint32_t klass,
                              const scene::Scene& scene) const;

  Kind kind_ = Kind::kSwell;
  std::vector<Category> pixel_classes_, categories_;
};

}  // namespace swell::apps
