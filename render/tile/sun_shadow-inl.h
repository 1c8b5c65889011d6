// How much of the sun points see, for the materials.
#if defined(SWELL_RENDER_TILE_SUN_SHADOW_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_TILE_SUN_SHADOW_INL_H_
#undef SWELL_RENDER_TILE_SUN_SHADOW_INL_H_
#else
#define SWELL_RENDER_TILE_SUN_SHADOW_INL_H_
#endif

#include "render/packets/square_map-inl.h"
#include "render/sky/cloud_shadow-inl.h"
#include "render/tile/shading_result-inl.h"
#include "render/world/land_shadow.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// As disc_part() (render/world/land_shadow.h), and 1 for 1 and more.
HWY_INLINE V DiscPart(V lit) {
  const V one = Constant(1.0f);
  const V x = MulSub(Max(lit, 0.0f), 2.0f, one);
  const V part = MulAdd(x, MulAdd(x * x, -0.137f, 0.637f), 0.5f);
  return IfThenElse(lit >= one, one, part);
}

// What the land leaves of the sun at p, relative to the eye. A function of its own, and few lanes
// come far: what it takes would cost the shaders registers.
inline HWY_NOINLINE V SunOverLand(const SunShadow& shadow, const V3& p, float eye_z) {
  const D d;
  const DI di;
  const LandShadow& land = *shadow.land;
  const V one = Constant(1.0f);
  const auto texel = [&](glm::vec3 axis)
                         HWY_ATTR { return MulAdd(p.x, axis.x, MulAdd(p.y, axis.y, axis.z)); };
  const V along = texel(shadow.along), across = texel(shadow.across);
  const glm::vec2 low(land.begin), high(land.end - 1);
  const auto inside =
      ((along >= low.x) & (across >= low.y)) & ((along < high.x) & (across < high.y));
  if (hn::AllFalse(d, inside)) return one;
  const VI i = TruncateToInt(IfThenElseZero(inside, along));
  const VI j = TruncateToInt(IfThenElseZero(inside, across));

  // Most points stand above all shadows around.
  constexpr int kBlock = LandShadow::kBlock_log2;
  const VI block = hn::ShiftRight<kBlock>(j) * land.blocks_along + hn::ShiftRight<kBlock>(i);
  const V z = p.z + eye_z;
  const auto low_enough = inside & (z < hn::GatherIndex(d, land.block_lit_above_m.data(), block));
  if (hn::AllFalse(d, low_enough)) return one;

  const V s = along - hn::ConvertTo(d, i), t = across - hn::ConvertTo(d, j);
  const VI first = j * land.texels_along + i;
  const auto* const bounds = reinterpret_cast<const std::int32_t*>(land.bounds.data());
  const auto gather = [&](int offset)
                          HWY_ATTR { return hn::GatherIndex(di, bounds, first + offset); };
  const VI at00 = gather(0), at10 = gather(1);
  const VI at01 = gather(land.texels_along), at11 = gather(land.texels_along + 1);
  const auto between = [&](auto&& code) HWY_ATTR {
    const auto of = [&](VI word) HWY_ATTR { return hn::ConvertTo(d, code(word)); };
    return Lerp(Lerp(of(at00), of(at10), s), Lerp(of(at01), of(at11), s), t);
  };
  const V dark_below = between([&](VI word) HWY_ATTR { return word & 0xffff; });
  const V lit_above = between([&](VI word) HWY_ATTR { return hn::ShiftRight<16>(word) & 0xffff; });
  const V height = (z - LandShadow::kLowest_m) * (1.0f / land.step_m);
  const V lit = (height - dark_below) / Max(lit_above - dark_below, one);
  return IfThenElse(low_enough, DiscPart(lit), one);
}

// A point relative to an object's place, along the axes of ObjectShadows.
struct SunPlace {
  V right, up, depth;
};

// The part of the sun's disc that an outline covers, seen from a place: the disc has the radius
// `soft` at the outline's distance. Five strips of it, as broad as it is in their middles.
HWY_INLINE V DiscCovered(const Outline& outline, const SunPlace& at, V soft) {
  const D d;
  constexpr int kStrips = 5;
  constexpr std::array<float, kStrips> kUp = {-0.8f, -0.4f, 0.0f, 0.4f, 0.8f};
  constexpr std::array<float, kStrips> kHalf = {0.6f, 0.9165151f, 1.0f, 0.9165151f, 0.6f};
  constexpr float kWhole = 2.0f * (0.6f + 0.9165151f + 1.0f + 0.9165151f + 0.6f);
  constexpr float kLast = Outline::kRows - 1;
  const V zero = hn::Zero(d);
  V covered = zero;
  for (int k = 0; k < kStrips; ++k) {
    const V up = MulAdd(soft, kUp[k], at.up);
    const V row = (up - outline.lowest_m) * outline.rows_per_m;
    const VI i = TruncateToInt(Clamp(row, 0.0f, kLast - 1.0f));
    const V t = Clamp(row - hn::ConvertTo(d, i), 0.0f, 1.0f);
    const auto end = [&](const std::array<float, Outline::kRows>& of_row) HWY_ATTR {
      return Lerp(hn::GatherIndex(d, of_row.data(), i), hn::GatherIndex(d, of_row.data() + 1, i),
                  t);
    };
    const V half = soft * kHalf[k];
    const V left = Max(end(outline.left_m), at.right - half);
    const V right = Min(end(outline.right_m), at.right + half);
    const auto crosses = (row >= zero) & (row <= kLast);
    covered = covered + IfThenElseZero(crosses, Max(right - left, zero));
  }
  return Min(covered / (soft * kWhole), 1.0f);
}

