// What media (media-inl.h) are laid before a tile's pixels with, once all of them are shaded.
#if defined(SWELL_RENDER_TILE_MEDIUM_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_TILE_MEDIUM_INL_H_
#undef SWELL_RENDER_TILE_MEDIUM_INL_H_
#else
#define SWELL_RENDER_TILE_MEDIUM_INL_H_
#endif

#include <span>

#include "render/sky/air_way-inl.h"
#include "render/tile/resolve-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// Pixels, or parts of pixels, and where what they show is; of the sky, something near.
struct PlaceShown {
  V x_px, y_px, z;
  hn::Mask<D> is_surface;
  V3 way;  // the ray of depth 1
  V depth;
  V height;  // over the eye; on a round earth as MakePacket() has it
};

HWY_INLINE PlaceShown FindPlace(const Shading& s, V x_px, V y_px, V z) {
  PlaceShown at;
  at.x_px = x_px, at.y_px = y_px;
  at.is_surface = z > 0.0f;
  at.z = IfThenElse(at.is_surface, z, 1.0f);
  at.way = RayAt(s.rays, x_px, y_px);
  at.depth = s.rays.near_m / at.z;
  const V horizontal2 = MulAdd(at.way.x, at.way.x, at.way.y * at.way.y);
  const V sunk = horizontal2 * at.depth * s.rays.drop_per_m2;
  at.height = (sunk + at.way.z) * at.depth;
  return at;
}

// The way from the eye to there; beside surfaces, to the sky.
HWY_INLINE AirWay WayTo(const ViewRays& rays, const PlaceShown& at) {
  const V length2 = Dot(at.way, at.way), inverse = InverseSqrt(length2);
  const V distance = at.depth * (length2 * inverse);
  return {at.way * inverse, IfThenElse(at.is_surface, distance, kEndless_m),
          IfThenElse(at.is_surface, at.height + rays.eye_z, kEndless_m), rays.eye_z};
}

// Some pixels of a tile: their places in the tile, in its buffers and in the window, and what
// stands in its depth buffer, 0 of the sky.
struct PixelsShown {
  int x, y;
  std::size_t at;
  V x_px, y_px, z;
};

// Calls lay(pixels, light) for all pixels of a tile, which returns whether it has changed the light
// that stands in the scratch.
template <class Lay>
HWY_INLINE void LayOverPixels(const Shading& s, const TilePixels& tile, ShadeScratch& scratch,
                              const Lay& lay) {
  const D d;
  const raster::PixelBox& box = tile.box;
  for (int y = 0; y < box.height_px; ++y) {
    const V y_px = Constant(static_cast<float>(box.y0_px + y));
    for (int x = 0; x < box.width_px; x += static_cast<int>(kLanes)) {
      const std::size_t at = static_cast<std::size_t>(y) * s.grid.tile_size_px + x;
      const V x_px = hn::ConvertTo(d, CountFrom(box.x0_px + x));
      const V z = tile.depth ? hn::LoadU(d, tile.depth + at) : hn::Zero(d);
      V3 light = ReadLight(scratch, at);
      if (lay(PixelsShown{x, y, at, x_px, y_px, z}, light)) WriteLight(light, at, scratch);
    }
  }
}

// The passes of a medium M that is found for each pixel alone, by M::Through(s, way, light).
// M::kBeforeSky: whether it is laid before the sky, too.
template <class M>
struct LaidByPixel {
  static HWY_INLINE V3 Lay(const Shading& s, V x_px, V y_px, V z, V3 light) {
    const PlaceShown at = FindPlace(s, x_px, y_px, z);
    const V3 seen = M::Through(s, WayTo(s.rays, at), light);
    return M::kBeforeSky ? seen : IfThenElse(at.is_surface, seen, light);
  }
  static void LayOverTile(const Shading& s, const TilePixels& tile, ShadeScratch& scratch) {
    LayOverPixels(s, tile, scratch, [&](const PixelsShown& p, V3& light) HWY_ATTR {
      if (!M::kBeforeSky && hn::AllFalse(D(), p.z > 0.0f)) return false;
      light = Lay(s, p.x_px, p.y_px, p.z, light);
      return true;
    });
  }
  static void LayOverFragments(const Shading& s, std::span<const EdgeFragment> fragments,
                               ShadeScratch& scratch) {
    LayOverEachFragment(fragments, scratch, [&](const FragmentsShown& f, V3 light) HWY_ATTR {
      return Lay(s, f.x_px, f.y_px, f.z, light);
    });
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
