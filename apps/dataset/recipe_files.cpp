#include "apps/dataset/recipe_files.h"

#include <fmt/core.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>
#include <vector>

#include "apps/shared/program.h"
#include "render/frame.h"
#include "scene/file/scene_files.h"
#include "scene/scene_error.h"
#include "shapes/run_importer.h"

namespace swell::apps {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Files = std::vector<scene::SceneFile>;

// Adds those of the scene that are not among the files yet; false if there were none.
bool add_files(Files& files, const scene::Scene& scene) {
  const std::size_t before = files.size();
  for (const scene::SceneFile& file : scene::files_of(scene))
    if (std::ranges::find(files, file) == files.end()) files.push_back(file);
  return files.size() > before;
}

[[noreturn]] void refuse(const std::string& path, const std::string& what) {
  throw scene::SceneError(one_line(fmt::format("{}: {}", path, what)));
}

Bytes read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse(path, "got no file that can be read, allowed a file");
  return {std::istreambuf_iterator<char>(file), {}};
}

Bytes content_of(const scene::SceneFile& file) {
  if (!file.is_mesh) return read_file(file.path);
  try {
    const std::vector<char> mesh = shapes::run_importer(file.path, file.up);
    return {mesh.begin(), mesh.end()};
  } catch (const std::runtime_error& error) {
    refuse(file.path, error.what());
  }
}

Bytes text_and_scene(const scene::Recipe& recipe) {
  Bytes bytes(recipe.text.begin(), recipe.text.end());
  bytes.push_back(0);
  const Bytes scene = read_file(recipe.scene.string());
  bytes.insert(bytes.end(), scene.begin(), scene.end());
  return bytes;
}

}  // namespace

void try_files(const scene::Recipe& recipe, int threads) {
  Files tried;
  std::optional<render::World> world;
  scene::for_each_trial(recipe, [&](const scene::Scene& scene) {
    if (add_files(tried, scene))
      world = world ? render::World(scene, *world, threads) : render::World(scene, threads);
  });
}

std::string recipe_hash(const scene::Recipe& recipe) {
  Files files;
  scene::for_each_trial(recipe, [&](const scene::Scene& scene) { add_files(files, scene); });
  Bytes bytes = text_and_scene(recipe);
  for (const scene::SceneFile& file : files) {
    bytes.push_back(0);
    const std::string hash = file_hash(content_of(file));
    bytes.insert(bytes.end(), hash.begin(), hash.end());
  }
  return file_hash(bytes);
}

std::string recipe_hash_without_files(const scene::Recipe& recipe) {
  return file_hash(text_and_scene(recipe));
}

std::string file_hash(std::span<const std::uint8_t> bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace swell::apps
