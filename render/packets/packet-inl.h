// The value types of the shaders: a packet is one SIMD vector of pixels. Per-target code; the
// targets are fixed-size (x86), so vectors may be members of these short-lived structs.
#if defined(SWELL_RENDER_PACKETS_PACKET_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_PACKETS_PACKET_INL_H_
#undef SWELL_RENDER_PACKETS_PACKET_INL_H_
#else
#define SWELL_RENDER_PACKETS_PACKET_INL_H_
#endif

#include <hwy/highway.h>

#include <array>

#include "math/elementary-inl.h"
#include "math/lanes-inl.h"
#include "render/packets/slope_layer.h"
#include "render/packets/view_rays.h"
#include "texture/packed_map-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {
using namespace swell::HWY_NAMESPACE;  // elementary functions

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
  return MulAdd(Constant(rays.ray_dx), x_px,
                MulAdd(Constant(rays.ray_dy), y_px, Constant(rays.ray)));
}

// Pixels at (x_px, y_px) whose depth buffer holds z > 0.
HWY_INLINE Packet MakePacket(const ViewRays& rays, V x_px, V y_px, V z) {
  Packet packet;
  packet.x_px = x_px;
  packet.y_px = y_px;
  packet.depth = rays.near_m / z;
  const V3 ray = RayAt(rays, x_px, y_px);
  packet.p = ray * packet.depth;
  const V length2 = Dot(ray, ray);
  const V inverse_length = InverseSqrt(length2);
  packet.distance = packet.depth * (length2 * inverse_length);
  packet.to_eye = ray * -inverse_length;
  // The level there has sunk by c r^2 and leans by 2 c r, with r / distance the ray's horizontal
  // part: level rays meet it at the horizon. (What to_eye's x and y change by is left out: 0.5 % at
  // the horizon of an eye 40 km up.)
  const V horizontal2 = MulAdd(ray.x, ray.x, ray.y * ray.y);
  const V sunk = horizontal2 * packet.depth * rays.drop_per_m2;
  packet.p.z = MulAdd(sunk, packet.depth, packet.p.z);
  packet.to_eye.z = NegMulAdd(sunk + sunk, inverse_length, packet.to_eye.z);
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
  const V a = MulAdd(x_px, 0.06711056f, y_px * 0.00583715f);
  const V b = (a - Floor(a)) * 52.9829189f;
  return b - Floor(b);
}

// log2 of the size [m] of a pixel's footprint across the view.
HWY_INLINE V FootprintAcross(const ViewRays& rays, const Packet& packet) {
  return Log2Coarse(D(), packet.depth * rays.pixel_angle);
}

// log2 of the footprint on a surface that the eye meets at cos_view: lengthened by four fifths
// (in log) of the stretch along the view. Less would leave grazing views aliased, more would blur
// them across the view.
HWY_INLINE V FootprintLevel(V across_log2, V cos_view) {
  return NegMulAdd(Log2Coarse(D(), cos_view), 0.8f, across_log2);
}

// log2 of what a pixel shows of level ground, in metres.
HWY_INLINE V GroundLevel(const ViewRays& rays, const Packet& packet) {
  return FootprintLevel(FootprintAcross(rays, packet), Clamp(Abs(packet.to_eye.z), 0.3f, 1.0f));
}

// The place of p [m] in a layer's map, in 1/256 texels of level 0.
struct LayerPlace {
  V x_fx8, y_fx8;
};

// Of a layer that may have other lengths along x and y.
template <class Layer>
concept HasTwoLengths = requires(const Layer& layer) {
  layer.y_texels_fx8_per_m;
};

template <class Layer>
HWY_INLINE LayerPlace PlaceIn(const Layer& layer, V x_m, V y_m) {
  const V per_m = Constant(layer.texels_fx8_per_m);
  V y_per_m = per_m;
  if constexpr (HasTwoLengths<Layer>) y_per_m = Constant(layer.y_texels_fx8_per_m);
  return {MulAdd(x_m, per_m, layer.x_eye_fx8), MulAdd(y_m, y_per_m, layer.y_eye_fx8)};
}

// Whether a layer has detail at any lane's level.
HWY_INLINE bool ShowsDetail(const SlopeLayer& layer, V level_m) {
  const float coarsest_m = layer.coarsest - layer.log2_texels_per_m;
  return !hn::AllFalse(D(), level_m < coarsest_m);
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
  const V level = Clamp(level_m + layer.log2_texels_per_m, 0.0f, layer.coarsest);
  const VI base = TruncateToInt(level);
  const V t = level - hn::ConvertTo(d, base);
  const V lost = EntriesOfEight(d, layer.lost_variance.data(), base);
  const V lost_by_next = EntriesOfEight(d, layer.lost_by_next.data(), base);
  variance = MulAdd(lost_by_next, t, variance + lost);
  return {base, t, hn::AllTrue(d, level >= layer.coarsest)};
}

// What perturbs texture coordinates, in units of SlopeLayer::uv_noise_m.
struct UvNoise {
  V u, v;
};

// The place of p in a layer's map, perturbed.
HWY_INLINE LayerPlace PlaceBent(const SlopeLayer& layer, V3 p, UvNoise by) {
  const V noise = Constant(layer.uv_noise_m);
  return PlaceIn(layer, MulAdd(by.u, noise, p.x), MulAdd(by.v, noise, p.y));
}

// Adds a layer's slopes at p to (slope_x, slope_y), blended between mip levels, and the variance
// that they have lost to `variance`.
HWY_INLINE void AddSlopes(const SlopeLayer& layer, V3 p, V level_m, UvNoise noise, V& slope_x,
                          V& slope_y, V& variance) {
  const MapLevel level = LevelIn(layer, level_m, variance);
  if (level.all_lost) return;
  const LayerPlace place = PlaceBent(layer, p, noise);
  texture::HWY_NAMESPACE::AddBlended(
      D(), *layer.map, {RoundToInt(place.x_fx8), RoundToInt(place.y_fx8), level.base, level.t},
      layer.gain, slope_x, slope_y);
}

// What a layer's map holds at a place on the nearest mip level with detail: one sample, and nothing
// multiplied by the layer's gain.
HWY_INLINE void SampleNearest(const SlopeLayer& layer, const LayerPlace& place, V level_m, V& a,
                              V& b) {
  const V level = Clamp(level_m + (layer.log2_texels_per_m + 0.5f), 0.0f, layer.coarsest);
  texture::HWY_NAMESPACE::SampleLevel(D(), *layer.map, RoundToInt(place.x_fx8),
                                      RoundToInt(place.y_fx8), TruncateToInt(level), a, b);
}

// A layer's values at p on the nearest mip level with detail.
HWY_INLINE void NearestSlopes(const SlopeLayer& layer, V3 p, V level_m, V& a, V& b) {
  SampleNearest(layer, PlaceIn(layer, p.x, p.y), level_m, a, b);
  const V gain = Constant(layer.gain);
  a = a * gain;
  b = b * gain;
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
