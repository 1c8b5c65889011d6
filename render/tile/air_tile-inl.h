// Lays the air before a tile's surfaces, once all are shaded: fog, and the air below an eye far
// over the sea. A row of pixels at a time, so that no packet waits for the one before; what depends
// on the direction alone lies on straight lines between nodes, as the sky does.
#if defined(SWELL_RENDER_TILE_AIR_TILE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_TILE_AIR_TILE_INL_H_
#undef SWELL_RENDER_TILE_AIR_TILE_INL_H_
#else
#define SWELL_RENDER_TILE_AIR_TILE_INL_H_
#endif

#include <span>

#include "render/tile/attenuate-inl.h"
#include "render/tile/packet-inl.h"
#include "render/tile/resolve-inl.h"
#include "render/tile/sky-inl.h"

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

// What depends on a pixel's direction alone, each in as many channels of the lattice: of fog ...
struct FogAhead {
  static constexpr std::size_t kChannels = 3;
  V length, inverse_length;  // of the ray of depth 1
  V phase;

  static HWY_INLINE FogAhead Find(const Shading& s, V3 way) {
    const V length2 = Dot(way, way), inverse = InverseSqrt(length2);
    return {length2 * inverse, inverse, FogPhase(s.media.fog, way * inverse)};
  }
  template <class Store>
  HWY_INLINE void StoreTo(const Store& store) const {
    store(0, length), store(1, inverse_length), store(2, phase);
  }
  template <class Read>
  static HWY_INLINE FogAhead ReadFrom(const Read& read) {
    return {read(0), read(1), read(2)};
  }

  HWY_INLINE FogRay RayTo(const Shading& s, const PlaceShown& at) const {
    return {s.media.fog.at_eye, at.way * inverse_length, at.depth * length,
            at.height + s.rays.eye_z};
  }
  HWY_INLINE V3 Lay(const Shading& s, const PlaceShown& at, V3 light) const {
    return HazeAndFog(s, RayTo(s, at), phase, light,
                      [&]() HWY_ATTR { return MakePacket(s.rays, at.x_px, at.y_px, at.z); });
  }
};

// The aerial perspective of the first `length` of the way, whose whole is `distance`.
HWY_INLINE V3 LayAerialPerspective(const Shading& s, const PlaceShown& at, const AirAhead& air,
                                   V distance, V length, V3 light) {
  const V zero = hn::Zero(D());
  const V3 p = {at.way.x * at.depth, at.way.y * at.depth, at.height};
  const Packet packet = {zero, zero, at.depth, p, distance, {zero, zero, zero}};
  return ThroughAerialPerspective(s, packet, light, length, [&]() HWY_ATTR { return air; });
}

// ... of aerial perspective ...
struct AerialPerspectiveAhead {
  static constexpr std::size_t kChannels = 5;
  V length;
  AirAhead air;

  static HWY_INLINE AerialPerspectiveAhead Find(const Shading& s, V3 way) {
    const V length2 = Dot(way, way), inverse = InverseSqrt(length2);
    return {length2 * inverse, FindAirAhead(s.light, way * inverse)};
  }
  template <class Store>
  HWY_INLINE void StoreTo(const Store& store) const {
    store(0, length), store(1, air.below.x), store(2, air.below.y), store(3, air.below.z);
    store(4, air.steep);
  }
  template <class Read>
  static HWY_INLINE AerialPerspectiveAhead ReadFrom(const Read& read) {
    return {read(0), {{read(1), read(2), read(3)}, read(4)}};
  }

  HWY_INLINE V3 Lay(const Shading& s, const PlaceShown& at, V3 light) const {
    const V distance = at.depth * length;
    return LayAerialPerspective(s, at, air, distance, distance, light);
  }
};

// ... and of both.
struct FogAndPerspectiveAhead {
  static constexpr std::size_t kChannels = FogAhead::kChannels + 4;
  FogAhead fog;
  AirAhead air;

  static HWY_INLINE FogAndPerspectiveAhead Find(const Shading& s, V3 way) {
    const FogAhead fog = FogAhead::Find(s, way);
    return {fog, FindAirAhead(s.light, way * fog.inverse_length)};
  }
  template <class Store>
  HWY_INLINE void StoreTo(const Store& store) const {
    fog.StoreTo(store);
    store(3, air.below.x), store(4, air.below.y), store(5, air.below.z), store(6, air.steep);
  }
  template <class Read>
  static HWY_INLINE FogAndPerspectiveAhead ReadFrom(const Read& read) {
    return {FogAhead::ReadFrom(read), {{read(3), read(4), read(5)}, read(6)}};
  }

