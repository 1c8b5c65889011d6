// Lays the air before a tile's surfaces: fog, and the air below an eye far over the sea. A row of
// pixels at a time, so that no packet waits for the one before; what depends on the direction alone
// lies on straight lines between nodes, as the sky does.
#if defined(SWELL_RENDER_TILE_AIR_TILE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_TILE_AIR_TILE_INL_H_
#undef SWELL_RENDER_TILE_AIR_TILE_INL_H_
#else
#define SWELL_RENDER_TILE_AIR_TILE_INL_H_
#endif

#include <span>

#include "render/tile/air-inl.h"
#include "render/tile/lattice-inl.h"
#include "render/tile/medium-inl.h"
#include "render/tile/stored_fog-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// What depends on a pixel's direction alone, each in as many channels of the lattice: of fog, and
// of the aerial perspective of an eye far over the sea. kIsStored: fog comes from s.stored_fog.
template <bool kHasFog, bool kHasPerspective, bool kIsStored = false>
struct AirInDirection {
  static constexpr std::size_t kChannels = 1 + (kHasFog ? 2 : 0) + (kHasPerspective ? 4 : 0);
  V length;  // of the ray of depth 1
  V inverse_length, phase;
  AirAhead air;

  static HWY_INLINE AirInDirection Find(const Shading& s, V3 way) {
    const V length2 = Dot(way, way), inverse = InverseSqrt(length2);
    AirInDirection found;
    found.length = length2 * inverse;
    found.inverse_length = inverse;
    if constexpr (kHasFog) found.phase = FogPhase(s.media.fog, way * inverse);
    if constexpr (kHasPerspective) found.air = FindAirAhead(s.light, way * inverse);
    return found;
  }

  // Calls visit(channel, value) for all channels.
  template <class Visitor>
  HWY_INLINE void Visit(const Visitor& visit) {
    std::size_t channel = 0;
    visit(channel++, length);
    if constexpr (kHasFog) visit(channel++, inverse_length), visit(channel++, phase);
    if constexpr (!kHasPerspective) return;
    visit(channel++, air.below.x), visit(channel++, air.below.y), visit(channel++, air.below.z);
    visit(channel++, air.steep);
  }

  // What fog does on a path; of the packet's primitives, a lane each, if it is stored.
  HWY_INLINE FogView FindFog(const Shading& s, const PlaceShown& at, const std::uint32_t* primitive,
                             const FogRay& ray, const FogPath& path) const {
    const auto own = [&]() HWY_ATTR { return SeeFog(s.media.fog, ray, path, phase); };
    if constexpr (!kIsStored)
      return own();
    else if (s.stored_fog->is_table)
      return LookUpFog(*s.stored_fog, at.z);
    else
      return InterpolateFog(*s.stored_fog, primitive, at.way, own);
  }

  // primitive: what the packet shows, a lane each.
  HWY_INLINE V3 Lay(const Shading& s, const PlaceShown& at, const std::uint32_t* primitive,
                    V3 light) const {
    const V distance = at.depth * length;
    const auto lay_perspective = [&](V3 seen, V way) HWY_ATTR {
      const V zero = hn::Zero(D());
      const V3 p = {at.way.x * at.depth, at.way.y * at.depth, at.height};
      const Packet packet = {zero, zero, at.depth, p, distance, {zero, zero, zero}};
      return ThroughAerialPerspective(s, packet, seen, way, [&]() HWY_ATTR { return air; });
    };
    if constexpr (!kHasFog) {
      return lay_perspective(light, distance);
    } else {
      const FogRay ray = {
          {at.way * inverse_length, distance, at.height + s.rays.eye_z, s.rays.eye_z},
          s.media.fog.at_eye};
      const auto packet = [&]() HWY_ATTR { return MakePacket(s.rays, at.x_px, at.y_px, at.z); };
      const FogPath path = PathTo(s.media.fog, ray);
      const FogView view = FindFog(s, at, primitive, ray, path);
      return HazeAndFog(s, distance, path, view, light, packet, [&](V3 seen, V way) HWY_ATTR {
        return kHasPerspective ? lay_perspective(seen, way) : Haze(s, packet(), seen, way);
      });
    }
  }
};

