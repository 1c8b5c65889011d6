// Arithmetic on SIMD vectors as mathematics writes it: a * b + 2.0f. Every kernel starts here.
//
// A lane is one number of a vector; V holds as many floats as the target takes at once. A scalar
// beside a vector stands for a vector of it. Operators are Highway's, an instruction each:
// a * b + c rounds twice, as on every target (-ffp-contract=off), MulAdd(a, b, c) once.
// Per-target code: for *_simd.cpp files and what they include.
#if defined(SWELL_MATH_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_MATH_LANES_INL_H_
#undef SWELL_MATH_LANES_INL_H_
#else
#define SWELL_MATH_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <glm/glm.hpp>
#include <type_traits>

HWY_BEFORE_NAMESPACE();
namespace swell {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<float>;
using DI = hn::RebindToSigned<D>;
using DU = hn::RebindToUnsigned<D>;
using V = hn::Vec<D>;
using VI = hn::Vec<DI>;
using VU = hn::Vec<DU>;
using M = hn::Mask<D>;
constexpr std::size_t kLanes = hn::MaxLanes(D());

// A vector of any type and number of lanes.
template <class T>
concept Vector = requires {
  typename hn::TFromV<T>;
};
template <Vector T>
using LaneOf = hn::TFromV<T>;

// The scalar in every lane.
template <Vector T>
HWY_INLINE T Spread(LaneOf<T> value) {
  return hn::Set(hn::DFromV<T>(), value);
}
HWY_INLINE V Constant(float value) { return hn::Set(D(), value); }

// A vector with a scalar, either way round.
#define SWELL_OPERATOR(op)                                              \
  template <Vector T>                                                   \
  HWY_INLINE auto operator op(T a, std::type_identity_t<LaneOf<T>> b) { \
    return a op Spread<T>(b);                                           \
  }                                                                     \
  template <Vector T>                                                   \
  HWY_INLINE auto operator op(std::type_identity_t<LaneOf<T>> a, T b) { \
    return Spread<T>(a) op b;                                           \
  }
SWELL_OPERATOR(+)
SWELL_OPERATOR(-)
SWELL_OPERATOR(*)
SWELL_OPERATOR(/)
SWELL_OPERATOR(&)
SWELL_OPERATOR(|)
SWELL_OPERATOR(<)
SWELL_OPERATOR(>)
SWELL_OPERATOR(<=)
SWELL_OPERATOR(>=)
#undef SWELL_OPERATOR

template <Vector T>
HWY_INLINE T operator-(T a) {
  return hn::Neg(a);
}

// Yes or no a lane.
template <class T>
concept LaneMask = !Vector<T> && requires(T mask) {
  hn::And(mask, hn::Not(mask));
};
template <LaneMask T>
HWY_INLINE T operator&(T a, T b) {
  return hn::And(a, b);
}
template <LaneMask T>
HWY_INLINE T operator|(T a, T b) {
  return hn::Or(a, b);
}
template <LaneMask T>
HWY_INLINE T operator!(T a) {
  return hn::Not(a);
}

// Vectors and scalars of their lanes' type, at least one of each.
template <class... T>
struct FirstVector {};
template <class First, class... T>
struct FirstVector<First, T...> : FirstVector<T...> {};
template <Vector First, class... T>
struct FirstVector<First, T...> {
  using Type = First;
};
template <class... T>
using Mixed = typename FirstVector<T...>::Type;
template <class... T>
concept MixedVector = (Vector<T> || ...) && (std::is_arithmetic_v<T> || ...);

template <Vector T>
HWY_INLINE T SpreadIfScalar(T value) {
  return value;
}
template <Vector T>
HWY_INLINE T SpreadIfScalar(LaneOf<T> value) {
  return Spread<T>(value);
}

// Highway's functions with scalars among their arguments.
template <class A, class B, class C>
requires MixedVector<A, B, C> HWY_INLINE auto MulAdd(A a, B b, C c) {
  using T = Mixed<A, B, C>;
  return hn::MulAdd(SpreadIfScalar<T>(a), SpreadIfScalar<T>(b), SpreadIfScalar<T>(c));
}
template <class A, class B, class C>
requires MixedVector<A, B, C> HWY_INLINE auto NegMulAdd(A a, B b, C c) {
  using T = Mixed<A, B, C>;
  return hn::NegMulAdd(SpreadIfScalar<T>(a), SpreadIfScalar<T>(b), SpreadIfScalar<T>(c));
}
template <class A, class B, class C>
requires MixedVector<A, B, C> HWY_INLINE auto MulSub(A a, B b, C c) {
  using T = Mixed<A, B, C>;
  return hn::MulSub(SpreadIfScalar<T>(a), SpreadIfScalar<T>(b), SpreadIfScalar<T>(c));
}
template <class A, class B>
requires MixedVector<A, B> HWY_INLINE auto Min(A a, B b) {
  using T = Mixed<A, B>;
  return hn::Min(SpreadIfScalar<T>(a), SpreadIfScalar<T>(b));
}
template <class A, class B>
requires MixedVector<A, B> HWY_INLINE auto Max(A a, B b) {
  using T = Mixed<A, B>;
  return hn::Max(SpreadIfScalar<T>(a), SpreadIfScalar<T>(b));
}
template <class Mask, class A, class B>
requires MixedVector<A, B> HWY_INLINE auto IfThenElse(Mask mask, A yes, B no) {
  using T = Mixed<A, B>;
  return hn::IfThenElse(mask, SpreadIfScalar<T>(yes), SpreadIfScalar<T>(no));
}

// The entries of a table of eight at those places; there is room for a vector of them.
template <class D, class VI = hn::Vec<hn::RebindToSigned<D>>>
HWY_INLINE hn::Vec<D> EntriesOfEight(D d, const hn::TFromD<D>* table, VI at) {
  if constexpr (hn::MaxLanes(D()) >= 8)
    return hn::TableLookupLanes(hn::LoadU(d, table), hn::IndicesFromVec(d, at));
  else
    return hn::GatherIndex(d, table, at);
}

// first, first + 1, ... by lane. Highway's Iota of a variable goes through memory, a store a lane.
HWY_INLINE VI CountFrom(int first) { return hn::Iota(DI(), 0) + first; }

HWY_INLINE V Clamp(V v, float low, float high) { return Min(Max(v, low), high); }
// a + t (b - a)
HWY_INLINE V Lerp(V a, V b, V t) { return MulAdd(b - a, t, a); }
// 3 t^2 - 2 t^3 of t clamped to [0, 1].
HWY_INLINE V SmoothBlend(V t) {
  const V x = Clamp(t, 0.0f, 1.0f);
  return x * x * NegMulAdd(x, 2.0f, 3.0f);
}
HWY_INLINE V InverseSqrt(V x) { return 1.0f / Sqrt(x); }

// A vector in space, or a colour, a lane.
struct V3 {
  V x, y, z;
};

HWY_INLINE V3 Constant(glm::vec3 v) { return {Constant(v.x), Constant(v.y), Constant(v.z)}; }

HWY_INLINE V3 operator+(V3 a, V3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
HWY_INLINE V3 operator-(V3 a, V3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
HWY_INLINE V3 operator*(V3 a, V3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
HWY_INLINE V3 operator*(V3 a, V s) { return {a.x * s, a.y * s, a.z * s}; }
HWY_INLINE V3 operator*(V3 a, float s) { return a * Constant(s); }
HWY_INLINE V3 operator-(V3 a) { return {-a.x, -a.y, -a.z}; }
// a s + b
HWY_INLINE V3 MulAdd(V3 a, V s, V3 b) {
  return {MulAdd(a.x, s, b.x), MulAdd(a.y, s, b.y), MulAdd(a.z, s, b.z)};
}
HWY_INLINE V Dot(V3 a, V3 b) { return MulAdd(a.x, b.x, MulAdd(a.y, b.y, a.z * b.z)); }
template <class Mask>
HWY_INLINE V3 IfThenElse(Mask mask, V3 yes, V3 no) {
  return {IfThenElse(mask, yes.x, no.x), IfThenElse(mask, yes.y, no.y),
          IfThenElse(mask, yes.z, no.z)};
}
HWY_INLINE V3 Lerp(V3 a, V3 b, V t) {
  return {Lerp(a.x, b.x, t), Lerp(a.y, b.y, t), Lerp(a.z, b.z, t)};
}

}  // namespace HWY_NAMESPACE
}  // namespace swell
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
