// The water's surface at a packet: slopes and foam of all waves.
#if defined(SWELL_RENDER_WATER_WATER_SLOPES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_WATER_WATER_SLOPES_INL_H_
#undef SWELL_RENDER_WATER_WATER_SLOPES_INL_H_
#else
#define SWELL_RENDER_WATER_WATER_SLOPES_INL_H_
#endif

#include <algorithm>
#include <array>
#include <span>

#include "render/water/foam-inl.h"
#include "render/water/near_shore-inl.h"
#include "render/water/tiled_slopes-inl.h"
#include "render/water/wakes-inl.h"
#include "render/water/water.h"
#include "render/water/whitecaps-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// The water's surface at a packet: mean slopes that the maps show, and the variance (of both axes
// together) of the slopes too fine for a pixel.
struct WaterSlopes {
  V slope_x, slope_y, variance;
  V fine_variance;  // of all slopes but the drawn ones of the long waves: triangles do not show
                    // them
  V long_cosine;    // to the eye, of those
  FoamLayer foam;
  V wake;  // over 1 where one is seen
};

// Level water without foam or wakes.
HWY_INLINE WaterSlopes NoSlopes(V variance, V fine_variance, V long_cosine) {
  const V zero = hn::Zero(D());
  return {zero, zero, variance, fine_variance, long_cosine, NoFoam(), zero};
}

HWY_INLINE void AddSine(const SineLayer& sine, V3 p, V level_m, WaterSlopes& s) {
  const V cycles = MulAdd(p.x, sine.kx, MulAdd(p.y, sine.ky, sine.cycles));
  V sin_unused, cosine;
  SinCosTurns(D(), cycles, sin_unused, cosine);
  // A wave shorter than two footprints turns into roughness.
  const float level_lost = sine.wavelength_log2 - 1.0f;
  const V seen = Clamp(level_lost - level_m, 0.0f, 1.0f);
  const V amount = cosine * seen;
  s.slope_x = MulAdd(amount, sine.slope_x, s.slope_x);
  s.slope_y = MulAdd(amount, sine.slope_y, s.slope_y);
  const float variance = 0.5f * (sine.slope_x * sine.slope_x + sine.slope_y * sine.slope_y);
  s.variance = MulAdd(NegMulAdd(seen, seen, 1.0f), variance, s.variance);
}

// The unit normal of slopes.
HWY_INLINE V3 NormalOf(V slope_x, V slope_y) {
  const V inv_length = InverseSqrt(MulAdd(slope_x, slope_x, MulAdd(slope_y, slope_y, 1.0f)));
  return {-(slope_x * inv_length), -(slope_y * inv_length), inv_length};
}

// What a coast's maps say of a packet: what the sea's own waves cede to the trains that know its
// floor and what land takes of them, and the foam where waves break, both 0 outside the maps.
struct Surf {
  V ceded, foam;
  V torn_foam;      // that is torn as whitecaps are, beside `foam`
  V trains;         // the part of `ceded` that is the trains'
  FrontsAt fronts;  // of scenes whose fronts lift the water alone
  CoastWhitecaps whitecaps;
  hn::Mask<D> has_trains;  // in the trains' map
  hn::Mask<D> inside;      // in any
  bool is_near;            // any lane inside
  bool all_ceded;          // no lane has anything of the sea's long waves
};

// Whitecaps of the trains; from far, where eight bits lose them, their mean.
HWY_INLINE void SampleTrainWhitecaps(const Water& water, const LayerPlace& place, V level_m,
                                     Surf& surf) {
  const D d;
  const V one = Constant(1.0f), half = Constant(0.5f);
  const SlopeLayer& layer = water.trains.whitecaps;
  V foam, short_part;
  SampleNearest(layer, place, level_m, foam, short_part);
  foam = MulAdd(foam, half, half);
  short_part = Min(MulAdd(short_part, half, half), one);
  // As TrainSquare has them: part = ceded - (1 - short_part).
  const V part = Max(surf.ceded - (one - short_part), hn::Zero(d));
  foam = Lerp(foam, part * water.whitecaps.foam[0].mean, FoamLost(layer, level_m));
  surf.whitecaps.on_trains = IfThenElseZero(surf.inside, foam);
  surf.whitecaps.short_part = IfThenElse(surf.inside, short_part, one);
}

