#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "texture/sample_packets_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "texture/packed_map.h"
#include "texture/sample_packets.h"
//
#include "texture/packed_map-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::texture {
namespace HWY_NAMESPACE {

using D = hn::ScalableTag<float>;
using DI = hn::RebindToSigned<D>;
constexpr std::size_t kLanes = hn::MaxLanes(D());

// Copies one packet, repeating the last element.
template <class T>
void copy_packet(std::span<const T> from, std::size_t first, T* packet) {
  for (std::size_t i = 0; i < kLanes; ++i) packet[i] = from[std::min(first + i, from.size() - 1)];
}

void packed2(const PackedMap2& map, std::span<const float> u, std::span<const float> v,
             std::span<const int> level, int uniform_level, std::span<Sample2> out) {
  const D d;
  const DI di;
  HWY_ALIGN float u_packet[kLanes], v_packet[kLanes], a_packet[kLanes], b_packet[kLanes];
  HWY_ALIGN int level_packet[kLanes];
  for (std::size_t first = 0; first < u.size(); first += kLanes) {
    copy_packet(u, first, u_packet);
    copy_packet(v, first, v_packet);
    hn::Vec<D> a, b;
    if (level.empty()) {
      SamplePacked2Level(d, map, hn::Load(d, u_packet), hn::Load(d, v_packet), uniform_level, a, b);
    } else {
      copy_packet(level, first, level_packet);
      SamplePacked2(d, map, hn::Load(d, u_packet), hn::Load(d, v_packet),
                    hn::Load(di, level_packet), a, b);
    }
    hn::Store(a, d, a_packet);
    hn::Store(b, d, b_packet);
    for (std::size_t i = 0; i < kLanes && first + i < u.size(); ++i) {
      out[first + i] = {a_packet[i], b_packet[i]};
    }
  }
}

void rgba(const RgbaImage& image, std::span<const float> x_px, std::span<const float> y_px,
          std::span<Sample4> out) {
  const D d;
  HWY_ALIGN float x_packet[kLanes], y_packet[kLanes], channels[4][kLanes];
  for (std::size_t first = 0; first < x_px.size(); first += kLanes) {
    copy_packet(x_px, first, x_packet);
    copy_packet(y_px, first, y_packet);
    hn::Vec<D> r, g, b, a;
    SampleRgba(d, image, hn::Load(d, x_packet), hn::Load(d, y_packet), r, g, b, a);
    hn::Store(r, d, channels[0]);
    hn::Store(g, d, channels[1]);
    hn::Store(b, d, channels[2]);
    hn::Store(a, d, channels[3]);
    for (std::size_t i = 0; i < kLanes && first + i < x_px.size(); ++i) {
      out[first + i] = {channels[0][i], channels[1][i], channels[2][i], channels[3][i]};
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::texture
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::texture {

HWY_EXPORT(packed2);
HWY_EXPORT(rgba);

std::vector<Sample2> sample_packed2(const PackedMap2& map, std::span<const float> u,
                                    std::span<const float> v, std::span<const int> level) {
  std::vector<Sample2> out(u.size());
  HWY_DYNAMIC_DISPATCH(packed2)(map, u, v, level, 0, out);
  return out;
}

std::vector<Sample2> sample_packed2_level(const PackedMap2& map, std::span<const float> u,
                                          std::span<const float> v, int level) {
  std::vector<Sample2> out(u.size());
  HWY_DYNAMIC_DISPATCH(packed2)(map, u, v, {}, level, out);
  return out;
}

std::vector<Sample4> sample_rgba(const RgbaImage& image, std::span<const float> x_px,
                                 std::span<const float> y_px) {
  std::vector<Sample4> out(x_px.size());
  HWY_DYNAMIC_DISPATCH(rgba)(image, x_px, y_px, out);
  return out;
}

}  // namespace swell::texture
#endif  // HWY_ONCE
