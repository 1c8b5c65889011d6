#include "shapes/tree_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "math/elementary.h"
#include "math/random.h"
#include "math/stop.h"

namespace swell::shapes {
namespace {

using terrain::TreeSpecies;

constexpr double kWhorls = 9.0;  // of a conifer's boughs
constexpr std::size_t kSizesPerLeaf = 4;
constexpr float kGather = 0.85f;  // how much of their size large leaves move inwards by

// Source: Roberts, The Unreasonable Effectiveness of Quasirandom Sequences, 2018 (R3): each
// beginning of it is spread evenly.
glm::dvec3 spread_point(std::size_t n) {
  constexpr double g = 1.22074408460575947536;
  const auto part = [&](double step) {
    const double x = 0.5 + static_cast<double>(n) * step;
    return x - std::floor(x);
  };
  return {part(1.0 / g), part(1.0 / (g * g)), part(1.0 / (g * g * g))};
}

glm::vec2 direction(double turns) {
  const SinCos angle = sin_cos_turns(turns);
  return {angle.cos, angle.sin};
}

double chance(std::size_t leaf, int number) {
  return random_uniform(71, leaf * 8 + static_cast<std::size_t>(number));
}

// A rounded crown with lumps, open below.
TreeLeaf broad_leaf(std::size_t n) {
  const glm::dvec3 u = spread_point(n);
  const double up = 1.0 - 2.0 * u.x, around = std::sqrt(1.0 - up * up);
  const double lumps =
      0.82 + 0.18 * sin_cos_turns(3.0 * u.y + 0.5 * up).sin * sin_cos_turns(1.4 * up + u.y).cos;
  const double r = lumps * (0.5 + 0.5 * std::sqrt(u.z));
  const glm::vec2 side = direction(u.y) * static_cast<float>(r * around);
  TreeLeaf leaf;
  leaf.middle = {side, 0.5 + 0.5 * r * (up < 0.0 ? 0.8 * up : up)};
  // The first two together fill the crown: one with a side on top, the other, lower, under a hump.
  if (n == 0)
    leaf.corner = {glm::vec2(-0.9f, 0.34f), glm::vec2(0.9f, 0.34f), glm::vec2(0.0f, -0.66f)};
  if (n == 1)
    leaf.corner = {glm::vec2(-0.85f, -0.36f), glm::vec2(0.85f, -0.36f), glm::vec2(0.1f, 0.66f)};
  if (n < 2) return leaf;
  // A few large ones inside, and many small ones around them. On top a side is up: corners would be
  // thorns.
  const double high = std::clamp(3.0 * up, 0.0, 1.0);
  const double turn = 0.75 + (chance(n, 0) - 0.5) * (1.0 - 0.72 * high);
  const double large = chance(n, 1);
  leaf.size = static_cast<float>(0.55 + 0.95 * large * large * large);
  for (int k = 0; k < 3; ++k)
    leaf.corner[k] = leaf.size * glm::vec2(1.2f, 0.6f) * direction(turn + k / 3.0);
  return leaf;
}

// A cone of boughs in whorls that hang to their ends.
TreeLeaf conifer_leaf(std::size_t n) {
  const glm::dvec3 u = spread_point(n);
  const double up = 1.0 - std::sqrt(1.0 - 0.985 * u.x);  // as many as the cone is wide there
  const double in_whorl = kWhorls * up - std::floor(kWhorls * up);
  const double r = (1.0 - up) * (1.0 - 0.4 * in_whorl) * (0.35 + 0.65 * std::sqrt(u.z));
  TreeLeaf leaf;
  leaf.middle = {direction(u.y) * static_cast<float>(r), up - 0.05 * r};
  const auto size = static_cast<float>(n == 0 ? 1.0 : 0.6 + 0.8 * chance(n, 1));
  const auto lean = static_cast<float>(n == 0 ? 0.0 : 1.2 * (chance(n, 0) - 0.5));
  leaf.corner = {size * glm::vec2(-1.0f, -0.333f), size * glm::vec2(1.0f, -0.333f),
                 size * glm::vec2(lean, 0.667f)};
  return leaf;
}

TreeLeaf reed_blade(std::size_t n) {
  const glm::dvec3 u = spread_point(n);
  TreeLeaf leaf;
  leaf.middle = {direction(u.y) * static_cast<float>(0.75 * std::sqrt(u.z)), 0.0f};
  const auto lean = static_cast<float>(0.9 * (chance(n, 0) - 0.5));
  const auto height = static_cast<float>(n == 0 ? 1.0 : 0.62 + 0.38 * chance(n, 1));
  leaf.corner = {glm::vec2(-0.5f, 0.0f), glm::vec2(0.5f, 0.0f), glm::vec2(lean, height)};
  return leaf;
}

template <class Make>
std::vector<TreeLeaf> make_leaves(std::size_t count, const Make& make) {
  std::vector<TreeLeaf> leaves;
  for (std::size_t n = 0; n < count; ++n) {
    leaves.push_back(make(n));
    const SinCos phase = sin_cos_turns(chance(n, 2));
    leaves.back().flutter = {phase.sin, phase.cos};
  }
  return leaves;
}

TreeShape bare_shape(TreeSpecies species) {
  switch (species) {
    case TreeSpecies::kConifer:
      return {.crown_begin = 0.05f,
              .gathers_up = 0.333f,
              .flatness = 0.4f,
              .trunk = 0.014f,
              .leaves = make_leaves(1200, conifer_leaf)};
    case TreeSpecies::kReed:
      return {.gathers_up = 0.0f, .is_blades = true, .leaves = make_leaves(40, reed_blade)};
    default:
      return {.crown_begin = 0.16f,
              .fewest_leaves = 2.0f,
              .trunk = 0.018f,
              .leaves = make_leaves(1500, broad_leaf)};
  }
}

// Size of the smallest leaves.
float finest_size(TreeSpecies species) {
  switch (species) {
    case TreeSpecies::kConifer:
      return 0.125f;
    case TreeSpecies::kReed:
      return 0.11f;
    default:
      return 0.068f;
  }
}

// Points of a square that triangles cover, from (-1.5, -0.25) on: right in radii, up in crown
// heights.
class CoverGrid {
 public:
  void add(const std::array<glm::vec2, 3>& p) {
    std::array<glm::vec2, 3> q;
    for (int k = 0; k < 3; ++k) q[k] = (p[k] - glm::vec2(-1.5f, -0.25f)) * kPointsPerUnit;
    const auto [x0, x1] = std::minmax({q[0].x, q[1].x, q[2].x});
    const auto [y0, y1] = std::minmax({q[0].y, q[1].y, q[2].y});
    const auto limit = [](float v) { return std::clamp(static_cast<int>(v), 0, kSide - 1); };
    const float area = cross(q[0], q[1], q[2]);
    const int first = limit(x0), last = limit(x1);
    for (int y = limit(y0); y <= limit(y1); ++y) {
      std::uint8_t* const row = covered_.data() + y * kSide;
      // Without a branch, so that compilers take several points at once.
      for (int x = first; x <= last; ++x) {
        const auto is_left = [&, at = glm::vec2(x, y)](int k) {
          return cross(q[k], q[(k + 1) % 3], at) * area >= 0.0f ? 1 : 0;
        };
        row[x] |= static_cast<std::uint8_t>(is_left(0) & is_left(1) & is_left(2));
      }
    }
  }

