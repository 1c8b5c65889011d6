// swell-dataset: draws a data set by a recipe.
#include <fmt/core.h>

#include <filesystem>
#include <stdexcept>

#include "apps/dataset/data_set_folder.h"
#include "apps/dataset/dataset_options.h"
#include "apps/shared/label_file.h"
#include "apps/shared/options.h"
#include "apps/shared/program.h"
#include "apps/shared/progress.h"
#include "scene/recipe.h"

namespace swell::apps {
namespace {

[[noreturn]] void refuse(const scene::Recipe& recipe, std::string_view key, std::string_view got,
                         const std::string& allowed) {
  throw scene::SceneError(one_line(
      fmt::format("{}: {}, got '{}', allowed {}", recipe.file.string(), key, got, allowed)));
}

render::LabelSet labels_of(const scene::Recipe& recipe) {
  if (recipe.labels.empty()) return {};
  const auto labels = parse_labels(recipe.labels);
  if (!labels) refuse(recipe, "labels", recipe.labels, label_names() + ", with commas");
  return *labels;
}

ClassSet classes_of(const scene::Recipe& recipe) {
  const auto classes = ClassSet::find(recipe.classes, scene::scene_of_all(recipe));
  if (!classes) refuse(recipe, "classes", recipe.classes, ClassSet::names());
  return *classes;
}

void draw_samples(const DatasetOptions& options, const scene::Recipe& recipe,
                  const ClassSet& classes, render::LabelSet labels, const DataSetFolder& folder) {
  const auto [first, step] = options.shard;
  Progress progress(first < recipe.count ? (recipe.count - 1 - first) / step + 1 : 0, options.quiet,
                    "samples");
  SampleMaker maker(recipe, classes, labels, options.threads);
  for (int n = first; n < recipe.count; n += step) {
    if (folder.has(n)) {
      progress.skip();
      continue;
    }
    folder.write(n, maker.make(n));
    progress.step();
  }
}

void run(const DatasetOptions& options) {
  select_simd(options.simd);
  const scene::Recipe recipe = scene::load_recipe(options.recipe);
  const render::LabelSet labels = labels_of(recipe);
  const ClassSet classes = classes_of(recipe);
  if (options.check && !std::filesystem::is_directory(options.out))
    throw std::runtime_error(options.out + ": no folder of a data set");
  const DataSetFolder folder(options.out, recipe, !labels.empty());
  if (!options.check) {
    draw_samples(options, recipe, classes, labels, folder);
    if (folder.is_complete()) folder.finish(classes);
  } else if (const std::string fault = folder.fault(); !fault.empty()) {
    throw std::runtime_error(fmt::format("{}: {}", options.out, fault));
  }
}

}  // namespace
}  // namespace swell::apps

int main(int argc, char** argv) {
  return swell::apps::run_program([&] {
    const auto options = swell::apps::parse_dataset_options(argc, argv);
    if (options) swell::apps::run(*options);
  });
}
