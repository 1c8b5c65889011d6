// One sample of a recipe: its picture, labels, masks, camera and boxes, as files.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/dataset/class_sets.h"
#include "apps/shared/notices.h"
#include "math/parallel.h"
#include "render/frame.h"
#include "scene/file/recipe.h"

namespace swell::apps {

struct SampleFile {
  std::string name;  // in the data set's folder: "images/000017.png"
  std::vector<std::uint8_t> bytes;
};

struct Sample {
  std::vector<SampleFile> files;
  std::string facts;  // JSON: COCO's "image", and its "annotations" of the picture
};

// Draws samples. What a sample is depends on the recipe, the classes and its number alone.
class SampleMaker {
 public:
  // The references must outlive the maker. threads in [1, 256].
  SampleMaker(const scene::Recipe& recipe, const ClassSet& classes, render::LabelSet labels,
              int threads);

  // Throws scene::SceneError where the values that were drawn make no scene together.
  Sample make(int sample);

 private:
  // Makes the world of the scene that has these settings.
  void make_world(const std::vector<std::string>& settings);

  const scene::Recipe& recipe_;
  const ClassSet& classes_;
  render::LabelSet labels_;  // of the EXR file
  Workers workers_;
  std::optional<render::World> world_;  // of the last sample
  render::Workspace workspace_;
  render::Target target_;
  ocean::SeaFrame sea_;
  EyeWarning warning_;
};

// "images/000017.png" of ("images", 17, "png").
std::string sample_file(const std::string& folder, int sample, const std::string& extension);

}  // namespace swell::apps
