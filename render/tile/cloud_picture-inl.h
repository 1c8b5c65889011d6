// Lays volumetric clouds before a tile's pixels.
#if defined(SWELL_RENDER_TILE_CLOUD_PICTURE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_TILE_CLOUD_PICTURE_INL_H_
#undef SWELL_RENDER_TILE_CLOUD_PICTURE_INL_H_
#else
#define SWELL_RENDER_TILE_CLOUD_PICTURE_INL_H_
#endif

#include "render/packets/packet-inl.h"
#include "render/tile/cloud_picture.h"
#include "render/tile/medium-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// The channels of CloudPicture at pixels.
struct CloudsSeen {
  V3 light;
  V opacity, front, back;
};

// Farther than all clouds.
constexpr float kBeyondClouds_m = 1e9f;

// The clouds before `light`, what is seen after distance_m. A pixel that ends among them sees as
// much of them as an even cloud between the two ends would show.
HWY_INLINE V3 LayClouds(const CloudsSeen& seen, V distance_m, V3 light) {
  const D d;
  const V zero = hn::Zero(d), one = Constant(1.0f);
  const V way = Max(seen.back - seen.front, 1e-4f);
  const V part = MulSub(distance_m, seen.opacity, seen.front) / way;
  const auto whole = part >= one;
  V hidden = IfThenElseZero(whole, seen.opacity), shown = IfThenElseZero(whole, one);
  const auto among = hn::AndNot(whole, part > zero);
  if (!hn::AllFalse(d, among)) {
    const V passes = Max(one - seen.opacity, 1.0f / 256.0f);
    const V some = one - Exp2(d, part * Log2(d, passes));
    hidden = IfThenElse(among, some, hidden);
    shown = IfThenElse(among, some / Max(seen.opacity, 1e-6f), shown);
  }
  return MulAdd(seen.light, shown, light * (one - hidden));
}

// The clouds in the kLanes pixels from (x, y) of the window on; x a multiple of kLanes. Where they
// hide nothing the rest is 0.
HWY_INLINE CloudsSeen CloudsOfPacket(const CloudPicture& picture, int x, int y) {
  const D d;
  const int step = picture.step();
  const float per_step = 1.0f / static_cast<float>(step);
  const VI past_node = CountFrom(x % step);
  const VI left = hn::ShiftRightSame(past_node, picture.step_log2), right = left + 1;
  const V across = hn::ConvertTo(d, past_node & (step - 1)) * per_step;
  const V below = Constant(static_cast<float>(y % step) * per_step);
  const std::size_t at =
      static_cast<std::size_t>(y / step) * picture.stride + static_cast<std::size_t>(x / step);
  const auto read = [&](std::size_t channel) HWY_ATTR {
    const float* const upper = picture.nodes[channel].data() + at;
    const V nodes = Lerp(hn::LoadU(d, upper), hn::LoadU(d, upper + picture.stride), below);
    return Lerp(hn::TableLookupLanes(nodes, hn::IndicesFromVec(d, left)),
                hn::TableLookupLanes(nodes, hn::IndicesFromVec(d, right)), across);
  };
  const V zero = hn::Zero(d);
  CloudsSeen seen = {{zero, zero, zero}, read(CloudPicture::kOpacity), zero, zero};
  if (hn::AllFalse(d, seen.opacity > zero)) return seen;
  seen.light = {read(0), read(1), read(2)};
  seen.front = read(CloudPicture::kFront), seen.back = read(CloudPicture::kBack);
  return seen;
}

// The clouds at any places in the window.
HWY_INLINE CloudsSeen CloudsAt(const CloudPicture& picture, V x_px, V y_px) {
  const DI di;
  const float per_step = 1.0f / static_cast<float>(picture.step());
  const V x = Max(x_px * per_step, 0.0f);
  const V y = Max(y_px * per_step, 0.0f);
  const VI column = Min(TruncateToInt(x), hn::Set(di, picture.columns - 2));
  const VI row = Min(TruncateToInt(y), hn::Set(di, picture.rows - 2));
  const V across = x - hn::ConvertTo(D(), column);
  const V below = y - hn::ConvertTo(D(), row);
  const VI stride = hn::Set(di, static_cast<int>(picture.stride));
  const VI upper = row * stride + column, lower = upper + stride;
  const VI one = hn::Set(di, 1);
  const auto read = [&](std::size_t channel) HWY_ATTR {
    const float* const nodes = picture.nodes[channel].data();
    const auto node = [&](VI at) HWY_ATTR { return hn::GatherIndex(D(), nodes, at); };
    return Lerp(Lerp(node(upper), node(lower), below),
                Lerp(node(upper + one), node(lower + one), below), across);
  };
  return {{read(0), read(1), read(2)},
          read(CloudPicture::kOpacity),
          read(CloudPicture::kFront),
          read(CloudPicture::kBack)};
}

// How far what a depth buffer's z shows is away, or the sky.
HWY_INLINE V DistanceShown(const ViewRays& rays, V x_px, V y_px, V z) {
  const V3 ray = RayAt(rays, x_px, y_px);
  const V depth = rays.near_m / Max(z, 1e-12f);
  const V distance = depth * Sqrt(Dot(ray, ray));
  return IfThenElse(z > 0.0f, distance, kBeyondClouds_m);
}

struct VolumetricClouds {
  static bool IsOn(const Shading& s) { return s.clouds && s.clouds->any; }

  static HWY_NOINLINE void LayOverTile(const Shading& s, const TilePixels& tile,
                                       ShadeScratch& scratch) {
    LayOverPixels(s, tile, scratch, [&](const PixelsShown& p, V3& light) HWY_ATTR {
      const CloudsSeen seen = CloudsOfPacket(*s.clouds, tile.box.x0_px + p.x, tile.box.y0_px + p.y);
      if (hn::AllFalse(D(), seen.opacity > 0.0f)) return false;
      light = LayClouds(seen, DistanceShown(s.rays, p.x_px, p.y_px, p.z), light);
      return true;
    });
  }

  // Those that pixels' centres show get the tile's light later, from GatherCentres().
  static HWY_NOINLINE void LayOverFragments(const Shading& s,
                                            std::span<const EdgeFragment> fragments,
                                            ShadeScratch& scratch) {
    LayOverEachFragment(fragments, scratch, [&](const FragmentsShown& f, V3 light) HWY_ATTR {
      return LayClouds(CloudsAt(*s.clouds, f.x_px, f.y_px),
                       DistanceShown(s.rays, f.x_px, f.y_px, f.z), light);
    });
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
