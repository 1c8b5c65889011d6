// The value types of the shaders: a packet is one SIMD vector of pixels. Per-target code; the
// targets are fixed-size (x86), so vectors may be members of these short-lived structs.
#if defined(SWELL_RENDER_TILE_PACKET_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_TILE_PACKET_INL_H_
#undef SWELL_RENDER_TILE_PACKET_INL_H_
#else
#define SWELL_RENDER_TILE_PACKET_INL_H_
#endif

#include <hwy/highway.h>

#include <array>

#include "math/elementary-inl.h"
#include "render/tile/shade_tile.h"
#include "texture/packed_map-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace swell::HWY_NAMESPACE;  // elementary functions

using D = hn::ScalableTag<float>;
using DI = hn::RebindToSigned<D>;
using V = hn::Vec<D>;
using VI = hn::Vec<DI>;
constexpr std::size_t kLanes = hn::MaxLanes(D());

struct V3 {
  V x, y, z;
};

HWY_INLINE V Constant(float value) { return hn::Set(D(), value); }
HWY_INLINE V3 Constant(glm::vec3 v) { return {Constant(v.x), Constant(v.y), Constant(v.z)}; }

// first, first + 1, ... by lane. Highway's Iota of a variable goes through memory, a store a lane.
HWY_INLINE VI CountFrom(int first) { return hn::Add(hn::Iota(DI(), 0), hn::Set(DI(), first)); }

