#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "math/check.h"
#include "render/tile/shade_tile.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/tile/shade_tile_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/labels/keep_labels-inl.h"
#include "render/materials/list-inl.h"
#include "render/tile/air_tile-inl.h"
#include "render/tile/attenuate-inl.h"
#include "render/tile/cloud_deck-inl.h"
#include "render/tile/cloud_picture-inl.h"
#include "render/tile/packet-inl.h"
#include "render/tile/pixel_lists-inl.h"
#include "render/tile/resolve-inl.h"
#include "render/tile/sky-inl.h"
#include "render/tile/surfel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// Where a packet's pixels, or parts of pixels, lie in the window, and what they show.
struct ListedPacket {
  Lanes lanes;
  V x_px, y_px, z;
};

// Listed pixels, a packet from `at` on.
struct PixelsInTile {
  const Shading& s;
  const TilePixels& tile;
  const PixelList& list;
  ShadeScratch& scratch;

  // A run of neighbours is loaded and stored whole; a padded packet is none.
  HWY_INLINE bool IsRun(std::size_t i) const {
    return i + kLanes <= list.count &&
           list.at[i + kLanes - 1] - list.at[i] == static_cast<int>(kLanes) - 1;
  }

  HWY_INLINE ListedPacket Load(std::size_t i) const {
    const D d;
    const DI di;
    const hn::Rebind<std::uint16_t, D> d16;
    const std::uint16_t* at = list.at + i;
    const int size_log2 = std::countr_zero(static_cast<unsigned>(s.grid.tile_size_px));
    const VI index = hn::PromoteTo(di, hn::LoadU(d16, at));
    const VI y = hn::ShiftRightSame(index, size_log2);
    const VI x = hn::Sub(index, hn::ShiftLeftSame(y, size_log2));
    HWY_ALIGN std::array<float, kLanes> z;
    const bool run = IsRun(i);
    if (!run)
      for (std::size_t lane = 0; lane < kLanes; ++lane) z[lane] = tile.depth[at[lane]];
    return {Lanes{tile.primitive, at}, hn::ConvertTo(d, hn::Add(x, hn::Set(di, tile.box.x0_px))),
            hn::ConvertTo(d, hn::Add(y, hn::Set(di, tile.box.y0_px))),
            hn::LoadU(d, run ? tile.depth + at[0] : z.data())};
  }

  HWY_INLINE void Store(std::size_t i, const V3& colour) const {
    const D d;
    const std::uint16_t* at = list.at + i;
    if (IsRun(i)) {
      hn::StoreU(colour.x, d, scratch.red.data() + at[0]);
      hn::StoreU(colour.y, d, scratch.green.data() + at[0]);
      hn::StoreU(colour.z, d, scratch.blue.data() + at[0]);
      return;
    }
    HWY_ALIGN std::array<float, kLanes> red, green, blue;
    hn::Store(colour.x, d, red.data());
    hn::Store(colour.y, d, green.data());
    hn::Store(colour.z, d, blue.data());
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      scratch.red[at[lane]] = red[lane];
      scratch.green[at[lane]] = green[lane];
      scratch.blue[at[lane]] = blue[lane];
    }
  }
};

// Listed fragments, the same way.
struct FragmentsInTile {
  std::span<const EdgeFragment> fragments;
  const PixelList& list;
  ShadeScratch& scratch;

  HWY_INLINE ListedPacket Load(std::size_t i) const {
    const D d;
    const std::uint16_t* at = list.at + i;
    HWY_ALIGN std::array<float, kLanes> x, y, z;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const EdgeFragment& fragment = fragments[at[lane]];
      x[lane] = fragment.x_px, y[lane] = fragment.y_px, z[lane] = fragment.z;
    }
    return {Lanes{scratch.fragment_primitive.data(), at}, hn::Load(d, x.data()),
            hn::Load(d, y.data()), hn::Load(d, z.data())};
  }

  HWY_INLINE void Store(std::size_t i, const V3& colour) const {
    const D d;
    const std::uint16_t* at = list.at + i;
    HWY_ALIGN std::array<float, kLanes> red, green, blue;
    hn::Store(colour.x, d, red.data());
    hn::Store(colour.y, d, green.data());
    hn::Store(colour.z, d, blue.data());
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      scratch.fragment_red[at[lane]] = red[lane];
      scratch.fragment_green[at[lane]] = green[lane];
      scratch.fragment_blue[at[lane]] = blue[lane];
    }
  }
};

// Calls shade(packet) for what is listed and stores the colours.
template <class Listed, class Shade>
HWY_INLINE void ShadeList(const Listed& listed, const Shade& shade) {
  for (std::size_t i = 0; i < listed.list.count; i += kLanes)
    listed.Store(i, shade(listed.Load(i)));
}

