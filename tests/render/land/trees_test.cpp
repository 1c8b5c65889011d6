// Trees in pictures.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <string>

#include "math/random.h"
#include "math/simd_target.h"
#include "raster/pass.h"
#include "render/labels/classes.h"
#include "render/labels/label_channels.h"
#include "render/measures.h"
#include "render/shot.h"
#include "render/view/choose_trees.h"
#include "render/world/forest.h"
#include "render/world/world_state.h"
#include "scene/terrain.h"
#include "sky/sky_light.h"

namespace swell::render {
namespace {

constexpr double kTime_s = 3.0;
constexpr int kTreesWide = 192, kTreesHigh = 112;

// A small wooded island in a calm sea, without haze to hide anything.
scene::Scene wooded_island(const std::string& more = "") {
  return scene::parse_scene(R"(
    [camera]
    eye_m = [0.0, -210.0, 5.0]
    heading_deg = 0.0
    pitch_deg = -4.0
    fov_y_deg = 40.0
    [sky]
    cloud_cover = 0.0
    haze_distance_m = 1e6
    [wind]
    speed_mps = 2.0
    [sea]
    patch_lengths_m = [60.0, 13.0]
    resolution = 64
    amplitude_scale = 0.3
    [detail]
    water_triangles = 3000
    terrain_triangles = 3000
    [terrain]
    island_radius_m = 130.0
    island_height_m = 30.0
    [[trees]]
    density_per_m2 = 0.02
    height_m = [6.0, 14.0]
    clumping = 0.2
)" + more,
                            "wooded_island.toml");
}

const World& island_world() {
  static const World world = world_of(wooded_island());
  return world;
}

Shot tree_shot(const World& world, const FrameOptions& options = {}, int threads = 2) {
  return Shot(world, view_of(world, kTime_s, kTreesWide, kTreesHigh), kTime_s, options, threads);
}

int luma(std::uint32_t rgba) {
  return static_cast<int>((rgba & 255) * 2 + (rgba >> 8 & 255) * 5 + (rgba >> 16 & 255)) / 8;
}

double mean_luma_difference(const Target& a, const Target& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i)
    sum += std::abs(luma(a.rgba[i]) - luma(b.rgba[i]));
  return sum / static_cast<double>(a.rgba.size());
}

TEST(DrawnTrees, HaveTheSameBitsOnAnyThreadsTilesAndTargets) {
  const Shot reference = tree_shot(island_world(), {.edge_samples = 4}, 1);
  const auto expect_same = [&](const World& world, int tile_size_px, int threads) {
    const FrameOptions options = {.tile_size_px = tile_size_px, .edge_samples = 4};
    const Shot shot = tree_shot(world, options, threads);
    EXPECT_EQ(difference(shot.target, reference.target), "") << tile_size_px << " " << threads;
  };
  expect_same(island_world(), 64, 3);
  for (const int tile : {16, 32}) expect_same(island_world(), tile, 2);
  expect_same(World(wooded_island(), 1), 64, 2);
  if (!simd_target_available(SimdTarget::kAvx512)) return;
  select_simd_target(simd_targets().front());
  expect_same(island_world(), 64, 2);
  select_simd_target(SimdTarget::kAvx512);
}

TEST(DrawnTrees, LeaveNoTraceOfFramesBefore) {
  const World& world = island_world();
  Shot film;
  const auto draw_from = [&](glm::dvec3 eye, double heading) {
    const View view = make_view(eye, heading, -0.07, 0.7, 0.25f, kTreesWide, kTreesHigh);
    film.draw(world, view, kTime_s);
  };
  draw_from({20.0, -60.0, 30.0}, 0.3);
  draw_from({500.0, -60.0, 300.0}, -1.5);
  draw_from({0.0, -210.0, 5.0}, 0.0);
  EXPECT_EQ(difference(Shot(world, film.view, kTime_s).target, film.target), "");
}

