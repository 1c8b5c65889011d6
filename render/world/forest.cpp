#include "render/world/forest.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "math/for_each_row.h"
#include "math/large_array.h"
#include "math/stop.h"
#include "ocean/inland/river_network.h"
#include "scene/check_scene.h"
#include "terrain/terrain.h"

namespace swell::render {
namespace {

using terrain::Tree;
using terrain::TreeSpecies;

constexpr float kLongestShadow = 5.0f;  // of the heights of trees
constexpr double kHighestSea_m = 1.0;   // that waves and tides reach
constexpr float kShadeOfCrown = 0.85f;  // part of the sun's light that a crown takes

// Calls body(i) for each i below count, 4096 a task.
template <class Body>
void for_pieces(std::size_t count, Workers& workers, const Body& body) {
  constexpr std::size_t kPerTask = 4096;
  workers.for_each(count / kPerTask + 1, [&](std::size_t task, int) {
    const std::size_t end = std::min((task + 1) * kPerTask, count);
    for (std::size_t i = task * kPerTask; i < end; ++i) body(i);
  });
}

// An ellipse with a soft rim: half axes `along` a unit direction and `across` it.
struct Disc {
  glm::vec2 middle_m{0.0f}, direction{1.0f, 0.0f};
  float along_m = 0.0f, across_m = 0.0f;
  float part = 0.0f;  // of what lies under it that it takes
};

// A square of values that discs are laid on: what is left between them multiplies.
class DiscMap {
 public:
  DiscMap(int size, double square_m)
      : size_(size), texels_per_m_(static_cast<float>(size / square_m)) {
    const auto texels = static_cast<std::size_t>(size) * size;
    reserve_large(left_, texels);
    left_.assign(texels, 1.0f);
  }

  // Lays discs 0 to count - 1, each disc(i), in their order at every texel.
  template <class DiscOf>
  void add(std::size_t count, Workers& workers, const DiscOf& disc) {
    std::vector<Laid> all(count);
    for_pieces(count, workers, [&](std::size_t i) { all[i] = lay(disc(i)); });
    workers.for_each(static_cast<std::size_t>(size_ / kBandRows), [&](std::size_t band, int) {
      const int first = static_cast<int>(band) * kBandRows, last = first + kBandRows - 1;
      check_stop();
      for (const Laid& one : all)
        if (one.y0 <= last && one.y1 >= first) add_rows(one, first, last);
    });
  }

  float at(glm::vec2 p_m) const {
    const auto limit = [&](float v) {
      return static_cast<std::size_t>(
          std::clamp(static_cast<int>(std::floor(v * texels_per_m_ + 0.5f)), 0, size_ - 1));
    };
    return 1.0f - left_[limit(p_m.y) * static_cast<std::size_t>(size_) + limit(p_m.x)];
  }

  int size() const { return size_; }
  const std::vector<float>& left() const { return left_; }
  std::vector<float> take_left() && { return std::move(left_); }

 private:
  static constexpr int kBandRows = 64;

  // A disc in texels, and those that it may cover.
  struct Laid {
    glm::vec2 middle, direction;
    float along, across, covered;
    int x0, y0, x1, y1;
  };

  Laid lay(const Disc& disc) const {
    const glm::vec2 middle = disc.middle_m * texels_per_m_, direction = disc.direction;
    // Discs narrower than a texel are as large as one, and fainter.
    const float along = std::max(disc.along_m * texels_per_m_, 0.8f);
    const float across = std::max(disc.across_m * texels_per_m_, 0.8f);
    const float covered = disc.part *
                          (disc.along_m * disc.across_m * texels_per_m_ * texels_per_m_) /
                          (along * across);
    // The box of the ellipse with its rim.
    const auto reach = [&](float part_along, float part_across) {
      const float a = along * part_along, b = across * part_across;
      return static_cast<int>(std::ceil(1.25f * std::sqrt(a * a + b * b)));
    };
    const int reach_x = reach(direction.x, direction.y), reach_y = reach(direction.y, direction.x);
    const auto x = static_cast<int>(middle.x), y = static_cast<int>(middle.y);
    return {middle,      direction,
            along,       across,
            covered,     std::max(x - reach_x, 0),
            y - reach_y, std::min(x + reach_x, size_ - 1),
            y + reach_y};
  }