// The same for packets side by side: shade(packets, colours).
template <class Listed, class Shade>
HWY_INLINE void ShadeSideBySide(const Listed& listed, const Shade& shade) {
  PerPacket<ListedPacket> packets;
  PerPacket<V3> colours;
  for (std::size_t i = 0; i < listed.list.count; i += kMostPacketsAtOnce * kLanes) {
    const std::size_t pixels = std::min(listed.list.count - i, kMostPacketsAtOnce * kLanes);
    const std::size_t count = (pixels + kLanes - 1) / kLanes;
    for (std::size_t k = 0; k < count; ++k) packets[k] = listed.Load(i + k * kLanes);
    shade(std::span<const ListedPacket>(packets.data(), count), colours.data());
    for (std::size_t k = 0; k < count; ++k) listed.Store(i + k * kLanes, colours[k]);
  }
}

// The light of a packet's pixels as it arrives, but for air that is laid last. What labels want of
// the window's goes to `keep`.
template <ViewKind kView, class M, class Shade, class Keep, class... Found>
HWY_INLINE V3 ArrivingLight(const Shading& s, const TilePixels& tile, const M& material,
                            const Lanes& lanes, const Packet& shown, const Shade& shade,
                            const Keep& keep, const Found&... found) {
  if constexpr (kView == ViewKind::kWindow) {
    const auto surfel = shade(s, tile, lanes, shown, found...);
    keep(lanes.at, surfel);
    if (s.media.submerged) {
      const V shafts = ShaftsBefore(s, tile.box, tile.shafts, shown.x_px, shown.y_px,
                                    hn::Neg(shown.to_eye.z), shown.distance);
      return SeenInWater<M::kSurface>(s.media, WaterLevel(material, s, lanes), shown, surfel.light,
                                      shafts);
    }
    if (IsAirLaidLast(s)) return surfel.light;
    const V3 light = ThroughAir(s, shown, surfel.light);
    return s.light.clouds.is_below ? CloudsBefore(s, shown, light) : light;
  } else {
    const Seen seen = FindSeen<kView>(s, shown, WaterLevel(material, s, lanes));
    const auto surfel = shade(s, tile, lanes, seen.packet, found...);
    const V3 light = Attenuate<kView>(s, shown, seen, surfel.light);
    if constexpr (requires { surfel.cover; })
      return s.media.submerged ? light : Lerp(Constant(s.media.body), light, surfel.cover);
    else
      return light;
  }
}

// The light of packets side by side. A function of its own: pixels and fragments share it.
template <class M, class Shade, class Keep>
HWY_NOINLINE void ArrivingLights(const Shading& s, const TilePixels& tile, const M& material,
                                 const Shade& shade, const Keep& keep,
                                 std::span<const ListedPacket> packets, V3* lights) {
  PerPacket<Packet> shown;
  PerPacket<typename Shade::Found> found;
  for (std::size_t k = 0; k < packets.size(); ++k)
    shown[k] = MakePacket(s.rays, packets[k].x_px, packets[k].y_px, packets[k].z);
  shade.LookUp(s, std::span<const Packet>(shown.data(), packets.size()), found.data());
  for (std::size_t k = 0; k < packets.size(); ++k)
    lights[k] = ArrivingLight<ViewKind::kWindow>(s, tile, material, packets[k].lanes, shown[k],
                                                 shade, keep, found[k]);
}

// Labels are of the pixels' centres alone: fragments keep nothing.
template <ViewKind kView, class M, class Keep>
HWY_INLINE void ShadeMaterial(const Shading& s, const TilePixels& tile, const PixelList& list,
                              ShadeScratch& scratch, const Keep& keep) {
  const M& material = s.material<M>();
  WithShader<kView>(material, [&]<class Shade>(const Shade& shade) HWY_ATTR {
    const auto shade_list = [&](const auto& listed, const auto& kept) HWY_ATTR {
      // Elsewhere what is shown is not where it seems to be.
      if constexpr (kView == ViewKind::kWindow && LooksUpSideBySide<Shade>) {
        ShadeSideBySide(listed, [&](std::span<const ListedPacket> packets, V3* lights) HWY_ATTR {
          ArrivingLights(s, tile, material, shade, kept, packets, lights);
        });
      } else {
        ShadeList(listed, [&](const ListedPacket& packet) HWY_ATTR {
          const Packet shown = MakePacket(s.rays, packet.x_px, packet.y_px, packet.z);
          return ArrivingLight<kView>(s, tile, material, packet.lanes, shown, shade, kept);
        });
      }
    };
    shade_list(PixelsInTile{s, tile, list, scratch}, keep);
    if (kView != ViewKind::kWindow || tile.fragments.empty()) return;
    const PixelList parts = ListFragments(tile.fragments, s.primitives.begin(M::kSurface),
                                          s.primitives.end(M::kSurface), scratch);
    shade_list(FragmentsInTile{tile.fragments, parts, scratch}, KeepNothing());
  });
}