// Triangles in another order leave each pixel with the same depth and the same triangle.
TEST(DrawnTrees, OrderOfTrianglesChangesNoPixel) {
  const Shot frame(island_world(), view_of(island_world(), kTime_s, 640, 360), kTime_s);
  const auto indices = frame.state().window.draws[SurfaceKind::kTrees].indices;
  ASSERT_GT(indices.size(), 2000u);
  std::vector<std::uint32_t> order(indices.size() / 3), shuffled;
  std::iota(order.begin(), order.end(), 0u);
  std::shuffle(order.begin(), order.end(), std::mt19937(7));  // NOLINT: any order will do
  for (const std::uint32_t t : order)
    shuffled.insert(shuffled.end(), {indices[3 * t], indices[3 * t + 1], indices[3 * t + 2]});
  Workers workers(2);
  const auto drawn = [&](std::span<const std::uint32_t> triangles, raster::Pass& pass) {
    raster::Draw draw;
    draw.p_clip = frame.state().window.vertices_of(SurfaceKind::kTrees).p_clip;
    draw.indices = triangles;
    raster::prepare_pass(std::span(&draw, 1), frame.state().window.viewport(), 64, pass, workers);
  };
  raster::Pass plain_pass, shuffled_pass;
  drawn(indices, plain_pass);
  drawn(shuffled, shuffled_pass);
  std::vector<float> depth(64 * 64), other_depth(depth.size());
  std::vector<std::uint32_t> primitive(depth.size()), other(depth.size());
  int seen = 0;
  const raster::TileGrid grid = raster::tile_grid(frame.state().window.viewport(), 64);
  for (int tile = 0; tile < grid.count(); ++tile) {
    if (!raster::tile_has_triangles(plain_pass, tile)) continue;
    raster::draw_tile(plain_pass, tile, depth, primitive);
    raster::draw_tile(shuffled_pass, tile, other_depth, other);
    EXPECT_EQ(depth, other_depth);
    for (std::size_t i = 0; i < primitive.size(); ++i) {
      if (primitive[i] == raster::kNoPrimitive) {
        EXPECT_EQ(other[i], raster::kNoPrimitive);
        continue;
      }
      EXPECT_EQ(primitive[i], order[other[i]]);
      ++seen;
    }
  }
  EXPECT_GT(seen, 5000);
}

TEST(DrawnTrees, AreLabelledByClassAndNumber) {
  FrameOptions options;
  options.labels.add(Label::kClass);
  options.labels.add(Label::kId);
  const World& world = island_world();
  const Shot frame = tree_shot(world, options);
  const std::vector<std::string> names = class_names(world.scene());
  const auto tree_class = class_of(names, "tree");
  ASSERT_TRUE(tree_class);
  const Labels& labels = frame.target.labels;
  const std::size_t trees = world.state().forest->trees.trees.size();
  int pixels = 0;
  for (std::size_t i = 0; i < labels.klass.size(); ++i) {
    const bool is_tree = labels.klass[i] == *tree_class;
    EXPECT_EQ(is_tree, labels.id[i] >= kFirstTreeId);
    if (!is_tree) continue;
    EXPECT_LT(labels.id[i] - kFirstTreeId, trees);
    ++pixels;
  }
  EXPECT_GT(pixels, 500);
}

// Every label is a whole number that single precision holds.
static_assert(kFirstTreeId + terrain::kMostTrees < 1u << 24);

// TRE-03: from the same places, through lenses that make crowns 50 pixels wide or three, trees
// cover as much of the ground.
TEST(DrawnTrees, CoverAsMuchHoweverSmallTheyAreDrawn) {
  const World& world = island_world();
  const auto tree_class = class_of(class_names(world.scene()), "tree");
  ASSERT_TRUE(tree_class);
  const auto covered_m2 = [&](double distance_m, double pixel_m) {
    // A square of 30 m on the island's middle, seen at 45 degrees.
    const int side_px = static_cast<int>(std::round(30.0 / pixel_m));
    const double away_m = distance_m * std::sqrt(0.5);
    const View view = make_view({0.0, -away_m, away_m + 15.0}, 0.0, -0.25 * kPi,
                                2.0 * std::atan(15.0 / distance_m), 0.25f, side_px, side_px);
    FrameOptions options = {.without = {Part::kWater}};
    options.labels.add(Label::kClass);
    const Shot frame(world, view, kTime_s, options);
    return static_cast<double>(std::ranges::count(frame.target.labels.klass, *tree_class)) *
           pixel_m * pixel_m;
  };
  for (const double distance_m : {200.0, 2000.0}) {
    const double whole_m2 = covered_m2(distance_m, 0.1);
    EXPECT_GT(whole_m2, 90.0);
    for (const double pixel_m : {0.2, 0.3})
      EXPECT_NEAR(covered_m2(distance_m, pixel_m) / whole_m2, 1.0, 0.05)
          << distance_m << " " << pixel_m;
  }
}