  float of_box() const {
    return static_cast<float>(std::accumulate(covered_.begin(), covered_.end(), 0)) /
           (2.0f * kPointsPerUnit.x * kPointsPerUnit.y);
  }

 private:
  static constexpr int kSide = 96;
  static constexpr glm::vec2 kPointsPerUnit{kSide / 3.0f, kSide / 1.5f};
  static float cross(glm::vec2 a, glm::vec2 b, glm::vec2 c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  }
  std::array<std::uint8_t, std::size_t{kSide} * kSide> covered_{};
};

// The part of the crown's box that leaves cover, seen from the side; the last one grows.
float cover_of(const TreeShape& shape, float leaves, float size) {
  float sum = 0.0f;
  for (const glm::vec2& right : {glm::vec2(1, 0), glm::vec2(0.6f, 0.8f), glm::vec2(-0.28f, 0.96f),
                                 glm::vec2(-0.936f, 0.352f)}) {
    check_stop();
    CoverGrid grid;
    for (std::size_t n = 0; static_cast<float>(n) < leaves; ++n) {
      const TreeLeaf& leaf = shape.leaves[n];
      const float grown = std::sqrt(std::min(leaves - static_cast<float>(n), 1.0f));
      const glm::vec3 middle = leaf_middle(shape, leaf, size);
      const glm::vec2 seen(glm::dot(glm::vec2(middle), right), middle.z);
      std::array<glm::vec2, 3> p;
      for (int k = 0; k < 3; ++k) p[k] = seen + leaf_corner(shape, leaf.corner[k], size, grown);
      grid.add(p);
    }
    sum += 0.25f * grid.of_box();
  }
  return sum;
}

// The size at which leaves cover `cover`.
float size_for_cover(const TreeShape& shape, float leaves, float cover) {
  float low = 0.02f, high = shape.is_blades ? 3.0f : 1.3f;
  for (int i = 0; i < 11; ++i) {
    const float middle = 0.5f * (low + high);
    (cover_of(shape, leaves, middle) < cover ? low : high) = middle;
  }
  return 0.5f * (low + high);
}

// Between numbers that are half as large again each, sizes go evenly; a single leaf that grows
// among few is followed in steps.
void fit_sizes(float finest, TreeShape& shape) {
  constexpr std::size_t kFew = 4 * kSizesPerLeaf;
  const std::size_t all = shape.leaves.size() * kSizesPerLeaf;
  const auto leaves_of = [](std::size_t n) { return static_cast<float>(n) / kSizesPerLeaf; };
  const float cover = cover_of(shape, leaves_of(all), finest);
  shape.size.assign(all + 1, finest);
  // Trees of few leaves are drawn without the trunk that shows below the crown.
  constexpr float kRadiusOverHeight = 0.3f;
  const float with_trunk =
      cover + shape.trunk * shape.crown_begin / (kRadiusOverHeight * (1.0f - shape.crown_begin));
  const float one = size_for_cover(shape, 1.0f, with_trunk);
  std::fill_n(shape.size.begin(), kSizesPerLeaf + 1, one);
  for (std::size_t n = kSizesPerLeaf; n < all;) {
    const std::size_t next = std::min(all, n < kFew ? n + 1 : n + n / 2);
    const float target = n < kFew ? with_trunk : cover;
    const float size = next == all ? finest : size_for_cover(shape, leaves_of(next), target);
    for (std::size_t k = n + 1; k <= next; ++k) {
      const float t = static_cast<float>(k - n) / static_cast<float>(next - n);
      shape.size[k] = shape.size[n] * (1.0f - t) + size * t;
    }
    n = next;
  }
}

}  // namespace

TreeShape make_tree_shape(TreeSpecies species) {
  TreeShape shape = bare_shape(species);
  fit_sizes(finest_size(species), shape);
  return shape;
}

float leaf_size(const TreeShape& shape, float leaves) {
  const float at = leaves * static_cast<float>(kSizesPerLeaf);
  const auto n = static_cast<std::size_t>(at);
  if (n + 1 >= shape.size.size()) return shape.size.back();
  const float t = at - static_cast<float>(n);
  return shape.size[n] + t * (shape.size[n + 1] - shape.size[n]);
}

glm::vec3 leaf_middle(const TreeShape& shape, const TreeLeaf& leaf, float size) {
  const glm::vec3 gathers(0.0f, 0.0f, shape.gathers_up);
  return gathers + (leaf.middle - gathers) * (1.0f - std::min(kGather * size * leaf.size, 1.0f));
}

glm::vec2 leaf_corner(const TreeShape& shape, glm::vec2 corner, float size, float grown) {
  if (shape.is_blades)
    return {corner.x * (corner.y > 0.0f ? 1.0f : size * grown), corner.y * grown};
  const float height = shape.flatness + (1.0f - shape.flatness) * std::min(size, 1.0f);
  return corner * glm::vec2(1.0f, height) * (size * grown);
}

float crown_cover(const TreeShape& shape, int leaves, float size) {
  return cover_of(shape, static_cast<float>(leaves), size);
}

}  // namespace swell::shapes
