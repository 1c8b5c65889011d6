#include "terrain/trees.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <utility>

#include "math/random.h"
#include "math/smoothstep.h"
#include "math/stop.h"
#include "terrain/poisson_tile.h"
#include "terrain/terrain.h"
#include "texture/image/image_io.h"
#include "texture/perlin.h"

namespace swell::terrain {
namespace {

constexpr double kClumps_m = 140.0;  // of the noise that makes clearings
constexpr double kLeastCell_m = 48.0;
constexpr int kMostCells = 512;  // a side

// How dense a stand is at a place, as part of its density_per_m2.
class StandDensity {
 public:
  StandDensity(const TreeStand& stand, const HeightGrid& terrain)
      : stand_(stand), terrain_(terrain), noise_(stand.seed) {
    if (!stand.density_map.empty())
      map_ = texture::read_image(stand.density_map, {.max_side_px = kMaxImageSide});
  }

  float at(glm::dvec2 p) const {
    float density = 1.0f;
    if (map_) density = in_map(p);
    if (stand_.clumping <= 0.0) return density;
    const auto noise =
        static_cast<float>(noise_.fractal2(p.x / kClumps_m, p.y / kClumps_m, 4, 0.55));
    const auto clearings = static_cast<float>(stand_.clumping);
    return density * (1.0f - clearings * (1.0f - smoothstep(-0.25f, 0.15f, noise)));
  }

 private:
  // The nearest pixel; north is on top.
  float in_map(glm::dvec2 p) const {
    const glm::dvec2 part = (p - terrain_.grid.min_world) / terrain_.grid.extent_m();
    const int x = std::clamp(static_cast<int>(part.x * map_->width), 0, map_->width - 1);
    const int y = std::clamp(static_cast<int>((1.0 - part.y) * map_->height), 0, map_->height - 1);
    return std::clamp(map_->at(x, y, 0), 0.0f, 1.0f);
  }

  const TreeStand& stand_;
  const HeightGrid& terrain_;
  texture::PerlinNoise noise_;
  std::optional<texture::ImageF> map_;
};

bool on_bank(const TreeStand& stand, const WaterLines& lines, glm::dvec2 p) {
  const auto is_near = [&](const HeightGrid* line) {
    if (!line) return false;
    const double distance_m = height_at(*line, p);
    return distance_m > 0.0 && distance_m <= stand.bank_width_m;
  };
  if (stand.lake_shores && is_near(lines.still)) return true;
  // Where a river meets the sea its banks end.
  return is_near(lines.rivers) && !is_near(lines.still);
}

TreeSpecies species_of(const TreeStand& stand, std::uint32_t random) {
  if (stand.species != TreeSpecies::kMixed) return stand.species;
  return (random & 0xff) < 110 ? TreeSpecies::kConifer : TreeSpecies::kBroadleaf;
}

// Crown's radius over height: the least, and how much more the broadest have.
glm::vec2 breadth_of(TreeSpecies species) {
  switch (species) {
    case TreeSpecies::kConifer:
      return {0.17f, 0.07f};
    case TreeSpecies::kBroadleaf:
      return {0.30f, 0.12f};
    default:
      return {0.28f, 0.15f};
  }
}

// What decides a stand's trees.
struct StandPlan {
  const TreeStand& stand;
  const HeightGrid& terrain;
  const WaterLines& lines;
  StandDensity density;
  std::vector<glm::dvec2> tile;
  double tile_m;
  glm::dvec2 shift_m;  // of the tiles, so that stands of one density differ
};

// The tree at point k of tile (i, j), if one stands there.
std::optional<Tree> tree_at(const StandPlan& plan, int i, int j, std::size_t k) {
  const Grid& square = plan.terrain.grid;
  const glm::dvec2 from_corner = (glm::dvec2(i, j) + plan.tile[k]) * plan.tile_m - plan.shift_m;
  const glm::dvec2 p = square.min_world + from_corner;
  if (!square.holds(p)) return std::nullopt;
  const TreeStand& stand = plan.stand;
  const double ground_m = height_at(plan.terrain, p);
  if (!(ground_m > 0.0 && ground_m >= stand.ground_m.x && ground_m <= stand.ground_m.y))
    return std::nullopt;
  // Rivers and lakes lie above the sea.
  if (plan.lines.rivers && height_at(*plan.lines.rivers, p) <= 0.0) return std::nullopt;
  if (plan.lines.still && height_at(*plan.lines.still, p) <= 0.0) return std::nullopt;
  if (stand.place == TreePlace::kBanks && !on_bank(stand, plan.lines, p)) return std::nullopt;
  const float rank = (static_cast<float>(k) + 0.5f) / static_cast<float>(kPoissonPoints);
  const float density = plan.density.at(p);
  if (rank >= density) return std::nullopt;
  if (glm::length(slope_at(plan.terrain, p)) > stand.steepest) return std::nullopt;

  const std::uint64_t bits = random_bits(
      stand.seed, (static_cast<std::uint64_t>(static_cast<std::uint32_t>(j)) << 44) ^
                      (static_cast<std::uint64_t>(static_cast<std::uint32_t>(i)) << 16) ^ k);
  const auto part = [&](int shift) {
    return static_cast<float>(bits >> shift & 0xfff) * (1.0f / 4096.0f);
  };
  Tree tree;
  tree.foot = glm::vec3(from_corner, ground_m);
  tree.random = static_cast<std::uint32_t>(bits >> 40);
  tree.species = species_of(stand, tree.random);
  const glm::vec2 sizes(stand.height_m), breadth = breadth_of(tree.species);
  tree.height_m = sizes.x + (sizes.y - sizes.x) * part(0);
  tree.radius_m = tree.height_m * (breadth.x + breadth.y * part(12));
  tree.rank = std::min(rank / density, 0.999999f);
  return tree;
}

// Where a stand may have trees: squares of the land, a coarse grid.
class StandArea {
 public:
  StandArea(const TreeStand& stand, const HeightGrid& terrain, const WaterLines& lines,
            Workers& workers)
      : square_m_(terrain.grid.size_m() / kSquares), may_have_(std::size_t{kSquares} * kSquares) {
    constexpr int kRowsAtOnce = 32;
    const int rows = terrain.grid.samples_y;
    const auto pieces = static_cast<std::size_t>((rows + kRowsAtOnce - 1) / kRowsAtOnce);
    std::vector<std::vector<bool>> of_piece(pieces, may_have_);
    workers.for_each(pieces, [&](std::size_t piece, int) {
      const int first = static_cast<int>(piece) * kRowsAtOnce;
      for (int j = first; j < std::min(first + kRowsAtOnce, rows); ++j)
        mark_row(stand, terrain, lines, j, of_piece[piece]);
    });
    for (const std::vector<bool>& marked : of_piece)
      std::transform(may_have_.begin(), may_have_.end(), marked.begin(), may_have_.begin(),
                     std::logical_or<>());
  }

