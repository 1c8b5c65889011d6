// Trees: leaves and bark under sun and sky. A crown is shaded as the rounded or pointed body that
// its triangles stand for, however many they are, so that it looks alike from near and far.
#if defined(SWELL_RENDER_MATERIALS_TREE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_MATERIALS_TREE_INL_H_
#undef SWELL_RENDER_MATERIALS_TREE_INL_H_
#else
#define SWELL_RENDER_MATERIALS_TREE_INL_H_
#endif

#include "render/materials/tree.h"
#include "render/packets/lanes3-inl.h"
#include "render/tile/shading_result-inl.h"
#include "render/tile/sun_shadow-inl.h"
#include "render/view/trees_drawn.h"

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
  const V3 from_foot = packet.p - foot.Load();
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
          MulAdd(from_foot.x, across.x, MulAdd(from_foot.y, across.y, across.z))};
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
  const V up = Clamp((tree.from_foot.z - tree.crown_begin) * tree.inverse_crown, 0.0f, 1.0f);
  const V narrow = Max(NegMulAdd(tree.taper, up, one), 0.2f);
  const V scale = tree.inverse_radius / narrow;
  const V x = tree.from_foot.x * scale, y = tree.from_foot.y * scale;
  const V z = MulAdd(tree.rise_by_up, up, tree.rise);
  // Large triangles lie across the crown's middle; the hull that they stand for bulges to the eye.
  const V round = z * (one - tree.taper);
  const V out2 = Min(MulAdd(x, x, MulAdd(y, y, round * round)), one);
  const V inside = one - out2;
  V3 normal = MulAdd(packet.to_eye, Sqrt(inside), V3{x, y, z});

  V a = zero, b = zero, unused = zero;
  AddSlopes(material.foliage, {tree.across, tree.from_foot.z, zero}, FootprintAcross(rays, packet),
            {zero, zero}, a, b, unused);
  normal = normal + V3{a, -a, b};
  const V inverse = InverseSqrt(Max(Dot(normal, normal), 1e-6f));
  return {normal * inverse, Clamp(MulAdd(b, 0.3f, one), 0.5f, 1.6f), up,
          inside * (one - tree.leaf_size)};
}

template <ViewKind kView>
struct Shader<Tree, kView> {
  const Tree& tree;

  HWY_INLINE ShadingResult operator()(const Shading& s, const TilePixels& tile, const Lanes& lanes,
                                      const Packet& packet) const {
    const D d;
    const V zero = hn::Zero(d), one = Constant(1.0f), half = Constant(0.5f);
    const TreeLanes its = LoadTrees(tree, s.primitives.begin(Tree::kSurface), lanes, packet);
    const CrownPoint point = FindCrownPoint(tree, s.rays, packet, its);
    const auto is_bark = its.translucency < zero;
    const V through = Max(its.translucency, zero);

    // Neighbours and the crown itself take light from what lies low and deep inside.
    const V low = (one - point.up) * MulAdd(its.crowding, 0.7f, 0.25f);
    const V deep = IfThenElse(is_bark, 0.5f, point.inside);
    const V open = (one - low) * NegMulAdd(deep, 0.7f, one);

    const V facing = Dot(point.normal, Constant(s.light.sun_direction));
    const V lit = Max(MulAdd(facing, 0.75f, 0.25f), zero);
    const V from_behind = Max(-Dot(packet.to_eye, Constant(s.light.sun_direction)), zero);
    const V sun =
        MulAdd(through, from_behind, lit) * (SunVisible(s, tile, packet, Constant(-1.0f)) * open);
    const V sky_seen = MulAdd(point.normal.z, half, half) * open;
    // Below there is ground of about the trees' own brightness.
    const V around = MulAdd(sky_seen, 0.9f, 0.1f);
    const V3 arriving =
        MulAdd(Constant(s.light.sun_irradiance), sun * 0.318309886f,
               Constant(s.light.ambient) * (around * AmbientUnderClouds(s, packet.p)));
    return {arriving * (its.albedo * point.bright), point.normal};
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
