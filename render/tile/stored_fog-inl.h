// A pixel's fog from what is stored of it (stored_fog.h).
#if defined(SWELL_RENDER_TILE_STORED_FOG_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_TILE_STORED_FOG_INL_H_
#undef SWELL_RENDER_TILE_STORED_FOG_INL_H_
#else
#define SWELL_RENDER_TILE_STORED_FOG_INL_H_
#endif

#include <algorithm>
#include <array>

#include "render/packets/lanes3-inl.h"
#include "render/sky/fog-inl.h"
#include "render/tile/stored_fog.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

HWY_INLINE V3 Cross(V3 a, V3 b) {
  return {MulSub(a.y, b.z, a.z * b.y), MulSub(a.z, b.x, a.x * b.z), MulSub(a.x, b.y, a.y * b.x)};
}

// How much each corner of a triangle counts where a ray from the eye meets it: at least 0, and 1 in
// all. On edges a pixel may lie just beside its triangle.
struct CornerWeights {
  V first, second, third;
  hn::Mask<D> has_area;  // elsewhere there is no such place
};

// corner: relative to the eye. Perspective needs no thought: the weights are those of the place.
//
// Source: T. Möller, B. Trumbore, Fast, minimum storage ray-triangle intersection, 1997.
HWY_INLINE CornerWeights WeighCorners(V3 ray, const std::array<V3, 3>& corner) {
  const V zero = hn::Zero(D()), one = Constant(1.0f);
  const V3 along = corner[1] - corner[0], across = corner[2] - corner[0], to_eye = -corner[0];
  const V3 normal = Cross(ray, across);
  const V area = Dot(along, normal);
  CornerWeights weights;
  weights.has_area = area != zero;
  const V inverse = one / IfThenElse(weights.has_area, area, one);
  const V second = Dot(to_eye, normal) * inverse;
  const V third = Dot(ray, Cross(to_eye, along)) * inverse;
  weights.second = Clamp(second, 0.0f, 1.0f);
  weights.third = Min(Max(third, zero), one - weights.second);
  weights.first = one - weights.second - weights.third;
  return weights;
}

// The fog before a packet's places on their triangles, interpolated between the corners; where
// there is no triangle that of own(), the pixels' own. ray: from the eye through the pixels.
template <class Own>
HWY_INLINE FogView InterpolateFog(const StoredFog& stored, const std::uint32_t* primitive, V3 ray,
                                  const Own& own) {
  std::array<FogAtCorners, kLanes> triangle;
  bool is_one = true;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const bool is_next = i > 0 && primitive[i] == primitive[i - 1];
    triangle[i] = is_next ? triangle[i - 1] : find_corners(stored, primitive[i]);
    is_one = is_one && (i == 0 || is_next);
  }
  const auto load = [&](std::size_t corner, glm::vec3 FogAtPlace::*value) HWY_ATTR {
    if (is_one) return Constant(triangle[0][corner]->*value);
    Lanes3 lanes;
    for (std::size_t i = 0; i < kLanes; ++i) lanes.Set(i, triangle[i][corner]->*value);
    return lanes.Load();
  };
  const auto load_all = [&](glm::vec3 FogAtPlace::*value) HWY_ATTR {
    return std::array<V3, 3>{load(0, value), load(1, value), load(2, value)};
  };
  const CornerWeights weights = WeighCorners(ray, load_all(&FogAtPlace::p_seen));
  const auto mix = [&](glm::vec3 FogAtPlace::*value) HWY_ATTR {
    const std::array<V3, 3> at = load_all(value);
    return MulAdd(at[0], weights.first, MulAdd(at[1], weights.second, at[2] * weights.third));
  };
  const FogView between = {mix(&FogAtPlace::passes), mix(&FogAtPlace::added)};
  if (hn::AllTrue(D(), weights.has_area)) return between;
  const FogView its_own = own();
  return {IfThenElse(weights.has_area, between.passes, its_own.passes),
          IfThenElse(weights.has_area, between.added, its_own.added)};
}

// The fog before places of depth z > 0 in the depth buffer.
HWY_INLINE FogView LookUpFog(const StoredFog& stored, V z) {
  const DI di;
  const VI first_bits = hn::ShiftRight<FogTable::kDroppedBits>(hn::BitCast(di, z));
  const VI row = hn::Set(di, FogTable::kFirst) - first_bits;
  HWY_ALIGN std::array<std::int32_t, kLanes> rows;
  hn::Store(Min(Max(row, 0), FogTable::kRows - 1), di, rows.data());
  Lanes3 passes, added;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const FogAtPlace& at = stored.table[static_cast<std::size_t>(rows[i])];
    passes.Set(i, at.passes);
    added.Set(i, at.added);
  }
  return {passes.Load(), added.Load()};
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
