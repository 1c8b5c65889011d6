// Fog on the way to the eye: what a way loses, and what it scatters to the eye. sky/fog.h has the
// forms and names their papers.
#if defined(SWELL_RENDER_SKY_FOG_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_SKY_FOG_INL_H_
#undef SWELL_RENDER_SKY_FOG_INL_H_
#else
#define SWELL_RENDER_SKY_FOG_INL_H_
#endif

#include <algorithm>

#include "render/sky/air_way-inl.h"
#include "render/sky/cloud_shadow-inl.h"
#include "render/sky/fog.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// A way that may lie in fog.
struct FogRay : AirWay {
  const FogStart& start;
};

HWY_INLINE FogRay RayToSky(const FogStart& start, V3 direction) {
  return {{direction, Constant(kEndless_m), Constant(kEndless_m), start.height_m}, start};
}

// What of it lies in fog.
struct FogPath {
  V before;   // of the way, not in fog yet [m]
  V amount;   // as metres of fog of sea level
  V leaning;  // amount (1 - w / s), w the mean sine of its elevation, s that of the sun's
};

HWY_INLINE V Leaning(const Fog& fog, V amount, V rise) {
  return NegMulAdd(amount * rise, 1.0f / fog.sun_sine, amount);
}

// Returns the part of a ray that lies under the fog's top, from begin to end. Over a round earth
// the height of a straight line is that of a parabola.
HWY_INLINE FogPath PathInSlab(const Fog& fog, const FogRay& ray) {
  const D d;
  const V zero = hn::Zero(d), least = Constant(1e-9f);
  const V rise = ray.direction.z;
  const float c = fog.drop_per_m2, under_top_m = fog.top_m - ray.start.height_m;
  const V under_root = MulAdd(rise, rise, 4.0f * c * under_top_m);
  const V root = Sqrt(Max(under_root, zero));
  V begin = zero, end;
  if (under_top_m >= 0.0f) {
    end = 2.0f * under_top_m / Max(rise + root, least);
  } else {
    const V down = root - rise;
    const auto meets = (rise < zero) & (under_root > zero);
    const V comes = -2.0f * under_top_m / Max(down, least);
    begin = Min(IfThenElse(meets, comes, ray.distance), ray.distance);
    end = down * (0.5f / std::max(c, 1e-12f));
  }
  end = Max(Min(end, ray.distance), begin);
  const V amount = end - begin;
  const V mean_rise = MulAdd(begin + end, c, rise);
  return {begin, amount, Leaning(fog, amount, mean_rise)};
}

// (1 - e^-x) / x of x >= 0.
HWY_INLINE V MeanPassing(V x) {
  const V one = Constant(1.0f);
  const V e = Exp(D(), -Min(x, 80.0f));
  const V series = NegMulAdd(NegMulAdd(x, 1.0f / 6.0f, 0.5f), x, one);
  return IfThenElse(x < 0.02f, series, (one - e) / x);
}

// Returns the path through fog that thins as e^(-z / H), by the fog's mean along a straight line
// between two heights.
HWY_INLINE FogPath PathInThinningFog(const Fog& fog, const FogRay& ray) {
  const D d;
  const V zero = hn::Zero(d);
  const float inv_top = 1.0f / fog.top_m, start_m = std::max(ray.start.height_m, 0.0f);
  const V end_m = Max(ray.end_height, zero);
  const V low = Min(end_m, start_m);
  const V apart = Abs(end_m - start_m) * inv_top;
  const V density = Exp(d, -Min(low * inv_top, 80.0f));
  const V amount = density * ray.distance * MeanPassing(apart);
  const V rise = (end_m - start_m) / Max(ray.distance, 1e-3f);
  // From twice its height up fog lies at the end of the way.
  const V fall = Max(start_m - end_m, 1e-3f);
  const V before = Clamp((start_m - 2.0f * fog.top_m) / fall, 0.0f, 1.0f);
  return {before * ray.distance, amount, Leaning(fog, amount, rise)};
}

