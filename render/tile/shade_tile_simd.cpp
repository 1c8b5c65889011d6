#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "math/check.h"
#include "render/tile/shade_tile.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/tile/shade_tile_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/materials/object-inl.h"
#include "render/materials/terrain-inl.h"
#include "render/materials/water-inl.h"
#include "render/tile/packet-inl.h"
#include "render/tile/sky-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

constexpr std::size_t kLanes = hn::MaxLanes(D());

// The pixels of one material in a tile, as positions y * tile_size + x in its buffers.
struct PixelList {
  std::uint16_t* at;
  std::size_t count = 0;
};

// Repeats the last pixel up to a full packet, so that every packet is shaded whole.
void PadToPacket(PixelList& list) {
  if (list.count == 0) return;
  const std::uint16_t last = list.at[list.count - 1];
  std::fill_n(list.at + list.count, kLanes, last);
}

// Appends pixels `first` and the kLanes - 1 after it.
HWY_INLINE void AppendPacket(PixelList& list, std::size_t first) {
  const hn::Rebind<std::uint16_t, D> d16;
  hn::StoreU(hn::Iota(d16, static_cast<std::uint16_t>(first)), d16, list.at + list.count);
  list.count += kLanes;
}

// Sorts the tile's pixels by material, whole packets of one material at once.
void SortByMaterial(const ShadeContext& c, const raster::PixelBox& box,
                    const std::uint32_t* primitive, PixelList& water, PixelList& terrain,
                    PixelList& sky) {
  const hn::RebindToUnsigned<D> du;
  const auto water_end = hn::Set(du, c.water_primitives);
  for (int y = 0; y < box.height_px; ++y) {
    const std::size_t row = static_cast<std::size_t>(y) * c.grid.tile_size_px;
    const auto width = static_cast<std::size_t>(box.width_px);
    for (std::size_t x = 0; x < width;) {
      const std::size_t i = row + x;
      if (x + kLanes <= width && hn::AllTrue(du, hn::Lt(hn::LoadU(du, primitive + i), water_end))) {
        AppendPacket(water, i);
        x += kLanes;
        continue;
      }
      const std::size_t end = std::min(x + kLanes, width);
      for (; x < end; ++x) {
        // Branch-free: write to all three lists, advance one.
        const std::uint32_t p = primitive[row + x];
        const auto index = static_cast<std::uint16_t>(row + x);
        water.at[water.count] = terrain.at[terrain.count] = sky.at[sky.count] = index;
        const bool is_water = p < c.water_primitives, is_sky = p == raster::kNoPrimitive;
        water.count += is_water;
        sky.count += is_sky;
        terrain.count += !is_water && !is_sky;
      }
    }
  }
  PadToPacket(water);
  PadToPacket(terrain);
  PadToPacket(sky);
}

// Moves the objects' pixels out of the list of terrain, which keeps its order.
void SplitObjects(const ShadeContext& c, const std::uint32_t* primitive, PixelList& terrain,
                  PixelList& objects) {
  if (c.object_primitives.empty()) return;
  const std::size_t count = std::exchange(terrain.count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint16_t at = terrain.at[i];
    PixelList& list = primitive[at] < c.first_object ? terrain : objects;
    list.at[list.count++] = at;
  }
  PadToPacket(terrain);
  PadToPacket(objects);
}

// The primitives of the pixels at[0] to at[kLanes - 1].
using ObjectPacket = std::array<const ObjectPrimitive*, kLanes>;
ObjectPacket ObjectsAt(const ShadeContext& c, const std::uint32_t* primitive,
                       const std::uint16_t* at) {
  ObjectPacket packet;
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    packet[lane] = &c.object_primitives[primitive[at[lane]] - c.first_object];
  return packet;
}

