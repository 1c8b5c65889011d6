// The media between the eye and what it sees in air, in the order in which they are laid: the
// nearest to the eye last. To add one: a line in the list, and a header of its own.
//
// A medium M is a struct of static functions:
//   bool IsOn(const Shading&);
//   void LayOverTile(const Shading&, const TilePixels&, ShadeScratch&);
//   void LayOverFragments(const Shading&, std::span<const EdgeFragment>, ShadeScratch&);
//   V3 Beyond(const Shading&, const AirWay&, V3 light);  // if it has one
// The Lay functions lay it before what a tile of the window shows, whose light stands in the
// scratch; a tile of open sky has no depths. LaidByPixel<M> makes both of one function.
// Beyond() is for what water mirrors, or an eye in it sees through the surface, on a way from the
// sea.
#if defined(SWELL_RENDER_TILE_MEDIA_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_TILE_MEDIA_INL_H_
#undef SWELL_RENDER_TILE_MEDIA_INL_H_
#else
#define SWELL_RENDER_TILE_MEDIA_INL_H_
#endif

#include <span>
#include <tuple>

#include "render/tile/air_tile-inl.h"
#include "render/tile/cloud_deck-inl.h"
#include "render/tile/cloud_picture-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

using MediaInAir = std::tuple<  //
    Air,                        //
    CloudDeck,                  //
    VolumetricClouds            //
    >;

template <class Visit>
HWY_INLINE void ForEachMedium(const Visit& visit) {
  [&]<class... M>(std::tuple<M...>*)
      HWY_ATTR { (visit.template operator()<M>(), ...); }(static_cast<MediaInAir*>(nullptr));
}

// Lays all media before a tile of the window and its fragments.
HWY_INLINE void LayMedia(const Shading& s, const TilePixels& tile, ShadeScratch& scratch) {
  if (s.media.submerged) return;
  ForEachMedium([&]<class M>() HWY_ATTR {
    if (!M::IsOn(s)) return;
    M::LayOverTile(s, tile, scratch);
    M::LayOverFragments(s, tile.fragments, scratch);
  });
}

// Light on its way to the sea through all media.
HWY_INLINE V3 ThroughMediaBeyond(const Shading& s, const AirWay& way, V3 light) {
  ForEachMedium([&]<class M>() HWY_ATTR {
    if constexpr (requires { M::Beyond(s, way, light); })
      if (M::IsOn(s)) light = M::Beyond(s, way, light);
  });
  return light;
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