// How much nearer to the sun than the place the outline is there: more than that of whatever lies
// between its ends, in a body without hollows.
HWY_INLINE V AheadOf(const Outline& outline, const SunPlace& at) {
  const D d;
  constexpr float kLast = Outline::kRows - 1;
  const V row = (at.up - outline.lowest_m) * outline.rows_per_m;
  const VI i = TruncateToInt(Clamp(row + 0.5f, 0.0f, kLast));
  const auto end = [&](const std::array<float, Outline::kRows>& of_row)
                       HWY_ATTR { return hn::GatherIndex(d, of_row.data(), i); };
  const V left = end(outline.left_m), right = end(outline.right_m);
  const V width = Max(right - left, 1e-6f);
  const V t = Clamp((at.right - left) / width, 0.0f, 1.0f);
  return Lerp(end(outline.left_depth_m), end(outline.right_depth_m), t) - at.depth;
}

// What a place sees of the sun's light and of that from above, over their means.
struct LightSeen {
  V sun, ambient;
};

// The light from above at p over its mean: fog in the shadow of clouds sends less of it down.
HWY_INLINE V AmbientUnderClouds(const Shading& s, const V3& p) {
  const V one = Constant(1.0f);
  if (s.light.fog_ambient <= 0.0f) return one;
  const V lit = SunUnderClouds(*s.sun_shadow.clouds, p, s.rays.eye_z);
  return MulAdd(lit - one, s.light.fog_ambient, one);
}

// What land and clouds leave of the sun at p.
HWY_INLINE V SunOverLandAndClouds(const Shading& s, const V3& p) {
  V visible = Constant(1.0f);
  if (s.sun_shadow.land) visible = SunOverLand(s.sun_shadow, p, s.rays.eye_z);
  if (s.sun_shadow.clouds)
    visible = visible * SunUnderClouds(*s.sun_shadow.clouds, p, s.rays.eye_z);
  return visible;
}

// Radiance of deep water at p, where light comes in from around and which so is never quite in the
// shade.
HWY_INLINE V3 DeepWater(const Shading& s, const V3& p, V sun_visible) {
  V3 body = Constant(s.media.body);
  if (s.light.fog_ambient > 0.0f) {
    const V less = AmbientUnderClouds(s, p) - 1.0f;
    body = MulAdd(Constant(s.media.body - s.media.body_sun), less, body);
  }
  return MulAdd(Constant(s.media.body_sun), MulSub(sun_visible, 0.6f, 0.6f), body);
}

// The pixels that a packet lies between.
HWY_INLINE PixelSpan SpanOf(const Packet& packet) {
  const D d;
  return {hn::GetLane(hn::MinOfLanes(d, packet.x_px)), hn::GetLane(hn::MinOfLanes(d, packet.y_px)),
          hn::GetLane(hn::MaxOfLanes(d, packet.x_px)), hn::GetLane(hn::MaxOfLanes(d, packet.y_px))};
}

// A point that light may fall on.
struct LitPoint {
  V3 p;    // relative to the eye
  V soft;  // half a pixel's breadth there [m]
  V own;   // the number of the object that it is on, below 0 if on none
  bool is_sea = false;
};

