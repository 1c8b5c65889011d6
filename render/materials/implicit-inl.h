// Implicit surfaces: the slope of what functions make, for the shader of objects.
#if defined(SWELL_RENDER_MATERIALS_IMPLICIT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_MATERIALS_IMPLICIT_INL_H_
#undef SWELL_RENDER_MATERIALS_IMPLICIT_INL_H_
#else
#define SWELL_RENDER_MATERIALS_IMPLICIT_INL_H_
#endif

#include "render/packets/packet-inl.h"
#include "render/view/implicit_tables-inl.h"
#include "render/view/object_instance.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

struct ValueAndGradient {
  V value;
  V3 gradient;  // half of it
};

HWY_INLINE ValueAndGradient At(const RayQuadric& f, V3 p) {
  const V xy = Constant(f.xy), xz = Constant(f.xz), yz = Constant(f.yz);
  const V3 b = Constant(f.b);
  const V3 half = {MulAdd(f.xx, p.x, MulAdd(xy, p.y, MulAdd(xz, p.z, b.x))),
                   MulAdd(xy, p.x, MulAdd(f.yy, p.y, MulAdd(yz, p.z, b.y))),
                   MulAdd(xz, p.x, MulAdd(yz, p.y, MulAdd(f.zz, p.z, b.z)))};
  return {Dot(p, half + b) + f.c, half};
}

// A term with its perturbations: grad F' = grad F + sum of 3 factor Q^2 grad Q.
HWY_INLINE ValueAndGradient At(const PosedImplicit& implicit, const RayTerm& term, V3 p) {
  ValueAndGradient result = At(term.quadric, p);
  for (std::uint32_t i = 0; i < term.perturbations; ++i) {
    const RayPerturbation& r = implicit.perturbations[term.first_perturbation + i];
    const ValueAndGradient more = At(r.quadric, p);
    const V q = Max(more.value, 0.0f), q2 = q * q;
    const V factor = Constant(r.factor);
    result.value = MulAdd(factor, q2 * q, result.value);
    result.gradient = MulAdd(more.gradient, factor * 3.0f * q2, result.gradient);
  }
  return result;
}

// The direction against the gradient of the function whose zero is nearest.
struct NearestZero {
  V3 out;
  V away2;

  HWY_INLINE void Take(const ValueAndGradient& at) {
    const V length2 = Max(Dot(at.gradient, at.gradient), 1e-30f);
    const V away2_here = at.value * at.value / length2;
    const auto nearer = away2_here < away2;
    const V inverse = -InverseSqrt(length2);
    away2 = IfThenElse(nearer, away2_here, away2);
    out.x = IfThenElse(nearer, at.gradient.x * inverse, out.x);
    out.y = IfThenElse(nearer, at.gradient.y * inverse, out.y);
    out.z = IfThenElse(nearer, at.gradient.z * inverse, out.z);
  }
};

// A table's functions h - z and h - threshold.
HWY_INLINE void TakeTable(const RayTable& table, V3 p, NearestZero& zero) {
  const V3 at = InTable(table, p);
  const HeightAndSlope h =
      WithHeights(table, [&](const auto& of) HWY_ATTR { return HeightsAt(of, at.x, at.y); });
  const glm::mat3 transposed = glm::transpose(table.linear);
  const V3 level = Turned(transposed, {h.along_u, h.along_v, hn::Zero(D())}) * 0.5f;
  zero.Take({h.height - at.z, level - Constant(0.5f * transposed[2])});
  // Level heights have no border.
  constexpr float kLevel = 1e-12f;
  const V over = IfThenElse(Dot(level, level) > kLevel, h.height - table.threshold_m, 1e15f);
  zero.Take({over, level});
}

// Out of the part at p, from its middle.
HWY_INLINE V3 OutOf(const PosedImplicit& implicit, const RayPart& part, V3 p) {
  NearestZero zero = {Constant(glm::vec3(0.0f)), Constant(1e30f)};
  for (std::uint32_t i = 0; i < part.terms; ++i)
    zero.Take(At(implicit, implicit.terms[part.first_term + i], p));
  if (part.table != RayPart::kNoTable)
    TakeTable(implicit.tables[static_cast<std::size_t>(part.table)], p, zero);
  return zero.out;
}

// Sets `normal`, in the axes of the lanes' meshes, at their points q where they show implicit
// surfaces. Returns those lanes.
HWY_INLINE hn::Mask<D> TakeImplicitNormals(const ObjectPrimitive* const* primitive, V3 q,
                                           V3& normal) {
  const D d;
  auto taken = hn::FirstN(d, 0);
  // Most packets show one part.
  const auto* last = static_cast<const shapes::ObjectTriangle*>(nullptr);
  for (std::size_t first = 0; first < kLanes; ++first) {
    const ObjectInstance& object = *primitive[first]->object;
    if (!object.implicit || primitive[first]->triangle == last) continue;
    last = primitive[first]->triangle;
    HWY_ALIGN float same[kLanes];
    for (std::size_t i = 0; i < kLanes; ++i)
      same[i] = primitive[i]->object == &object && primitive[i]->triangle == last ? 1.0f : 0.0f;
    const auto lanes = hn::Load(d, same) > 0.0f;
    const auto number = last - object.mesh->triangles.data();
    const RayPart& part = object.implicit->parts[static_cast<std::size_t>(number)];
    const V3 size = Constant(object.implicit_size);
    const V3 p = q * size + Constant(object.implicit_base - part.middle);
    const V3 out = OutOf(*object.implicit, part, p) * size;
    normal.x = IfThenElse(lanes, out.x, normal.x);
    normal.y = IfThenElse(lanes, out.y, normal.y);
    normal.z = IfThenElse(lanes, out.z, normal.z);
    taken = taken | lanes;
  }
  return taken;
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