  // Whether a square may have any, with this corner from the grid's corner [m].
  bool meets(glm::dvec2 corner_m, double size_m) const {
    const auto [x0, x1] = squares(corner_m.x, corner_m.x + size_m);
    const auto [y0, y1] = squares(corner_m.y, corner_m.y + size_m);
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x)
        if (may_have_[static_cast<std::size_t>(y) * kSquares + x]) return true;
    return false;
  }

 private:
  static constexpr int kSquares = 256;  // a side
  // Heights between samples lie between theirs; the ground at a sample that is outside a range may
  // be in it next to the sample.
  static constexpr double kBetweenSamples_m = 20.0;

  static bool may_be_bank(const TreeStand& stand, const WaterLines& lines, const Grid& grid,
                          glm::ivec2 sample) {
    if (stand.place != TreePlace::kBanks) return true;
    const glm::dvec2 p = grid.point(sample.x, sample.y);
    const auto is_near = [&](const HeightGrid* line) {
      return line && height_at(*line, p) <= stand.bank_width_m + 2.0 * grid.spacing_m;
    };
    return is_near(lines.rivers) || (stand.lake_shores && is_near(lines.still));
  }

  void mark_row(const TreeStand& stand, const HeightGrid& terrain, const WaterLines& lines, int j,
                std::vector<bool>& marked) const {
    check_stop();
    const Grid& grid = terrain.grid;
    for (int i = 0; i < grid.samples_x; ++i) {
      const float height_m = terrain.height_m[grid.index(i, j)];
      const bool is_land = height_m >= std::max(stand.ground_m.x, 0.0) - kBetweenSamples_m &&
                           height_m <= stand.ground_m.y + kBetweenSamples_m;
      if (is_land && may_be_bank(stand, lines, grid, {i, j}))
        mark(glm::dvec2(i, j) * grid.spacing_m, grid.spacing_m, marked);
    }
  }

  std::pair<int, int> squares(double low_m, double high_m) const {
    const auto limit = [&](double x) {
      return static_cast<int>(std::clamp(x / square_m_, 0.0, kSquares - 1.0));
    };
    return {limit(low_m), limit(high_m)};
  }