// Trees that stand alone, all as high, of both kinds.
const World& sparse_world() {
  static const World world = world_of([] {
    scene::Scene scene = wooded_island();
    scene.trees[0].density_per_m2 = 0.001;
    scene.trees[0].clumping = 0.0;
    scene.trees[0].height_m = {11.9, 12.0};
    return scene;
  }());
  return world;
}

// What a picture shows of a tree of the world, from 8 degrees above and another side of each:
// pixel_m at its middle; `shift` moves the picture by parts of a pixel. Draws with `shot`.
double covered_m2(const World& world, std::uint32_t number, double distance_m, double pixel_m,
                  glm::dvec2 shift, Shot& shot) {
  const terrain::Trees& trees = world.state().forest->trees;
  const terrain::Tree& tree = trees.trees[number];
  const double height_m = static_cast<double>(tree.height_m);
  const double heading = 0.7 * number, down = 8.0 * kPi / 180.0;
  const auto side_px = static_cast<int>(std::ceil(2.0 * height_m / pixel_m));
  const glm::dvec2 ahead(std::sin(heading), std::cos(heading));
  const glm::dvec3 middle = trees.origin + glm::dvec3(tree.foot) +
                            glm::dvec3(0.0, 0.0, 0.5 * height_m) +
                            pixel_m * glm::dvec3(shift.x * ahead.y, -shift.x * ahead.x, shift.y);
  const glm::dvec3 eye = middle + distance_m * glm::dvec3(-std::cos(down) * ahead, std::sin(down));
  const View view =
      make_view(eye, heading, -down, 2.0 * std::atan(0.5 * side_px * pixel_m / distance_m), 0.25f,
                side_px, side_px);
  // So many triangles that the ground hides no more of a foot from afar.
  FrameOptions options = {.terrain_triangles = 30000, .without = {Part::kWater}};
  options.labels.add(Label::kId);
  const Target& picture = shot.draw(world, view, kTime_s, options);
  return static_cast<double>(std::ranges::count(picture.labels.id, kFirstTreeId + number)) *
         pixel_m * pixel_m;
}

// TRE-03: a tree covers as much of pictures of 935 pixels a radian, from 20 m to 2 km, as all of
// its triangles do.
TEST(DrawnTrees, AloneCoverAsMuchFrom20MetresTo2Kilometres) {
  const World& world = sparse_world();
  ASSERT_GT(world.state().forest->trees.trees.size(), 24u);
  Shot shot;
  for (const double distance_m : {20.0, 60.0, 200.0, 400.0, 600.0, 1000.0, 2000.0}) {
    const int shifts = distance_m < 300.0 ? 1 : 8;
    double drawn_m2 = 0.0, whole_m2 = 0.0;
    for (std::uint32_t number = 0; number < 24; ++number) {
      whole_m2 += covered_m2(world, number, distance_m, 0.03, glm::dvec2(0.0), shot);
      for (int k = 0; k < shifts; ++k)
        drawn_m2 += covered_m2(world, number, distance_m, distance_m / 935.0,
                               {random_uniform(5, 2 * k), random_uniform(5, 2 * k + 1)}, shot) /
                    shifts;
    }
    EXPECT_GT(whole_m2, 200.0);
    EXPECT_NEAR(drawn_m2 / whole_m2, 1.0, 0.05) << distance_m << " m";
  }
}

TEST(DrawnTrees, AreMirroredInTheWater) {
  const Shot with = tree_shot(island_world());
  const Shot without = tree_shot(island_world(), {.without = {Part::kTrees}});
  int darker = 0, water = 0;
  for (int y = 0; y < kTreesHigh; ++y)
    for (int x = 0; x < kTreesWide; ++x) {
      if (!with.shows(SurfaceKind::kWater, x, y)) continue;
      const std::size_t at = with.at(x, y);
      ++water;
      darker += luma(with.target.rgba[at]) < luma(without.target.rgba[at]) - 4;
    }
  EXPECT_GT(darker, water / 20);
  const PrimitiveRanges& mirrored = with.state().planar_maps.reflection.view.primitives;
  EXPECT_GT(mirrored.end(SurfaceKind::kTrees), mirrored.begin(SurfaceKind::kTrees));
}

