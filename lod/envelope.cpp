#include "lod/envelope.h"

#include "math/check.h"

namespace swell::lod {
namespace {

// Rebuilds the bintree from the levels of its leaves, which their order determines.
template <class LeafRange>  // HeightRange(std::size_t triangle)
struct EnvelopeBuilder {
  const Mesh& mesh;
  Envelopes& envelopes;
  LeafRange leaf_range;
  std::size_t node = 0, leaf = 0;

  void build(int level) {
    SWELL_DCHECK(leaf < mesh.level.size() && mesh.level[leaf] >= level, "leaf={} level={}", leaf,
                 level);
    const std::size_t whole = node++;
    if (mesh.level[leaf] == level) {
      envelopes.height[whole] = leaf_range(leaf++);
      envelopes.leaves[whole] = 1;
      return;
    }
    const std::size_t first = node;
    build(level + 1);
    const std::size_t second = node;
    build(level + 1);
    envelopes.height[whole] = join(envelopes.height[first], envelopes.height[second]);
    envelopes.leaves[whole] = envelopes.leaves[first] + envelopes.leaves[second];
  }
};

template <class LeafRange>
void build(const Mesh& mesh, Envelopes& envelopes, LeafRange leaf_range) {
  const std::size_t triangles = mesh.level.size();
  SWELL_CHECK(triangles >= 2 && mesh.indices.size() == 3 * triangles, "{} triangles, {} indices",
              triangles, mesh.indices.size());
  envelopes.height.resize(2 * triangles - 2);
  envelopes.leaves.resize(2 * triangles - 2);
  EnvelopeBuilder<LeafRange> builder{mesh, envelopes, leaf_range};
  builder.build(0);
  builder.build(0);
}

Envelope envelope(const Envelopes& envelopes, const std::array<glm::ivec2, 3>& corner, int level,
                  int node, int first_leaf) {
  const auto i = static_cast<std::size_t>(node);
  return {corner, envelopes.height[i], level, node, first_leaf, envelopes.leaves[i]};
}

// ---- what the view sees ----

struct ViewSearch {
  const Envelopes& envelopes;
  double step_m;
  glm::dvec3 corner_rel;  // of the domain, from the eye
  std::array<glm::dvec4, 5> planes;
  std::vector<TriangleRange>& in_view;
  int tested = 0;

  // planes_left: a bit for each plane that cuts all boxes above.
  void visit(const Envelope& e, unsigned planes_left) {
    ++tested;
    const glm::dvec3 low = corner_rel + glm::dvec3(step_m * glm::dvec2(e.low()), e.height.low_m);
    const glm::dvec3 high = corner_rel + glm::dvec3(step_m * glm::dvec2(e.high()), e.height.high_m);
    for (unsigned i = 0; i < planes.size(); ++i) {
      if ((planes_left >> i & 1u) == 0) continue;
      const glm::dvec3 n(planes[i]), a = n * low, b = n * high;
      const glm::dvec3 least = glm::min(a, b), most = glm::max(a, b);
      if (((most.x + most.y) + most.z) + planes[i].w < 0.0) return;
      if (((least.x + least.y) + least.z) + planes[i].w >= 0.0) planes_left &= ~(1u << i);
    }
    if (planes_left == 0 || e.is_leaf()) return add(e);
    for (const Envelope& half : halves_of(envelopes, e)) visit(half, planes_left);
  }

  void add(const Envelope& e) {
    if (in_view.empty() || in_view.back().end != e.first_leaf)
      in_view.push_back({e.first_leaf, e.first_leaf});
    in_view.back().end = e.first_leaf + e.leaves;
  }
};

}  // namespace

void build_envelopes(const Mesh& mesh, std::span<const float> height_m, Envelopes& envelopes) {
  SWELL_CHECK(height_m.size() == mesh.lattice.size(), "{} vertices, {} heights",
              mesh.lattice.size(), height_m.size());
  build(mesh, envelopes, [&](std::size_t triangle) {
    const std::uint32_t* v = &mesh.indices[3 * triangle];
    const float a = height_m[v[0]], b = height_m[v[1]], c = height_m[v[2]];
    return HeightRange{std::min(std::min(a, b), c), std::max(std::max(a, b), c)};
  });
}

void build_envelopes(const Mesh& mesh, int lattice_bits, const HeightPyramid& bounds,
                     Envelopes& envelopes) {
  build(mesh, envelopes, [&](std::size_t triangle) {
    const std::uint32_t* v = &mesh.indices[3 * triangle];
    const glm::ivec2 a = mesh.lattice[v[0]], b = mesh.lattice[v[1]], c = mesh.lattice[v[2]];
    return height_range(bounds, lattice_bits, glm::min(glm::min(a, b), c),
                        glm::max(glm::max(a, b), c));
  });
}

std::array<Envelope, 2> roots_of(const Envelopes& envelopes, int lattice_bits) {
  const int n = 1 << lattice_bits;
  const Envelope south_east = envelope(envelopes, {{{0, 0}, {n, 0}, {n, n}}}, 0, 0, 0);
  return {south_east, envelope(envelopes, {{{n, n}, {0, n}, {0, 0}}}, 0, 2 * south_east.leaves - 1,
                               south_east.leaves)};
}

std::array<Envelope, 2> halves_of(const Envelopes& envelopes, const Envelope& whole) {
  SWELL_DCHECK(!whole.is_leaf(), "node={}", whole.node);
  const auto [first, apex, last] = whole.corner;
  const glm::ivec2 middle = (first + last) / 2;
  std::array<std::array<glm::ivec2, 3>, 2> corner = {{{apex, middle, first}, {last, middle, apex}}};
  if (whole.level % 2 != 0) std::swap(corner[0], corner[1]);  // as in mesh.cpp
  const int level = whole.level + 1;
  const Envelope a = envelope(envelopes, corner[0], level, whole.node + 1, whole.first_leaf);
  return {
      a, envelope(envelopes, corner[1], level, a.node + 2 * a.leaves - 1, a.first_leaf + a.leaves)};
}

int find_in_view(const Envelopes& envelopes, const Domain& domain, const View& view,
                 std::vector<TriangleRange>& in_view) {
  in_view.clear();
  ViewSearch search{.envelopes = envelopes,
                    .step_m = domain.step_m(),
                    .corner_rel = glm::dvec3(domain.min_world, 0.0) - view.eye_world,
                    .planes = {},
                    .in_view = in_view};
  const std::array<glm::vec4, 5> planes = frustum_planes(view);
  std::copy(planes.begin(), planes.end(), search.planes.begin());
  for (const Envelope& root : roots_of(envelopes, domain.lattice_bits)) search.visit(root, 31u);
  return search.tested;
}

}  // namespace swell::lod