// Returns the path of a ray into the sky, with all the fog that it meets.
HWY_INLINE FogPath PathToSky(const Fog& fog, const FogRay& ray) {
  if (!fog.is_exponential) return PathInSlab(fog, ray);
  // Chapman's path of level rays, sqrt(pi R H / 2): as over a flat earth with the sine
  // sqrt(4 c H / pi).
  const V rise = ray.direction.z;
  const V bent = Constant(5.0929582f * fog.drop_per_m2 * fog.top_m);
  const V sine = (rise + Sqrt(MulAdd(rise, rise, bent))) * 0.5f;
  const V amount = ray.start.above_m / Max(sine, 1e-6f);
  return {hn::Zero(D()), amount, Leaning(fog, amount, sine)};
}

// cos(2 pi x) of |x| below 2^22. Absolute error 5e-7.
HWY_INLINE V CosTurns(V x) {
  const V r = x - hn::Round(x);
  const V r2 = r * r;
  // (cos(2 pi r) - 1) / r^2 in r^2, at Chebyshev nodes.
  V p = MulAdd(6.71221733f, r2, -26.0995922f);
  p = MulAdd(p, r2, 60.2028008f);
  p = MulAdd(p, r2, -85.4543839f);
  p = MulAdd(p, r2, 64.9393387f);
  p = MulAdd(p, r2, -19.7392082f);
  return MulAdd(p, r2, 1.0f);
}

// The mean density between two places on a ray, against that of fog without banks. That of a wave
// is the difference of the ends' cosines over the angle between them; over short ways its value in
// the middle.
HWY_INLINE V MeanOfBanks(const Fog& fog, const FogRay& ray, const FogPath& path) {
  constexpr float kTurn = 6.2831853f, kShortTurns = 4e-3f;
  const D d;
  const V zero = hn::Zero(d);
  const V end = Min(path.before + path.amount, Min(ray.distance, 1e5f));
  const V begin = Min(path.before, end);
  const V length = end - begin;
  const auto from_start = begin == zero;
  const bool all_from_start = hn::AllTrue(d, from_start);
  V density = Constant(1.0f);
  for (int i = 0; i < fog.bank_count; ++i) {
    const FogBank& bank = fog.banks[static_cast<std::size_t>(i)];
    const V at_eye = Constant(bank.turns);
    const V per_m =
        MulAdd(ray.direction.x, bank.turns_per_m.x, ray.direction.y * bank.turns_per_m.y);
    const V turns = per_m * length;
    V near = Constant(bank.cosine);
    if (!all_from_start)
      near = IfThenElse(from_start, near, CosTurns(MulAdd(per_m, begin, at_eye)));
    const V apart = near - CosTurns(MulAdd(per_m, end, at_eye));
    const auto is_short = Abs(turns) < kShortTurns;
    V wave = apart * (1.0f / kTurn) / turns;
    if (!hn::AllFalse(d, is_short)) {
      const V middle = (begin + end) * 0.5f;
      const V sine = CosTurns(MulAdd(per_m, middle, at_eye - 0.25f));
      wave = IfThenElse(is_short, sine, wave);
    }
    density = MulAdd(wave, bank.amount, density);
  }
  return Max(density, zero);
}

// What a way does to light of one channel: the part of it that passes, and what is scattered once
// of a sun whose irradiance and phase function are 1.
struct FogEffect {
  V passes, once;
};

// upright: amount over leaning.
HWY_INLINE FogEffect EffectOf(const Fog& fog, const FogStart& start, const FogPath& path, V upright,
                              int channel) {
  const D d;
  const V per_m = Constant(fog.per_m[channel]);
  const V depth = Min(path.amount * per_m, 80.0f);
  const V passes = Exp(d, -depth);
  if (fog.is_paper) {
    const V lost = 1.0f - passes;
    return {passes, lost * fog.at_sea.sun_passes[channel]};
  }
  // e^-b (1 - e^-x) / x, b that of the sun's way to where this one begins.
  const float b = std::min(fog.per_m[channel] * start.above_m / fog.sun_sine, 80.0f);
  const V begin = Constant(start.sun_passes[channel]);
  const V x = path.leaning * per_m;
  const V end = Exp(d, -Clamp(x + b, 0.0f, 80.0f));
  const auto is_small = Abs(x) < 0.03f;
  const V series = NegMulAdd(NegMulAdd(x, 1.0f / 6.0f, 0.5f), x, 1.0f);
  return {passes, IfThenElse(is_small, depth * begin * series, (begin - end) * upright)};
}