HWY_INLINE void SampleTrains(const Water& water, V3 p, V level_m, Surf& surf) {
  const SlopeLayer& layer = water.trains.surf;
  const LayerPlace place = PlaceIn(layer, p.x, p.y);
  surf.has_trains = surf.inside = IsInside(layer, place);
  if (hn::AllFalse(D(), surf.inside)) return;
  SampleNearest(layer, place, level_m - 0.5f, surf.ceded, surf.foam);
  // All but half a step is all.
  surf.ceded = IfThenElse(surf.ceded > 0.996f, 1.0f, surf.ceded);
  surf.ceded = IfThenElseZero(surf.inside, surf.ceded);
  surf.foam = IfThenElseZero(surf.inside, surf.foam);
  surf.trains = surf.ceded;
  if (water.trains.whitecaps.map && !hn::AllTrue(D(), surf.ceded == hn::Zero(D())))
    SampleTrainWhitecaps(water, place, level_m, surf);
}

// In place: copies of so much took a twentieth of a pixel's time.
HWY_INLINE void SampleSurf(const Water& water, V3 p, V level_m, Surf& surf) {
  const D d;
  const V zero = hn::Zero(d), one = Constant(1.0f);
  surf.ceded = surf.foam = surf.torn_foam = surf.trains = zero;
  surf.whitecaps = NoCoastWhitecaps();
  surf.has_trains = surf.inside = hn::MaskFromVec(zero);
  if (water.trains.on) SampleTrains(water, p, level_m, surf);
  if (water.near_shore.map.map) {
    // What trains leave: they are the waves, where there are some.
    const V left = one - surf.ceded;
    const NearShoreAt shore = SampleNearShore(water.near_shore, p, level_m, left);
    const float torn = water.near_shore.fronts.torn;
    surf.torn_foam = shore.foam * left * torn;
    surf.foam = MulAdd(shore.foam * (1.0f - torn), left, surf.foam);
    surf.ceded = MulAdd(shore.taken, left, surf.ceded);
    surf.whitecaps.taken = shore.taken;
    if (water.near_shore.fronts.lifts()) {
      surf.fronts = shore.fronts;
      surf.ceded = MulAdd(shore.fronts.ceded, one - surf.ceded, surf.ceded);
      surf.whitecaps.taken = MulAdd(shore.fronts.ceded, one - shore.taken, shore.taken);
    }
    surf.inside = surf.inside | shore.inside;
  }
  surf.is_near = !hn::AllFalse(d, surf.inside);
  surf.all_ceded = surf.is_near && hn::AllTrue(d, surf.ceded >= one);
}

// Near a coast the longest waves make room for the trains that know its floor: their slopes keep
// 1 - ceded, their variance its square.
HWY_INLINE void BlendCoast(const Water& water, V3 p, V level_m, const Surf& surf, WaterSlopes& s) {
  const D d;
  const V kept = 1.0f - surf.ceded;
  const V long_variance = s.variance - water.base_variance;
  s.slope_x = NegMulAdd(s.slope_x, surf.ceded, s.slope_x);
  s.slope_y = NegMulAdd(s.slope_y, surf.ceded, s.slope_y);
  const V blended = MulAdd(long_variance, kept * kept, water.base_variance);
  // Not rounded outside: a packet with no lane inside does not come by here.
  s.variance = IfThenElse(surf.inside, blended, s.variance);
  if (water.near_shore.fronts.lifts()) {
    s.slope_x = s.slope_x + surf.fronts.slope_x;
    s.slope_y = s.slope_y + surf.fronts.slope_y;
    s.variance = s.variance + surf.fronts.variance;
  }
  if (hn::AllFalse(d, surf.has_trains)) return;
  V x = hn::Zero(d), y = hn::Zero(d), lost = hn::Zero(d);
  AddSlopes(water.trains.slopes, p, level_m, {x, y}, x, y, lost);
  s.slope_x = s.slope_x + IfThenElseZero(surf.has_trains, x);
  s.slope_y = s.slope_y + IfThenElseZero(surf.has_trains, y);
  s.variance = s.variance + IfThenElseZero(surf.has_trains, lost);
}

constexpr float kMinCos = 0.02f;