// A sunny wood down to the shore, from above.
TEST(DrawnTrees, CastShadowsOnLandAndSeaAwayFromTheSun) {
  scene::Scene scene = wooded_island();
  scene.trees[0].ground_m.x = 0.1;
  scene.sky.sun_azimuth_rad = 0.0;  // in the north: shadows fall to the south
  scene.sky.sun_elevation_rad = 0.35;
  scene.sky.sun_direction = sky::sun_direction(0.0, 0.35);
  const World world = world_of(scene);
  FrameOptions options;
  options.labels.add(Label::kClass);
  const View view = make_view({0.0, -1.0, 420.0}, 0.0, -1.57, 0.7, 0.25f, kTreesWide, kTreesHigh);
  const Shot with(world, view, kTime_s, options);
  const Shot without(world, view, kTime_s, {.without = {Part::kShadows}});
  int on_land = 0, on_sea_south = 0, on_sea_north = 0;
  for (int y = 0; y < kTreesHigh; ++y)
    for (int x = 0; x < kTreesWide; ++x) {
      const std::size_t at = with.at(x, y);
      const bool darker = luma(with.target.rgba[at]) < luma(without.target.rgba[at]) - 4;
      if (with.target.labels.klass[at] == kTerrainClass) on_land += darker;
      if (with.target.labels.klass[at] != kWaterClass) continue;
      (y > kTreesHigh / 2 ? on_sea_south : on_sea_north) += darker;
    }
  EXPECT_GT(on_land, 100);
  EXPECT_GT(on_sea_south, 20);
  EXPECT_LT(on_sea_north, on_sea_south / 4);
}

// Trees of a ring of places and sizes, each chosen or not as plain arithmetic says.
TEST(ChosenTrees, AreThoseThatThePictureShowsOnAnyTarget) {
  constexpr std::uint32_t kCount = 5000;
  std::mt19937 random(5);  // NOLINT: any numbers will do
  std::uniform_real_distribution<float> part(0.0f, 1.0f);
  TreeColumns trees;
  for (std::uint32_t i = 0; i < kCount + kTreeLanes; ++i) {
    trees.x_m.push_back(3000.0f * part(random) - 1500.0f);
    trees.y_m.push_back(3000.0f * part(random) - 1500.0f);
    trees.z_m.push_back(60.0f * part(random));
    trees.height_m.push_back(2.0f + 14.0f * part(random));
    trees.radius_m.push_back(3.0f * part(random));
    trees.rank.push_back(part(random));
    trees.thinned_px.push_back(9.0f + 7.0f * part(random));
  }
  const View view = make_view({0.0, 0.0, 40.0}, 0.4, -0.1, 0.7, 0.25f, 640, 360);
  TreeSight sight{.planes = frustum_planes(view), .origin_rel = {0.0f, 0.0f, -40.0f}, .px = 500.0f};
  std::vector<std::uint32_t> chosen(kCount + kTreeLanes);
  for (const SimdTarget target : simd_targets()) {
    if (!simd_target_available(target)) continue;
    select_simd_target(target);
    const std::uint32_t first = 3, count = kCount - first;
    const std::uint32_t found = choose_trees(trees, first, count, sight, chosen.data());
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = first; i < kCount; ++i) {
      const glm::vec3 middle =
          glm::vec3(trees.x_m[i], trees.y_m[i], trees.z_m[i] + 0.5f * trees.height_m[i]) +
          sight.origin_rel;
      const float height_px = trees.height_m[i] * sight.px / glm::length(middle);
      bool shown =
          height_px > kLastTree_px && trees.rank[i] < part_of_trees(height_px, trees.thinned_px[i]);
      for (const glm::vec4& plane : sight.planes)
        shown = shown && glm::dot(glm::vec3(plane), middle) + plane.w >=
                             -1.02f * (0.5f * trees.height_m[i] + trees.radius_m[i]);
      if (shown) expected.push_back(i);
    }
    EXPECT_GT(found, 100u);
    EXPECT_EQ(std::vector(chosen.begin(), chosen.begin() + found), expected);
  }
}

TEST(DrawnTrees, LeftOutLeaveTheLandAsItIsWithoutAny) {
  scene::Scene bare = wooded_island();
  bare.trees.clear();
  const World bare_world = world_of(bare);
  const Shot left_out = tree_shot(island_world(), {.without = {Part::kTrees}});
  EXPECT_EQ(difference(left_out.target, tree_shot(bare_world).target), "");
}