  void mark(glm::dvec2 at_m, double around_m, std::vector<bool>& marked) const {
    const auto [x0, x1] = squares(at_m.x - around_m, at_m.x + around_m);
    const auto [y0, y1] = squares(at_m.y - around_m, at_m.y + around_m);
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) marked[static_cast<std::size_t>(y) * kSquares + x] = true;
  }

  double square_m_;
  std::vector<bool> may_have_;
};

// Tiles of the pattern that may have trees, by rows.
std::vector<std::vector<int>> tiles_of(const StandPlan& plan, Workers& workers) {
  const StandArea area(plan.stand, plan.terrain, plan.lines, workers);
  const double size_m = plan.terrain.grid.size_m();
  const int tiles = static_cast<int>(std::ceil((size_m + plan.tile_m) / plan.tile_m));
  std::vector<std::vector<int>> rows(static_cast<std::size_t>(tiles));
  for (int j = 0; j < tiles; ++j)
    for (int i = 0; i < tiles; ++i)
      if (area.meets(glm::dvec2(i, j) * plan.tile_m - plan.shift_m, plan.tile_m))
        rows[static_cast<std::size_t>(j)].push_back(i);
  return rows;
}

std::vector<Tree> plant_stand(const StandPlan& plan, const std::vector<std::vector<int>>& tiles,
                              Workers& workers) {
  std::vector<std::vector<Tree>> of_row(tiles.size());
  workers.for_each(of_row.size(), [&](std::size_t row, int) {
    for (const int i : tiles[row]) {
      check_stop();
      for (std::size_t k = 0; k < plan.tile.size(); ++k)
        if (const auto tree = tree_at(plan, i, static_cast<int>(row), k))
          of_row[row].push_back(*tree);
    }
  });
  std::vector<Tree> all;
  for (const std::vector<Tree>& row : of_row) all.insert(all.end(), row.begin(), row.end());
  return all;
}

// Sorts trees into cells, and within these by rank; those of one rank stay in their order.
void sort_into_cells(double size_m, Workers& workers, Trees& trees) {
  const double cell_m = std::max(kLeastCell_m, size_m / kMostCells);
  const int side = std::max(1, static_cast<int>(std::ceil(size_m / cell_m)));
  const auto cell_of = [&](const Tree& tree) {
    const auto at = [&](float x) { return std::clamp(static_cast<int>(x / cell_m), 0, side - 1); };
    return static_cast<std::size_t>(at(tree.foot.y)) * side + at(tree.foot.x);
  };
  const std::vector<Tree> before = std::move(trees.trees);
  std::vector<std::uint32_t> begin(static_cast<std::size_t>(side) * side + 1);
  for (const Tree& tree : before) ++begin[cell_of(tree) + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  for (std::size_t cell = 0; cell + 1 < begin.size(); ++cell)
    if (const std::uint32_t count = begin[cell + 1] - begin[cell]; count > 0)
      trees.cells.push_back({.first = begin[cell], .count = count});
  trees.trees.resize(before.size());
  for (const Tree& tree : before) trees.trees[begin[cell_of(tree)]++] = tree;
  workers.for_each(trees.cells.size(), [&](std::size_t n, int) {
    const TreeCell& cell = trees.cells[n];
    std::ranges::stable_sort(std::span(trees.trees).subspan(cell.first, cell.count), {},
                             &Tree::rank);
  });
}

void bound_cells(Trees& trees) {
  for (TreeCell& cell : trees.cells) {
    const auto its = std::span(trees.trees).subspan(cell.first, cell.count);
    glm::vec3 low(its[0].foot), high(its[0].foot);
    for (const Tree& tree : its) {
      const glm::vec3 reach(tree.radius_m, tree.radius_m, 0.0f);
      low = glm::min(low, tree.foot - reach - glm::vec3(0, 0, 1));
      high = glm::max(high, tree.foot + reach + glm::vec3(0, 0, tree.height_m));
      cell.tallest_m = std::max(cell.tallest_m, tree.height_m);
    }
    cell.middle = 0.5f * (low + high);
    cell.radius_m = 0.5f * glm::distance(low, high);
  }
}

// The squared distance along a row from the nearest sample of which f is that in the other
// direction. Source: Felzenszwalb, Huttenlocher, Distance Transforms of Sampled Functions, 2012.
void nearest_along(std::span<const float> f, std::span<float> out) {
  const auto n = static_cast<int>(f.size());
  std::vector<int> at(f.size());
  std::vector<double> begin(f.size() + 1);
  int last = 0;
  begin[0] = -HUGE_VAL, begin[1] = HUGE_VAL;
  for (int q = 1; q < n; ++q) {
    const auto crossing = [&](int p) {
      return ((static_cast<double>(f[q]) + static_cast<double>(q) * q) -
              (static_cast<double>(f[p]) + static_cast<double>(p) * p)) /
             (2.0 * (q - p));
    };
    double s = crossing(at[last]);
    while (s <= begin[last]) s = crossing(at[--last]);
    at[++last] = q;
    begin[last] = s, begin[last + 1] = HUGE_VAL;
  }
  last = 0;
  for (int q = 0; q < n; ++q) {
    while (begin[last + 1] < q) ++last;
    const auto d = static_cast<float>(q - at[last]);
    out[q] = d * d + f[at[last]];
  }
}

}  // namespace

