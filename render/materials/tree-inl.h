// Trees: leaves and bark under sun and sky. A crown is shaded as the rounded or pointed body that
// its triangles stand for, however many they are, so that it looks alike from near and far.
#if defined(SWELL_RENDER_MATERIALS_TREE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_MATERIALS_TREE_INL_H_
#undef SWELL_RENDER_MATERIALS_TREE_INL_H_
#else
#define SWELL_RENDER_MATERIALS_TREE_INL_H_
#endif

#include "render/materials/tree.h"
#include "render/tile/lanes3-inl.h"
#include "render/tile/sun_shadow-inl.h"
#include "render/tile/surfel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// What a packet's pixels show of their trees.
struct TreeLanes {
  V3 from_foot;                  // [m]
  V inverse_radius;              // [1/m]
  V crown_begin, inverse_crown;  // [m], [1/m]
  V taper, rise, rise_by_up;
  V3 albedo;
  V translucency;  // < 0: bark
  V leaf_size;     // of the crown
  V crowding;
  V across;  // of the view, from the trunk, with a shift that differs from leaf to leaf [m]
};

// How bright a leaf is among those of its tree.
inline float LeafBrightness(const DrawnTree& tree, std::uint32_t leaf) {
  const std::uint32_t bits = (leaf * 2654435761u ^ tree.tree * 2246822519u) >> 13 & 0xff;
  return 1.0f + (0.3f / 255.0f * static_cast<float>(bits) - 0.15f) * (1.0f - tree.leaf_size);
}

HWY_INLINE TreeLanes LoadTrees(const Tree& material, std::uint32_t first, const Lanes& lanes,
                               const Packet& packet) {
  const D d;
  constexpr std::size_t n = Lanes3::kCount;
  Lanes3 foot, albedo, aside;
  HWY_ALIGN float radius[n], begin[n], crown[n], taper[n], rise[n], rise_by_up[n], through[n],
      size[n], crowding[n];
  for (std::size_t i = 0; i < n; ++i) {
    const TreePrimitive& primitive = material.primitives[lanes.primitive(i) - first];
    const DrawnTree& tree = material.drawn[primitive.tree];
    const TreeSurface& species = material.species[tree.species];
    const bool is_bark = primitive.leaf == kTrunkLeaf;
    foot.Set(i, tree.foot_rel);
    aside.Set(i, {tree.aside, 0.37f * static_cast<float>(primitive.leaf % 61u)});
    radius[i] = tree.inverse_radius_m;
    begin[i] = tree.crown_begin_m, crown[i] = tree.inverse_crown_m;
    taper[i] = species.taper, rise[i] = species.rise.x, rise_by_up[i] = species.rise.y;
    size[i] = tree.leaf_size;
    crowding[i] = tree.crowding;
    through[i] = is_bark ? -1.0f : species.translucency;
    albedo.Set(i,
               is_bark ? species.bark : tree.leaves_albedo * LeafBrightness(tree, primitive.leaf));
  }
  const V3 from_foot = Difference(packet.p, foot.Load());
  const V3 across = aside.Load();
  return {from_foot,
          hn::Load(d, radius),
          hn::Load(d, begin),
          hn::Load(d, crown),
          hn::Load(d, taper),
          hn::Load(d, rise),
          hn::Load(d, rise_by_up),
          albedo.Load(),
          hn::Load(d, through),
          hn::Load(d, size),
          hn::Load(d, crowding),
          hn::MulAdd(from_foot.x, across.x, hn::MulAdd(from_foot.y, across.y, across.z))};
}

// A point of a crown.
struct CrownPoint {
  V3 normal;  // unit, of the crown's hull, roughened by the leaves
  V bright;   // of single leaves
  V up;       // in the crown, from 0 to 1
  V inside;   // 1 at the trunk, 0 at the hull
};