// Calls shade(at, x_px, y_px, z) for the list's pixels, a packet at a time, and stores its colours.
// `at`: the packet's part of the list.
template <class Shade>
HWY_INLINE void ShadeList(const ShadeContext& c, const raster::PixelBox& box, const PixelList& list,
                          const float* depth, ShadeScratch& scratch, const Shade& shade) {
  const D d;
  const DI di;
  const hn::Rebind<std::uint16_t, D> d16;
  const int size_log2 = std::countr_zero(static_cast<unsigned>(c.grid.tile_size_px));
  HWY_ALIGN std::array<float, kLanes> z, red, green, blue;
  for (std::size_t i = 0; i < list.count; i += kLanes) {
    const std::uint16_t* at = list.at + i;
    const VI index = hn::PromoteTo(di, hn::LoadU(d16, at));
    const VI y = hn::ShiftRightSame(index, size_log2);
    const VI x = hn::Sub(index, hn::ShiftLeftSame(y, size_log2));
    const V x_px = hn::ConvertTo(d, hn::Add(x, hn::Set(di, box.x0_px)));
    const V y_px = hn::ConvertTo(d, hn::Add(y, hn::Set(di, box.y0_px)));

    // A run of neighbours is loaded and stored whole; a padded packet is none.
    const bool run =
        i + kLanes <= list.count && at[kLanes - 1] - at[0] == static_cast<int>(kLanes) - 1;
    if (!run)
      for (std::size_t lane = 0; lane < kLanes; ++lane) z[lane] = depth[at[lane]];
    const V3 colour = shade(at, x_px, y_px, hn::LoadU(d, run ? depth + at[0] : z.data()));
    if (run) {
      hn::StoreU(colour.x, d, scratch.red.data() + at[0]);
      hn::StoreU(colour.y, d, scratch.green.data() + at[0]);
      hn::StoreU(colour.z, d, scratch.blue.data() + at[0]);
      continue;
    }
    hn::Store(colour.x, d, red.data());
    hn::Store(colour.y, d, green.data());
    hn::Store(colour.z, d, blue.data());
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      scratch.red[at[lane]] = red[lane];
      scratch.green[at[lane]] = green[lane];
      scratch.blue[at[lane]] = blue[lane];
    }
  }
}

// The sRGB curve times 255, for linear x in [0, 1]. Error 0.09. Above the linear part a polynomial
// in sqrt(x), fitted by weighted least squares to 1.055 x^(1/2.4) - 0.055.
HWY_INLINE V EncodeSrgb(V x) {
  const V s = hn::Sqrt(x);
  V p = Constant(0.5172983f);
  p = hn::MulAdd(p, s, Constant(-1.6236454f));
  p = hn::MulAdd(p, s, Constant(2.0315608f));
  p = hn::MulAdd(p, s, Constant(-1.4027299f));
  p = hn::MulAdd(p, s, Constant(1.5179496f));
  p = hn::MulAdd(p, s, Constant(-0.0401095f));
  const V curve = hn::IfThenElse(hn::Lt(x, Constant(0.0031308f)), hn::Mul(x, Constant(12.92f)), p);
  return hn::Mul(curve, Constant(255.0f));
}

// Resolve: exposure, a shoulder from 0.7 up that reaches white at infinity only (so that glitter
// keeps its form), sRGB, a dither of one step, 8 bits.
HWY_INLINE VI ToByte(V linear, V exposure, V dither) {
  const V x = hn::Max(hn::Mul(linear, exposure), hn::Zero(D()));
  const V over = hn::Max(hn::Sub(x, Constant(0.7f)), hn::Zero(D()));
  V mapped = x;
  if (!hn::AllFalse(D(), hn::Gt(over, hn::Zero(D())))) {
    const V shoulder = hn::Div(over, hn::MulAdd(over, Constant(1.0f / 0.3f), Constant(1.0f)));
    mapped = hn::Min(hn::Add(hn::Min(x, Constant(0.7f)), shoulder), Constant(1.0f));
  }
  const V code = hn::Add(EncodeSrgb(mapped), dither);
  return hn::ConvertTo(DI(), hn::Min(code, Constant(255.0f)));
}

HWY_INLINE void ResolveTile(const ShadeContext& c, const raster::PixelBox& box,
                            const ShadeScratch& scratch, std::uint32_t* rgba, float* linear) {
  const D d;
  const DI di;
  const V exposure = Constant(c.exposure);
  HWY_ALIGN std::array<std::int32_t, kLanes> tail;
  for (int y = 0; y < box.height_px; ++y) {
    std::uint32_t* row =
        rgba + static_cast<std::size_t>(box.y0_px + y) * c.viewport.width_px + box.x0_px;
    for (int x = 0; x < box.width_px; x += static_cast<int>(kLanes)) {
      const std::size_t i = static_cast<std::size_t>(y) * c.grid.tile_size_px + x;
      const V dither = PixelNoise(hn::ConvertTo(d, hn::Iota(di, box.x0_px + x)),
                                  Constant(static_cast<float>(box.y0_px + y)));
      const VI r = ToByte(hn::Load(d, scratch.red.data() + i), exposure, dither);
      const VI g = ToByte(hn::Load(d, scratch.green.data() + i), exposure, dither);
      const VI b = ToByte(hn::Load(d, scratch.blue.data() + i), exposure, dither);
      const VI pixel =
          hn::Or(hn::Or(r, hn::ShiftLeft<8>(g)),
                 hn::Or(hn::ShiftLeft<16>(b), hn::Set(di, static_cast<std::int32_t>(0xff000000u))));
      if (x + static_cast<int>(kLanes) <= box.width_px) {
        hn::StoreU(pixel, di, reinterpret_cast<std::int32_t*>(row + x));
      } else {
        hn::Store(pixel, di, tail.data());
        std::copy_n(tail.data(), box.width_px - x, reinterpret_cast<std::int32_t*>(row + x));
      }
    }
    if (!linear) continue;
    for (int x = 0; x < box.width_px; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * c.grid.tile_size_px + x;
      float* out = linear + 3 * (static_cast<std::size_t>(box.y0_px + y) * c.viewport.width_px +
                                 box.x0_px + x);
      out[0] = scratch.red[i];
      out[1] = scratch.green[i];
      out[2] = scratch.blue[i];
    }
  }
}