HeightGrid distance_from_sea(const HeightGrid& terrain) {
  const int n = std::min(terrain.grid.samples_x, kWaterLineSamples);
  const Grid grid{terrain.grid.min_world, terrain.grid.size_m() / (n - 1), n, n};
  HeightGrid distance = resample(terrain, grid);
  constexpr float kFarthest = 1e12f;  // squared, in samples
  for (float& h : distance.height_m) h = h <= 0.0f ? 0.0f : kFarthest;
  std::vector<float> line(static_cast<std::size_t>(n)), nearest(line.size());
  for (int i = 0; i < n; ++i) {
    check_stop();
    for (int j = 0; j < n; ++j) line[j] = distance.height_m[grid.index(i, j)];
    nearest_along(line, nearest);
    for (int j = 0; j < n; ++j) distance.height_m[grid.index(i, j)] = nearest[j];
  }
  for (int j = 0; j < n; ++j) {
    const auto row = std::span(distance.height_m).subspan(grid.index(0, j), line.size());
    std::ranges::copy(row, line.begin());
    nearest_along(line, row);
  }
  for (float& d : distance.height_m) d = std::sqrt(d) * static_cast<float>(grid.spacing_m);
  return distance;
}

Trees plant_trees(std::span<const TreeStand> stands, const HeightGrid& terrain,
                  const WaterLines& lines, Workers& workers) {
  Trees trees;
  const double size_m = terrain.grid.size_m();
  trees.origin = glm::dvec3(terrain.grid.min_world, 0.0);
  std::vector<std::vector<glm::dvec2>> poisson_tiles(stands.size());
  workers.for_each(stands.size(), [&](std::size_t n, int) {
    if (stands[n].density_per_m2 > 0.0) poisson_tiles[n] = make_poisson_tile(stands[n].seed);
  });
  double places = 0.0;
  for (std::size_t n = 0; n < stands.size(); ++n) {
    const TreeStand& stand = stands[n];
    if (!(stand.density_per_m2 > 0.0)) continue;
    const double tile_m = std::sqrt(kPoissonPoints / stand.density_per_m2);
    if (!std::isfinite(tile_m)) continue;  // on no square is there one
    const auto shift = [&](std::uint64_t axis) {
      return tile_m * random_uniform(stand.seed, (std::uint64_t{1} << 62) + axis);
    };
    const StandPlan plan{stand,
                         terrain,
                         lines,
                         StandDensity(stand, terrain),
                         std::move(poisson_tiles[n]),
                         tile_m,
                         {shift(0), shift(1)}};
    const auto tiles = tiles_of(plan, workers);
    for (const std::vector<int>& row : tiles)
      places += static_cast<double>(row.size() * kPoissonPoints);
    const auto fail = [&](const std::string& makes, const std::string& allowed) {
      throw TerrainError(fmt::format("trees[{}].density_per_m2", n),
                         fmt::format("{}, which makes {}", stand.density_per_m2, makes), allowed);
    };
    if (places > kMostTreePlaces)
      fail(fmt::format("{:.2g} places for trees", places),
           fmt::format("at most {:.2g} of all stands", kMostTreePlaces));
    const std::vector<Tree> planted = plant_stand(plan, tiles, workers);
    if (trees.trees.size() + planted.size() > kMostTrees)
      fail(fmt::format("{} trees of all stands", trees.trees.size() + planted.size()),
           fmt::format("at most {}", kMostTrees));
    trees.trees.insert(trees.trees.end(), planted.begin(), planted.end());
  }
  sort_into_cells(size_m, workers, trees);
  bound_cells(trees);
  return trees;
}

}  // namespace swell::terrain