  HWY_INLINE V3 Lay(const Shading& s, const PlaceShown& at, V3 light) const {
    const FogRay ray = fog.RayTo(s, at);
    return HazeAndFog(
        s, ray, fog.phase, light,
        [&]() HWY_ATTR { return MakePacket(s.rays, at.x_px, at.y_px, at.z); },
        [&](V3 seen, V length)
            HWY_ATTR { return LayAerialPerspective(s, at, air, ray.distance, length, seen); });
  }
};

template <class Ahead>
HWY_INLINE void FindNodes(const Shading& s, const raster::PixelBox& box, SkyNodes& nodes) {
  const D d;
  static_assert(Ahead::kChannels <= SkyNodes::kAirChannels);
  const int columns = nodes_along(box.width_px), rows = nodes_along(box.height_px);
  for (int row = 0; row < rows; ++row) {
    const V y_px = Constant(static_cast<float>(box.y0_px + row * kStep));
    for (int column = 0; column < columns; column += static_cast<int>(kLanes)) {
      const V x_px = MulAdd(hn::ConvertTo(d, CountFrom(column)), static_cast<float>(kStep),
                            static_cast<float>(box.x0_px));
      const auto at = static_cast<std::size_t>(row) * SkyNodes::kStride + column;
      Ahead::Find(s, RayAt(s.rays, x_px, y_px)).StoreTo([&](std::size_t channel, V value) HWY_ATTR {
        hn::StoreU(value, d, &nodes.air[channel][at]);
      });
    }
  }
}

template <class Ahead>
HWY_INLINE void LayOverTile(const Shading& s, const raster::PixelBox& box, const float* depth,
                            ShadeScratch& scratch) {
  const D d;
  SkyNodes& nodes = scratch.sky;
  const bool by_nodes = IsAirOnLattice(s);
  if (by_nodes) FindNodes<Ahead>(s, box, nodes);
  for (int y = 0; y < box.height_px; ++y) {
    const V y_px = Constant(static_cast<float>(box.y0_px + y));
    const BetweenRows between(y);
    for (int x = 0; x < box.width_px; x += static_cast<int>(kLanes)) {
      const std::size_t at = static_cast<std::size_t>(y) * s.grid.tile_size_px + x;
      const V z = hn::LoadU(d, depth + at);
      if (hn::AllFalse(d, z > 0.0f)) continue;
      const PlaceShown place = FindPlace(s, hn::ConvertTo(d, CountFrom(box.x0_px + x)), y_px, z);
      const auto read = [&](std::size_t channel) HWY_ATTR {
        return ToPixels(between(nodes.air[channel].data(), static_cast<std::size_t>(x / kStep)));
      };
      const Ahead ahead = by_nodes ? Ahead::ReadFrom(read) : Ahead::Find(s, place.way);
      const V3 light = ReadLight(scratch, at);
      WriteLight(Where(place.is_surface, ahead.Lay(s, place, light), light), at, scratch);
    }
  }
}

// Lays air before all surfaces of a tile, whose light stands in the scratch.
inline HWY_NOINLINE void LayAirOverTile(const Shading& s, const raster::PixelBox& box,
                                        const float* depth, ShadeScratch& scratch) {
  if (!IsAirLaidLast(s)) return;
  if (IsFogSeenFromAbove(s))
    LayOverTile<FogAndPerspectiveAhead>(s, box, depth, scratch);
  else if (s.media.fog.on)
    LayOverTile<FogAhead>(s, box, depth, scratch);
  else
    LayOverTile<AerialPerspectiveAhead>(s, box, depth, scratch);
}

// Lays air before the surfaces that the fragments show.
inline HWY_NOINLINE void LayAirOverFragments(const Shading& s,
                                             std::span<const EdgeFragment> fragments,
                                             ShadeScratch& scratch) {
  if (!IsAirLaidLast(s)) return;
  LayOverFragments(fragments, scratch, [&](V x_px, V y_px, V z, V3 light) HWY_ATTR {
    const PlaceShown place = FindPlace(s, x_px, y_px, z);
    const V3 seen = s.media.fog.on
                        ? FogAhead::Find(s, place.way).Lay(s, place, light)
                        : AerialPerspectiveAhead::Find(s, place.way).Lay(s, place, light);
    return Where(place.is_surface, seen, light);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