HWY_INLINE CrownPoint FindCrownPoint(const Tree& material, const ViewRays& rays,
                                     const Packet& packet, const TreeLanes& tree) {
  const D d;
  const V zero = hn::Zero(d), one = Constant(1.0f);
  const V up =
      Clamp(hn::Mul(hn::Sub(tree.from_foot.z, tree.crown_begin), tree.inverse_crown), 0.0f, 1.0f);
  const V narrow = hn::Max(hn::NegMulAdd(tree.taper, up, one), Constant(0.2f));
  const V scale = hn::Div(tree.inverse_radius, narrow);
  const V x = hn::Mul(tree.from_foot.x, scale), y = hn::Mul(tree.from_foot.y, scale);
  const V z = hn::MulAdd(tree.rise_by_up, up, tree.rise);
  // Large triangles lie across the crown's middle; the hull that they stand for bulges to the eye.
  const V round = hn::Mul(z, hn::Sub(one, tree.taper));
  const V out2 = hn::Min(hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(round, round))), one);
  const V inside = hn::Sub(one, out2);
  V3 normal = ScaleAdd(packet.to_eye, hn::Sqrt(inside), V3{x, y, z});

  V a = zero, b = zero, unused = zero;
  AddSlopes(material.foliage, {tree.across, tree.from_foot.z, zero}, FootprintAcross(rays, packet),
            zero, zero, a, b, unused);
  normal = Sum(normal, {a, hn::Neg(a), b});
  const V inverse = InverseSqrt(hn::Max(Dot(normal, normal), Constant(1e-6f)));
  return {Scale(normal, inverse), Clamp(hn::MulAdd(b, Constant(0.3f), one), 0.5f, 1.6f), up,
          hn::Mul(inside, hn::Sub(one, tree.leaf_size))};
}

template <ViewKind kView>
struct Shader<Tree, kView> {
  const Tree& tree;

  HWY_INLINE Surfel operator()(const Shading& s, const TilePixels& tile, const Lanes& lanes,
                               const Packet& packet) const {
    const D d;
    const V zero = hn::Zero(d), one = Constant(1.0f), half = Constant(0.5f);
    const TreeLanes its = LoadTrees(tree, s.primitives.begin(Tree::kSurface), lanes, packet);
    const CrownPoint point = FindCrownPoint(tree, s.rays, packet, its);
    const auto is_bark = hn::Lt(its.translucency, zero);
    const V through = hn::Max(its.translucency, zero);

    // Neighbours and the crown itself take light from what lies low and deep inside.
    const V low =
        hn::Mul(hn::Sub(one, point.up), hn::MulAdd(its.crowding, Constant(0.7f), Constant(0.25f)));
    const V deep = hn::IfThenElse(is_bark, Constant(0.5f), point.inside);
    const V open = hn::Mul(hn::Sub(one, low), hn::NegMulAdd(deep, Constant(0.7f), one));

    const V facing = Dot(point.normal, Constant(s.light.sun_direction));
    const V lit = hn::Max(hn::MulAdd(facing, Constant(0.75f), Constant(0.25f)), zero);
    const V from_behind =
        hn::Max(hn::Neg(Dot(packet.to_eye, Constant(s.light.sun_direction))), zero);
    const V sun = hn::Mul(hn::MulAdd(through, from_behind, lit),
                          hn::Mul(SunVisible(s, tile, packet, Constant(-1.0f)), open));
    const V sky_seen = hn::Mul(hn::MulAdd(point.normal.z, half, half), open);
    // Below there is ground of about the trees' own brightness.
    const V around = hn::MulAdd(sky_seen, Constant(0.9f), Constant(0.1f));
    const V3 arriving = ScaleAdd(
        Constant(s.light.sun_irradiance), hn::Mul(sun, Constant(0.318309886f)),
        Scale(Constant(s.light.ambient), hn::Mul(around, AmbientUnderClouds(s, packet.p))));
    return {Product(arriving, Scale(its.albedo, point.bright)), point.normal};
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
