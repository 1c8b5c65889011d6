// The matrix of the determinism contract: every scene file, and a view from high up, five times
// each, on several thread counts, SIMD targets and tile sizes, each picture against one made in
// another way.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "math/simd_target.h"
#include "render/shot.h"
#include "render/world_view.h"
#include "scene/scene.h"

namespace swell::render {
namespace {

namespace fs = std::filesystem;

struct Way {
  int threads;
  SimdTarget simd;
  int tile_size_px;
};
const Way kReference{2, simd_targets().front(), 64};
const Way kWays[] = {{1, simd_targets().back(), 64},
                     {3, simd_targets().front(), 32},
                     {7, simd_targets().back(), 16},
                     {16, simd_targets().back(), 32}};
constexpr double kTimes_s[] = {0.0, 0.7, 13.0, 601.5, 86400.0};

std::vector<fs::path> scene_files() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(fs::path(SWELL_SOURCE_DIR) / "scenes"))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  for (const char* const name : {"cumulus", "fog", "from_10km", "stars"})
    files.push_back(fs::path(SWELL_SOURCE_DIR) / fmt::format("tests/scenes/{}.toml", name));
  std::sort(files.begin(), files.end());
  return files;
}

std::string name_of(const fs::path& file) { return file.stem().string(); }

class EverySceneFile : public testing::TestWithParam<fs::path> {
 protected:
  void TearDown() override {
    for (const SimdTarget target : simd_targets())
      if (simd_target_available(target)) select_simd_target(target);
  }
};
INSTANTIATE_TEST_SUITE_P(Scenes, EverySceneFile, testing::ValuesIn(scene_files()),
                         [](const auto& test) { return name_of(test.param); });

std::uint64_t hash_of(const World& world, double t_s, const Way& way, Workspace& workspace,
                      Target& target) {
  select_simd_target(way.simd);
  Workers workers(way.threads);
  ocean::SeaFrame sea;
  render_frame(world, world_view(world, t_s, 160, 90, sea, workers), t_s,
               {.tile_size_px = way.tile_size_px, .water_triangles = 6000}, workspace, target,
               workers);
  return picture_hash(target);
}

TEST_P(EverySceneFile, IsTheSamePictureHoweverItIsDrawn) {
  const World world = world_of(scene::load_scene(GetParam()));
  // One workspace goes through all ways and times, the reference has one of its own.
  Workspace workspace, reference_workspace;
  Target target;
  for (const double t_s : kTimes_s) {
    const std::uint64_t expected = hash_of(world, t_s, kReference, reference_workspace, target);
    for (const Way& way : kWays) {
      if (!simd_target_available(way.simd)) continue;
      ASSERT_EQ(hash_of(world, t_s, way, workspace, target), expected)
          << "t=" << t_s << " threads=" << way.threads << ' ' << simd_target_name(way.simd)
          << " tile=" << way.tile_size_px;
    }
  }
}

TEST(SceneFiles, AreDrawnOnBothTargets) {
  if (!simd_target_available(SimdTarget::kAvx512))
    GTEST_SKIP() << "this CPU has no AVX-512: the matrix was drawn on AVX2 alone";
}

TEST(SceneFiles, AreAtLeastTwelve) { EXPECT_GE(scene_files().size(), 12u); }

}  // namespace
}  // namespace swell::render
