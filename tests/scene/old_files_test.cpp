// Files that shipped with a version stay readable: files that people wrote for it do, too.
#include <gtest/gtest.h>

#include <filesystem>

#include "scene/file/recipe.h"
#include "scene/scene.h"

namespace swell::scene {
namespace {

int read_all(const std::filesystem::path& folder) {
  int read = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".toml") continue;
    ++read;
    EXPECT_NO_THROW(load_scene(entry.path())) << entry.path();
  }
  return read;
}

TEST(OldFiles, OfVersion_0_1_0) {
  const auto folder = std::filesystem::path(SWELL_SOURCE_DIR) / "tests/scenes_0.1.0";
  EXPECT_EQ(read_all(folder), 31);
  EXPECT_EQ(read_all(folder / "papers"), 9);
  EXPECT_NO_THROW(load_recipe(folder / "recipes/harbour.toml"));
}

}  // namespace
}  // namespace swell::scene
