// A tile's pixels in lists by material, and of its fragments those of a material.
#if defined(SWELL_RENDER_SHADE_PIXEL_LISTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_SHADE_PIXEL_LISTS_INL_H_
#undef SWELL_RENDER_SHADE_PIXEL_LISTS_INL_H_
#else
#define SWELL_RENDER_SHADE_PIXEL_LISTS_INL_H_
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "render/materials/list.h"
#include "render/packets/packet-inl.h"
#include "render/tile/scratch.h"
#include "render/tile/shading_result-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// The pixels of one material in a tile, as positions y * tile_size + x in its buffers.
struct PixelList {
  std::uint16_t* at = nullptr;
  std::size_t count = 0;

  void Append(std::uint16_t pixel) { at[count++] = pixel; }
};

// By material, and the sky last.
using PixelLists = std::array<PixelList, kMaterialCount + 1>;
constexpr std::size_t kSky = kMaterialCount;

inline std::size_t CountSurfaces(const PixelLists& lists) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < kMaterialCount; ++k) count += lists[k].count;
  return count;
}

static_assert(kLanes <= kListPadding);

// Repeats the last pixel up to a full packet, so that every packet is shaded whole.
inline void PadToPackets(PixelList& list) {
  if (list.count == 0) return;
  const std::uint16_t last = list.at[list.count - 1];
  std::fill_n(list.at + list.count, kLanes, last);
}

// Appends pixels `first` and the kLanes - 1 after it.
HWY_INLINE void AppendPacket(PixelList& list, std::size_t first) {
  const hn::Rebind<std::uint16_t, D> d16;
  hn::StoreU(hn::Iota(d16, 0) + static_cast<std::uint16_t>(first), d16, list.at + list.count);
  list.count += kLanes;
}

// Sorts the tile's pixels into those of the first material and those of the others together, whole
// packets of one of these at once, and lists the first pixels of packets with any sky.
inline HWY_NOINLINE void SortByMaterial(const Shading& s, const TilePixels& tile, PixelList& first,
                                        PixelList& others, PixelList& sky) {
  constexpr SurfaceKind kFirst = std::tuple_element_t<0, Materials>::kSurface;
  const hn::RebindToUnsigned<D> du;
  const std::uint32_t first_begin = s.primitives.begin(kFirst);
  const std::uint32_t first_size = s.primitives.end(kFirst) - first_begin;
  const auto begin = hn::Set(du, first_begin), size = hn::Set(du, first_size);
  const auto none = hn::Set(du, raster::kNoPrimitive);
  for (int y = 0; y < tile.box.height_px; ++y) {
    const std::size_t row = static_cast<std::size_t>(y) * s.grid.tile_size_px;
    const auto width = static_cast<std::size_t>(tile.box.width_px);
    for (std::size_t x = 0; x < width;) {
      const std::size_t i = row + x;
      if (x + kLanes <= width) {
        const auto p = hn::LoadU(du, tile.primitive + i);
        hwy::Prefetch(tile.depth + i);  // read next
        const auto is_first = p - begin < size, is_sky = p == none;
        const bool some_sky = !hn::AllFalse(du, is_sky);
        if (some_sky) sky.Append(static_cast<std::uint16_t>(i));
        PixelList* const list = hn::AllTrue(du, is_first)             ? &first
                                : hn::AllFalse(du, is_first | is_sky) ? &others
                                                                      : nullptr;
        if (list) AppendPacket(*list, i);
        if (list || hn::AllTrue(du, is_sky)) {
          x += kLanes;
          continue;
        }
      } else {
        sky.Append(static_cast<std::uint16_t>(i));
      }
      const std::size_t end = std::min(x + kLanes, width);
      for (; x < end; ++x) {
        // Branch-free: write to both lists, advance one or none.
        const std::uint32_t p = tile.primitive[row + x];
        const auto index = static_cast<std::uint16_t>(row + x);
        first.at[first.count] = others.at[others.count] = index;
        const bool is_first = p - first_begin < first_size;
        first.count += is_first;
        others.count += !is_first && p != raster::kNoPrimitive;
      }
    }
  }
}

// Moves the pixels of material kMaterial and those after it out of the list before, which keeps its
// order.
template <std::size_t kMaterial>
void SplitOff(const Shading& s, const TilePixels& tile, PixelLists& lists) {
  if constexpr (kMaterial < kMaterialCount) {
    constexpr SurfaceKind kBefore = std::tuple_element_t<kMaterial - 1, Materials>::kSurface;
    PixelList &list = lists[kMaterial - 1], &rest = lists[kMaterial];
    const std::size_t count = std::exchange(list.count, 0);
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint16_t at = list.at[i];
      (s.primitives.holds(kBefore, tile.primitive[at]) ? list : rest).Append(at);
    }
    SplitOff<kMaterial + 1>(s, tile, lists);
  }
}

inline HWY_NOINLINE PixelLists ListPixels(const Shading& s, const TilePixels& tile,
                                          ShadeScratch& scratch) {
  PixelLists lists;
  for (std::size_t i = 0; i < lists.size(); ++i) lists[i].at = scratch.lists[i].data();
  SortByMaterial(s, tile, lists[0], lists[std::min<std::size_t>(1, kSky)], lists[kSky]);
  SplitOff<2>(s, tile, lists);
  for (std::size_t k = 0; k < kSky; ++k) PadToPackets(lists[k]);
  return lists;
}

// The fragments to shade that have primitives in [begin, end).
inline PixelList ListFragments(std::span<const EdgeFragment> fragments, std::uint32_t begin,
                               std::uint32_t end, ShadeScratch& scratch) {
  PixelList list{scratch.fragment_list.data()};
  for (std::size_t n = 0; n < fragments.size(); ++n)
    if (!fragments[n].is_centre && fragments[n].primitive - begin < end - begin)
      list.Append(static_cast<std::uint16_t>(n));
  PadToPackets(list);
  return list;
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