// Shades the pixels of all materials and returns their number.
template <ViewKind kView, class Keep>
HWY_INLINE std::size_t ShadeSurfaces(const Shading& s, const TilePixels& tile,
                                     const PixelLists& lists, ShadeScratch& scratch,
                                     const Keep& keep) {
  const auto shade_all = [&]<std::size_t... k>(std::index_sequence<k...>) HWY_ATTR {
    (ShadeMaterial<kView, std::tuple_element_t<k, Materials>>(s, tile, lists[k], scratch, keep),
     ...);
    return (lists[k].count + ... + 0);
  };
  return shade_all(std::make_index_sequence<kMaterialCount>());
}

// Shades the sky's pixels before those of surfaces: whole packets that have any, which writes to
// all of their pixels.
void ShadeSkyPackets(const Shading& s, const TilePixels& tile, const PixelList& packets,
                     ShadeScratch& scratch) {
  if (packets.count == 0) return;
  const int last_row = packets.at[packets.count - 1] / s.grid.tile_size_px;
  const SkyLattice lattice = MakeSkyLattice(s, tile.box, last_row + 1, tile.shafts, scratch.sky);
  for (std::size_t n = 0; n < packets.count; ++n) {
    const int i = packets.at[n], y = i / s.grid.tile_size_px, x = i % s.grid.tile_size_px;
    WriteLight(SkyOfPacket(s, tile.box, lattice, x, y), packets.at[n], scratch);
  }
}

template <class Keep>
HWY_INLINE int ShadeAllPixels(const Shading& s, const TilePixels& tile, ShadeScratch& scratch,
                              std::uint32_t* rgba, float* linear, const Keep& keep) {
  const PixelLists lists = ListPixels(s, tile, scratch);
  ShadeSkyPackets(s, tile, lists[kSky], scratch);
  const std::size_t shaded = ShadeSurfaces<ViewKind::kWindow>(s, tile, lists, scratch, keep);
  if (!tile.fragments.empty()) {
    const PixelList parts = ListFragments(tile.fragments, raster::kNoPrimitive, 0, scratch);
    ShadeList(FragmentsInTile{tile.fragments, parts, scratch},
              [&](const ListedPacket& packet) HWY_ATTR {
                return ShadeSky(s, tile.box, tile.shafts, packet.x_px, packet.y_px);
              });
  }
  LayAirOverTile(s, tile.box, tile.depth, scratch);
  LayAirOverFragments(s, tile.fragments, scratch);
  LayCloudsOverFragments(s, tile.fragments, scratch);
  LayCloudsOverTile(s, tile.box, tile.depth, scratch);
  ResolveTile(s, tile.box, scratch, rgba, linear);
  if (!tile.fragments.empty()) ResolveFragments(s, tile, scratch, rgba, linear);
  return static_cast<int>(shaded);
}

TilePixels PixelsOf(const Shading& s, const TileInput& input, ShadeScratch& scratch) {
  for (std::size_t n = 0; n < input.fragments.size(); ++n)
    scratch.fragment_primitive[n] = input.fragments[n].primitive;
  const raster::PixelBox box = raster::tile_box(s.viewport, s.grid, input.tile);
  const auto casters = s.sun_shadow.casters.of_tile(input.tile);
  return {box,
          input.depth.data(),
          input.primitive.data(),
          input.fragments,
          input.lookups,
          casters,
          FindShafts(s, box, casters, scratch.shafts)};
}

int ShadeTile(const Shading& s, const TileInput& input, ShadeScratch& scratch, std::uint32_t* rgba,
              float* linear) {
  return ShadeAllPixels(s, PixelsOf(s, input, scratch), scratch, rgba, linear, KeepNothing());
}

// A function of its own: what labels take costs registers.
int ShadeLabelledTile(const Shading& s, const TileInput& input, ShadeScratch& scratch,
                      std::uint32_t* rgba, float* linear, ShadedLabels& labels) {
  return ShadeAllPixels(s, PixelsOf(s, input, scratch), scratch, rgba, linear, KeepLabels{labels});
}

void ShadeSkyTile(const Shading& s, int tile, ShadeScratch& scratch, std::uint32_t* rgba,
                  float* linear) {
  const raster::PixelBox box = raster::tile_box(s.viewport, s.grid, tile);
  const std::int32_t* const shafts =
      FindShafts(s, box, s.sun_shadow.casters.of_tile(tile), scratch.shafts);
  const SkyLattice lattice = MakeSkyLattice(s, box, box.height_px, shafts, scratch.sky);
  for (int y = 0; y < box.height_px; ++y)
    for (int x = 0; x < box.width_px; x += static_cast<int>(kLanes))
      WriteLight(SkyOfPacket(s, box, lattice, x, y),
                 static_cast<std::size_t>(y) * s.grid.tile_size_px + x, scratch);
  LayCloudsOverTile(s, box, nullptr, scratch);
  ResolveTile(s, box, scratch, rgba, linear);
}

