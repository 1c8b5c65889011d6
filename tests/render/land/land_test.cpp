// What the ground is made of: where, and that neither distance nor motion changes what is seen.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "render/linear_renderer.h"
#include "render/measures.h"
#include "render/world/ground_cover.h"
#include "render/world/terrain_maps.h"
#include "render/world/world_state.h"
#include "terrain/height_grid.h"

namespace swell::render {
namespace {

scene::Scene hills() { return scene::load_scene(SWELL_SOURCE_DIR "/tests/scenes/hills.toml"); }

const World& hill_world() {
  static const World world = world_of(hills());
  return world;
}

// Level 0 of the cover map: grass, dry growth, rock and sky in [0, 1].
glm::vec4 cover_at(const World& world, int i, int j) {
  const texture::CoverMap& map = world.state().terrain_maps->ground[0];
  const auto& bytes = map.words[static_cast<std::size_t>(map.size) * map.size +
                                static_cast<std::size_t>(j) * map.size + i]
                          .bytes;
  const auto value = [&](int channel) {
    return (static_cast<float>(bytes[static_cast<std::size_t>(4 * channel)]) + 127.0f) / 254.0f;
  };
  return {value(0), value(1), value(2), value(3)};
}

// Mean cover over texels that are alike.
class MeanCover {
 public:
  void add(const glm::vec4& cover) { sum_ += cover, ++count_; }
  glm::vec4 mean() const { return sum_ / static_cast<float>(count_); }
  int count() const { return count_; }