// The light that fog leaves of what is seen through it, and adds.
struct FogView {
  V3 passes, added;
};

// Returns Blinn's lobe of the sun's light, without its factors, in a direction of length 1.
HWY_INLINE V FogPhase(const Fog& fog, V3 direction) {
  const V cosine = Dot(direction, Constant(fog.to_sun));
  const V under = NegMulAdd(cosine, 2.0f * fog.forward, 1.0f + fog.forward * fog.forward);
  return 1.0f / (under * Sqrt(under));
}

// How far along a ray so much of its fog lies before: there the fog thins as e^(-z / H). With a the
// fog straight up from the start and w the ray's rise, t = -(H / w) ln(1 - w amount / a).
HWY_INLINE V DistanceOfAmount(const Fog& fog, const FogRay& ray, V rise, V amount) {
  const D d;
  const float above_m = std::max(ray.start.above_m, 1e-20f);
  const V level = amount * (fog.top_m / above_m);
  const V y = amount * rise * (1.0f / above_m);
  const V left = Max(1.0f - y, 1e-4f);
  const auto is_level = Abs(y) < 1e-3f;
  const V bent = Log2(d, left) * -0.69314718f / IfThenElse(is_level, 1.0f, y);
  return level * IfThenElse(is_level, 1.0f, bent);
}

// Places along a way, each of which stands for as much of the light that the way scatters. Before
// the sky, which is found at few pixels, there are more of them, so that shafts are sharp.
constexpr int kPlacesOnWay = 8, kPlacesBeforeSky = 32;

// The sun's light that clouds leave a way to scatter to the eye, over its mean. `amount`: as the
// path's, in its banks. From the part u of the way comes light e^(-x u), as in EffectOf().
static HWY_NOINLINE V SunUnderCloudsOnWay(const Fog& fog, FogRay ray, FogPath path, V amount,
                                          int places) {
  const D d;
  const V one = Constant(1.0f), zero = hn::Zero(d);
  // A round earth's slab is level where most of the light comes from: near the eye.
  V rise = ray.direction.z;
  if (fog.is_exponential) {
    const V upright = path.leaning / Max(path.amount, 1e-9f);
    rise = (one - upright) * fog.sun_sine;
  }
  const V depth = amount * fog.per_m.y;
  const V x = Max(fog.is_paper ? depth : Leaning(fog, depth, rise), -60.0f);
  const V lost = one - Exp(d, -Min(x, 60.0f));
  const auto is_even = Abs(x) < 1e-3f;
  const V scale = -0.69314718f / IfThenElse(is_even, one, x);

  // How fast a place moves over the shadow: along the sun's light it stays the same.
  const glm::vec2 slant = fog.clouds->slant;
  const V across_x = NegMulAdd(rise, slant.x, ray.direction.x);
  const V across_y = NegMulAdd(rise, slant.y, ray.direction.y);
  const V across = Sqrt(MulAdd(across_x, across_x, across_y * across_y));
  V sum = zero, last = path.before;
  for (int k = 0; k < places; ++k) {
    const V q = Constant((static_cast<float>(k) + 0.5f) / static_cast<float>(places));
    const V part = Log2(d, NegMulAdd(lost, q, one)) * scale;
    const V before = path.amount * IfThenElse(is_even, q, part);
    const V t =
        fog.is_exponential ? DistanceOfAmount(fog, ray, rise, before) : path.before + before;
    const V z = Max(MulAdd(t, rise, ray.start.height_m), zero);
    const V3 place = {MulAdd(t, ray.direction.x, ray.from_x),
                      MulAdd(t, ray.direction.y, ray.from_y), z};
    const V apart = (t - last) * across;
    sum = sum + SunUnderCloudsAbout(*fog.clouds, place, apart);
    last = t;
  }
  return sum * (1.0f / static_cast<float>(places));
}

// Returns SunUnderCloudsOnWay() less 1, and 0 where the fog is too thin to be seen.
HWY_INLINE V ShadeOfClouds(const Fog& fog, const FogRay& ray, const FogPath& path, V amount,
                           int places) {
  const D d;
  const auto shows = amount * fog.per_m.y > 1.0f / 512.0f;
  if (hn::AllFalse(d, shows)) return hn::Zero(d);
  const V lit = SunUnderCloudsOnWay(fog, ray, path, amount, places);
  return IfThenElseZero(shows, lit - 1.0f);
}

