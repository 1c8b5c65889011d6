// Stage 2: the triangles of rivers and lakes.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <span>

#include "ocean/inland/inland_water.h"
#include "render/frame/options.h"
#include "render/view/meshes.h"
#include "render/world/world_state.h"

namespace swell::render {
namespace {

using ocean::kInlandBlock;
using ocean::kInlandSide;

// Cells as wide as this part of their distance are drawn whole where some of them are dry.
constexpr double kFarCell = 0.01;

// Water that the eye is not above mirrors the sky alone, and so does water that takes up less than
// this part of the picture; from the second part on the image is all there.
constexpr double kLeastOver_m = 0.05, kLeastPart = 0.005, kFullPart = 0.015;

// No near plane reaches further down into water from above it.
constexpr double kNearPlane_m = 1.0;

bool may_be_seen(const std::array<glm::vec4, 5>& planes, glm::vec3 middle_rel, float radius_m) {
  return std::ranges::all_of(planes, [&](const glm::vec4& plane) {
    return glm::dot(glm::vec3(plane), middle_rel) + plane.w > -radius_m;
  });
}

// Triangulates one block's cells.
class BlockCells {
 public:
  BlockCells(const ocean::InlandBlock& block, std::span<const ocean::InlandSample> samples,
             double spacing_m, double distance_m, std::uint32_t first_vertex, RiverMesh& mesh)
      : block_(block), samples_(samples), first_vertex_(first_vertex), mesh_(mesh) {
    const double far_cells = kFarCell * distance_m / spacing_m;
    while (far_ * 2 <= kInlandBlock && far_ * 2 <= far_cells) far_ *= 2;
    // Where the sea's waves come in, cells follow them.
    widest_ = block.sea ? std::max(far_, 2) : kInlandBlock;
  }

  void add() { add_square(0, 0, kInlandBlock); }

 private:
  bool is_wet(int i, int j) const {
    return block_.wet[static_cast<std::size_t>(j) * kInlandBlock + static_cast<std::size_t>(i)];
  }

  // A square of `size` cells in one piece, if it is wet all over or small in the view, else in
  // quarters.
  void add_square(int i0, int j0, int size) {
    int wet = 0;
    for (int j = j0; j < j0 + size; ++j)
      for (int i = i0; i < i0 + size; ++i) wet += is_wet(i, j);
    if (wet == 0) return;
    if (size > 1 &&
        (size > widest_ || (wet < size * size && (size > far_ || !is_known(i0, j0, size))))) {
      const int half = size / 2;
      for (const int j : {j0, j0 + half})
        for (const int i : {i0, i0 + half}) add_square(i, j, half);
      return;
    }
    if (size == 1) {
      const std::uint32_t a = vertex(i0, j0), d = vertex(i0 + 1, j0 + 1);
      mesh_.indices.insert(mesh_.indices.end(),
                           {a, vertex(i0 + 1, j0), d, a, d, vertex(i0, j0 + 1)});
      return;
    }
    // A fan around the middle that has the vertices of its neighbours on its border: no cracks.
    add_side({i0, j0}, {1, 0}, size, j0 == 0);
    add_side({i0 + size, j0}, {0, 1}, size, i0 + size == kInlandBlock);
    add_side({i0 + size, j0 + size}, {-1, 0}, size, j0 + size == kInlandBlock);
    add_side({i0, j0 + size}, {0, -1}, size, i0 == 0);
  }

  // The triangles between a side of a square, which has it on the left, and the middle.
  void add_side(glm::ivec2 from, glm::ivec2 along, int size, bool on_border) {
    const int half = size / 2, step = on_border ? 1 : std::min(far_, size);
    const glm::ivec2 middle = from + half * along + half * glm::ivec2(-along.y, along.x);
    const std::uint32_t m = vertex(middle.x, middle.y);
    for (int k = 0; k < size; k += step) {
      const glm::ivec2 a = from + k * along, b = from + (k + step) * along;
      mesh_.indices.insert(mesh_.indices.end(), {vertex(a.x, a.y), vertex(b.x, b.y), m});
    }
  }

  // Whether the corners lie near water.
  bool is_known(int i, int j, int size) const {
    const auto known = [&](int x, int y) {
      return samples_[static_cast<std::size_t>(y) * kInlandSide + static_cast<std::size_t>(x)]
                 .near != 0.0f;
    };
    return known(i, j) && known(i + size, j) && known(i, j + size) && known(i + size, j + size);
  }