// The area that waves of these slopes turn to the eye, over the level's.
HWY_INLINE V CosineOfSlopes(const Packet& packet, const WaterSlopes& s) {
  return NegMulAdd(s.slope_x, packet.to_eye.x,
                   NegMulAdd(s.slope_y, packet.to_eye.y, packet.to_eye.z));
}

// How Perlin noise bends the coordinates of the ripples.
template <bool kCoast>
HWY_INLINE void BendRipples(const Water& water, V3 p, V level_m, V& du, V& dv) {
  V unused = hn::Zero(D());
  // In scenes with surf nobody sees the step between two levels of the noise.
  if (kCoast && water.trains.on)
    NearestSlopes(water.uv_noise, p, level_m, du, dv);
  else
    AddSlopes(water.uv_noise, p, level_m, {du, dv}, du, dv, unused);
}

// What disturbs the water: slopes on those that there are, and foam, torn as whitecaps are.
HWY_INLINE void AddWakes(const Water& water, V3 p, V level_m, WaterSlopes& s) {
  const WakesAt at = SampleWakes(water.wakes, p, level_m);
  if (!at.is_near) return;
  s.slope_x = s.slope_x + at.slope_x;
  s.slope_y = s.slope_y + at.slope_y;
  s.variance = s.variance + at.variance;
  s.fine_variance = s.fine_variance + at.variance;
  const V slope2 = MulAdd(at.slope_x, at.slope_x, at.slope_y * at.slope_y);
  s.wake = Max(slope2 * (1.0f / (0.02f * 0.02f)), at.foam * 10.0f);
  s.foam = Join(s.foam, TearWhitecaps(water.wakes.foam, p, level_m, at.foam));
}

// Adds whitecaps: `foam` is that of the longest patch's waves. Without a coast surf is not read.
template <bool kCoast>
HWY_INLINE void AddWhitecaps(const Water& water, const ViewRays& rays,
                             std::span<const Packet> packets, std::span<const V> level_flat_m,
                             const Surf* surf, PerPacket<V>& foam, WaterSlopes* s) {
  if (kCoast && water.trains.on)
    for (std::size_t k = 0; k < packets.size(); ++k)
      foam[k] =
          Min(NegMulAdd(foam[k], surf[k].trains, foam[k]) + surf[k].whitecaps.on_trains, 1.0f);
  for (std::size_t k = 0; k < packets.size(); ++k) {
    const V height_m = packets[k].p.z + rays.eye_z;
    if constexpr (kCoast)
      foam[k] = WhitecapsAt(water.whitecaps, foam[k], packets[k].p, height_m, level_flat_m[k],
                            surf[k].whitecaps);
    else
      foam[k] = WhitecapsAt(water.whitecaps, foam[k], packets[k].p, height_m, level_flat_m[k],
                            NoCoastWhitecaps());
  }
  for (std::size_t k = 0; k < packets.size(); ++k)
    s[k].foam = TearWhitecaps(water.whitecaps, packets[k].p, level_flat_m[k], foam[k]);
}

// Adds the slopes of the sea's longest patch; returns what foam its waves have.
HWY_INLINE PerPacket<V> AddPatch(const Water& water, std::span<const Packet> packets,
                                 std::span<const V> level_flat_m, WaterSlopes* s) {
  const FoamMap* const long_foam = water.whitecaps.count > 0 ? &water.whitecaps.foam[0] : nullptr;
  PerPacket<V> foam;
  for (std::size_t k = 0; k < packets.size(); ++k)
    foam[k] = AddLongestPatch(water.layers[0], long_foam, packets[k].p, level_flat_m[k],
                              s[k].slope_x, s[k].slope_y, s[k].variance);
  return foam;
}

// Adds the foam of waves that break at a coast.
HWY_INLINE void AddCoastFoam(const Water& water, std::span<const Packet> packets,
                             std::span<const V> level_flat_m, const Surf* surf, WaterSlopes* s) {
  for (std::size_t k = 0; k < packets.size(); ++k)
    s[k].foam =
        Join(s[k].foam,
             FoamOfOver(FoamOver(water.foam_lace, packets[k].p, level_flat_m[k], surf[k].foam)));
  if (water.near_shore.fronts.torn <= 0.0f) return;
  for (std::size_t k = 0; k < packets.size(); ++k)
    s[k].foam = Join(s[k].foam, TearWhitecaps(water.whitecaps, packets[k].p, level_flat_m[k],
                                              surf[k].torn_foam));
}

