// What a material's per-pixel code gets and gives.
#if defined(SWELL_RENDER_TILE_SHADING_RESULT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_TILE_SHADING_RESULT_INL_H_
#undef SWELL_RENDER_TILE_SHADING_RESULT_INL_H_
#else
#define SWELL_RENDER_TILE_SHADING_RESULT_INL_H_
#endif

#include "render/packets/packet-inl.h"
#include "render/tile/shading.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
struct EdgeFragment;

namespace HWY_NAMESPACE {

// A tile of the visibility buffer; open sky has none.
struct TilePixels {
  raster::PixelBox box;
  const float* depth = nullptr;
  const std::uint32_t* primitive = nullptr;
  std::span<const EdgeFragment> fragments = {};
  TilePlanarMaps planar_maps = {};
  std::span<const std::uint16_t> casters = {};  // of Shading::sun_shadow
  const std::int32_t* shafts = nullptr;         // of ShaftNodes
};

// Which primitives a packet's lanes show, for materials that fetch what their triangles hold.
struct Lanes {
  const std::uint32_t* primitives;
  const std::uint16_t* at;  // by lane: where in `primitives`

  std::uint32_t primitive(std::size_t lane) const { return primitives[at[lane]]; }
};

// What a packet's pixels show of a surface.
struct ShadingResult {
  V3 light;                      // that leaves it towards the eye, before the medium between
  V3 normal;                     // as shaded, of length 1: for labels, as what follows
  V foam_cover = hn::Zero(D());  // part of the water that foam hides
  V flags = hn::Zero(D());       // bits of Label::kFlags, as a number
};

// A surface that ends softly: where `cover` is 0 the medium alone is seen.
struct FadingResult : ShadingResult {
  V cover;
};

// The per-pixel code of material M in a kind of view: specialised in M's -inl.h with
//   const M& material;  (its only member)
//   ShadingResult operator()(const Shading&, const TilePixels&, const Lanes&, const Packet&)
// The packet holds true places in the world, also in views that mirror or squeeze them; the medium
// is not its business. A shader that waits for what it looks up may do so for packets side by side,
// kMostPacketsAtOnce at most, so that they wait together:
//   using Found = ...;
//   void LookUp(const Shading&, std::span<const Packet>, Found* found)
// with a Found for each packet, which is then the last argument of the call. The window's alone.
template <class M, ViewKind kView>
struct Shader;

template <class Shader>
concept LooksUpSideBySide = requires {
  typename Shader::Found;
};

// Calls use(shader) with the shader for this view; a material with variants overloads it.
template <ViewKind kView, class M, class Use>
HWY_INLINE void WithShader(const M& material, const Use& use) {
  use(Shader<M, kView>{material});
}

// Height of the level that mirrors the pixels' surface, relative to the eye: the view's, or
// what a material's overload says.
template <class M>
HWY_INLINE V WaterLevel(const M&, const Shading& s, const Lanes&) {
  return Constant(s.level_rel_m);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
