// Beams among trees: what they meet belongs to the tree that it says, and to the picture's.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "render/labels/label_channels.h"
#include "render/labels/labels.h"
#include "render/measure/lidar.h"
#include "render/shot.h"
#include "render/world/forest.h"
#include "render/world/world_state.h"

namespace swell::render {
namespace {

constexpr int kWidth = 480, kHeight = 360;

// Trees on a beach to the south, in still air, so near that they are drawn with all their leaves.
World grove(terrain::TreeSpecies species) {
  scene::Scene scene;
  scene.round_earth = false;
  scene.sea.wind_speed_mps = 0.0;
  scene.terrain.emplace();
  scene.terrain->coast_m = {{-500.0, 0.0}, {500.0, 0.0}};
  scene.terrain->beach_slope = 0.1;
  scene.terrain->beach_size_m = 200.0;
  scene.trees.push_back({.species = species,
                         .density_per_m2 = 0.02,
                         .clumping = 0.0,
                         .height_m = {6.0, 9.0},
                         .ground_m = {0.5, 100.0}});
  scene.camera.eye_m = {0.0, 12.0, 4.0};
  scene.camera.heading_rad = kPi;
  scene.camera.fov_y_rad = radians(15.0);
  return world_of(scene);
}

struct Scanned {
  Shot shot;
  std::vector<LidarReturn> returns;  // of beams through the pixels' middles

  explicit Scanned(const World& world) {
    shot.draw(world, view_of(world, 0.0, kWidth, kHeight), 0.0, {.labels = LabelSet::all()});
    std::vector<LidarBeam> beams;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const glm::dvec3 d = shot.direction(x, y);
        beams.push_back({std::atan2(d.y, d.x), std::atan2(d.z, std::hypot(d.x, d.y))});
      }
    returns.resize(beams.size());
    Lidar(world, shot.workers)
        .scan({.begin = {shot.view.eye_world}, .beams = beams}, returns, shot.workers);
  }
};

class Grove : public testing::TestWithParam<terrain::TreeSpecies> {};

TEST_P(Grove, BeamsMeetTheTreesThatTheyName) {
  const World world = grove(GetParam());
  const Forest& forest = *world.state().forest;
  const Scanned scanned(world);
  int leaves = 0, trunks = 0;
  for (const LidarReturn& r : scanned.returns) {
    if (r.id < kFirstTreeId) continue;
    ASSERT_LT(r.id - kFirstTreeId, forest.trees.trees.size());
    EXPECT_EQ(r.klass, world.state().tree_class);
    const terrain::Tree& tree = forest.trees.trees[r.id - kFirstTreeId];
    // The sensor's axes are the world's.
    const glm::dvec3 from_foot = scanned.shot.view.eye_world + glm::dvec3(r.p_sensor) -
                                 forest.trees.origin - glm::dvec3(tree.foot);
    const auto radius_m = static_cast<double>(tree.radius_m);
    const auto height_m = static_cast<double>(tree.height_m);
    EXPECT_LT(std::hypot(from_foot.x, from_foot.y), 1.5 * radius_m);
    EXPECT_GT(from_foot.z, -0.15 * height_m);
    EXPECT_LT(from_foot.z, 1.15 * height_m);
    // Leaves in all directions have a mean cosine of a half.
    const bool is_leaf = std::abs(r.intensity - 0.45f * 0.5f) < 1e-3f;
    const bool is_trunk = std::abs(r.intensity - 0.3f) < 1e-3f;
    EXPECT_TRUE(is_leaf || is_trunk) << r.intensity;
    leaves += is_leaf, trunks += is_trunk;
    if (is_trunk) {
      EXPECT_LT(std::hypot(from_foot.x, from_foot.y), 0.1 * height_m);
    }
  }
  fmt::print("{} leaves, {} trunks\n", leaves, trunks);
  EXPECT_GT(leaves, 20000);
  EXPECT_EQ(trunks > 0, GetParam() != terrain::TreeSpecies::kReed);
}

TEST_P(Grove, TreesAreAsFarAsThePicturesLabelsSay) {
  const World world = grove(GetParam());
  const Scanned scanned(world);
  const Labels& labels = scanned.shot.target.labels;
  int compared = 0, others = 0, off = 0;
  for (std::size_t n = 0; n < scanned.returns.size(); ++n) {
    const double drawn_m = distance_of(scanned.shot.view, static_cast<int>(n % kWidth),
                                       static_cast<int>(n / kWidth), labels.depth_m[n]);
    if (labels.id[n] < kFirstTreeId || drawn_m > 25.0) continue;
    ++compared;
    const LidarReturn& r = scanned.returns[n];
    others += r.id != labels.id[n];
    off += std::abs(static_cast<double>(r.range_m) - drawn_m) > 2e-3;
  }
  fmt::print("{} pixels of trees, {} of others, {} off\n", compared, others, off);
  EXPECT_GT(compared, 20000);
  EXPECT_LT(others, compared / 1000);
  EXPECT_LT(off, compared / 1000) << "rounded to the pixels' fixed point";
}

INSTANTIATE_TEST_SUITE_P(Species, Grove,
                         testing::Values(terrain::TreeSpecies::kConifer,
                                         terrain::TreeSpecies::kBroadleaf),
                         [](const auto& species) {
                           return std::string(
                               terrain::kTreeSpeciesNames[static_cast<std::size_t>(species.param)]);
                         });

}  // namespace
}  // namespace swell::render