// Writes a tile's colours to the lookup image, zeros where there is no primitive and so no colour.
HWY_INLINE void EncodeLookupTile(const Shading& s, const raster::PixelBox& box,
                                 const std::uint32_t* primitive, const ShadeScratch& scratch,
                                 texture::RgbaImage& image) {
  const hn::RebindToUnsigned<D> du;
  HWY_ALIGN std::array<std::uint32_t, kLanes> tail;
  const auto width = static_cast<std::size_t>(box.width_px);
  for (int y = 0; y < box.height_px; ++y) {
    std::uint32_t* row =
        image.texels.data() + static_cast<std::size_t>(box.y0_px + y) * image.stride + box.x0_px;
    for (std::size_t x = 0; x < width; x += kLanes) {
      const std::size_t i = static_cast<std::size_t>(y) * s.grid.tile_size_px + x;
      const V3 light = ReadLight(scratch, i);
      const VI r = EncodeLight(light.x), g = EncodeLight(light.y), b = EncodeLight(light.z);
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

void ShadeLookupTile(const Shading& s, int tile_index, const float* depth,
                     const std::uint32_t* primitive, ShadeScratch& scratch,
                     texture::RgbaImage& image) {
  const TilePixels tile{raster::tile_box(s.viewport, s.grid, tile_index), depth, primitive, {}, {},
                        s.sun_shadow.casters.of_tile(tile_index)};
  const PixelLists lists = ListPixels(s, tile, scratch);
  if (s.kind == ViewKind::kRefraction)
    ShadeSurfaces<ViewKind::kRefraction>(s, tile, lists, scratch, KeepNothing());
  else
    ShadeSurfaces<ViewKind::kReflection>(s, tile, lists, scratch, KeepNothing());
  EncodeLookupTile(s, tile.box, primitive, scratch, image);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::render {

HWY_EXPORT(ShadeTile);
HWY_EXPORT(ShadeLabelledTile);
HWY_EXPORT(ShadeSkyTile);
HWY_EXPORT(ShadeLookupTile);

namespace {

void check_picture(const Shading& s, std::span<const std::uint32_t> rgba,
                   std::span<const float> linear) {
  const std::size_t pixels = static_cast<std::size_t>(s.viewport.width_px) * s.viewport.height_px;
  SWELL_CHECK(rgba.size() == pixels && (linear.empty() || linear.size() == 3 * pixels),
              "{} pixels, {} linear of {}x{}", rgba.size(), linear.size(), s.viewport.width_px,
              s.viewport.height_px);
}

void check_tile(const Shading& s, std::span<const float> depth,
                std::span<const std::uint32_t> primitive) {
  const auto side = static_cast<std::size_t>(s.grid.tile_size_px);
  SWELL_CHECK(depth.size() == side * side && primitive.size() == side * side,
              "depth={} primitive={} tile_size_px={}", depth.size(), primitive.size(), side);
}

}  // namespace

int shade_tile(const Shading& shading, const TileInput& input, ShadeScratch& scratch,
               std::span<std::uint32_t> rgba, std::span<float> linear, ShadedLabels* labels) {
  check_tile(shading, input.depth, input.primitive);
  check_picture(shading, rgba, linear);
  SWELL_CHECK(input.fragments.size() <= kMaxTileFragments, "fragments={}", input.fragments.size());
  float* const light = linear.empty() ? nullptr : linear.data();
  if (labels)
    return HWY_DYNAMIC_DISPATCH(ShadeLabelledTile)(shading, input, scratch, rgba.data(), light,
                                                   *labels);
  return HWY_DYNAMIC_DISPATCH(ShadeTile)(shading, input, scratch, rgba.data(), light);
}

void shade_sky_tile(const Shading& shading, int tile, ShadeScratch& scratch,
                    std::span<std::uint32_t> rgba, std::span<float> linear) {
  check_picture(shading, rgba, linear);
  HWY_DYNAMIC_DISPATCH(ShadeSkyTile)
  (shading, tile, scratch, rgba.data(), linear.empty() ? nullptr : linear.data());
}

void shade_lookup_tile(const Shading& shading, int tile, std::span<const float> depth,
                       std::span<const std::uint32_t> primitive, ShadeScratch& scratch,
                       texture::RgbaImage& image) {
  check_tile(shading, depth, primitive);
  HWY_DYNAMIC_DISPATCH(ShadeLookupTile)
  (shading, tile, depth.data(), primitive.data(), scratch, image);
}

}  // namespace swell::render
#endif  // HWY_ONCE