int ShadeTile(const ShadeContext& c, int tile, const float* depth, const std::uint32_t* primitive,
              TileLookups lookups, ShadeScratch& scratch, std::uint32_t* rgba, float* linear) {
  const raster::PixelBox box = raster::tile_box(c.viewport, c.grid, tile);
  PixelList water{scratch.water.data()}, terrain{scratch.terrain.data()}, sky{scratch.sky.data()};
  PixelList objects{scratch.objects.data()};
  using At = const std::uint16_t*;
  SortByMaterial(c, box, primitive, water, terrain, sky);
  SplitObjects(c, primitive, terrain, objects);
  if (c.has_coast)
    ShadeList(c, box, water, depth, scratch, [&](At, V x, V y, V z) HWY_ATTR {
      return ShadeWater<true>(c, MakePacket(c, x, y, z), lookups);
    });
  else
    ShadeList(c, box, water, depth, scratch, [&](At, V x, V y, V z) HWY_ATTR {
      return ShadeWater<false>(c, MakePacket(c, x, y, z), lookups);
    });
  ShadeList(c, box, terrain, depth, scratch,
            [&](At, V x, V y, V z) HWY_ATTR { return ShadeTerrain(c, MakePacket(c, x, y, z)); });
  ShadeList(c, box, objects, depth, scratch, [&](At at, V x, V y, V z) HWY_ATTR {
    return ShadeObject(c, MakePacket(c, x, y, z), ObjectsAt(c, primitive, at).data());
  });
  ShadeList(c, box, sky, depth, scratch,
            [&](At, V x, V y, V) HWY_ATTR { return ShadeSky(c, x, y); });
  ResolveTile(c, box, scratch, rgba, linear);
  return static_cast<int>(water.count + terrain.count + objects.count);
}

void ShadeSkyTile(const ShadeContext& c, int tile, ShadeScratch& scratch, std::uint32_t* rgba,
                  float* linear) {
  const D d;
  const raster::PixelBox box = raster::tile_box(c.viewport, c.grid, tile);
  for (int y = 0; y < box.height_px; ++y) {
    const V y_px = Constant(static_cast<float>(box.y0_px + y));
    for (int x = 0; x < box.width_px; x += static_cast<int>(kLanes)) {
      const std::size_t i = static_cast<std::size_t>(y) * c.grid.tile_size_px + x;
      const V3 colour = ShadeSky(c, hn::ConvertTo(d, hn::Iota(DI(), box.x0_px + x)), y_px);
      hn::Store(colour.x, d, scratch.red.data() + i);
      hn::Store(colour.y, d, scratch.green.data() + i);
      hn::Store(colour.z, d, scratch.blue.data() + i);
    }
  }
  ResolveTile(c, box, scratch, rgba, linear);
}

// Radiance as a byte of a lookup image.
HWY_INLINE VI EncodeRadiance(V radiance) {
  const V scaled = hn::Mul(hn::Max(radiance, hn::Zero(D())), Constant(1.0f / kLookupRange));
  const V code = hn::Min(hn::Mul(hn::Sqrt(scaled), Constant(255.0f)), Constant(255.0f));
  return hn::ConvertTo(DI(), hn::Add(code, Constant(0.5f)));
}

// Writes a tile's colours to the lookup image, zeros where there is no primitive and so no colour.
HWY_INLINE void EncodeLookupTile(const ShadeContext& c, const raster::PixelBox& box,
                                 const std::uint32_t* primitive, const ShadeScratch& scratch,
                                 texture::RgbaImage& image) {
  const D d;
  const hn::RebindToUnsigned<D> du;
  HWY_ALIGN std::array<std::uint32_t, kLanes> tail;
  const auto width = static_cast<std::size_t>(box.width_px);
  for (int y = 0; y < box.height_px; ++y) {
    std::uint32_t* row =
        image.texels.data() + static_cast<std::size_t>(box.y0_px + y) * image.stride + box.x0_px;
    for (std::size_t x = 0; x < width; x += kLanes) {
      const std::size_t i = static_cast<std::size_t>(y) * c.grid.tile_size_px + x;
      const VI r = EncodeRadiance(hn::Load(d, scratch.red.data() + i));
      const VI g = EncodeRadiance(hn::Load(d, scratch.green.data() + i));
      const VI b = EncodeRadiance(hn::Load(d, scratch.blue.data() + i));
      const VI rgb = hn::Or(hn::Or(r, hn::ShiftLeft<8>(g)), hn::ShiftLeft<16>(b));
      const auto texel = hn::Or(hn::BitCast(du, rgb), hn::Set(du, 0xff000000u));
      const auto drawn = hn::Ne(hn::LoadU(du, primitive + i), hn::Set(du, raster::kNoPrimitive));
      const auto result = hn::IfThenElseZero(drawn, texel);
      if (x + kLanes <= width) {
        hn::StoreU(result, du, row + x);
        continue;
      }
      hn::Store(result, du, tail.data());
      std::copy_n(tail.begin(), width - x, row + x);
    }
  }
}

