// Packets of the pixels and the fragments that a list names: gathered, shaded, their colours
// stored.
#if defined(SWELL_RENDER_SHADE_LISTED_PACKETS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_SHADE_LISTED_PACKETS_INL_H_
#undef SWELL_RENDER_SHADE_LISTED_PACKETS_INL_H_
#else
#define SWELL_RENDER_SHADE_LISTED_PACKETS_INL_H_
#endif

#include <algorithm>
#include <array>
#include <bit>

#include "render/packets/packet-inl.h"
#include "render/shade/pixel_lists-inl.h"
#include "render/tile/shading_result-inl.h"
#include "render/tile/tone_curve-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// Where a packet's pixels, or parts of pixels, lie in the window, and what they show.
struct ListedPacket {
  Lanes lanes;
  V x_px, y_px, z;
};

// Writes each lane to where `at` says.
HWY_INLINE void ScatterLanes(V values, const std::uint16_t* at, float* to) {
  HWY_ALIGN std::array<float, kLanes> lanes;
  hn::Store(values, D(), lanes.data());
  for (std::size_t lane = 0; lane < kLanes; ++lane) to[at[lane]] = lanes[lane];
}

HWY_INLINE void ScatterColour(const V3& colour, const std::uint16_t* at, float* red, float* green,
                              float* blue) {
  ScatterLanes(colour.x, at, red);
  ScatterLanes(colour.y, at, green);
  ScatterLanes(colour.z, at, blue);
}

// Writes each lane's pixel to where `at` says.
HWY_INLINE void ScatterPixels(const V3& colour, V brightness, const std::uint16_t* at,
                              PixelLight* to) {
  const D d;
  const hn::Repartition<std::uint64_t, D> d64;
  // The four numbers of lanes 0, 1, 2 and 3 of each four.
  HWY_ALIGN std::array<std::array<float, kLanes>, 4> parts;
  const auto store = [&](std::size_t first, V red_green, V blue_brightness) HWY_ATTR {
    const auto rg = hn::BitCast(d64, red_green), bb = hn::BitCast(d64, blue_brightness);
    hn::Store(hn::BitCast(d, hn::InterleaveLower(d64, rg, bb)), d, parts[first].data());
    hn::Store(hn::BitCast(d, hn::InterleaveUpper(d64, rg, bb)), d, parts[first + 1].data());
  };
  store(0, hn::InterleaveLower(d, colour.x, colour.y),
        hn::InterleaveLower(d, colour.z, brightness));
  store(2, hn::InterleaveUpper(d, colour.x, colour.y),
        hn::InterleaveUpper(d, colour.z, brightness));
  const hn::Full128<float> d4;
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    hn::Store(hn::Load(d4, parts[lane % 4].data() + lane / 4 * 4), d4, &to[at[lane]].red);
}

// Listed pixels, a packet from `at` on.
struct PixelsInTile {
  const Shading& s;
  const TilePixels& tile;
  const PixelList& list;
  ShadeScratch& scratch;
  bool is_adaptive;            // colours go into scratch.pixels, not into the planes
  BrightnessScale brightness;  // that tells this material's pixels apart

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
    const VI x = index - hn::ShiftLeftSame(y, size_log2);
    HWY_ALIGN std::array<float, kLanes> z;
    const bool run = IsRun(i);
    if (!run)
      for (std::size_t lane = 0; lane < kLanes; ++lane) z[lane] = tile.depth[at[lane]];
    return {Lanes{tile.primitive, at}, hn::ConvertTo(d, x + tile.box.x0_px),
            hn::ConvertTo(d, y + tile.box.y0_px),
            hn::LoadU(d, run ? tile.depth + at[0] : z.data())};
  }

  HWY_INLINE void Store(std::size_t i, const V3& colour) const {
    const D d;
    const std::uint16_t* at = list.at + i;
    if (is_adaptive) {
      ScatterPixels(colour, BrightnessOf(colour, brightness, s.exposure), at,
                    scratch.pixels.data());
    } else if (IsRun(i)) {
      hn::StoreU(colour.x, d, scratch.red.data() + at[0]);
      hn::StoreU(colour.y, d, scratch.green.data() + at[0]);
      hn::StoreU(colour.z, d, scratch.blue.data() + at[0]);
    } else {
      ScatterColour(colour, at, scratch.red.data(), scratch.green.data(), scratch.blue.data());
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
    const std::uint16_t* at = list.at + i;
    ScatterColour(colour, at, scratch.fragment_red.data(), scratch.fragment_green.data(),
                  scratch.fragment_blue.data());
  }
};

// Calls shade(packet) for what is listed and stores the colours.
template <class Listed, class Shade>
HWY_INLINE void ShadeList(const Listed& listed, const Shade& shade) {
  for (std::size_t i = 0; i < listed.list.count; i += kLanes)
    listed.Store(i, shade(listed.Load(i)));
}

// Calls shade(packets, colours) for listed packets side by side and stores the colours.
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

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
