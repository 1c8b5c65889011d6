// What a material's unit (material_unit.cpp.in) is made of: the light of listed pixels as it
// arrives at the eye.
#if defined(SWELL_RENDER_SHADE_SHADE_MATERIAL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_SHADE_SHADE_MATERIAL_INL_H_
#undef SWELL_RENDER_SHADE_SHADE_MATERIAL_INL_H_
#else
#define SWELL_RENDER_SHADE_SHADE_MATERIAL_INL_H_
#endif

#include <array>
#include <span>

#include "render/shade/keep_labels-inl.h"
#include "render/shade/listed_packets-inl.h"
#include "render/shade/material_units-inl.h"
#include "render/tile/attenuate-inl.h"
#include "render/tile/shafts-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// The light of a packet's pixels as it arrives, but for media that are laid last. What labels want
// of the window's goes to `keep`.
template <ViewKind kView, class M, class Shade, class Keep, class... Found>
HWY_INLINE V3 ArrivingLight(const Shading& s, const TilePixels& tile, const Lanes& lanes,
                            const Packet& shown, const Shade& shade, const Keep& keep,
                            const Found&... found) {
  const M& material = s.material<M>();
  if constexpr (kView == ViewKind::kWindow) {
    const auto result = shade(s, tile, lanes, shown, found...);
    keep(lanes.at, result);
    if (s.media.submerged) {
      const V shafts = ShaftsBefore(s, tile.box, tile.shafts, shown.x_px, shown.y_px,
                                    -shown.to_eye.z, shown.distance);
      return SeenInWater<M::kSurface>(s.media, WaterLevel(material, s, lanes), shown, result.light,
                                      shafts);
    }
    return Air::IsOn(s) ? result.light : Haze(s, shown, result.light);
  } else {
    const Seen seen = FindSeen<kView>(s, shown, WaterLevel(material, s, lanes));
    return Attenuate<kView>(s, shown, seen, shade(s, tile, lanes, seen.packet, found...));
  }
}

// The light of packets side by side. A function of its own: pixels and fragments share it.
template <class M, class Shade, class Keep>
HWY_NOINLINE void ArrivingLights(const Shading& s, const TilePixels& tile, const Shade& shade,
                                 const Keep& keep, std::span<const ListedPacket> packets,
                                 V3* lights) {
  PerPacket<Packet> shown;
  PerPacket<typename Shade::Found> found;
  for (std::size_t k = 0; k < packets.size(); ++k)
    shown[k] = MakePacket(s.rays, packets[k].x_px, packets[k].y_px, packets[k].z);
  shade.LookUp(s, std::span<const Packet>(shown.data(), packets.size()), found.data());
  for (std::size_t k = 0; k < packets.size(); ++k)
    lights[k] = ArrivingLight<ViewKind::kWindow, M>(s, tile, packets[k].lanes, shown[k], shade,
                                                    keep, found[k]);
}

// How pixels of a material are told apart by one number. The sea is darkest in red, in which what
// is shown therefore differs most; under water there is none. Grass and sand may be as bright as
// each other, but not as red. Land's grain is as fine as a pixel in all directions, so that
// neighbours say less of what lies between.
template <class M>
BrightnessScale BrightnessScaleOf(const Media& media) {
  if (media.submerged) return {{0.25f, 0.5f, 0.25f}, 1.0f};
  if (kSurfaceTraits[M::kSurface].is_water) return {{0.6f, 0.2f, 0.2f}, 1.0f};
  return {{0.75f, 0.25f, 0.0f}, 1.5f};
}

// Labels are of the pixels' centres alone: fragments keep nothing. A function of its own for each
// kind of view, with labels and without: what they take costs registers.
template <ViewKind kView, class M, class Keep>
HWY_NOINLINE void ShadePixels(const Shading& s, const TilePixels& tile, const PixelList& list,
                              ShadeScratch& scratch, const Keep& keep) {
  const M& material = s.material<M>();
  WithShader<kView>(material, [&]<class Shade>(const Shade& shade) HWY_ATTR {
    const auto shade_list = [&](const auto& listed, const auto& kept) HWY_ATTR {
      // Elsewhere what is shown is not where it seems to be.
      if constexpr (kView == ViewKind::kWindow && LooksUpSideBySide<Shade>) {
        ShadeSideBySide(listed, [&](std::span<const ListedPacket> packets, V3* lights) HWY_ATTR {
          ArrivingLights<M>(s, tile, shade, kept, packets, lights);
        });
      } else {
        ShadeList(listed, [&](const ListedPacket& packet) HWY_ATTR {
          const Packet shown = MakePacket(s.rays, packet.x_px, packet.y_px, packet.z);
          return ArrivingLight<kView, M>(s, tile, packet.lanes, shown, shade, kept);
        });
      }
    };
    const bool is_adaptive = kView == ViewKind::kWindow && s.is_adaptive;
    shade_list(PixelsInTile{s, tile, list, scratch, is_adaptive, BrightnessScaleOf<M>(s.media)},
               keep);
    if (kView != ViewKind::kWindow || tile.fragments.empty()) return;
    const PixelList parts = ListFragments(tile.fragments, s.primitives.begin(M::kSurface),
                                          s.primitives.end(M::kSurface), scratch);
    shade_list(FragmentsInTile{tile.fragments, parts, scratch}, KeepNothing());
  });
}

template <class M>
void ShadeMaterial(const Shading& s, const TilePixels& tile, const PixelList& list,
                   ShadeScratch& scratch, ShadedLabels* labels) {
  if (s.kind == ViewKind::kRefraction)
    ShadePixels<ViewKind::kRefraction, M>(s, tile, list, scratch, KeepNothing());
  else if (s.kind == ViewKind::kReflection)
    ShadePixels<ViewKind::kReflection, M>(s, tile, list, scratch, KeepNothing());
  else if (labels)
    ShadePixels<ViewKind::kWindow, M>(s, tile, list, scratch, KeepLabels{*labels});
  else
    ShadePixels<ViewKind::kWindow, M>(s, tile, list, scratch, KeepNothing());
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