void ShadeLookupTile(const ShadeContext& c, int tile, const float* depth,
                     const std::uint32_t* primitive, ShadeScratch& scratch,
                     texture::RgbaImage& image) {
  const raster::PixelBox box = raster::tile_box(c.viewport, c.grid, tile);
  PixelList water{scratch.water.data()}, terrain{scratch.terrain.data()}, sky{scratch.sky.data()};
  PixelList objects{scratch.objects.data()};
  using At = const std::uint16_t*;
  SortByMaterial(c, box, primitive, water, terrain, sky);
  SplitObjects(c, primitive, terrain, objects);
  const bool submerged = c.kind == ViewKind::kRefraction;
  ShadeList(c, box, terrain, depth, scratch, [&](At, V x, V y, V z) HWY_ATTR {
    const Packet packet = MakePacket(c, x, y, z);
    return submerged ? ShadeSubmerged(c, packet) : ShadeMirrored(c, packet);
  });
  ShadeList(c, box, objects, depth, scratch, [&](At at, V x, V y, V z) HWY_ATTR {
    const Packet packet = MakePacket(c, x, y, z);
    const ObjectPacket shown = ObjectsAt(c, primitive, at);
    return submerged ? ShadeSubmergedObject(c, packet, shown.data())
                     : ShadeObject(c, packet, shown.data());
  });
  EncodeLookupTile(c, box, primitive, scratch, image);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::render {

HWY_EXPORT(ShadeTile);
HWY_EXPORT(ShadeSkyTile);
HWY_EXPORT(ShadeLookupTile);

namespace {

void check_picture(const ShadeContext& c, std::span<const std::uint32_t> rgba,
                   std::span<const float> linear) {
  const std::size_t pixels = static_cast<std::size_t>(c.viewport.width_px) * c.viewport.height_px;
  SWELL_CHECK(rgba.size() == pixels && (linear.empty() || linear.size() == 3 * pixels),
              "{} pixels, {} linear of {}x{}", rgba.size(), linear.size(), c.viewport.width_px,
              c.viewport.height_px);
}

void check_tile(const ShadeContext& c, std::span<const float> depth,
                std::span<const std::uint32_t> primitive) {
  const auto side = static_cast<std::size_t>(c.grid.tile_size_px);
  SWELL_CHECK(depth.size() == side * side && primitive.size() == side * side,
              "depth={} primitive={} tile_size_px={}", depth.size(), primitive.size(), side);
}

}  // namespace

int shade_tile(const ShadeContext& context, int tile, std::span<const float> depth,
               std::span<const std::uint32_t> primitive, TileLookups lookups, ShadeScratch& scratch,
               std::span<std::uint32_t> rgba, std::span<float> linear) {
  check_tile(context, depth, primitive);
  check_picture(context, rgba, linear);
  return HWY_DYNAMIC_DISPATCH(ShadeTile)(context, tile, depth.data(), primitive.data(), lookups,
                                         scratch, rgba.data(),
                                         linear.empty() ? nullptr : linear.data());
}

void shade_sky_tile(const ShadeContext& context, int tile, ShadeScratch& scratch,
                    std::span<std::uint32_t> rgba, std::span<float> linear) {
  check_picture(context, rgba, linear);
  HWY_DYNAMIC_DISPATCH(ShadeSkyTile)
  (context, tile, scratch, rgba.data(), linear.empty() ? nullptr : linear.data());
}

void shade_lookup_tile(const ShadeContext& context, int tile, std::span<const float> depth,
                       std::span<const std::uint32_t> primitive, ShadeScratch& scratch,
                       texture::RgbaImage& image) {
  check_tile(context, depth, primitive);
  HWY_DYNAMIC_DISPATCH(ShadeLookupTile)
  (context, tile, depth.data(), primitive.data(), scratch, image);
}

}  // namespace swell::render
#endif  // HWY_ONCE