// What the objects leave of the sun at points in a span of pixels.
inline HWY_NOINLINE V SunOverObjects(const SunShadow& shadow,
                                     std::span<const std::uint16_t> casters, const PixelSpan& span,
                                     const LitPoint& point) {
  const ObjectShadows& shadows = *shadow.objects;
  const D d;
  constexpr auto kRadius = static_cast<float>(kSunRadius_rad);
  const V zero = hn::Zero(d), one = Constant(1.0f);
  const auto high = point.p.z >= shadows.lowest_rel_m;
  const std::span pixels = point.is_sea ? shadow.casters.sea_pixels : shadow.casters.pixels;
  const V3 of_eye = {Dot(point.p, Constant(shadows.right)), Dot(point.p, Constant(shadows.up)),
                     Dot(point.p, Constant(shadows.sun))};
  V visible = one;
  for (const std::uint16_t number : casters) {
    if (!pixels[number].meets(span)) continue;
    const SunBox& box = shadows.boxes[number];
    if (box.reach_m <= 0.0f) continue;
    const V3 p = of_eye - Constant(box.place);
    const SunPlace at = {p.x, p.y, p.z};
    // The box, as soft as anything in it is.
    const V farthest = box.most_depth_m - at.depth;
    const V most_soft = MulAdd(farthest, kRadius, point.soft);
    const V aside = Abs(at.right - box.middle_m);
    const V above = Abs(at.up - box.middle_up_m);
    const auto in_box =
        (aside < most_soft + box.half_width_m) & (above < most_soft + box.half_height_m);
    const auto other = point.own != Constant(box.object);
    const auto near = (farthest > zero) & (farthest < box.reach_m);
    const auto some = (in_box & near) & (other & high);
    if (hn::AllFalse(d, some)) continue;

    const Outline& outline = shadows.casters[number].outline;
    const V ahead = AheadOf(outline, at);
    const V soft = MulAdd(Max(ahead, zero), kRadius, point.soft);
    const V fading = Clamp(NegMulAdd(ahead, 2.0f / box.reach_m, 2.0f), 0.0f, 1.0f);
    const V before = Clamp(ahead * 20.0f, 0.0f, 1.0f) * fading;
    const V covered = DiscCovered(outline, at, soft) * before;
    visible = IfThenElse(some, NegMulAdd(visible, covered, visible), visible);
  }
  return visible;
}

// Where light that falls on points under the water's level comes in; far below all for very deep
// ones.
HWY_INLINE V3 WhereLightEnters(const Shading& s, const V3& p) {
  const V level = Constant(s.level_rel_m), deepest = Constant(kDeepestShadow_m);
  const V depth = Max(level - p.z, 0.0f);
  const V z = IfThenElse(depth < deepest, Max(p.z, level), -1e9f);
  return {MulAdd(depth, s.sun_shadow.entry.x, p.x), MulAdd(depth, s.sun_shadow.entry.y, p.y), z};
}

HWY_INLINE V PixelSoftness(const Shading& s, V depth) {
  return MulAdd(depth, 0.5f * s.rays.pixel_angle, 1e-4f);
}

// The part of the sun's light that trees leave at points so high above the ground or the water. As
// if on the ground where the light comes down that passes there. A function of its own, as those
// above.
inline HWY_NOINLINE V SunUnderTrees(const Shading& s, const Packet& packet, V above_m) {
  const SunShadow& shadow = s.sun_shadow;
  if (!shadow.under_trees.map) return Constant(1.0f);
  const V3 p = {NegMulAdd(above_m, shadow.tree_slide.x, packet.p.x),
                NegMulAdd(above_m, shadow.tree_slide.y, packet.p.y), packet.p.z};
  return SampleSquare(shadow.under_trees, p, GroundLevel(s.rays, packet), Constant(1.0f));
}

// The part of the sun that a packet's points see, in [0, 1], but for trees; `own` says which
// objects they are on. The ground has a map of its own.
HWY_INLINE V SunVisible(const Shading& s, const TilePixels& tile, const Packet& packet, V own,
                        bool is_sea = false) {
  const V visible = SunOverLandAndClouds(s, packet.p);
  if (tile.casters.empty()) return visible;
  return visible * SunOverObjects(s.sun_shadow, tile.casters, SpanOf(packet),
                                  {packet.p, PixelSoftness(s, packet.depth), own, is_sea});
}

// The part of the sun's light that trees leave on the sea.
inline HWY_NOINLINE V SunUnderTreesOnSea(const Shading& s, const Packet& packet) {
  const D d;
  const V one = Constant(1.0f);
  const glm::vec2 low = s.sun_shadow.sea_shade_low, high = s.sun_shadow.sea_shade_high;
  const auto in_x = (packet.p.x > low.x) & (packet.p.x < high.x);
  const auto in_y = (packet.p.y > low.y) & (packet.p.y < high.y);
  const auto in_box = in_x & in_y;
  if (hn::AllFalse(d, in_box)) return one;
  return IfThenElse(in_box, SunUnderTrees(s, packet, hn::Zero(d)), one);
}

// The part of the sun that the sea sees.
HWY_INLINE V SunOnSea(const Shading& s, const TilePixels& tile, const Packet& packet) {
  const V visible = SunVisible(s, tile, packet, Constant(-1.0f), true);
  if (!s.sun_shadow.under_trees.map) return visible;
  return visible * SunUnderTreesOnSea(s, packet);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