HWY_INLINE FogView SeeFog(const Fog& fog, const FogRay& ray, FogPath path, V phase,
                          int places = kPlacesOnWay) {
  const V one = Constant(1.0f);
  const V upright = path.amount / path.leaning;
  const FogPath way = path;
  if (fog.bank_count > 0) {
    const V density = MeanOfBanks(fog, ray, path);
    path.amount = path.amount * density;
    path.leaning = path.leaning * density;
  }
  V shade = hn::Zero(D());
  if (fog.clouds) shade = ShadeOfClouds(fog, ray, way, path.amount, places);
  const auto added = [&](const FogEffect& effect, int channel) HWY_ATTR {
    const V once = phase * effect.once, lost = one - effect.passes;
    const auto light = [&](glm::vec3 even) HWY_ATTR {
      return MulAdd(once, fog.scattered[channel], lost * even[channel]);
    };
    return fog.clouds ? MulAdd(shade, light(fog.even_sun), light(fog.even)) : light(fog.even);
  };
  const FogEffect red = EffectOf(fog, ray.start, path, upright, 0);
  if (fog.is_grey)
    return {{red.passes, red.passes, red.passes}, {added(red, 0), added(red, 1), added(red, 2)}};
  const FogEffect green = EffectOf(fog, ray.start, path, upright, 1);
  const FogEffect blue = EffectOf(fog, ray.start, path, upright, 2);
  return {{red.passes, green.passes, blue.passes},
          {added(red, 0), added(green, 1), added(blue, 2)}};
}

HWY_INLINE FogView SeeFog(const Fog& fog, const FogRay& ray, const FogPath& path) {
  return SeeFog(fog, ray, path, FogPhase(fog, ray.direction));
}

HWY_INLINE V3 ThroughFog(const FogView& view, V3 light) {
  return {MulAdd(light.x, view.passes.x, view.added.x),
          MulAdd(light.y, view.passes.y, view.added.y),
          MulAdd(light.z, view.passes.z, view.added.z)};
}

// Returns the path to a place. A way with both ends in a slab lies in it whole: from an eye in the
// fog the sea does.
HWY_INLINE FogPath PathTo(const Fog& fog, const FogRay& ray) {
  if (fog.is_exponential) return PathInThinningFog(fog, ray);
  if (ray.start.height_m > fog.top_m) return PathInSlab(fog, ray);
  const V up = ray.end_height - ray.start.height_m;
  const FogPath whole = {hn::Zero(D()), ray.distance,
                         NegMulAdd(up, 1.0f / fog.sun_sine, ray.distance)};
  const auto is_whole = ray.end_height <= fog.top_m;
  if (hn::AllTrue(D(), is_whole)) return whole;
  const FogPath part = PathInSlab(fog, ray);
  return {hn::IfThenZeroElse(is_whole, part.before),
          IfThenElse(is_whole, whole.amount, part.amount),
          IfThenElse(is_whole, whole.leaning, part.leaning)};
}

// The fog before the sky, in a direction of length 1.
static HWY_NOINLINE FogView SkyFog(const Fog& fog, const FogStart& start, V3 direction,
                                   int places) {
  const FogRay ray = RayToSky(start, direction);
  return SeeFog(fog, ray, PathToSky(fog, ray), FogPhase(fog, direction), places);
}

// As waves mirror it.
HWY_INLINE V3 SkyThroughFog(const Fog& fog, const FogStart& start, V3 direction, V3 light) {
  return ThroughFog(SkyFog(fog, start, direction, kPlacesOnWay), light);
}

// How much more of the sun there is at a height over the eye than at the sea, as the mean of the
// channels has it: what stands out of fog is bright.
HWY_INLINE V SunOverFog(const Fog& fog, V height) {
  const D d;
  const V zero = hn::Zero(d);
  const V z = Max(height + fog.at_eye.height_m, zero);
  const V thinner = fog.is_exponential ? 1.0f - Exp(d, -Min(z * (1.0f / fog.top_m), 80.0f))
                                       : Min(z * (1.0f / fog.top_m), 1.0f);
  const float depth = fog.at_sea.above_m * fog.per_m.y / fog.sun_sine;
  return Exp(d, thinner * std::min(depth, 80.0f));
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