TEST(DrawnTrees, SwayWithTheWindAndRepeatThemselves) {
  const World& world = island_world();
  const auto at = [&](double t_s) {
    const Shot shot(world, view_of(world, 0.0, 640, 360), t_s);
    return shot.state().meshes.trees.drawn_in(ViewKind::kWindow).p_rel;
  };
  const auto a = at(1.0), b = at(1.0), c = at(2.0);
  EXPECT_EQ(a, b);
  ASSERT_EQ(a.size(), c.size());
  float most = 0.0f;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, glm::distance(a[i], c[i]));
  EXPECT_GT(most, 0.01f);
  EXPECT_LT(most, 0.5f);
}

// Seen from the side and from above, what covers the picture does not change as trees get fewer
// triangles, thin out and pass into the colour of the land: in steps of 1 % of the distance no
// picture differs from the mean of its neighbours by much more than it does as a rule.
TEST(DrawnTrees, PassIntoTheLandWithoutAPop) {
  const World& world = island_world();
  Shot film;
  std::vector<double> mean;
  // The picture narrows as the eye goes, so that the island stays as large and its trees do not.
  for (int k = 0; k < 60; ++k) {
    const double away = 1.0 + 0.01 * k;
    const View view = make_view({0.0, -900.0 * away, 400.0 * away}, 0.0, -0.42, 0.5, 0.25f,
                                static_cast<int>(220 / away), static_cast<int>(130 / away));
    film.draw(world, view, kTime_s, {.edge_samples = 4, .without = {Part::kWater}});
    double sum = 0.0;
    for (const std::uint32_t pixel : film.target.rgba) sum += luma(pixel);
    mean.push_back(sum / static_cast<double>(film.target.rgba.size()));
  }
  double most = 0.0;
  for (std::size_t k = 1; k + 1 < mean.size(); ++k)
    most = std::max(most, std::abs(mean[k] - 0.5 * (mean[k - 1] + mean[k + 1])));
  EXPECT_LT(most, 0.5) << "of 255";
}

// A step of a thousandth of the distance changes a picture by no more where trees are drawn with
// other triangles than it does without them by motion alone, many times over.
TEST(DrawnTrees, SmallStepsMakeSmallDifferences) {
  const World& world = island_world();
  Shot film;
  Target before;
  std::vector<double> steps;
  for (int k = 0; k < 40; ++k) {
    const double away = 1.0 + 0.001 * k;
    const View view = make_view({0.0, -400.0 * away, 30.0 * away}, 0.0, -0.05, 0.5, 0.25f,
                                kTreesWide, kTreesHigh);
    const Target& now = film.draw(world, view, kTime_s, {.edge_samples = 4});
    if (k > 0) steps.push_back(mean_luma_difference(before, now));
    before = now;
  }
  std::vector<double> sorted = steps;
  std::ranges::sort(sorted);
  EXPECT_LT(sorted.back(), 2.0 * sorted[sorted.size() / 2] + 0.05);
}

TEST(TreesOfScenes, TheSceneOfTreesHasAHundredThousand) {
  const scene::Scene scene = scene::load_scene(SWELL_SOURCE_DIR "/tests/scenes/trees.toml");
  const terrain::HeightGrid land = *scene::build_terrain(scene);
  const terrain::HeightGrid sea = terrain::distance_from_sea(land);
  Workers workers(2);
  const terrain::Trees trees = terrain::plant_trees(scene.trees, land, {.still = &sea}, workers);
  const auto reeds =
      std::ranges::count(trees.trees, terrain::TreeSpecies::kReed, &terrain::Tree::species);
  EXPECT_NEAR(static_cast<double>(std::ssize(trees.trees) - reeds), 100000.0, 5000.0);
  EXPECT_GT(reeds, 1000);
}

TEST(TreesOfScenes, BadInputIsNamedInOneLine) {
  const auto fault_of = [](const std::string& more) -> std::string {
    try {
      const World world = world_of(wooded_island(more));
    } catch (const scene::SceneError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(fault_of("[[trees]]\ndensity_per_m2 = 1e9\n")
                .find("trees[1].density_per_m2, got 1000000000, allowed"),
            std::string::npos);
  EXPECT_NE(fault_of("[[trees]]\nspecies = \"palm\"\n").find("trees[1].species"),
            std::string::npos);
  EXPECT_NE(fault_of("[[trees]]\nheight_m = [9.0, 3.0]\n").find("the lower one first"),
            std::string::npos);
  EXPECT_NE(fault_of("[[trees]]\ndensity_map = \"none.png\"\n").find("No such file"),
            std::string::npos);
  EXPECT_THROW(scene::parse_scene("[[trees]]\n", "bare.toml"), scene::SceneError);
}

}  // namespace
}  // namespace swell::render