// Slopes from the sines, the wave patches and the scrolling bump layers, whose coordinates noise
// bends where the longest of them are seen. How steeply the eye meets the long waves decides how
// long a pixel's footprint is on the shorter ones. A layer waits for the longer ones: packets side
// by side hide that.
template <bool kCoast>
HWY_INLINE void SampleWater(const Water& water, const ViewRays& rays,
                            std::span<const Packet> packets, WaterSlopes* s) {
  const D d;
  const V zero = hn::Zero(d);
  const std::size_t count = packets.size();
  PerPacket<V> across, level_flat_m, level_m, du, dv;
  PerPacket<Surf> surf;
  for (std::size_t k = 0; k < count; ++k) {
    across[k] = FootprintAcross(rays, packets[k]);
    level_flat_m[k] = FootprintLevel(across[k], Clamp(packets[k].to_eye.z, kMinCos, 1.0f));
    level_m[k] = level_flat_m[k];
    if constexpr (kCoast) SampleSurf(water, packets[k].p, level_flat_m[k], surf[k]);
    s[k] = NoSlopes(Constant(water.base_variance), zero, packets[k].to_eye.z);
    du[k] = dv[k] = zero;
  }
  for (int i = 0; i < water.sine_count; ++i)
    for (std::size_t k = 0; k < count; ++k)
      AddSine(water.sines[static_cast<std::size_t>(i)], packets[k].p, level_m[k], s[k]);
  bool all_ceded = kCoast;
  if constexpr (kCoast)
    for (std::size_t k = 0; k < count; ++k) all_ceded = all_ceded && surf[k].all_ceded;
  const bool has_patch = water.first_ripples > 0;
  const auto levels = std::span<const V>(level_flat_m).first(count);
  const bool has_sea = has_patch && !all_ceded;
  if (has_sea || (kCoast && all_ceded && water.trains.whitecaps.map)) {
    PerPacket<V> foam;
    if (has_sea)
      foam = AddPatch(water, packets, levels, s);
    else
      foam.fill(zero);
    AddWhitecaps<kCoast>(water, rays, packets, levels, surf.data(), foam, s);
  }
  if constexpr (kCoast)
    AddCoastFoam(water, packets, std::span(level_flat_m).first(count), surf.data(), s);
  // Without patches the sines alone are the long waves: the loop then begins before the first
  // layer. (One loop with AddSlopes in it once: two take 4 % longer.)
  const int last_long = water.long_layer_count - 1;
  for (int i = std::min(last_long, 0); i < water.layer_count; ++i) {
    const bool is_long = i <= last_long;
    if (i == water.first_ripples) {
      for (std::size_t k = 0; k < count; ++k)
        if (ShowsDetail(water.layers[i], level_m[k]))
          BendRipples<kCoast>(water, packets[k].p, level_m[k], du[k], dv[k]);
    }
    if (i >= (has_patch ? 1 : 0) && !(is_long && all_ceded)) {
      const SlopeLayer& layer = water.layers[static_cast<std::size_t>(i)];
      for (std::size_t k = 0; k < count; ++k)
        AddSlopes(layer, packets[k].p, level_m[k], {du[k], dv[k]}, s[k].slope_x, s[k].slope_y,
                  s[k].variance);
    }
    if (!is_long) continue;
    for (std::size_t k = 0; k < count; ++k) {
      if (kCoast && surf[k].is_near && i == last_long)
        BlendCoast(water, packets[k].p, level_flat_m[k], surf[k], s[k]);
      s[k].long_cosine = CosineOfSlopes(packets[k], s[k]);
      // The normal's length is left out: it is near 1, and a level needs no better.
      level_m[k] = FootprintLevel(across[k], Clamp(s[k].long_cosine, kMinCos, 1.0f));
      s[k].fine_variance = s[k].variance + water.short_variance;
    }
  }
  if (water.wakes.count > 0)
    for (std::size_t k = 0; k < count; ++k) AddWakes(water, packets[k].p, level_flat_m[k], s[k]);
}

template <bool kCoast>
HWY_INLINE WaterSlopes SampleWater(const Water& water, const ViewRays& rays, const Packet& packet) {
  WaterSlopes s;
  SampleWater<kCoast>(water, rays, std::span(&packet, 1), &s);
  return s;
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
