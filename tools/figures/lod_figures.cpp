#include "tools/figures/lod_figures.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <set>
#include <span>
#include <string_view>
#include <utility>

#include "lod/roam.h"
#include "lod/tree.h"

namespace swell::apps {
namespace {

constexpr int kBits = 4, kSteps = 1 << kBits;  // of the lattice
constexpr double kSquare_px = 400.0, kMargin_px = 20.0, kCaption_px = 30.0;

using Point = std::pair<int, int>;
struct Leaf {
  std::array<Point, 3> corners;
  int level;
  bool operator<(const Leaf& other) const { return corners < other.corners; }
};
using Leaves = std::set<Leaf>;

// From the diamonds that are split, as the definition of the bintree says.
void add_leaves(const std::set<Point>& split, Point a, Point apex, Point b, int level,
                Leaves& leaves) {
  const int x2 = a.first + b.first, y2 = a.second + b.second;
  const Point middle{x2 / 2, y2 / 2};
  if (x2 % 2 != 0 || y2 % 2 != 0 || !split.contains(middle)) {
    leaves.insert({{a, apex, b}, level});
    return;
  }
  add_leaves(split, a, middle, apex, level + 1, leaves);
  add_leaves(split, apex, middle, b, level + 1, leaves);
}

Leaves leaves_of(const lod::Roam::Tree& tree) {
  std::set<Point> split;
  for (int i = 0; i < tree.node_end; ++i)
    if (tree.node(i).split) split.emplace(tree.node(i).position.x, tree.node(i).position.y);
  Leaves leaves;
  add_leaves(split, {0, 0}, {kSteps, 0}, {kSteps, kSteps}, 0, leaves);
  add_leaves(split, {kSteps, kSteps}, {0, kSteps}, {0, 0}, 0, leaves);
  return leaves;
}

int deepest_level(const Leaves& leaves) {
  return std::ranges::max_element(leaves, {}, &Leaf::level)->level;
}

// One square; leaves that `before` does not have are tinted.
std::string panel(const Leaves& leaves, const Leaves& before, double x_px,
                  std::string_view caption) {
  const double scale = kSquare_px / kSteps;
  std::string svg;
  for (const Leaf& leaf : leaves) {
    std::string points;
    for (const Point& p : leaf.corners)
      points +=
          fmt::format("{},{} ", x_px + scale * p.first, kMargin_px + kSquare_px - scale * p.second);
    svg += fmt::format("<polygon points=\"{}\" fill=\"{}\"/>\n", points,
                       before.contains(leaf) ? "#f4f7fa" : "#f6c667");
  }
  return svg + fmt::format("<text x=\"{}\" y=\"{}\">{}</text>\n", x_px + 0.5 * kSquare_px,
                           2.0 * kMargin_px + kSquare_px, caption);
}

LodFigure figure(std::string file, const Leaves& left, std::string_view left_caption,
                 const Leaves& right, std::string_view right_caption, bool tint) {
  LodFigure f;
  f.file = std::move(file);
  f.left_triangles = static_cast<int>(left.size());
  f.right_triangles = static_cast<int>(right.size());
  f.deepest_level = std::max(deepest_level(left), deepest_level(right));
  const double width_px = 2.0 * kSquare_px + 3.0 * kMargin_px;
  f.svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
      "height=\"{1}\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
      "<g stroke=\"#1d3d5c\" stroke-width=\"1.2\" stroke-linejoin=\"round\">\n",
      width_px, kSquare_px + 2.0 * kMargin_px + kCaption_px);
  std::string text;
  const auto add = [&](const Leaves& leaves, const Leaves& before, double x_px,
                       std::string_view caption) {
    const std::string all = panel(leaves, before, x_px, caption);
    const std::size_t words = all.find("<text");
    f.svg += all.substr(0, words);
    text += all.substr(words);
  };
  add(left, left, kMargin_px, left_caption);
  add(right, tint ? left : right, 2.0 * kMargin_px + kSquare_px, right_caption);
  f.svg += "</g>\n<g font-family=\"sans-serif\" font-size=\"16\" text-anchor=\"middle\">\n" + text +
           "</g>\n</svg>\n";
  return f;
}

lod::AdaptRequest request_from(glm::dvec3 eye, double heading_rad, double pitch_rad, int budget) {
  lod::AdaptRequest request;
  request.view = make_view(eye, heading_rad, pitch_rad, 1.5, 0.01f, 100, 100);
  request.triangle_budget = budget;
  return request;
}

LodFigure grid_figure() {
  const lod::Domain domain{.min_world = {0.0, 0.0}, .size_m = kSteps, .lattice_bits = kBits};
  // From far above all distances are alike, and the levels follow each other.
  lod::Roam uniform(domain, 256), simplified(domain, 256);
  uniform.adapt(request_from({8.0, 8.0, 1e6}, 0.0, -1.57, 256));
  simplified.adapt(request_from({-4.0, -4.0, 3.0}, 0.785, -0.4, 100));
  const Leaves left = leaves_of(uniform.tree()), right = leaves_of(simplified.tree());
  return figure("lod_grid_9x9.svg", left, fmt::format("uniform: {} triangles", left.size()), right,
                fmt::format("simplified: {} triangles", right.size()), false);
}

int node_at(const lod::Roam::Tree& tree, glm::ivec2 position) {
  for (int i = 0; i < tree.node_end; ++i)
    if (tree.node(i).position == position) return i;
  return -1;
}

LodFigure forced_split_figure() {
  constexpr glm::ivec2 kSplits[] = {{8, 8},   {8, 16},  {16, 8}, {12, 12}, {12, 16},
                                    {16, 12}, {14, 14}, {8, 0},  {16, 14}};
  constexpr glm::ivec2 kForced{15, 13};
  lod::Roam::Tree tree({.min_world = {0.0, 0.0}, .size_m = kSteps, .lattice_bits = kBits}, 256);
  lod::reset_tree(tree);
  for (const glm::ivec2& position : kSplits) lod::split(tree, node_at(tree, position));
  const Leaves left = leaves_of(tree);
  const int splits = lod::force_split(tree, node_at(tree, kForced));
  const Leaves right = leaves_of(tree);
  return figure("lod_forced_split.svg", left, fmt::format("{} triangles", left.size()), right,
                fmt::format("one split forces {} more: {} triangles", splits - 1, right.size()),
                true);
}

LodFigure split_figure() {
  lod::Roam::Tree tree({.min_world = {0.0, 0.0}, .size_m = kSteps, .lattice_bits = kBits}, 16);
  lod::reset_tree(tree);
  const Leaves left = leaves_of(tree);
  lod::split(tree, node_at(tree, {kSteps / 2, kSteps / 2}));
  const Leaves right = leaves_of(tree);
  return figure("lod_split.svg", left, fmt::format("{} triangles", left.size()), right,
                fmt::format("split: {} triangles", right.size()), true);
}

}  // namespace

std::vector<LodFigure> lod_figures() {
  return {grid_figure(), forced_split_figure(), split_figure()};
}

}  // namespace swell::apps