HWY_INLINE V Dot(V3 a, V3 b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
HWY_INLINE V3 Scale(V3 a, V s) { return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)}; }
HWY_INLINE V3 Product(V3 a, V3 b) {
  return {hn::Mul(a.x, b.x), hn::Mul(a.y, b.y), hn::Mul(a.z, b.z)};
}
HWY_INLINE V3 Sum(V3 a, V3 b) { return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)}; }
HWY_INLINE V3 Difference(V3 a, V3 b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
// a s + b
HWY_INLINE V3 ScaleAdd(V3 a, V s, V3 b) {
  return {hn::MulAdd(a.x, s, b.x), hn::MulAdd(a.y, s, b.y), hn::MulAdd(a.z, s, b.z)};
}
// a + t (b - a)
HWY_INLINE V Lerp(V a, V b, V t) { return hn::MulAdd(hn::Sub(b, a), t, a); }
HWY_INLINE V3 Lerp(V3 a, V3 b, V t) {
  return {Lerp(a.x, b.x, t), Lerp(a.y, b.y, t), Lerp(a.z, b.z, t)};
}
HWY_INLINE V Clamp(V v, float low, float high) {
  return hn::Min(hn::Max(v, Constant(low)), Constant(high));
}
// 3 t^2 - 2 t^3 of t clamped to [0, 1].
HWY_INLINE V SmoothBlend(V t) {
  const V x = Clamp(t, 0.0f, 1.0f);
  return hn::Mul(hn::Mul(x, x), hn::NegMulAdd(x, Constant(2.0f), Constant(3.0f)));
}
HWY_INLINE V InverseSqrt(V x) { return hn::Div(Constant(1.0f), hn::Sqrt(x)); }

// One packet of pixels and the points they show.
struct Packet {
  V x_px, y_px;  // whole pixel numbers
  V depth;       // along the view axis [m]
  // Position relative to the eye [m], in the flat world: on a round earth raised by what the place
  // has sunk. Of the mirrored or squeezed world if any.
  V3 p;
  V distance;  // [m]
  V3 to_eye;   // unit, as the level at that place has it
};

// The ray through the centres of pixels (x_px, y_px), of depth 1.
HWY_INLINE V3 RayAt(const ViewRays& rays, V x_px, V y_px) {
  return ScaleAdd(Constant(rays.ray_dx), x_px,
                  ScaleAdd(Constant(rays.ray_dy), y_px, Constant(rays.ray)));
}

// Pixels at (x_px, y_px) whose depth buffer holds z > 0.
HWY_INLINE Packet MakePacket(const ViewRays& rays, V x_px, V y_px, V z) {
  Packet packet;
  packet.x_px = x_px;
  packet.y_px = y_px;
  packet.depth = hn::Div(Constant(rays.near_m), z);
  const V3 ray = RayAt(rays, x_px, y_px);
  packet.p = Scale(ray, packet.depth);
  const V length2 = Dot(ray, ray);
  const V inverse_length = InverseSqrt(length2);
  packet.distance = hn::Mul(packet.depth, hn::Mul(length2, inverse_length));
  packet.to_eye = Scale(ray, hn::Neg(inverse_length));
  // The level there has sunk by c r^2 and leans by 2 c r, with r / distance the ray's horizontal
  // part: level rays meet it at the horizon. (What to_eye's x and y change by is left out: 0.5 % at
  // the horizon of an eye 40 km up.)
  const V horizontal2 = hn::MulAdd(ray.x, ray.x, hn::Mul(ray.y, ray.y));
  const V sunk = hn::Mul(hn::Mul(horizontal2, packet.depth), Constant(rays.drop_per_m2));
  packet.p.z = hn::MulAdd(sunk, packet.depth, packet.p.z);
  packet.to_eye.z = hn::NegMulAdd(hn::Add(sunk, sunk), inverse_length, packet.to_eye.z);
  return packet;
}

// As many packets as a shader may look up side by side. While one waits for what it looks up, the
// others go on: a processor sees that in loops over packets whose bodies are short.
constexpr std::size_t kMostPacketsAtOnce = 8;
template <class T>
using PerPacket = std::array<T, kMostPacketsAtOnce>;

// A value in [0, 1) that differs from pixel to pixel without visible pattern, the same in every
// frame. Source: Jimenez, Next Generation Post Processing in Call of Duty, 2014 (interleaved
// gradient noise).
HWY_INLINE V PixelNoise(V x_px, V y_px) {
  const V a = hn::MulAdd(x_px, Constant(0.06711056f), hn::Mul(y_px, Constant(0.00583715f)));
  const V b = hn::Mul(hn::Sub(a, hn::Floor(a)), Constant(52.9829189f));
  return hn::Sub(b, hn::Floor(b));
}

// log2 of the size [m] of a pixel's footprint across the view.
HWY_INLINE V FootprintAcross(const ViewRays& rays, const Packet& packet) {
  return Log2Coarse(D(), hn::Mul(packet.depth, Constant(rays.pixel_angle)));
}

// log2 of the footprint on a surface that the eye meets at cos_view: lengthened by four fifths
// (in log) of the stretch along the view. Less would leave grazing views aliased, more would blur
// them across the view.
HWY_INLINE V FootprintLevel(V across_log2, V cos_view) {
  return hn::NegMulAdd(Log2Coarse(D(), cos_view), Constant(0.8f), across_log2);
}

// log2 of what a pixel shows of level ground, in metres.
HWY_INLINE V GroundLevel(const ViewRays& rays, const Packet& packet) {
  return FootprintLevel(FootprintAcross(rays, packet), Clamp(hn::Abs(packet.to_eye.z), 0.3f, 1.0f));
}

// The place of p [m] in a layer's map, in 1/256 texels of level 0.
struct LayerPlace {
  V x_fx8, y_fx8;
};

template <class Layer>
HWY_INLINE LayerPlace PlaceIn(const Layer& layer, V x_m, V y_m) {
  const V per_m = Constant(layer.texels_fx8_per_m);
  return {hn::MulAdd(x_m, per_m, Constant(layer.x_eye_fx8)),
          hn::MulAdd(y_m, per_m, Constant(layer.y_eye_fx8))};
}

// Whether a layer has detail at any lane's level.
HWY_INLINE bool ShowsDetail(const SlopeLayer& layer, V level_m) {
  const float coarsest_m = layer.coarsest - layer.log2_texels_per_m;
  return !hn::AllFalse(D(), hn::Lt(level_m, Constant(coarsest_m)));
}

// Between which mip levels of a layer a packet lies.
struct MapLevel {
  VI base;
  V t;            // from level `base` to the next
  bool all_lost;  // in every lane: nothing is left of the layer
};

// Adds what a layer has lost at a footprint's level to `variance`.
HWY_INLINE MapLevel LevelIn(const SlopeLayer& layer, V level_m, V& variance) {
  const D d;
  const V level = Clamp(hn::Add(level_m, Constant(layer.log2_texels_per_m)), 0.0f, layer.coarsest);
  const VI base = TruncateToInt(level);
  const V t = hn::Sub(level, hn::ConvertTo(d, base));
  const auto lane = hn::IndicesFromVec(d, base);
  const V lost = hn::TableLookupLanes(hn::LoadU(d, layer.lost_variance.data()), lane);
  const V lost_by_next = hn::TableLookupLanes(hn::LoadU(d, layer.lost_by_next.data()), lane);
  variance = hn::MulAdd(lost_by_next, t, hn::Add(variance, lost));
  return {base, t, hn::AllTrue(d, hn::Ge(level, Constant(layer.coarsest)))};
}

// The place of p in a layer's map; (du, dv) perturb it, in units of uv_noise_m.
HWY_INLINE LayerPlace PlaceBent(const SlopeLayer& layer, V3 p, V du, V dv) {
  const V noise = Constant(layer.uv_noise_m);
  return PlaceIn(layer, hn::MulAdd(du, noise, p.x), hn::MulAdd(dv, noise, p.y));
}

// Adds a layer's slopes at p to (slope_x, slope_y), blended between mip levels, and the variance
// that they have lost to `variance`. (du, dv) perturb the coordinates, in units of uv_noise_m.
HWY_INLINE void AddSlopes(const SlopeLayer& layer, V3 p, V level_m, V du, V dv, V& slope_x,
                          V& slope_y, V& variance) {
  const MapLevel level = LevelIn(layer, level_m, variance);
  if (level.all_lost) return;
  const LayerPlace place = PlaceBent(layer, p, du, dv);
  texture::HWY_NAMESPACE::AddBlended(D(), *layer.map, RoundToInt(place.x_fx8),
                                     RoundToInt(place.y_fx8), level.base, level.t, layer.gain,
                                     slope_x, slope_y);
}

// What a layer's map holds at a place on the nearest mip level with detail: one sample, and nothing
// multiplied by the layer's gain.
HWY_INLINE void SampleNearest(const SlopeLayer& layer, const LayerPlace& place, V level_m, V& a,
                              V& b) {
  const V level =
      Clamp(hn::Add(level_m, Constant(layer.log2_texels_per_m + 0.5f)), 0.0f, layer.coarsest);
  texture::HWY_NAMESPACE::SampleLevel(D(), *layer.map, RoundToInt(place.x_fx8),
                                      RoundToInt(place.y_fx8), TruncateToInt(level), a, b);
}

// A layer's values at p on the nearest mip level with detail.
HWY_INLINE void NearestSlopes(const SlopeLayer& layer, V3 p, V level_m, V& a, V& b) {
  SampleNearest(layer, PlaceIn(layer, p.x, p.y), level_m, a, b);
  const V gain = Constant(layer.gain);
  a = hn::Mul(a, gain);
  b = hn::Mul(b, gain);
}

// The blurred sky's radiance in direction (x, y, z), z > -0.5, any length of (x, y, z) equal to
// `length`.
HWY_INLINE V3 SoftSkyRadiance(const texture::RgbMap& map, V3 direction, V length) {
  const D d;
  const float half_fx8 = 128.0f * static_cast<float>(map.size);
  const V scale = hn::Div(Constant(half_fx8), hn::Add(length, direction.z));
  const V middle = Constant(half_fx8 - 128.0f);
  V r, g, b;
  texture::HWY_NAMESPACE::SampleRgb(d, map, hn::MulAdd(direction.x, scale, middle),
                                    hn::MulAdd(direction.y, scale, middle), r, g, b);
  const V range = Constant(kSoftSkyRange);
  return {hn::Mul(hn::Mul(r, r), range), hn::Mul(hn::Mul(g, g), range),
          hn::Mul(hn::Mul(b, b), range)};
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
