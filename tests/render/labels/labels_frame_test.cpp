// Labels as outputs of a frame: same bits however they are made, and nothing else changes.
#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

#include "allocation_count.h"
#include "math/simd_target.h"
#include "render/labelled_frame.h"
#include "render/labels/classes.h"

namespace swell::render {
namespace {

constexpr glm::ivec2 kFrameSize_px(203, 121);  // no whole packets, no whole tiles

struct Drawing {
  int threads = 2;
  int tile_size_px = 64;
  LabelSet labels = LabelSet::all();
  bool wireframe = false;
};

void draw(const World& world, const Drawing& how, Shot& shot) {
  shot.draw(world, random_view(world.scene(), 0, kFrameSize_px), 2.0,
            {.tile_size_px = how.tile_size_px,
             .water_triangles = 4000,
             .wireframe = how.wireframe,
             .labels = how.labels,
             .next_view = random_view(world.scene(), 1, kFrameSize_px)});
}

Target draw(const World& world, const Drawing& how) {
  Shot shot(how.threads);
  draw(world, how, shot);
  return shot.target;
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

// The first label that differs, or nothing.
std::string difference(const Labels& a, const Labels& b) {
  if (!(a.set == b.set)) return "set";
  if (!same_bits(a.depth_m, b.depth_m)) return "depth";
  if (!same_bits(a.normal, b.normal)) return "normal";
  if (!same_bits(a.geometric_normal, b.geometric_normal)) return "geometric normal";
  if (!same_bits(a.id, b.id)) return "id";
  if (!same_bits(a.klass, b.klass)) return "class";
  if (!same_bits(a.motion_px, b.motion_px)) return "motion";
  if (!same_bits(a.elevation_m, b.elevation_m)) return "elevation";
  if (!same_bits(a.foam, b.foam)) return "foam";
  if (!same_bits(a.flags, b.flags)) return "flags";
  return "";
}

class LabelsOfFrame : public testing::TestWithParam<const char*> {
 protected:
  const World& world = shipped_world(GetParam());
};
INSTANTIATE_TEST_SUITE_P(Scenes, LabelsOfFrame,
                         testing::Values("lagoon", "beach", "buoys", "open_ocean_radial"),
                         [](const auto& test) { return std::string(test.param); });

TEST_P(LabelsOfFrame, ThreadsTilesAndSimdTargetChangeNoBit) {
  const Labels reference = draw(world, {}).labels;
  ASSERT_EQ(reference.id.size(), std::size_t{kFrameSize_px.x * kFrameSize_px.y});
  for (const Drawing& how : {Drawing{.threads = 1}, Drawing{.threads = 7},
                             Drawing{.tile_size_px = 16}, Drawing{.tile_size_px = 32}})
    EXPECT_EQ(difference(draw(world, how).labels, reference), "")
        << how.threads << " " << how.tile_size_px;
  if (!simd_target_available(SimdTarget::kAvx512)) return;
  select_simd_target(simd_targets().front());
  EXPECT_EQ(difference(draw(world, {}).labels, reference), "");
  select_simd_target(SimdTarget::kAvx512);
}

// Where a smooth river's pixels are in packets with rough ones on some tiles and not on others.
TEST(Labels, OfARiverChangeNoBitWithTilesAndSimdTarget) {
  const World& world = shipped_world("river");
  const View view = view_of(world, 0.0, 320, 180);
  const auto labels_on = [&](int tile_size_px) {
    return LabelledFrame(world, view, 0.0, {.tile_size_px = tile_size_px}).target.labels;
  };
  const SimdTarget best = current_simd_target();
  const Labels reference = labels_on(64);
  select_simd_target(simd_targets().front());
  for (const int tile_size_px : {16, 32, 64})
    EXPECT_EQ(difference(labels_on(tile_size_px), reference), "") << tile_size_px;
  select_simd_target(best);
}

TEST_P(LabelsOfFrame, ThePictureIsTheSameWithAndWithout) {
  const std::uint64_t without = picture_hash(draw(world, {.labels = {}}));
  EXPECT_EQ(picture_hash(draw(world, {})), without);
}

TEST_P(LabelsOfFrame, AnyOneOfThemIsAsAmongAll) {
  const Labels all = draw(world, {}).labels;
  Shot film;
  for (const LabelInfo& info : label_table()) {
    Drawing how{.labels = {}};
    how.labels.add(info.label);
    draw(world, how, film);
    const bool has_depth = info.label == Label::kDepth || info.label == Label::kDistance ||
                           info.label == Label::kPosition;
    Labels expected;
    expected.set = how.labels;
    if (has_depth) expected.depth_m = all.depth_m;
    if (info.label == Label::kNormal) expected.normal = all.normal;
    if (info.label == Label::kGeometricNormal) expected.geometric_normal = all.geometric_normal;
    if (info.label == Label::kId) expected.id = all.id;
    if (info.label == Label::kClass) expected.klass = all.klass;
    if (info.label == Label::kMotion) expected.motion_px = all.motion_px;
    if (info.label == Label::kElevation) expected.elevation_m = all.elevation_m;
    if (info.label == Label::kFoam) expected.foam = all.foam;
    if (info.label == Label::kFlags) expected.flags = all.flags;
    EXPECT_EQ(difference(film.target.labels, expected), "") << info.name;
  }
}

TEST_P(LabelsOfFrame, SteadyStateAllocatesNothing) {
  Shot film(1);
  const View view = random_view(world.scene(), 0, kFrameSize_px);
  const auto draw_all = [&] {
    for (int k = 0; k < 6; ++k)
      film.draw(world, view, k / 60.0, {.water_triangles = 4000, .labels = LabelSet::all()});
  };
  draw_all();
  const std::uint64_t before = allocation_count();
  draw_all();
  EXPECT_EQ(allocation_count() - before, 0u);
}

TEST(LabelsOfFrames, AWorkspaceGoesFromWorldToWorld) {
  Shot film;
  for (const char* name : {"lagoon", "buoys", "open_ocean_plane", "beach", "sines", "lagoon"}) {
    const World& world = shipped_world(name);
    draw(world, {}, film);
    EXPECT_EQ(difference(film.target.labels, draw(world, {}).labels), "") << name;
    draw(world, {.labels = {}}, film);
    EXPECT_EQ(difference(film.target.labels, {}), "") << name;
  }
}

TEST(LabelsOfFrames, WireframeChangesNone) {
  const World& world = shipped_world("lagoon");
  EXPECT_EQ(difference(draw(world, {.wireframe = true}).labels, draw(world, {}).labels), "");
}

TEST(LabelsOfFramesDeathTest, OptionsThatDoNotGoWithLabelsAreRefused) {
  const World& world = shipped_world("sines");
  const auto draw_with = [&](FrameOptions options) {
    options.labels = LabelSet::all();
    Shot(world, random_view(world.scene(), 0, {32, 32}), 0.0, options, 1);
  };
  EXPECT_DEATH(draw_with({.picture_scale = 0.5}), "picture_scale=0.5");
  EXPECT_DEATH(draw_with({.next_frame_s = 0.0}), "next_frame_s=0");
  EXPECT_DEATH(draw_with({.next_view = random_view(world.scene(), 0, {32, 31})}),
               "next_view of 32x31");
}

TEST(LabelClasses, ObjectsClassesAreNumberedAsTheyFirstCome) {
  scene::Scene scene;
  for (const char* label : {"boat", "", "water", "swimmer", "boat", "object"}) {
    scene.objects.emplace_back();
    scene.objects.back().label = label;
  }
  const std::vector<std::string> names = class_names(scene);
  EXPECT_EQ(names, (std::vector<std::string>{"sky", "water", "terrain", "object", "foam", "boat",
                                             "swimmer"}));
  EXPECT_EQ(object_classes(scene), (std::vector<std::uint32_t>{5, 3, 1, 6, 5, 3}));
  EXPECT_EQ(class_of(names, "swimmer"), 6u);
  EXPECT_EQ(class_of(names, "whale"), std::nullopt);
}

}  // namespace
}  // namespace swell::render
