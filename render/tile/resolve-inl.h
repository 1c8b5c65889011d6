// From linear light to the picture: exposure, tone curve, sRGB.
#if defined(SWELL_RENDER_TILE_RESOLVE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_TILE_RESOLVE_INL_H_
#undef SWELL_RENDER_TILE_RESOLVE_INL_H_
#else
#define SWELL_RENDER_TILE_RESOLVE_INL_H_
#endif

#include <algorithm>
#include <array>
#include <span>

#include "render/tile/scratch.h"
#include "render/tile/shading_result-inl.h"
#include "render/tile/tone_curve-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// The light of a packet of pixels from `at` on, which is a multiple of kLanes.
HWY_INLINE V3 ReadLight(const ShadeScratch& scratch, std::size_t at) {
  const D d;
  return {hn::Load(d, scratch.red.data() + at), hn::Load(d, scratch.green.data() + at),
          hn::Load(d, scratch.blue.data() + at)};
}

HWY_INLINE void WriteLight(V3 light, std::size_t at, ShadeScratch& scratch) {
  const D d;
  hn::Store(light.x, d, scratch.red.data() + at);
  hn::Store(light.y, d, scratch.green.data() + at);
  hn::Store(light.z, d, scratch.blue.data() + at);
}

// The sRGB curve times 255, for linear x in [0, 1]. Error 0.09. Above the linear part a polynomial
// in sqrt(x), fitted by weighted least squares to 1.055 x^(1/2.4) - 0.055.
HWY_INLINE V EncodeSrgb(V x) {
  const V s = Sqrt(x);
  V p = Constant(0.5172983f);
  p = MulAdd(p, s, -1.6236454f);
  p = MulAdd(p, s, 2.0315608f);
  p = MulAdd(p, s, -1.4027299f);
  p = MulAdd(p, s, 1.5179496f);
  p = MulAdd(p, s, -0.0401095f);
  const V curve = IfThenElse(x < 0.0031308f, x * 12.92f, p);
  return curve * 255.0f;
}

// sRGB, a dither of one step, 8 bits.
HWY_INLINE VI ToByte(V display, V dither) {
  const V code = EncodeSrgb(display) + dither;
  return TruncateToInt(Min(code, 255.0f));
}

// Pixels of display light at these places, alpha 255.
HWY_INLINE VI ToPixel(V3 display, V x_px, V y_px) {
  const V dither = PixelNoise(x_px, y_px);
  const VI r = ToByte(display.x, dither), g = ToByte(display.y, dither);
  const VI b = ToByte(display.z, dither);
  return (r | hn::ShiftLeft<8>(g)) |
         (hn::ShiftLeft<16>(b) | static_cast<std::int32_t>(0xff000000u));
}

// Writes linear light, three floats a pixel.
inline void CopyLinear(const Shading& s, const raster::PixelBox& box, const ShadeScratch& scratch,
                       float* linear) {
  for (int y = 0; y < box.height_px; ++y) {
    for (int x = 0; x < box.width_px; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * s.grid.tile_size_px + x;
      float* out = linear + 3 * (static_cast<std::size_t>(box.y0_px + y) * s.viewport.width_px +
                                 box.x0_px + x);
      out[0] = scratch.red[i];
      out[1] = scratch.green[i];
      out[2] = scratch.blue[i];
    }
  }
}

HWY_INLINE void ResolveTile(const Shading& s, const raster::PixelBox& box,
                            const ShadeScratch& scratch, std::uint32_t* rgba, float* linear) {
  const D d;
  const DI di;
  const V exposure = Constant(s.exposure);
  HWY_ALIGN std::array<std::int32_t, kLanes> tail;
  for (int y = 0; y < box.height_px; ++y) {
    std::uint32_t* row =
        rgba + static_cast<std::size_t>(box.y0_px + y) * s.viewport.width_px + box.x0_px;
    for (int x = 0; x < box.width_px; x += static_cast<int>(kLanes)) {
      const std::size_t i = static_cast<std::size_t>(y) * s.grid.tile_size_px + x;
      const V3 light = ReadLight(scratch, i);
      const V3 display = {ToneCurve(light.x, exposure), ToneCurve(light.y, exposure),
                          ToneCurve(light.z, exposure)};
      const VI pixel = ToPixel(display, hn::ConvertTo(d, CountFrom(box.x0_px + x)),
                               Constant(static_cast<float>(box.y0_px + y)));
      if (x + static_cast<int>(kLanes) <= box.width_px) {
        hn::StoreU(pixel, di, reinterpret_cast<std::int32_t*>(row + x));
      } else {
        hn::Store(pixel, di, tail.data());
        std::copy_n(tail.data(), box.width_px - x, reinterpret_cast<std::int32_t*>(row + x));
      }
    }
  }
  if (linear) CopyLinear(s, box, scratch, linear);
}

// The light of fragments, those that the centre shows with it, goes to the scratch's fragments.
inline void GatherCentres(const TilePixels& tile, ShadeScratch& scratch) {
  for (std::size_t n = 0; n < tile.fragments.size(); ++n) {
    if (!tile.fragments[n].is_centre) continue;
    const std::uint16_t at = tile.fragments[n].pixel;
    scratch.fragment_red[n] = scratch.red[at];
    scratch.fragment_green[n] = scratch.green[at];
    scratch.fragment_blue[n] = scratch.blue[at];
  }
}

