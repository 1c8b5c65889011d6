#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "math/check.h"
#include "render/shade/shade_tile.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/shade/shade_tile_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/packets/packet-inl.h"
#include "render/shade/adaptive-inl.h"
#include "render/shade/listed_packets-inl.h"
#include "render/shade/material_units-inl.h"
#include "render/shade/pixel_lists-inl.h"
#include "render/tile/light_code-inl.h"
#include "render/tile/media-inl.h"
#include "render/tile/resolve-inl.h"
#include "render/tile/shading_result-inl.h"
#include "render/tile/sky-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// Shades the pixels of all materials.
void ShadeSurfaces(const Shading& s, const TilePixels& tile, const PixelLists& lists,
                   ShadeScratch& scratch, ShadedLabels* labels) {
  const auto shade_all = [&]<std::size_t... k>(std::index_sequence<k...>) {
    (ShadeMaterial<std::tuple_element_t<k, Materials>>(s, tile, lists[k], scratch, labels), ...);
  };
  shade_all(std::make_index_sequence<kMaterialCount>());
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

// Shades all pixels of a tile.
ShadedPixels ShadeEach(const Shading& s, const TilePixels& tile, ShadeScratch& scratch,
                       ShadedLabels* labels) {
  const PixelLists lists = ListPixels(s, tile, scratch);
  ShadeSkyPackets(s, tile, lists[kSky], scratch);
  ShadeSurfaces(s, tile, lists, scratch, labels);
  return {static_cast<int>(CountSurfaces(lists)), 0};
}

// Shades as many pixels of a tile as the picture needs. Labels are of all of them, and do not
// change the picture: for these all are shaded, and then some filled in.
ShadedPixels ShadeAdaptively(const Shading& s, const TilePixels& tile, ShadeScratch& scratch,
                             ShadedLabels* labels) {
  TileSurfaces surfaces;
  FindSurfaces(s, tile, surfaces);
  ShadeSkyPackets(s, tile, ListSky(s, tile, surfaces, scratch), scratch);
  if (labels)
    ShadeSurfaces(s, tile, ListRows(s, surfaces.all, tile.box.height_px, surfaces, scratch),
                  scratch, labels);
  TilePixels without_fragments = tile;
  without_fragments.fragments = {};
  const std::size_t shaded = ShadeWhereNeeded(
      s, tile, surfaces, scratch, [&](const PixelLists& lists, bool is_first) HWY_ATTR {
        if (!labels) ShadeSurfaces(s, is_first ? tile : without_fragments, lists, scratch, nullptr);
      });
  std::size_t all = 0;
  for (int y = 0; y < tile.box.height_px; ++y) all += std::popcount(surfaces.all[y]);
  return {static_cast<int>(shaded), static_cast<int>(all - shaded)};
}

ShadedPixels ShadeAllPixels(const Shading& s, const TilePixels& tile, ShadeScratch& scratch,
                            std::uint32_t* rgba, float* linear, ShadedLabels* labels) {
  const ShadedPixels shaded = s.is_adaptive ? ShadeAdaptively(s, tile, scratch, labels)
                                            : ShadeEach(s, tile, scratch, labels);
  if (!tile.fragments.empty()) {
    const PixelList parts = ListFragments(tile.fragments, raster::kNoPrimitive, 0, scratch);
    ShadeList(FragmentsInTile{tile.fragments, parts, scratch},
              [&](const ListedPacket& packet) HWY_ATTR {
                return ShadeSky(s, tile.box, tile.shafts, packet.x_px, packet.y_px);
              });
  }
  LayMedia(s, tile, scratch);
  ResolveTile(s, tile.box, scratch, rgba, linear);
  if (!tile.fragments.empty()) ResolveFragments(s, tile, scratch, rgba, linear);
  return shaded;
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
          input.planar_maps,
          casters,
          FindShafts(s, box, casters, scratch.shafts)};
}

ShadedPixels ShadeTile(const Shading& s, const TileInput& input, ShadeScratch& scratch,
                       std::uint32_t* rgba, float* linear, ShadedLabels* labels) {
  return ShadeAllPixels(s, PixelsOf(s, input, scratch), scratch, rgba, linear, labels);
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
  LayMedia(s, TilePixels{.box = box}, scratch);
  ResolveTile(s, box, scratch, rgba, linear);
}

// Writes a tile's colours to the planar map, zeros where there is no primitive and so no colour.
HWY_INLINE void EncodePlanarTile(const Shading& s, const raster::PixelBox& box,
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
      const VI rgb = (r | hn::ShiftLeft<8>(g)) | hn::ShiftLeft<16>(b);
      const auto texel = hn::BitCast(du, rgb) | 0xff000000u;
      const auto drawn = hn::LoadU(du, primitive + i) != hn::Set(du, raster::kNoPrimitive);
      const auto result = IfThenElseZero(drawn, texel);
      if (x + kLanes <= width) {
        hn::StoreU(result, du, row + x);
        continue;
      }
      hn::Store(result, du, tail.data());
      std::copy_n(tail.begin(), width - x, row + x);
    }
  }
}

void ShadePlanarTile(const Shading& s, int tile_index, const float* depth,
                     const std::uint32_t* primitive, ShadeScratch& scratch,
                     texture::RgbaImage& image) {
  const TilePixels tile{raster::tile_box(s.viewport, s.grid, tile_index), depth, primitive, {}, {},
                        s.sun_shadow.casters.of_tile(tile_index)};
  const PixelLists lists = ListPixels(s, tile, scratch);
  ShadeSurfaces(s, tile, lists, scratch, nullptr);
  EncodePlanarTile(s, tile.box, primitive, scratch, image);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::render {

HWY_EXPORT(ShadeTile);
HWY_EXPORT(ShadeSkyTile);
HWY_EXPORT(ShadePlanarTile);

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

ShadedPixels shade_tile(const Shading& shading, const TileInput& input, ShadeScratch& scratch,
                        std::span<std::uint32_t> rgba, std::span<float> linear,
                        ShadedLabels* labels) {
  check_tile(shading, input.depth, input.primitive);
  check_picture(shading, rgba, linear);
  SWELL_CHECK(input.fragments.size() <= kMaxTileFragments, "fragments={}", input.fragments.size());
  float* const light = linear.empty() ? nullptr : linear.data();
  return HWY_DYNAMIC_DISPATCH(ShadeTile)(shading, input, scratch, rgba.data(), light, labels);
}

void shade_sky_tile(const Shading& shading, int tile, ShadeScratch& scratch,
                    std::span<std::uint32_t> rgba, std::span<float> linear) {
  check_picture(shading, rgba, linear);
  HWY_DYNAMIC_DISPATCH(ShadeSkyTile)
  (shading, tile, scratch, rgba.data(), linear.empty() ? nullptr : linear.data());
}

void shade_planar_tile(const Shading& shading, int tile, std::span<const float> depth,
                       std::span<const std::uint32_t> primitive, ShadeScratch& scratch,
                       texture::RgbaImage& image) {
  check_tile(shading, depth, primitive);
  HWY_DYNAMIC_DISPATCH(ShadePlanarTile)
  (shading, tile, depth.data(), primitive.data(), scratch, image);
}

}  // namespace swell::render
#endif  // HWY_ONCE