  void add_rows(const Laid& disc, int first_row, int last_row) {
    for (int y = std::max(disc.y0, first_row); y <= std::min(disc.y1, last_row); ++y)
      for (int x = disc.x0; x <= disc.x1; ++x) {
        const glm::vec2 d = glm::vec2(x, y) - disc.middle;
        const float a = glm::dot(d, disc.direction) / disc.along;
        const float b = (d.y * disc.direction.x - d.x * disc.direction.y) / disc.across;
        const float inside = std::clamp(2.5f - 2.0f * std::sqrt(a * a + b * b), 0.0f, 1.0f);
        left_[static_cast<std::size_t>(y) * size_ + x] *= 1.0f - disc.covered * inside;
      }
  }

  int size_;
  float texels_per_m_;
  std::vector<float> left_;
};

// Where a tree's shadow lies: its middle where light through the crown's middle comes to the ground
// or the sea.
Disc shadow_of(const Tree& tree, const terrain::HeightGrid& land, glm::vec3 to_light) {
  if (to_light.z <= 0.01f) return {};
  const float level = std::sqrt(to_light.x * to_light.x + to_light.y * to_light.y);
  const float longest = std::min(level / to_light.z, kLongestShadow);
  const glm::vec2 away =
      level > 1e-4f ? glm::vec2(-to_light.x, -to_light.y) / level : glm::vec2(1.0f, 0.0f);
  const float middle_m = tree.foot.z + 0.55f * tree.height_m;
  float ground_m = tree.foot.z, far_m = 0.0f;
  for (int step = 0; step < 3; ++step) {
    far_m = std::clamp(middle_m - ground_m, 0.0f, 2.0f * tree.height_m) * longest;
    const glm::dvec2 at(glm::vec2(tree.foot) + away * far_m);
    ground_m =
        std::max(static_cast<float>(terrain::height_at(land, land.grid.min_world + at)), 0.0f);
  }
  return {.middle_m = glm::vec2(tree.foot) + away * far_m,
          .direction = away,
          .along_m = tree.radius_m + 0.4f * tree.height_m * longest,
          .across_m = tree.radius_m,
          .part = kShadeOfCrown};
}

void pack(DiscMap discs, bool is_left, Workers& workers, texture::PackedMap1& map) {
  const int size = discs.size();
  std::vector<float> values = std::move(discs).take_left();
  for_each_row(size, workers, [&](int j) {
    for (float& value : std::span(values).subspan(static_cast<std::size_t>(j) * size, size))
      value = 2.0f * (is_left ? value : 1.0f - value) - 1.0f;
  });
  texture::pack_map1(size, values, map, &workers);
}

float crowding_at(const Tree& tree, const DiscMap& cover) {
  const float r = 2.0f * tree.radius_m;
  const glm::vec2 p(tree.foot);
  return 0.25f * (cover.at(p + glm::vec2(r, 0)) + cover.at(p - glm::vec2(r, 0)) +
                  cover.at(p + glm::vec2(0, r)) + cover.at(p - glm::vec2(0, r)));
}

// Where the sea may be in the shade of trees.
void find_sea_shade(const DiscMap& shade, const terrain::HeightGrid& land, Workers& workers,
                    Forest& forest) {
  const double size_m = land.grid.size_m(), step_m = size_m / shade.size();
  struct Box {
    glm::vec2 low, high;
  };
  const auto rows = static_cast<std::size_t>(shade.size());
  std::vector<Box> boxes(rows, {glm::vec2(static_cast<float>(size_m)), glm::vec2(0.0f)});
  workers.for_each(rows, [&](std::size_t j, int) {
    auto& [low, high] = boxes[j];
    for (std::size_t i = 0; i < rows; ++i) {
      if (shade.left()[j * rows + i] > 0.98f) continue;
      const glm::dvec2 p = step_m * glm::dvec2(i, j);
      if (terrain::height_at(land, land.grid.min_world + p) > kHighestSea_m) continue;
      low = glm::min(low, glm::vec2(p)), high = glm::max(high, glm::vec2(p));
    }
  });
  auto [low, high] = boxes[0];
  for (const Box& row : boxes) low = glm::min(low, row.low), high = glm::max(high, row.high);
  // Coarser levels of the map spread it a little.
  forest.sea_shade_low = low - static_cast<float>(8.0 * step_m);
  forest.sea_shade_high = high + static_cast<float>(8.0 * step_m);
}

void add_columns(Forest& forest) {
  TreeColumns& columns = forest.columns;
  const std::size_t size = forest.trees.trees.size() + kTreeLanes;
  for (auto* column : {&columns.x_m, &columns.y_m, &columns.z_m, &columns.height_m,
                       &columns.radius_m, &columns.rank, &columns.thinned_px})
    column->resize(size);
  columns.looks.resize(size);
  for (std::size_t i = 0; i < forest.trees.trees.size(); ++i) {
    const Tree& tree = forest.trees.trees[i];
    columns.x_m[i] = tree.foot.x, columns.y_m[i] = tree.foot.y, columns.z_m[i] = tree.foot.z;
    columns.height_m[i] = tree.height_m, columns.radius_m[i] = tree.radius_m;
    columns.rank[i] = tree.rank;
    columns.looks[i] = tree.random | static_cast<std::uint32_t>(tree.species) << 24;
    columns.thinned_px[i] = kThinnedTree_px + std::min(1.5f * forest.crowding[i], 1.0f) *
                                                  (kThinnedWood_px - kThinnedTree_px);
  }
}

void add_canopy(const terrain::HeightGrid& land, glm::vec3 to_light, Workers& workers,
                Forest& forest) {
  const std::vector<Tree>& trees = forest.trees.trees;
  DiscMap cover(kCoverSize, land.grid.size_m()), shade(kSunLeftSize, land.grid.size_m());
  cover.add(trees.size(), workers, [&](std::size_t i) {
    const float radius_m = trees[i].radius_m;
    return Disc{glm::vec2(trees[i].foot), {1.0f, 0.0f}, radius_m, radius_m, 0.9f};
  });
  shade.add(trees.size(), workers,
            [&](std::size_t i) { return shadow_of(trees[i], land, to_light); });
  find_sea_shade(shade, land, workers, forest);
  glm::vec3 albedo(0.0f);
  float area = 0.0f, height = 0.0f;
  for (const Tree& tree : trees) {
    const float its = tree.radius_m * tree.radius_m;
    albedo += its * tree_look(tree.species).albedo;
    area += its;
    height += its * tree.height_m;
  }
  forest.crowding.resize(trees.size());
  for_pieces(trees.size(), workers,
             [&](std::size_t i) { forest.crowding[i] = crowding_at(trees[i], cover); });
  constexpr float kBetweenCrowns = 0.9f;  // of a crown's light, with the shade around it
  forest.canopy_albedo = kBetweenCrowns * albedo / area;
  forest.mean_height_m = height / area;
  pack(std::move(cover), false, workers, forest.cover);
  pack(std::move(shade), true, workers, forest.sun_left);
}

// Metres from the edge of the nearest river, below 0 in it and in lakes with an outline.
terrain::HeightGrid distance_from_rivers(const scene::Scene& scene, const terrain::Grid& grid,
                                         Workers& workers) {
  constexpr float kFar_m = 1000.0f;
  const ocean::RiverNetwork network(scene.rivers, scene.lakes);
  terrain::HeightGrid distance{grid, std::vector<float>(grid.size(), kFar_m)};
  workers.for_each(static_cast<std::size_t>(grid.samples_y), [&](std::size_t j, int) {
    for (int i = 0; i < grid.samples_x; ++i) {
      const auto place = network.water_near(grid.point(i, static_cast<int>(j)));
      if (!place || (place->width_m == 0.0 && place->outside_m > 0.0)) continue;
      distance.height_m[grid.index(i, static_cast<int>(j))] = static_cast<float>(place->outside_m);
    }
  });
  return distance;
}

// The level of the lake at p; none where there is no lake.
std::optional<float> lake_level_m(const scene::Scene& scene, const ocean::InlandWater& inland,
                                  glm::dvec2 p) {
  const auto water = inland.at(p);
  if (!water || water->depth_m <= 0.0f) return std::nullopt;
  const auto has_level = [&](const ocean::Lake& lake) {
    return std::abs(lake.level_m - water->level_m) < 0.01;
  };
  if (std::ranges::none_of(scene.lakes, has_level)) return std::nullopt;
  return water->level_m;
}

// Metres from the nearest lake or the sea, 0 in them. Heights at lakes and beside are taken from
// the lake's level, so that its shore is where the sea's would be.
terrain::HeightGrid distance_from_still_water(const scene::Scene& scene,
                                              const terrain::HeightGrid& terrain,
                                              const ocean::InlandWater* inland) {
  if (scene.lakes.empty() || !inland) return terrain::distance_from_sea(terrain);
  terrain::HeightGrid land = terrain;
  const int last_x = land.grid.samples_x - 1, last_y = land.grid.samples_y - 1;
  for (int j = 0; j <= last_y; ++j)
    for (int i = 0; i <= last_x; ++i) {
      const std::optional<float> level_m = lake_level_m(scene, *inland, land.grid.point(i, j));
      if (!level_m) continue;
      for (int y = std::max(j - 1, 0); y <= std::min(j + 1, last_y); ++y)
        for (int x = std::max(i - 1, 0); x <= std::min(i + 1, last_x); ++x) {
          const std::size_t at = land.grid.index(x, y);
          land.height_m[at] = std::min(land.height_m[at], terrain.height_m[at] - *level_m);
        }
    }
  return terrain::distance_from_sea(land);
}

}  // namespace

TreeLook tree_look(TreeSpecies species) {
  switch (species) {
    case TreeSpecies::kConifer:
      return {.albedo = {0.030f, 0.058f, 0.024f},
              .bark = {0.085f, 0.060f, 0.045f},
              .translucency = 0.12f,
              .rise = {0.35f, 0.0f},
              .taper = 1.0f};
    case TreeSpecies::kReed:
      return {.albedo = {0.115f, 0.130f, 0.045f}, .translucency = 0.35f, .rise = {0.6f, 0.3f}};
    default:
      return {.albedo = {0.054f, 0.088f, 0.026f}, .translucency = 0.3f, .rise = {-0.9f, 2.0f}};
  }
}

Forest grow_forest(const scene::Scene& scene, const terrain::HeightGrid& terrain,
                   const ocean::InlandWater* inland, glm::vec3 to_light, Workers& workers) {
  Forest forest;
  const bool near_still_water =
      !scene.lakes.empty() || std::ranges::any_of(scene.trees, [](const terrain::TreeStand& stand) {
        return stand.place == terrain::TreePlace::kBanks;
      });
  terrain::HeightGrid still, rivers;
  if (near_still_water) still = distance_from_still_water(scene, terrain, inland);
  const bool has_rivers = !scene.rivers.empty() || !scene.lakes.empty();
  if (has_rivers) rivers = distance_from_rivers(scene, terrain.grid, workers);
  try {
    forest.trees = terrain::plant_trees(
        scene.trees, terrain,
        {.rivers = has_rivers ? &rivers : nullptr, .still = near_still_water ? &still : nullptr},
        workers);
  } catch (const terrain::TerrainError& error) {
    scene::refuse(scene, error);
  }
  if (forest.trees.empty()) return forest;
  workers.for_each(forest.shapes.size(), [&](std::size_t species, int) {
    forest.shapes[species] = shapes::make_tree_shape(static_cast<TreeSpecies>(species));
  });
  add_canopy(terrain, to_light, workers, forest);
  add_columns(forest);
  return forest;
}

}  // namespace swell::render