// Some fragments of a tile, from the first on: their middles in the window, and depths there as in
// the depth buffer.
struct FragmentsShown {
  std::size_t first;
  V x_px, y_px, z;
};

// The light of all fragments becomes lay(fragments, light).
template <class Lay>
HWY_INLINE void LayOverEachFragment(std::span<const EdgeFragment> fragments, ShadeScratch& scratch,
                                    const Lay& lay) {
  const D d;
  for (std::size_t n = 0; n < fragments.size(); n += kLanes) {
    HWY_ALIGN std::array<float, kLanes> x{}, y{}, z{};
    for (std::size_t i = 0; i < std::min(kLanes, fragments.size() - n); ++i)
      x[i] = fragments[n + i].x_px, y[i] = fragments[n + i].y_px, z[i] = fragments[n + i].z;
    const V3 light = {hn::Load(d, scratch.fragment_red.data() + n),
                      hn::Load(d, scratch.fragment_green.data() + n),
                      hn::Load(d, scratch.fragment_blue.data() + n)};
    const V3 laid =
        lay(FragmentsShown{n, hn::Load(d, x.data()), hn::Load(d, y.data()), hn::Load(d, z.data())},
            light);
    hn::Store(laid.x, d, scratch.fragment_red.data() + n);
    hn::Store(laid.y, d, scratch.fragment_green.data() + n);
    hn::Store(laid.z, d, scratch.fragment_blue.data() + n);
  }
}

// Calls visit(first, end) for the fragments of each pixel.
template <class Visit>
HWY_INLINE void ForEachEdgePixel(std::span<const EdgeFragment> fragments, const Visit& visit) {
  for (std::size_t first = 0; first < fragments.size();) {
    std::size_t end = first + 1;
    while (end < fragments.size() && fragments[end].pixel == fragments[first].pixel) ++end;
    visit(first, end);
    first = end;
  }
}

// The mean of a pixel's fragments, by their samples.
HWY_INLINE float MixFragments(std::span<const EdgeFragment> fragments, const float* value,
                              std::size_t first, std::size_t end) {
  float sum = 0.0f, samples = 0.0f;
  for (std::size_t n = first; n < end; ++n) {
    const auto weight = static_cast<float>(fragments[n].samples);
    sum += weight * value[n];
    samples += weight;
  }
  return sum / samples;
}

// Mixes the fragments of the tile's edges, after all of them are shaded: as light of the display,
// so that light too bright to show counts for no more than white. Overwrites those pixels.
HWY_INLINE void ResolveFragments(const Shading& s, const TilePixels& tile, ShadeScratch& scratch,
                                 std::uint32_t* rgba, float* linear) {
  const D d;
  const std::span<const EdgeFragment> fragments = tile.fragments;
  GatherCentres(tile, scratch);
  const std::array<float*, 3> colour = {scratch.fragment_red.data(), scratch.fragment_green.data(),
                                        scratch.fragment_blue.data()};
  const auto at = [&](std::uint16_t pixel) {
    const int side = s.grid.tile_size_px;
    return static_cast<std::size_t>(tile.box.y0_px + pixel / side) * s.viewport.width_px +
           static_cast<std::size_t>(tile.box.x0_px + pixel % side);
  };
  if (linear)
    ForEachEdgePixel(fragments, [&](std::size_t first, std::size_t end) {
      float* out = linear + 3 * at(fragments[first].pixel);
      for (std::size_t c = 0; c < 3; ++c) out[c] = MixFragments(fragments, colour[c], first, end);
    });

  for (float* value : colour)
    for (std::size_t n = 0; n < fragments.size(); n += kLanes)
      hn::Store(ToneCurve(hn::Load(d, value + n), Constant(s.exposure)), d, value + n);
  // A packet of pixels at a time; the last one with its first pixel repeated.
  HWY_ALIGN std::array<float, kLanes> red{}, green{}, blue{}, x{}, y{};
  HWY_ALIGN std::array<std::int32_t, kLanes> pixels;
  std::array<std::size_t, kLanes> place{};
  std::size_t count = 0;
  const auto flush = [&]() HWY_ATTR {
    const VI packet =
        ToPixel({hn::Load(d, red.data()), hn::Load(d, green.data()), hn::Load(d, blue.data())},
                hn::Load(d, x.data()), hn::Load(d, y.data()));
    hn::Store(packet, DI(), pixels.data());
    for (std::size_t i = 0; i < count; ++i) rgba[place[i]] = static_cast<std::uint32_t>(pixels[i]);
    count = 0;
  };
  ForEachEdgePixel(fragments, [&](std::size_t first, std::size_t end) HWY_ATTR {
    const std::uint16_t pixel = fragments[first].pixel;
    red[count] = MixFragments(fragments, colour[0], first, end);
    green[count] = MixFragments(fragments, colour[1], first, end);
    blue[count] = MixFragments(fragments, colour[2], first, end);
    x[count] = static_cast<float>(tile.box.x0_px + pixel % s.grid.tile_size_px);
    y[count] = static_cast<float>(tile.box.y0_px + pixel / s.grid.tile_size_px);
    place[count++] = at(pixel);
    if (count == kLanes) flush();
  });
  if (count > 0) flush();
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
