// From linear light to the picture: exposure, tone curve, sRGB.
#if defined(SWELL_RENDER_TILE_RESOLVE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_TILE_RESOLVE_INL_H_
#undef SWELL_RENDER_TILE_RESOLVE_INL_H_
#else
#define SWELL_RENDER_TILE_RESOLVE_INL_H_
#endif

#include <algorithm>
#include <array>

#include "render/tile/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

constexpr std::size_t kLanes = hn::MaxLanes(D());

// The sRGB curve times 255, for linear x in [0, 1]. Error 0.09. Above the linear part a polynomial
// in sqrt(x), fitted by weighted least squares to 1.055 x^(1/2.4) - 0.055.
HWY_INLINE V EncodeSrgb(V x) {
  const V s = hn::Sqrt(x);
  V p = Constant(0.5172983f);
  p = hn::MulAdd(p, s, Constant(-1.6236454f));
  p = hn::MulAdd(p, s, Constant(2.0315608f));
  p = hn::MulAdd(p, s, Constant(-1.4027299f));
  p = hn::MulAdd(p, s, Constant(1.5179496f));
  p = hn::MulAdd(p, s, Constant(-0.0401095f));
  const V curve = hn::IfThenElse(hn::Lt(x, Constant(0.0031308f)), hn::Mul(x, Constant(12.92f)), p);
  return hn::Mul(curve, Constant(255.0f));
}

// Resolve: exposure, a shoulder from 0.7 up that reaches white at infinity only (so that glitter
// keeps its form), sRGB, a dither of one step, 8 bits.
HWY_INLINE VI ToByte(V linear, V exposure, V dither) {
  const V x = hn::Max(hn::Mul(linear, exposure), hn::Zero(D()));
  const V over = hn::Max(hn::Sub(x, Constant(0.7f)), hn::Zero(D()));
  V mapped = x;
  if (!hn::AllFalse(D(), hn::Gt(over, hn::Zero(D())))) {
    const V shoulder = hn::Div(over, hn::MulAdd(over, Constant(1.0f / 0.3f), Constant(1.0f)));
    mapped = hn::Min(hn::Add(hn::Min(x, Constant(0.7f)), shoulder), Constant(1.0f));
  }
  const V code = hn::Add(EncodeSrgb(mapped), dither);
  return hn::ConvertTo(DI(), hn::Min(code, Constant(255.0f)));
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
      const V dither = PixelNoise(hn::ConvertTo(d, hn::Iota(di, box.x0_px + x)),
                                  Constant(static_cast<float>(box.y0_px + y)));
      const VI r = ToByte(hn::Load(d, scratch.red.data() + i), exposure, dither);
      const VI g = ToByte(hn::Load(d, scratch.green.data() + i), exposure, dither);
      const VI b = ToByte(hn::Load(d, scratch.blue.data() + i), exposure, dither);
      const VI pixel =
          hn::Or(hn::Or(r, hn::ShiftLeft<8>(g)),
                 hn::Or(hn::ShiftLeft<16>(b), hn::Set(di, static_cast<std::int32_t>(0xff000000u))));
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

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
