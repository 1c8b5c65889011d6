#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "texture/sample_packets_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "texture/packed_map.h"
#include "texture/sample_packets.h"
//
#include "texture/cover_map-inl.h"
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

void store_packet(hn::Vec<D> a, hn::Vec<D> b, std::size_t first, std::span<Sample2> out) {
  HWY_ALIGN float a_packet[kLanes], b_packet[kLanes];
  hn::Store(a, D(), a_packet);
  hn::Store(b, D(), b_packet);
  for (std::size_t i = 0; i < kLanes && first + i < out.size(); ++i)
    out[first + i] = {a_packet[i], b_packet[i]};
}

hn::Vec<DI> load_packet(std::span<const int> from, std::size_t first) {
  HWY_ALIGN int packet[kLanes];
  copy_packet(from, first, packet);
  return hn::Load(DI(), packet);
}

void one_level(const PackedMap2& map, const MapPlaces& places, std::span<Sample2> out) {
  for (std::size_t first = 0; first < out.size(); first += kLanes) {
    hn::Vec<D> a, b;
    SampleLevel(D(), map, load_packet(places.x_fx8, first), load_packet(places.y_fx8, first),
                load_packet(places.level, first), a, b);
    store_packet(a, b, first, out);
  }
}

void one_channel(const PackedMap1& map, const MapPlaces& places, std::span<float> out) {
  const D d;
  HWY_ALIGN float packet[kLanes];
  for (std::size_t first = 0; first < out.size(); first += kLanes) {
    hn::Store(SampleLevel(d, map, load_packet(places.x_fx8, first),
                          load_packet(places.y_fx8, first), load_packet(places.level, first)),
              d, packet);
    std::copy_n(packet, std::min(kLanes, out.size() - first), out.data() + first);
  }
}

void blended(const PackedMap2& map, const MapPlaces& places, std::span<const float> t, float gain,
             std::span<Sample2> sums) {
  const D d;
  HWY_ALIGN float t_packet[kLanes], a_packet[kLanes], b_packet[kLanes];
  for (std::size_t first = 0; first < sums.size(); first += kLanes) {
    copy_packet(t, first, t_packet);
    for (std::size_t i = 0; i < kLanes; ++i) {
      const Sample2& before = sums[std::min(first + i, sums.size() - 1)];
      a_packet[i] = before.a, b_packet[i] = before.b;
    }
    hn::Vec<D> a = hn::Load(d, a_packet), b = hn::Load(d, b_packet);
    AddBlended(d, map,
               {load_packet(places.x_fx8, first), load_packet(places.y_fx8, first),
                load_packet(places.level, first), hn::Load(d, t_packet)},
               gain, a, b);
    store_packet(a, b, first, sums);
  }
}

void rgba(const RgbaImage& image, std::span<const float> x_px, std::span<const float> y_px,
          std::span<Sample4> out) {
  const D d;
  HWY_ALIGN float x_packet[kLanes], y_packet[kLanes], channels[4][kLanes];
  for (std::size_t first = 0; first < x_px.size(); first += kLanes) {
    copy_packet(x_px, first, x_packet);
    copy_packet(y_px, first, y_packet);
    const auto [r, g, b, a] = SampleRgba(d, image, hn::Load(d, x_packet), hn::Load(d, y_packet));
    hn::Store(r, d, channels[0]);
    hn::Store(g, d, channels[1]);
    hn::Store(b, d, channels[2]);
    hn::Store(a, d, channels[3]);
    for (std::size_t i = 0; i < kLanes && first + i < x_px.size(); ++i) {
      out[first + i] = {channels[0][i], channels[1][i], channels[2][i], channels[3][i]};
    }
  }
}

void rgba_level(const RgbaImage& image, std::span<const float> x_px, std::span<const float> y_px,
                std::span<const int> level, std::span<Sample4> out) {
  const D d;
  HWY_ALIGN int level_packet[kLanes];
  HWY_ALIGN float x_packet[kLanes], y_packet[kLanes], channels[4][kLanes];
  for (std::size_t first = 0; first < x_px.size(); first += kLanes) {
    copy_packet(x_px, first, x_packet);
    copy_packet(y_px, first, y_packet);
    copy_packet(level, first, level_packet);
    const auto [r, g, b, a] =
        SampleRgbaLevel(d, image, hn::Load(d, x_packet), hn::Load(d, y_packet),
                        hn::Load(hn::RebindToSigned<D>(), level_packet));
    hn::Store(r, d, channels[0]);
    hn::Store(g, d, channels[1]);
    hn::Store(b, d, channels[2]);
    hn::Store(a, d, channels[3]);
    for (std::size_t i = 0; i < kLanes && first + i < x_px.size(); ++i) {
      out[first + i] = {channels[0][i], channels[1][i], channels[2][i], channels[3][i]};
    }
  }
}

