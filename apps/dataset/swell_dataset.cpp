// swell-dataset: draws a data set by a recipe.
#include <fmt/core.h>
#include <unistd.h>

#include <filesystem>
#include <stdexcept>

#include "apps/dataset/data_set_folder.h"
#include "apps/dataset/dataset_options.h"
#include "apps/dataset/recipe_files.h"
#include "apps/shared/label_file.h"
#include "apps/shared/options.h"
#include "apps/shared/program.h"
#include "apps/shared/progress.h"
#include "scene/file/recipe.h"

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

// Drawn counts the samples of the shard that was asked for, and those of them that were drawn.
struct Drawn {
  int samples = 0, drawn = 0;
};

Drawn draw_samples(const DatasetOptions& options, const scene::Recipe& recipe,
                   const ClassSet& classes, render::LabelSet labels, DataSetFolder& folder) {
  const auto [first, step] = options.shard;
  Drawn done{first < recipe.count ? (recipe.count - 1 - first) / step + 1 : 0};
  Progress progress(done.samples, options.quiet, "samples");
  SampleMaker maker(recipe, classes, labels, options.threads);
  for (int n = first; n < recipe.count; n += step) {
    if (folder.has(n)) {
      progress.skip();
      continue;
    }
    folder.write(n, maker.make(n));
    ++done.drawn;
    progress.step();
  }
  return done;
}

// Where no terminal shows the progress: the run's last line.
void say(const DatasetOptions& options, const std::string& text) {
  if (options.quiet || isatty(STDERR_FILENO) != 0) return;
  fmt::print(stderr, "{}\n", one_line(fmt::format("{}: {}", options.out, text)));
}

void fill(const DatasetOptions& options, const scene::Recipe& recipe, const ClassSet& classes,
          render::LabelSet labels) {
  try_files(recipe, options.threads);
  DataSetFolder folder(options.out, recipe, !labels.empty(), DataSetFolder::Use::kFill);
  if (folder.has_older_records())
    fmt::print(stderr, "note: {}\n",
               one_line(fmt::format("{}: records of an earlier version, without a hash over "
                                    "themselves: these samples are drawn again",
                                    options.out)));
  const Drawn done = draw_samples(options, recipe, classes, labels, folder);
  const std::string missing = folder.missing();
  if (missing.empty()) folder.finish(classes);
  say(options,
      fmt::format("{} of {} samples drawn, the others were there; the data set is {}", done.drawn,
                  done.samples, missing.empty() ? "complete" : "not complete: " + missing));
}

void check(const DatasetOptions& options, const scene::Recipe& recipe, bool has_labels) {
  if (!std::filesystem::is_directory(options.out))
    throw std::runtime_error(one_line(options.out + ": got no folder, allowed one of a data set"));
  const DataSetFolder folder(options.out, recipe, has_labels, DataSetFolder::Use::kCheck);
  if (const std::string fault = folder.fault(); !fault.empty())
    throw std::runtime_error(one_line(fmt::format("{}: {}", options.out, fault)));
  say(options, fmt::format("{} samples, all files as the manifest says", recipe.count));
}

void run(const DatasetOptions& options) {
  select_simd(options.simd);
  const scene::Recipe recipe = scene::load_recipe(options.recipe);
  const render::LabelSet labels = labels_of(recipe);
  const ClassSet classes = classes_of(recipe);
  if (options.try_only)
    try_files(recipe, options.threads);
  else if (options.check)
    check(options, recipe, !labels.empty());
  else
    fill(options, recipe, classes, labels);
}

}  // namespace
}  // namespace swell::apps

int main(int argc, char** argv) {
  return swell::apps::run_program([&] {
    const auto options = swell::apps::parse_dataset_options(argc, argv);
    if (options) swell::apps::run(*options);
  });
}
