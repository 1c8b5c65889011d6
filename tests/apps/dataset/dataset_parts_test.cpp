// The parts of swell-dataset against known answers.
#include <gtest/gtest.h>

#include <random>

#include "apps/dataset/class_sets.h"
#include "apps/dataset/dataset_options.h"
#include "apps/dataset/instances.h"
#include "apps/shared/program.h"
#include "scene/file/recipe.h"
#include "scene/scene.h"

namespace swell::apps {
namespace {

TEST(Instances, RunsGoDownTheColumns) {
  // 3 columns, 2 rows:  7 0 9 / 7 7 0
  const std::vector<std::uint32_t> ids = {7, 0, 9, 7, 7, 0};
  const auto found = find_instances(ids, 3, 5, 9);  // 9 is beyond
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].id, 7u);
  EXPECT_EQ(found[0].x_px, 0);
  EXPECT_EQ(found[0].y_px, 0);
  EXPECT_EQ(found[0].width_px, 2);
  EXPECT_EQ(found[0].height_px, 2);
  EXPECT_EQ(found[0].area_px, 3);
  EXPECT_EQ(found[0].runs, (std::vector<std::int64_t>{0, 2, 1, 1, 2}));
  const auto last = find_instances(ids, 3, 9, 10);
  ASSERT_EQ(last.size(), 1u);
  EXPECT_EQ(last[0].runs, (std::vector<std::int64_t>{4, 1, 1}));
}

TEST(Instances, RunsPaintTheMaskThatTheyComeFrom) {
  constexpr int kWidth = 17, kHeight = 11;
  std::mt19937 random(3);
  std::vector<std::uint32_t> ids(kWidth * kHeight);
  for (std::uint32_t& id : ids) id = random() % 4;
  std::vector<std::uint32_t> painted(ids.size(), 0);
  for (const Instance& instance : find_instances(ids, kWidth, 1, 4)) {
    std::size_t place = 0;
    for (std::size_t run = 0; run < instance.runs.size(); ++run)
      for (std::int64_t i = 0; i < instance.runs[run]; ++i, ++place)
        if (run % 2 == 1) painted[place % kHeight * kWidth + place / kHeight] = instance.id;
    EXPECT_EQ(place, ids.size());
  }
  EXPECT_EQ(painted, ids);
}

TEST(ClassSets, HoldWhatTheirDataSetsHold) {
  scene::Scene scene;
  scene.objects.resize(3);
  scene.objects[0].kind = scene::ObjectKind::kBuoy;
  scene.objects[1].kind = scene::ObjectKind::kPier;
  scene.objects[2].kind = scene::ObjectKind::kMesh;
  scene.objects[2].label = "swimmer";
  scene.objects[2].name = "hull";
  render::Labels labels;
  // Sky, water, foam, land, a buoy, a pier, the mesh, a tree.
  labels.id = {0, 1, 1, 2, 16, 17, 18, 4096};
  labels.klass = {0, 1, 4, 2, 3, 3, 5, 2};
  const auto map = [&](std::string_view name) {
    return ClassSet::find(name, scene)->class_map(labels, scene);
  };
  using Map = std::vector<std::uint8_t>;
  EXPECT_EQ(map("lars"), (Map{2, 1, 1, 0, 0, 0, 0, 0}));
  EXPECT_EQ(map("mastr1325"), (Map{2, 1, 1, 0, 0, 0, 0, 0}));
  EXPECT_EQ(map("waterscenes"), (Map{0, 0, 0, 0, 2, 1, 0, 0}));
  EXPECT_EQ(map("swell"), (Map{0, 1, 4, 2, 3, 3, 5, 2}));

  const auto category = [&](std::string_view name, std::size_t object) {
    return ClassSet::find(name, scene)->category_of(scene.objects[object]).value_or(-1);
  };
  EXPECT_EQ(category("lars", 0), 14);
  EXPECT_EQ(category("lars", 1), -1);
  EXPECT_EQ(category("lars", 2), 15);
  EXPECT_EQ(category("mastr1325", 2), 1);
  EXPECT_EQ(category("waterscenes", 1), 1);
  EXPECT_EQ(category("swell", 2), 11);  // after the ten kinds

  // One's own hull is to be ignored.
  scene.camera.mount = "hull";
  EXPECT_EQ(map("lars")[6], 255);
  EXPECT_EQ(map("mastr1325")[6], 4);
  EXPECT_FALSE(ClassSet::find("coco", scene));
}

TEST(Recipes, AnotherKeyChangesNoOther) {
  scene::Recipe recipe;
  recipe.seed = 5;
  recipe.ranges = {{"wind.speed_mps", 1.0, 9.0, false}};
  const auto alone = draw_sample(recipe, 3).settings;
  recipe.ranges.insert(recipe.ranges.begin(), {"sky.cloud_seed", 1.0, 4.0, true});
  recipe.choices = {{"camera.fov_y_deg", {"20", "40"}}};
  const auto more = draw_sample(recipe, 3).settings;
  ASSERT_EQ(more.size(), 3u);
  EXPECT_EQ(more[1], alone[0]);
}

TEST(Recipes, DrawsAreEvenlySpread) {
  scene::Recipe recipe;
  recipe.ranges = {{"a", 2.0, 4.0, false}, {"n", 1.0, 3.0, true}};
  recipe.choices = {{"c", {"x", "y"}}};
  constexpr int kSamples = 6000;
  double sum = 0.0, sum2 = 0.0;
  int whole[4] = {}, choice = 0;
  for (int n = 0; n < kSamples; ++n) {
    const auto settings = draw_sample(recipe, n).settings;
    const double a = std::stod(settings[0].substr(2));
    EXPECT_GE(a, 2.0);
    EXPECT_LE(a, 4.0);
    sum += a;
    sum2 += a * a;
    ++whole[std::stoi(settings[1].substr(2))];
    choice += settings[2] == "c=x";
  }
  // Within five standard deviations.
  EXPECT_NEAR(sum / kSamples, 3.0, 0.04);
  EXPECT_NEAR(sum2 / kSamples - 9.0, 1.0 / 3.0, 0.25);
  for (int n = 1; n <= 3; ++n) EXPECT_NEAR(whole[n], kSamples / 3, 185);
  EXPECT_NEAR(choice, kSamples / 2, 195);
}

TEST(Shards, AreCountedFromZero) {
  EXPECT_EQ(parse_shard("0/1").count, 1);
  EXPECT_EQ(parse_shard("7/8").index, 7);
  for (const char* text : {"", "1", "8/8", "-1/8", "1/0", "1/", "/2", "a/b", "1/2/3"})
    EXPECT_THROW(parse_shard(text), OptionError) << text;
}

}  // namespace
}  // namespace swell::apps