void rgb(const RgbMap& map, std::span<const float> x_fx8, std::span<const float> y_fx8,
         std::span<Sample3> out) {
  const D d;
  HWY_ALIGN float x_packet[kLanes], y_packet[kLanes], channels[3][kLanes];
  for (std::size_t first = 0; first < x_fx8.size(); first += kLanes) {
    copy_packet(x_fx8, first, x_packet);
    copy_packet(y_fx8, first, y_packet);
    hn::Vec<D> r, g, b;
    SampleRgb(d, map, hn::Load(d, x_packet), hn::Load(d, y_packet), r, g, b);
    hn::Store(r, d, channels[0]);
    hn::Store(g, d, channels[1]);
    hn::Store(b, d, channels[2]);
    for (std::size_t i = 0; i < kLanes && first + i < x_fx8.size(); ++i)
      out[first + i] = {channels[0][i], channels[1][i], channels[2][i]};
  }
}

void cover(const CoverMap& map, const MapPlaces& places, std::span<Sample4> out) {
  const D d;
  const hn::RebindToSigned<D> di;
  HWY_ALIGN int x_packet[kLanes], y_packet[kLanes], level_packet[kLanes];
  HWY_ALIGN float channels[4][kLanes];
  for (std::size_t first = 0; first < out.size(); first += kLanes) {
    copy_packet(places.x_fx8, first, x_packet);
    copy_packet(places.y_fx8, first, y_packet);
    copy_packet(places.level, first, level_packet);
    const auto [r, g, b, a] = SampleCover(d, map, hn::Load(di, x_packet), hn::Load(di, y_packet),
                                          hn::Load(di, level_packet));
    hn::Store(r, d, channels[0]);
    hn::Store(g, d, channels[1]);
    hn::Store(b, d, channels[2]);
    hn::Store(a, d, channels[3]);
    for (std::size_t i = 0; i < kLanes && first + i < out.size(); ++i)
      out[first + i] = {channels[0][i], channels[1][i], channels[2][i], channels[3][i]};
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::texture
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::texture {

HWY_EXPORT(one_level);
HWY_EXPORT(one_channel);
HWY_EXPORT(blended);
HWY_EXPORT(rgba);
HWY_EXPORT(rgba_level);
HWY_EXPORT(cover);
HWY_EXPORT(rgb);

std::vector<Sample2> sample_level(const PackedMap2& map, const MapPlaces& places) {
  std::vector<Sample2> out(places.level.size());
  HWY_DYNAMIC_DISPATCH(one_level)(map, places, out);
  return out;
}

std::vector<float> sample_level(const PackedMap1& map, const MapPlaces& places) {
  std::vector<float> out(places.level.size());
  HWY_DYNAMIC_DISPATCH(one_channel)(map, places, out);
  return out;
}

void add_blended(const PackedMap2& map, const MapPlaces& places, std::span<const float> t,
                 float gain, std::span<Sample2> sums) {
  HWY_DYNAMIC_DISPATCH(blended)(map, places, t, gain, sums);
}

std::vector<Sample4> sample_rgba(const RgbaImage& image, std::span<const float> x_px,
                                 std::span<const float> y_px) {
  std::vector<Sample4> out(x_px.size());
  HWY_DYNAMIC_DISPATCH(rgba)(image, x_px, y_px, out);
  return out;
}

std::vector<Sample4> sample_rgba_level(const RgbaImage& image, std::span<const float> x_px,
                                       std::span<const float> y_px, std::span<const int> level) {
  std::vector<Sample4> out(x_px.size());
  HWY_DYNAMIC_DISPATCH(rgba_level)(image, x_px, y_px, level, out);
  return out;
}

std::vector<Sample3> sample_rgb(const RgbMap& map, std::span<const float> x_fx8,
                                std::span<const float> y_fx8) {
  std::vector<Sample3> out(x_fx8.size());
  HWY_DYNAMIC_DISPATCH(rgb)(map, x_fx8, y_fx8, out);
  return out;
}

std::vector<Sample4> sample_cover(const CoverMap& map, const MapPlaces& places) {
  std::vector<Sample4> out(places.x_fx8.size());
  HWY_DYNAMIC_DISPATCH(cover)(map, places, out);
  return out;
}

}  // namespace swell::texture
#endif  // HWY_ONCE