  std::uint32_t vertex(int i, int j) const {
    return first_vertex_ + static_cast<std::uint32_t>(j * kInlandSide + i);
  }

  const ocean::InlandBlock& block_;
  std::span<const ocean::InlandSample> samples_;
  std::uint32_t first_vertex_;
  RiverMesh& mesh_;
  int far_ = 1, widest_ = kInlandBlock;
};

// Where rivers look, once their levels and the mirrors' are known. from_within: the images are of
// the level of the river that the eye is in.
void find_images(double eye_z, bool from_within, RiverMesh& rivers) {
  rivers.looks_into.resize(rivers.indices.size() / 3);
  for (std::size_t n = 0; n < rivers.looks_into.size(); ++n) {
    float low_m = HUGE_VALF, high_m = -HUGE_VALF, sea = 0.0f;
    for (const std::uint32_t v : std::span(rivers.indices).subspan(3 * n, 3)) {
      const float level_m = rivers.p_rel[v].z + static_cast<float>(eye_z);
      low_m = std::min(low_m, level_m);
      high_m = std::max(high_m, level_m);
      sea = std::max(sea, rivers.sea_share[v]);
    }
    // Places are rounded, and waves lift those that the sea has a share of.
    const float reach_m = kMirrorGone_m + (sea > 0.0f ? 2.0f : 0.05f);
    const auto mirrored_in = [&](float level_m) {
      return low_m < level_m + reach_m && high_m > level_m - reach_m;
    };
    unsigned into = (sea > 0.0f || from_within ? kSeaFloor | kSeaMirror : 0) |
                    (mirrored_in(0.0f) ? kSeaMirror : 0);
    for (std::size_t k = 0; k < rivers.mirror_count; ++k)
      if (mirrored_in(rivers.mirror[k].level_m)) into |= unsigned{kRiverMirror} << k;
    rivers.looks_into[n] = static_cast<std::uint8_t>(into);
  }
}

// The level of some water in view, and how much of the picture it may fill.
struct LevelInView {
  double weights = 0.0, levels = 0.0, solid_angle = 0.0;

  double level_m() const { return levels / weights; }

  // Blocks count by their nearness, so that the level moves smoothly as the eye does.
  void add(const ocean::InlandBlock& block, double spacing_m, double level_m, double distance_m,
           double eye_z) {
    const double near_m = distance_m + 0.25 * (spacing_m * kInlandBlock);
    const double weight = (1.0 - static_cast<double>(mirror_share(static_cast<float>(level_m)))) /
                          (near_m * near_m * near_m);
    weights += weight;
    levels += weight * level_m;
    solid_angle +=
        weight * block.wet_cells * spacing_m * spacing_m * std::max(eye_z - level_m, 0.0);
  }

  // Adds the mirror of this level, if it shows and there is water to show it.
  void add_mirror(const View& view, RiverMesh& rivers) const {
    const double part = solid_angle / static_cast<double>(4.0f * view.tan_half_x * view.tan_half_y);
    if (!(part > kLeastPart && view.eye_world.z > level_m() + kLeastOver_m)) return;
    const auto rel_m = static_cast<float>(level_m() - view.eye_world.z);
    if (std::ranges::none_of(rivers.p_rel,
                             [&](glm::vec3 p) { return std::abs(p.z - rel_m) < kMirrorGone_m; }))
      return;
    rivers.mirror[rivers.mirror_count++] = {
        static_cast<float>(level_m()),
        static_cast<float>(std::min((part - kLeastPart) / (kFullPart - kLeastPart), 1.0))};
  }
};

// The levels of the water in view: of all of it, and of lakes.
class LevelsInView {
 public:
  void add(const ocean::InlandBlock& block, double spacing_m, double level_m, double distance_m,
           double eye_z) {
    all_.add(block, spacing_m, level_m, distance_m, eye_z);
    if (block.high_m - block.low_m > kStill_m) return;
    const auto known = std::find_if(lakes_.begin(), lakes_.begin() + count_, [&](const auto& lake) {
      return std::abs(lake.level_m() - level_m) < static_cast<double>(kMirrorFull_m);
    });
    if (known == lakes_.end()) return;
    if (known == lakes_.begin() + count_) ++count_;
    known->add(block, spacing_m, level_m, distance_m, eye_z);
  }