template <class InDirection>
HWY_INLINE void FindNodes(const Shading& s, const raster::PixelBox& box, SkyNodes& nodes) {
  static_assert(InDirection::kChannels <= SkyNodes::kAirChannels);
  ForEachNodes(box, nodes_along(box.height_px), [&](V x_px, V y_px, const auto& store) HWY_ATTR {
    InDirection::Find(s, RayAt(s.rays, x_px, y_px))
        .Visit([&](std::size_t channel, V value)
                   HWY_ATTR { store(value, nodes.air[channel].data()); });
  });
}

// Fog, and the air below an eye far over the sea. The sky has what is before it.
struct Air {
  // Haze alone is little, and each surface has it from where its packet is at hand.
  static bool IsOn(const Shading& s) { return s.media.fog.on || s.media.molecules_per_m.z > 0.0f; }

  template <class Visit>
  static HWY_INLINE void WithStoredFog(const Shading& s, const Visit& visit) {
    if (IsFogSeenFromAbove(s))
      visit.template operator()<AirInDirection<true, true, true>>();
    else
      visit.template operator()<AirInDirection<true, false, true>>();
  }

  // Calls visit<InDirection>() with what of the air there is.
  template <class Visit>
  static HWY_INLINE void WithAirOf(const Shading& s, const Visit& visit) {
    if (s.media.fog.on && s.stored_fog)
      WithStoredFog(s, visit);
    else if (IsFogSeenFromAbove(s))
      visit.template operator()<AirInDirection<true, true>>();
    else if (s.media.fog.on)
      visit.template operator()<AirInDirection<true, false>>();
    else
      visit.template operator()<AirInDirection<false, true>>();
  }

  static HWY_NOINLINE void LayOverTile(const Shading& s, const TilePixels& tile,
                                       ShadeScratch& scratch) {
    if (!tile.depth) return;
    WithAirOf(s, [&]<class InDirection>() HWY_ATTR {
      SkyNodes& nodes = scratch.sky;
      const bool by_nodes = IsAirOnLattice(s);
      if (by_nodes) FindNodes<InDirection>(s, tile.box, nodes);
      LayOverPixels(s, tile, scratch, [&](const PixelsShown& pixels, V3& light) HWY_ATTR {
        if (hn::AllFalse(D(), pixels.z > 0.0f)) return false;
        const PlaceShown place = FindPlace(s, pixels.x_px, pixels.y_px, pixels.z);
        InDirection air;
        if (by_nodes) {
          const BetweenRows between(pixels.y);
          air.Visit([&](std::size_t channel, V& value) HWY_ATTR {
            value = ToPixels(
                between(nodes.air[channel].data(), static_cast<std::size_t>(pixels.x / kStep)));
          });
        } else {
          air = InDirection::Find(s, place.way);
        }
        const V3 seen = air.Lay(s, place, tile.primitive + pixels.at, light);
        light = IfThenElse(place.is_surface, seen, light);
        return true;
      });
    });
  }

  static HWY_NOINLINE void LayOverFragments(const Shading& s,
                                            std::span<const EdgeFragment> fragments,
                                            ShadeScratch& scratch) {
    WithAirOf(s, [&]<class InDirection>() HWY_ATTR {
      LayOverEachFragment(fragments, scratch, [&](const FragmentsShown& f, V3 light) HWY_ATTR {
        const PlaceShown place = FindPlace(s, f.x_px, f.y_px, f.z);
        const std::uint32_t* const primitive = scratch.fragment_primitive.data() + f.first;
        const V3 seen = InDirection::Find(s, place.way).Lay(s, place, primitive, light);
        return IfThenElse(place.is_surface, seen, light);
      });
    });
  }

  static HWY_INLINE V3 Beyond(const Shading& s, const AirWay& way, V3 light) {
    return s.media.fog.on ? FogFromSea(s.media.fog, way, light) : light;
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
