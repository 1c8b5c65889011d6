// Stage 3: trees, of as many triangles as each takes where it is seen.
//
// How many follows from the size that a tree has in the picture, without steps: the last triangle
// of a crown grows from nothing, and all the others shrink meanwhile (shapes/tree_shape.h). Trees
// that are only a few pixels high get fewer and broader, by their ranks, and sink into the land at
// last, which by then has their colour (render/materials/canopy-inl.h).
#include <hwy/cache_control.h>

#include <algorithm>
#include <cmath>

#include "math/check.h"
#include "math/smoothstep.h"
#include "render/frame/options.h"
#include "render/frame/profile.h"
#include "render/view/choose_trees.h"
#include "render/view/meshes.h"
#include "render/view/render_view.h"
#include "render/view/tree_corners.h"
#include "render/view/tree_ground.h"
#include "render/view/trees_drawn.h"
#include "render/world/forest.h"
#include "render/world/world_state.h"

namespace swell::render {
namespace {

// The area of a crown's box for each triangle: of leaves, of those of tall crowns, of blades.
constexpr float kLeaf_px2 = 75.0f, kTallLeaf_px2 = 45.0f, kBlade_px2 = 16.0f;
constexpr float kLow_px = 16.0f, kTall_px = 48.0f;  // trees with crowns of either
// Trees of these heights have as few triangles as one, and as few as their shape needs.
constexpr float kOneLeaf_px = 5.0f, kFewLeaves_px = 8.0f;
constexpr float kGrown_px = 4.0f;  // trees of this height have all of it
// Nobody sees whether low trees in a wood have smooth edges to the land between them. Low trees are
// lower than a height between the first two, by their ranks. A wood: so much of the ground is under
// crowns, and such a part of the trees is drawn; fewer are broad ones that stand out.
constexpr float kLikeLand_px = 32.0f, kUnlikeLand_px = 44.0f, kWood = 0.15f, kWoodKept = 0.25f;
constexpr float kSways_px = 16.0f;  // trees of less height do not sway, of twice that do
constexpr std::size_t kCellsAtOnce = 8, kTreesAhead = 4;

// What trees of a kind of view are drawn from.
struct TreeView {
  const Forest& forest;
  TreeSight sight;
  Sway sway;
  const Meshes& meshes;
};

TreeView tree_view(const WorldState& world, const RenderView& view, const Meshes& meshes,
                   bool shows_all, double t_s) {
  const View& camera = view.camera;
  return {*world.forest,
          {.planes = frustum_planes(camera),
           .origin_rel = glm::vec3(world.forest->trees.origin - camera.eye_world),
           .px = static_cast<float>(camera.width_px) / (2.0f * camera.tan_half_x),
           .drop_per_m2 = view.drop_per_m2,
           .mirror_rel_m = -static_cast<float>(camera.eye_world.z),
           .is_mirrored = view.kind == ViewKind::kReflection,
           .shows_all = shows_all},
          sway_at(world.scene.sea, t_s),
          meshes};
}

// Whether the view shows any of a ball where a round earth puts it.
bool in_view(const TreeSight& sight, glm::vec3 p_rel, float radius_m) {
  if (sight.is_mirrored) p_rel.z = 2.0f * sight.mirror_rel_m - p_rel.z;
  p_rel.z -= (p_rel.x * p_rel.x + p_rel.y * p_rel.y) * sight.drop_per_m2;
  return std::ranges::all_of(sight.planes, [&](const glm::vec4& plane) {
    return glm::dot(glm::vec3(plane), p_rel) + plane.w >= -1.02f * radius_m;
  });
}

// Cells that the views may show, nearest first.
void list_cells(const TreeView& view, TreeDraws& draws) {
  draws.cells.clear();
  const std::vector<terrain::TreeCell>& cells = view.forest.trees.cells;
  for (std::uint32_t i = 0; i < cells.size(); ++i) {
    const glm::vec3 middle = view.sight.origin_rel + cells[i].middle;
    const float distance_m =
        std::max(std::sqrt(glm::dot(middle, middle)) - cells[i].radius_m, 0.1f);
    if (cells[i].tallest_m * view.sight.px < kLastTree_px * distance_m) continue;
    if (view.sight.shows_all || in_view(view.sight, middle, cells[i].radius_m))
      draws.cells.push_back({.cell = i, .distance_m = distance_m});
  }
  std::ranges::sort(draws.cells, {},
                    [](const DrawnCell& cell) { return std::pair(cell.distance_m, cell.cell); });
}

const shapes::TreeShape& shape_of(const Forest& forest, const DrawnTree& drawn) {
  return forest.shapes[drawn.species];
}

// Trees of one species differ in colour.
glm::vec3 leaves_of(const DrawnTree& drawn) {
  const auto part = [](std::uint32_t bits) {
    return static_cast<float>(bits & 0xff) * (1.0f / 255.0f) - 0.5f;
  };
  const float yellow = part(drawn.looks >> 8), bright = part(drawn.looks >> 16);
  return tree_look(static_cast<terrain::TreeSpecies>(drawn.species)).albedo *
         glm::vec3(1.0f + 0.4f * yellow, 1.0f + 0.1f * yellow, 1.0f) * (1.0f + 0.45f * bright);
}

// What a tree's pixels need, once its sizes are set.
void prepare_shading(const TreeView& view, DrawnTree& drawn) {
  drawn.crown_begin_m = shape_of(view.forest, drawn).crown_begin * drawn.height_m;
  drawn.inverse_crown_m = 1.0f / (drawn.height_m - drawn.crown_begin_m);
  drawn.inverse_radius_m = 1.0f / drawn.radius_m;
  drawn.leaves_albedo = leaves_of(drawn);
  const glm::vec2 away(drawn.foot_rel);
  const float level = std::sqrt(std::max(glm::dot(away, away), 1e-6f));
  drawn.aside = {away.y / level, -away.x / level};
}

// Triangles of a crown whose box is so large in the picture.
float leaves_in(const shapes::TreeShape& shape, float box_px2, float height_px) {
  const float small = smoothstep(kOneLeaf_px, kFewLeaves_px, height_px);
  const float least = 1.0f + small * (shape.fewest_leaves - 1.0f);
  const float tall = smoothstep(kLow_px, kTall_px, height_px);
  const float leaf_px2 = kLeaf_px2 + tall * (kTallLeaf_px2 - kLeaf_px2);
  return std::clamp(box_px2 / (shape.is_blades ? kBlade_px2 : leaf_px2), least,
                    static_cast<float>(shape.leaves.size()));
}

// How a tree that is drawn is.
DrawnTree drawn_tree(const TreeView& view, std::uint32_t number) {
  const TreeColumns& trees = view.forest.columns;
  glm::vec3 foot(trees.x_m[number], trees.y_m[number], trees.z_m[number]);
  foot.z += drawn_ground_over(view.meshes, view.forest.trees.origin + glm::dvec3(foot));
  const float full_height_m = trees.height_m[number], full_radius_m = trees.radius_m[number];
  DrawnTree drawn{.foot_rel = view.sight.origin_rel + foot,
                  .tree = number,
                  .looks = trees.looks[number],
                  .species = trees.looks[number] >> 24};
  const glm::vec3 middle = drawn.foot_rel + glm::vec3(0.0f, 0.0f, 0.5f * full_height_m);
  const float px_per_m = view.sight.px / std::max(std::sqrt(glm::dot(middle, middle)), 0.1f);
  const float height_px = full_height_m * px_per_m;
  const float thinned_px = trees.thinned_px[number];
  const float kept = part_of_trees(height_px, thinned_px);

  // Those that go next shrink first, unless none go yet.
  const float going =
      kept < 1.0f ? std::clamp((kept - trees.rank[number]) / (0.25f * kept), 0.0f, 1.0f) : 1.0f;
  const float grown = going * smoothstep(kLastTree_px, kGrown_px, height_px);
  // By the power 5/8 of their number, but not so flat that a crown shows as a shard before the sky.
  constexpr float kBroadest = 2.5f;
  const float less = height_px / thinned_px;
  const float broader =
      less < 1.0f ? std::min(1.0f / (less * std::sqrt(std::sqrt(less))), kBroadest) : 1.0f;
  const shapes::TreeShape& shape = shape_of(view.forest, drawn);
  drawn.height_m = full_height_m * grown;
  drawn.radius_m = full_radius_m * grown * broader;
  const float box_px2 = 2.0f * full_radius_m * full_height_m * px_per_m * px_per_m;
  drawn.leaves = leaves_in(shape, box_px2, height_px);
  drawn.crowding = view.forest.crowding[number];
  drawn.like_land = drawn.crowding > kWood && kept > kWoodKept &&
                    height_px < kLikeLand_px + trees.rank[number] * (kUnlikeLand_px - kLikeLand_px);
  drawn.sways = smoothstep(kSways_px, 2.0f * kSways_px, height_px);
  drawn.leaf_size = shapes::leaf_size(shape, drawn.leaves);
  drawn.triangles = crown_triangles(drawn);
  const float trunk_m = shape.trunk * drawn.height_m;
  // From half a pixel's width on; among others not until it is four times as wide.
  const float seen =
      std::clamp(4.0f * trunk_m * px_per_m - 1.0f - 3.0f * drawn.crowding, 0.0f, 1.0f);
  drawn.trunk_m = trunk_m * seen;
  if (seen > 0.0f) drawn.triangles += 2;
  prepare_shading(view, drawn);
  return drawn;
}

// Those of a cell's trees whose ranks are below what any of them may need, which come first.
std::uint32_t trees_to_look_at(const TreeView& view, const DrawnCell& drawn) {
  const terrain::TreeCell& cell = view.forest.trees.cells[drawn.cell];
  const float most_kept =
      part_of_trees(cell.tallest_m * view.sight.px / drawn.distance_m, kThinnedTree_px);
  if (most_kept >= 1.0f) return cell.count;
  const auto ranks = std::span(view.forest.columns.rank).subspan(cell.first, cell.count);
  return static_cast<std::uint32_t>(std::ranges::lower_bound(ranks, most_kept) - ranks.begin());
}

// Draws a cell's trees: which, and of how many triangles.
void choose_trees(const TreeView& view, DrawnCell& drawn, TreeDraws& draws) {
  const std::uint32_t first = view.forest.trees.cells[drawn.cell].first;
  std::uint32_t* const chosen = draws.chosen.data() + first;
  drawn.trees =
      choose_trees(view.forest.columns, first, trees_to_look_at(view, drawn), view.sight, chosen);
  drawn.triangles = 0;
  for (std::uint32_t i = 0; i < drawn.trees; ++i) {
    draws.trees[first + i] = drawn_tree(view, chosen[i]);
    drawn.triangles += draws.trees[first + i].triangles;
  }
}

// `at`: of the tree in draws.trees.
void write_tree(const TreeView& view, std::uint32_t at, std::size_t first, TreeDraws& draws) {
  const DrawnTree& drawn = draws.trees[at];
  write_corners(view.forest, view.sway, drawn, draws.p_rel.data() + 3 * first);
  const std::uint32_t crown = crown_triangles(drawn);
  for (std::uint32_t n = 0; n < drawn.triangles; ++n)
    draws.primitives[first + n] = {at, n < crown ? n : kTrunkLeaf};
  std::fill_n(draws.like_land.begin() + static_cast<std::ptrdiff_t>(first), drawn.triangles,
              std::uint8_t{drawn.like_land});
}

// A tree that is written soon: it lies in one or two lines of the cache.
void prefetch_tree(const DrawnTree& drawn) {
  hwy::Prefetch(&drawn);
  hwy::Prefetch(&drawn.leaves_albedo);
}

void write_cell(const TreeView& view, const DrawnCell& drawn, TreeDraws& draws) {
  const std::uint32_t first = view.forest.trees.cells[drawn.cell].first;
  std::size_t triangle = drawn.first_triangle;
  for (std::uint32_t at = first; at < first + drawn.trees; ++at) {
    prefetch_tree(draws.trees[std::min<std::size_t>(at + kTreesAhead, draws.trees.size() - 1)]);
    write_tree(view, at, triangle, draws);
    triangle += draws.trees[at].triangles;
  }
}

// Makes room for the triangles of all cells.
void size_draws(TreeDraws& draws) {
  std::uint32_t triangles = 0;
  for (DrawnCell& cell : draws.cells) {
    cell.first_triangle = triangles;
    triangles += cell.triangles;
  }
  draws.primitives.resize(triangles);
  draws.like_land.resize(triangles);
  draws.p_rel.resize(std::size_t{3} * triangles);
  const std::size_t before = draws.indices.size();
  draws.indices.resize(draws.p_rel.size());
  for (std::size_t i = before; i < draws.indices.size(); ++i)
    draws.indices[i] = static_cast<std::uint32_t>(i);
}

// Calls body(cell) for each of the cells, some of them a task.
template <class Cells, class Body>
void for_cells(Cells& cells, const StageRun& run, const Body& body) {
  run.for_each((cells.size() + kCellsAtOnce - 1) / kCellsAtOnce, [&](std::size_t chunk, int) {
    const std::size_t begin = chunk * kCellsAtOnce;
    const std::size_t end = std::min(cells.size(), begin + kCellsAtOnce);
    for (std::size_t i = begin; i < end; ++i) body(cells[i]);
  });
}

void place_in_views(const WorldState& world, double t_s, Meshes& meshes, FrameViews views,
                    const StageRun& run) {
  // Through the surface an eye under water sees them far from where they are.
  const bool shows_all =
      std::ranges::any_of(views, [](const RenderView* v) { return v->eye.submerged; });
  const TreeView view = tree_view(world, *views.front(), meshes, shows_all, t_s);
  TreeDraws& draws = meshes.trees.drawn_in(views.front()->kind);
  draws.trees.resize(view.forest.trees.trees.size());
  draws.chosen.resize(view.forest.trees.trees.size());
  list_cells(view, draws);
  for_cells(draws.cells, run, [&](DrawnCell& cell) { choose_trees(view, cell, draws); });
  size_draws(draws);
  resize_vertices(SurfaceKind::kTrees, draws.p_rel.size(), views);
  for_cells(draws.cells, run, [&](const DrawnCell& cell) {
    write_cell(view, cell, draws);
    const std::size_t begin = std::size_t{3} * cell.first_triangle;
    map_vertices(meshes, SurfaceKind::kTrees, begin, begin + std::size_t{3} * cell.triangles,
                 views);
  });
}

// Trees stand above the water: its mirror shows them to an eye in air, the images of what lies
// beyond it to an eye under water.
bool shows_trees(const RenderView& view) {
  switch (view.kind) {
    case ViewKind::kWindow:
      return true;
    case ViewKind::kReflection:
      return !view.eye.submerged;
    case ViewKind::kRefraction:
      return view.eye.submerged;
  }
  return false;
}

}  // namespace

void place_trees(const WorldState& world, double t_s, const FrameOptions& options, Meshes& meshes,
                 FrameViews views, const StageRun& run) {
  const bool has_trees = world.forest && !options.without.has(Part::kTrees);
  if (has_trees) prepare_tree_ground(world, options, meshes.land, meshes.trees);
  for (const ViewKind kind : kAllViewKinds) {
    const ViewsOfKind of_kind(views, kind);
    const FrameViews its = of_kind.all();
    const bool shown =
        has_trees && std::ranges::any_of(its, [](const RenderView* v) { return shows_trees(*v); });
    if (shown) {
      place_in_views(world, t_s, meshes, its, run);
    } else {
      meshes.trees.drawn_in(kind).clear();
      resize_vertices(SurfaceKind::kTrees, 0, its);
    }
  }
}

void find_tree_moves(const WorldState& world, const TreeDraws& draws, double next_s,
                     std::span<glm::vec3> move, const StageRun& run) {
  SWELL_CHECK(move.size() == draws.p_rel.size(), "{} moves of {} vertices", move.size(),
              draws.p_rel.size());
  const Forest& forest = *world.forest;
  const Sway next = sway_at(world.scene.sea, next_s);
  for_cells(draws.cells, run, [&](const DrawnCell& cell) {
    const std::uint32_t first = forest.trees.cells[cell.cell].first;
    std::size_t at = std::size_t{3} * cell.first_triangle;
    for (std::uint32_t i = first; i < first + cell.trees; ++i) {
      const DrawnTree& drawn = draws.trees[i];
      write_corners(forest, next, drawn, move.data() + at);
      for (const std::size_t end = at + std::size_t{3} * drawn.triangles; at < end; ++at)
        move[at] -= draws.p_rel[at];
    }
  });
}

}  // namespace swell::render