 private:
  glm::vec4 sum_{0.0f};
  int count_ = 0;
};

TEST(Land, HasItsMaterialsByHeightAndSteepness) {
  const World& world = hill_world();
  const terrain::HeightGrid& land = *world.state().terrain;
  const terrain::GroundMaterials& materials = world.scene().terrain->ground;
  const int size = world.state().terrain_maps->ground[0].size;
  const double step_m = land.grid.size_m() / size;
  MeanCover cliffs, meadows, beaches;
  for (int j = 8; j < size - 8; j += 3) {
    for (int i = 8; i < size - 8; i += 3) {
      const glm::dvec2 p = land.grid.min_world + step_m * glm::dvec2(i, j);
      const double height_m = terrain::height_at(land, p);
      const double along_x = terrain::height_at(land, p + glm::dvec2(step_m, 0.0)) -
                             terrain::height_at(land, p - glm::dvec2(step_m, 0.0));
      const double along_y = terrain::height_at(land, p + glm::dvec2(0.0, step_m)) -
                             terrain::height_at(land, p - glm::dvec2(0.0, step_m));
      const double steepness = std::hypot(along_x, along_y) / (2.0 * step_m);
      const glm::vec4 cover = cover_at(world, i, j);
      EXPECT_LE(cover.x + cover.y + cover.z, 1.02f);
      if (steepness > 1.6 * materials.rock_slope)
        cliffs.add(cover);
      else if (steepness < 0.4 * materials.rock_slope && height_m > materials.grass_from_m + 6.0)
        meadows.add(cover);
      else if (steepness < 0.2 && height_m > 0.0 && height_m < materials.grass_from_m - 1.6)
        beaches.add(cover);
    }
  }
  ASSERT_GT(std::min({cliffs.count(), meadows.count(), beaches.count()}), 100);
  EXPECT_GT(cliffs.mean().z, 0.95f);
  EXPECT_GT(meadows.mean().x + meadows.mean().y, 0.8f);
  EXPECT_LT(meadows.mean().z, 0.01f);
  EXPECT_LT(beaches.mean().x + beaches.mean().y + beaches.mean().z, 0.02f);
}

TEST(Land, IsGreenerWhereItIsWet) {
  const terrain::GroundMaterials materials;
  const auto cover = [&](float hollow) {
    return cover_of({30.0f, 0.2f, hollow, 0.0f, 0.0f}, materials);
  };
  EXPECT_GT(cover(0.8f)[Cover::kGrass], cover(0.0f)[Cover::kGrass]);
  EXPECT_GT(cover(0.0f)[Cover::kGrass], cover(-0.8f)[Cover::kGrass]);
  EXPECT_GT(cover(-0.8f)[Cover::kDry], cover(0.8f)[Cover::kDry]);
}

// A wedge-shaped valley between two planes of 45 degrees: the horizon stands at most 90 degrees
// over a slope's own plane; on the planes and the ridges nothing does.
TEST(Land, SeesLessSkyInValleys) {
  constexpr int kSize = 256;
  Workers workers(2);
  std::vector<float> height_m;
  for (int j = 0; j < kSize; ++j)
    for (int i = 0; i < kSize; ++i) height_m.push_back(std::abs(static_cast<float>(i - kSize / 2)));
  const LargeArray<float> seen = find_sky_seen(kSize, height_m, 1.0, workers);
  const auto at = [&](int i) { return seen[static_cast<std::size_t>(kSize / 2) * kSize + i]; };
  // At the bottom the ground rises at 45 degrees to either hand, along diagonals at 35.3: cos^2 is
  // 1/2 twice, 2/3 four times and 1 twice.
  EXPECT_NEAR(at(kSize / 2), (2.0 / 2.0 + 4.0 * 2.0 / 3.0 + 2.0) / 8.0, 0.02);
  EXPECT_LT(at(kSize / 2 + 12), 0.95f);
  EXPECT_GT(at(kSize / 2 + 12), at(kSize / 2));
  std::vector<float> ridge;
  for (const float h : height_m) ridge.push_back(-h);
  for (const float open : find_sky_seen(kSize, ridge, 1.0, workers)) EXPECT_EQ(open, 1.0f);
}

// A camera above a meadow, on pictures of any size.
View above_meadow(double height_m, int width_px, int height_px) {
  return make_view({330.0, 120.0, height_m}, 0.4, radians(-80.0), radians(50.0), 0.25f, width_px,
                   height_px);
}

glm::dvec3 mean_light(LinearRenderer& renderer, const View& view) {
  renderer.draw_view(view, 0.0);
  glm::dvec3 sum(0.0);
  for (int y = 0; y < view.height_px; ++y)
    for (int x = 0; x < view.width_px; ++x) sum += glm::dvec3(renderer.linear(x, y));
  return sum / static_cast<double>(view.width_px * view.height_px);
}

// A piece of ground has the same mean on few pixels as on many.
TEST(Land, HasTheSameMeanColourFromAnyDistance) {
  LinearRenderer renderer(hills());
  for (const double height_m : {160.0, 260.0, 900.0}) {
    const glm::dvec3 near = mean_light(renderer, above_meadow(height_m, 512, 288));
    const glm::dvec3 far = mean_light(renderer, above_meadow(height_m, 32, 18));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(far[c] / near[c], 1.0, 0.02) << height_m << " " << c;
  }
}

// While the camera turns by a quarter of a pixel a frame, pixels go from what they show to what
// their neighbour shows without turning round on the way.
TEST(Land, DoesNotShimmerInASlowPan) {
  Shot film;
  for (const glm::dvec3& eye :
       {glm::dvec3(-500.0, -500.0, 330.0), glm::dvec3(330.0, 120.0, 130.0)}) {
    std::vector<std::vector<int>> frames;
    for (int n = 0; n < 9; ++n) {
      const double heading = radians(45.0 + n * 0.25 * 70.0 / 240);
      const View view = make_view(eye, heading, radians(-35.0), radians(40.0), 0.25f, 240, 136);
      frames.push_back(green_codes(film.draw(hill_world(), view, 0.0, {.edge_samples = 0})));
    }
    EXPECT_LT(part_reversed(frames, 12), 0.004) << eye.z;
  }
}

TEST(Land, CanBeLeftOut) {
  const View view = view_of(hill_world(), 0.0, 64, 48);
  const Shot with(hill_world(), view, 0.0);
  const Shot without(hill_world(), view, 0.0, {.without = {Part::kLandDetail}});
  EXPECT_TRUE(with.state().shading.material<Terrain>().land.on);
  EXPECT_FALSE(without.state().shading.material<Terrain>().land.on);
  EXPECT_NE(with.target.rgba, without.target.rgba);
}

}  // namespace
}  // namespace swell::render