  void set_mirrors(const View& view, RiverMesh& rivers) {
    rivers.mirror_count = 0;
    all_.add_mirror(view, rivers);
    const std::span lakes(lakes_.begin(), lakes_.begin() + count_);
    std::ranges::stable_sort(lakes, std::greater{}, &LevelInView::solid_angle);
    for (const LevelInView& lake : lakes) {
      if (rivers.mirror_count == kMostRiverMirrors) return;
      const bool is_served = std::ranges::any_of(rivers.mirrors(), [&](const RiverMirror& mirror) {
        return std::abs(mirror.level_m - static_cast<float>(lake.level_m())) < kMirrorFull_m;
      });
      if (!is_served) lake.add_mirror(view, rivers);
    }
  }

 private:
  static constexpr float kStill_m = 0.01f;  // the most that the levels of a block of lake differ
  static constexpr std::size_t kMostLakes = 32;

  LevelInView all_;
  std::array<LevelInView, kMostLakes> lakes_;
  std::ptrdiff_t count_ = 0;
};

}  // namespace

void choose_rivers(const WorldState& world, const View& view, const FrameOptions& options,
                   RiverMesh& rivers) {
  rivers.indices.clear();
  rivers.p_rel.clear();
  rivers.sea_share.clear();
  rivers.looks_into.clear();
  rivers.mirror_count = 0;
  const ocean::InlandWater* const inland = world.inland.get();
  if (!inland || options.without.has(Part::kRivers) || options.without.has(Part::kWater)) return;
  const std::array<glm::vec4, 5> planes = frustum_planes(view);
  const double spacing_m = inland->spacing_m(), block_m = spacing_m * kInlandBlock;
  const auto drop = static_cast<float>(drop_per_m2(world.earth_radius_m(options.without)));
  LevelsInView levels;
  for (std::size_t b = 0; b < inland->blocks().size(); ++b) {
    const ocean::InlandBlock& block = inland->blocks()[b];
    if (!(block.low_m <= block.high_m)) continue;
    const glm::dvec3 middle(
        inland->point(block.first_cell) + 0.5 * block_m,
        0.5 * (static_cast<double>(block.low_m) + static_cast<double>(block.high_m)));
    glm::vec3 middle_rel(middle - view.eye_world);
    const float around2 = middle_rel.x * middle_rel.x + middle_rel.y * middle_rel.y;
    middle_rel.z -= around2 * drop;
    const float radius_m = static_cast<float>(0.75 * block_m) + (block.high_m - block.low_m) + 2.0f;
    if (!may_be_seen(planes, middle_rel, radius_m)) continue;
    const double distance_m =
        std::max(0.0, static_cast<double>(glm::length(middle_rel) - radius_m));
    levels.add(block, spacing_m, middle.z, distance_m, view.eye_world.z);
    const auto samples =
        inland->samples().subspan(b * ocean::kInlandSamples, ocean::kInlandSamples);
    const auto first = static_cast<std::uint32_t>(rivers.p_rel.size());
    const std::size_t before = rivers.indices.size();
    BlockCells(block, samples, spacing_m, distance_m, first, rivers).add();
    if (rivers.indices.size() == before) continue;
    for (int j = 0; j < kInlandSide; ++j)
      for (int i = 0; i < kInlandSide; ++i) {
        const ocean::InlandSample& s =
            samples[static_cast<std::size_t>(j) * kInlandSide + static_cast<std::size_t>(i)];
        const glm::dvec2 p = inland->point(block.first_cell + glm::ivec2(i, j));
        rivers.p_rel.emplace_back(glm::dvec3(p, static_cast<double>(s.level_m)) - view.eye_world);
        rivers.sea_share.push_back(s.sea_share);
      }
  }
  levels.set_mirrors(view, rivers);
  const auto at_eye = inland->at(glm::dvec2(view.eye_world));
  const bool from_within =
      at_eye && view.eye_world.z < static_cast<double>(at_eye->level_m) + kNearPlane_m;
  find_images(view.eye_world.z, from_within, rivers);
}

}  // namespace swell::render
