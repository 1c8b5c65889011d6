#include "render/shaders/shader_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/shaders/shader_kernels_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>

#include "render/materials/object-inl.h"
#include "render/materials/river-inl.h"
#include "render/materials/terrain-inl.h"
#include "render/materials/tree-inl.h"
#include "render/tile/attenuate-inl.h"
#include "render/tile/resolve-inl.h"
#include "render/tile/sky-inl.h"
#include "render/water/water-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// Elements [first, first + kLanes), the last one repeated.
V LoadSome(std::span<const float> from, std::size_t first) {
  HWY_ALIGN float lanes[kLanes];
  for (std::size_t i = 0; i < kLanes; ++i) lanes[i] = from[std::min(first + i, from.size() - 1)];
  return hn::Load(D(), lanes);
}

V3 LoadSome(std::span<const glm::vec3> from, std::size_t first) {
  HWY_ALIGN float lanes[3][kLanes];
  for (std::size_t i = 0; i < kLanes; ++i)
    for (int axis = 0; axis < 3; ++axis)
      lanes[axis][i] = from[std::min(first + i, from.size() - 1)][axis];
  return {hn::Load(D(), lanes[0]), hn::Load(D(), lanes[1]), hn::Load(D(), lanes[2])};
}

void StoreSome(V from, std::span<float> to, std::size_t first) {
  HWY_ALIGN float lanes[kLanes];
  hn::Store(from, D(), lanes);
  for (std::size_t i = 0; i < kLanes && first + i < to.size(); ++i) to[first + i] = lanes[i];
}

void StoreSome(V3 from, std::span<glm::vec3> to, std::size_t first) {
  HWY_ALIGN float lanes[3][kLanes];
  hn::Store(from.x, D(), lanes[0]);
  hn::Store(from.y, D(), lanes[1]);
  hn::Store(from.z, D(), lanes[2]);
  for (std::size_t i = 0; i < kLanes && first + i < to.size(); ++i)
    to[first + i] = {lanes[0][i], lanes[1][i], lanes[2][i]};
}

// Calls each(first element) for each packet of `count`.
template <class Each>
void ForPackets(std::size_t count, const Each& each) {
  for (std::size_t i = 0; i < count; i += kLanes) each(i);
}

void Sky(const Shading& shading, std::span<const float> x_px, std::span<const float> y_px,
         std::span<glm::vec3> light) {
  ForPackets(light.size(), [&](std::size_t i) {
    StoreSome(ShadeSky(shading, {}, nullptr, LoadSome(x_px, i), LoadSome(y_px, i)), light, i);
  });
}

void FacetsSeen(float cosine, float variance, SeenFacets& facets) {
  const V c = Constant(cosine), v = Constant(variance);
  facets = {hn::GetLane(SeenCosine(c, v)), hn::GetLane(MirroringCosine(c, v)),
            hn::GetLane(ReflectingCosine(c, v)), hn::GetLane(SeenArea(c, v))};
}

void UnhiddenCosines(std::span<const float> cosine, float level_cosine, float variance_all,
                     float drawn, std::span<float> unhidden) {
  ForPackets(cosine.size(), [&](std::size_t i) {
    StoreSome(UnhiddenCosine(LoadSome(cosine, i), Constant(level_cosine), Constant(variance_all),
                             Constant(drawn)),
              unhidden, i);
  });
}

void TiltedNormals(std::span<const glm::vec3> to_eye, float least_cos, std::span<glm::vec3> normal,
                   std::span<float> cosine) {
  ForPackets(cosine.size(), [&](std::size_t i) {
    V3 n = LoadSome(std::span<const glm::vec3>(normal), i);
    StoreSome(TiltToEye(LoadSome(to_eye, i), least_cos, n), cosine, i);
    StoreSome(n, normal, i);
  });
}

void Glint(const GlintSurface& surface, std::span<const glm::vec3> to_eye,
           std::span<const float> area, std::span<float> glint) {
  WaterSlopes s = NoSlopes(Constant(surface.variance), hn::Zero(D()), hn::Zero(D()));
  s.slope_x = Constant(surface.slope.x);
  s.slope_y = Constant(surface.slope.y);
  const auto reflectance = [&](V3) HWY_ATTR { return Constant(surface.reflectance); };
  ForPackets(glint.size(), [&](std::size_t i) {
    Packet packet;
    packet.to_eye = LoadSome(to_eye, i);
    V inv_variance;
    StoreSome(
        SunGlint(surface.sun_direction, packet, s, reflectance, LoadSome(area, i), inv_variance),
        glint, i);
  });
}

void LightOfWater(const Shading& shading, std::span<const glm::vec3> to_eye,
                  std::span<glm::vec3> light) {
  const WaterShader<false> shader{shading.material<Water>()};
  ForPackets(light.size(), [&](std::size_t i) {
    Packet packet;
    packet.x_px = packet.y_px = hn::Zero(D());
    packet.to_eye = LoadSome(to_eye, i);
    packet.distance = shading.rays.eye_z / packet.to_eye.z;
    packet.depth = packet.distance;
    packet.p = packet.to_eye * -packet.distance;
    WaterSlopes slopes;
    shader.LookUp(shading, std::span(&packet, 1), &slopes);
    StoreSome(shader(shading, TilePixels{}, Lanes{}, packet, slopes).light, light, i);
  });
}

void Cover(const SlopeLayer& lace, std::span<const glm::vec3> p_rel, float level_m,
           std::span<const float> amount, std::span<float> cover) {
  ForPackets(cover.size(), [&](std::size_t i) {
    StoreSome(FoamCover(lace, LoadSome(p_rel, i), Constant(level_m), LoadSome(amount, i)), cover,
              i);
  });
}

void Edge(const Swash& swash, std::span<const glm::vec3> p_rel, std::span<float> edge_m,
          std::span<float> retreat) {
  ForPackets(edge_m.size(), [&](std::size_t i) {
    const SwashEdge edge = FindSwashEdge(swash, LoadSome(p_rel, i));
    StoreSome(edge.edge_m, edge_m, i);
    StoreSome(edge.retreat, retreat, i);
  });
}

void Footprints(const ViewRays& rays, std::span<const float> depth, std::span<const float> cos_view,
                std::span<float> across, std::span<float> level) {
  ForPackets(depth.size(), [&](std::size_t i) {
    Packet packet;
    packet.depth = LoadSome(depth, i);
    const V log2_m = FootprintAcross(rays, packet);
    StoreSome(log2_m, across, i);
    StoreSome(FootprintLevel(log2_m, LoadSome(cos_view, i)), level, i);
  });
}

void LayerSlopes(const SlopeLayer& layer, std::span<const glm::vec3> p_rel,
                 std::span<const float> level_m, std::span<glm::vec3> slopes) {
  const V zero = hn::Zero(D());
  ForPackets(slopes.size(), [&](std::size_t i) {
    WaterSlopes s = NoSlopes(zero, zero, zero);
    AddSlopes(layer, LoadSome(p_rel, i), LoadSome(level_m, i), {zero, zero}, s.slope_x, s.slope_y,
              s.variance);
    StoreSome(V3{s.slope_x, s.slope_y, s.variance}, slopes, i);
  });
}

void SineSlopes(const SineLayer& sine, std::span<const glm::vec3> p_rel,
                std::span<const float> level_m, std::span<glm::vec3> slopes) {
  const V zero = hn::Zero(D());
  ForPackets(slopes.size(), [&](std::size_t i) {
    WaterSlopes s = NoSlopes(zero, zero, zero);
    AddSine(sine, LoadSome(p_rel, i), LoadSome(level_m, i), s);
    StoreSome(V3{s.slope_x, s.slope_y, s.variance}, slopes, i);
  });
}

void Path(const Media& media, std::span<const float> cos_eye, std::span<const float> apparent_m,
          std::span<float> depth_m, std::span<float> length_m) {
  ForPackets(cos_eye.size(), [&](std::size_t i) {
    Packet packet;
    packet.to_eye = {hn::Zero(D()), hn::Zero(D()), LoadSome(cos_eye, i)};
    const WaterPath path = PathThroughWater(media, packet, LoadSome(apparent_m, i));
    StoreSome(path.depth, depth_m, i);
    StoreSome(path.length, length_m, i);
  });
}

void Absorb(const Media& media, std::span<const float> length_m, glm::vec3 light,
            std::span<glm::vec3> seen) {
  ForPackets(seen.size(), [&](std::size_t i) {
    const WaterPath path = {hn::Zero(D()), LoadSome(length_m, i)};
    StoreSome(AbsorbInWater(media, path, Constant(media.body), Constant(light)), seen, i);
  });
}

void UnderWater(const Media& media, glm::vec3 daylight, std::span<const float> length_m,
                std::span<const float> deeper_m, glm::vec3 light, std::span<glm::vec3> seen) {
  ForPackets(seen.size(), [&](std::size_t i) {
    const WaterWay way = {LoadSome(length_m, i), LoadSome(deeper_m, i)};
    StoreSome(ThroughWater(media, daylight, way, Constant(light)), seen, i);
  });
}

void Endless(const Media& media, glm::vec3 daylight, std::span<const float> w,
             std::span<glm::vec3> seen) {
  ForPackets(seen.size(), [&](std::size_t i) {
    StoreSome(EndlessWater(media, daylight, LoadSome(w, i)), seen, i);
  });
}

void HazeBetween(const Shading& shading, std::span<const float> distance_m, glm::vec3 to_eye,
                 glm::vec3 light, std::span<glm::vec3> seen) {
  ForPackets(seen.size(), [&](std::size_t i) {
    Packet packet;
    packet.distance = LoadSome(distance_m, i);
    packet.to_eye = Constant(to_eye);
    packet.p = packet.to_eye * -packet.distance;
    const V r2 = MulAdd(packet.p.x, packet.p.x, packet.p.y * packet.p.y);
    packet.p.z = MulAdd(r2, shading.rays.drop_per_m2, packet.p.z);
    StoreSome(Haze(shading, packet, Constant(light)), seen, i);
  });
}

void SeeFogAlong(const Fog& fog, const FogStart& start, std::span<const glm::vec3> direction,
                 std::span<const float> distance_m, std::span<glm::vec3> passes,
                 std::span<glm::vec3> added) {
  ForPackets(direction.size(), [&](std::size_t i) {
    const V3 d = LoadSome(direction, i);
    const V distance = LoadSome(distance_m, i);
    const V height = MulAdd(d.z, distance, start.height_m);
    const FogRay ray = {{d, distance, height, start.height_m}, start};
    const FogView to_place = SeeFog(fog, ray, PathTo(fog, ray));
    const FogView to_sky = SeeFog(fog, ray, PathToSky(fog, ray));
    const auto is_sky = distance >= kEndless_m;
    StoreSome(IfThenElse(is_sky, to_sky.passes, to_place.passes), passes, i);
    StoreSome(IfThenElse(is_sky, to_sky.added, to_place.added), added, i);
  });
}

void StarsIn(const Stars& stars, std::span<const glm::vec3> direction, float radius,
             std::span<glm::vec3> light) {
  ForPackets(direction.size(), [&](std::size_t i) {
    StoreSome(StarLight(stars, LoadSome(direction, i), Constant(radius)), light, i);
  });
}

template <ViewKind kView>
void FindPoints(const Media& media, float level_rel_m, std::span<const glm::vec3> p_shown,
                std::span<glm::vec3> p_rel) {
  ViewShading shading;
  shading.media = media;
  ForPackets(p_rel.size(), [&](std::size_t i) {
    Packet packet;
    packet.p = LoadSome(p_shown, i);
    packet.distance = Sqrt(Dot(packet.p, packet.p));
    packet.to_eye = packet.p * (-1.0f / packet.distance);
    StoreSome(FindSeen<kView>(shading, packet, Constant(level_rel_m)).packet.p, p_rel, i);
  });
}

void Find(ViewKind kind, const Media& media, float level_rel_m, std::span<const glm::vec3> p_shown,
          std::span<glm::vec3> p_rel) {
  if (kind == ViewKind::kReflection)
    FindPoints<ViewKind::kReflection>(media, level_rel_m, p_shown, p_rel);
  else
    FindPoints<ViewKind::kRefraction>(media, level_rel_m, p_shown, p_rel);
}

void Srgb(std::span<const float> linear, std::span<float> code) {
  ForPackets(code.size(),
             [&](std::size_t i) { StoreSome(EncodeSrgb(LoadSome(linear, i)), code, i); });
}

void Bytes(std::span<const float> linear, float exposure, std::span<const float> dither,
           std::span<int> byte) {
  HWY_ALIGN int lanes[kLanes];
  ForPackets(byte.size(), [&](std::size_t first) {
    const V display = ToneCurve(LoadSome(linear, first), Constant(exposure));
    hn::Store(ToByte(display, LoadSome(dither, first)), DI(), lanes);
    for (std::size_t i = 0; i < kLanes && first + i < byte.size(); ++i) byte[first + i] = lanes[i];
  });
}

void LightCode(std::span<const float> light, std::span<int> byte, std::span<float> decoded) {
  ForPackets(light.size(), [&](std::size_t i) {
    const VI code = EncodeLight(LoadSome(light, i));
    HWY_ALIGN std::array<std::int32_t, kLanes> lanes;
    hn::Store(code, DI(), lanes.data());
    for (std::size_t k = 0; k < kLanes && i + k < byte.size(); ++k) byte[i + k] = lanes[k];
    // Other channels change nothing.
    const V part = hn::ConvertTo(D(), code) * (1.0f / 255.0f);
    StoreSome(DecodeLight({part, hn::Zero(D()), Constant(1.0f)}).x, decoded, i);
  });
}

void Noise(std::span<const float> x_px, std::span<const float> y_px, std::span<float> noise) {
  ForPackets(noise.size(), [&](std::size_t i) {
    StoreSome(PixelNoise(LoadSome(x_px, i), LoadSome(y_px, i)), noise, i);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::render {

HWY_EXPORT(Sky);
HWY_EXPORT(Glint);
HWY_EXPORT(FacetsSeen);
HWY_EXPORT(UnhiddenCosines);
HWY_EXPORT(TiltedNormals);
HWY_EXPORT(LightOfWater);
HWY_EXPORT(Cover);
HWY_EXPORT(Edge);
HWY_EXPORT(Footprints);
HWY_EXPORT(LayerSlopes);
HWY_EXPORT(SineSlopes);
HWY_EXPORT(Path);
HWY_EXPORT(Absorb);
HWY_EXPORT(Endless);
HWY_EXPORT(UnderWater);
HWY_EXPORT(HazeBetween);
HWY_EXPORT(SeeFogAlong);
HWY_EXPORT(StarsIn);
HWY_EXPORT(Find);
HWY_EXPORT(Srgb);
HWY_EXPORT(Bytes);
HWY_EXPORT(LightCode);
HWY_EXPORT(Noise);

void sun_glint(const GlintSurface& surface, std::span<const glm::vec3> to_eye,
               std::span<const float> area, std::span<float> glint) {
  HWY_DYNAMIC_DISPATCH(Glint)(surface, to_eye, area, glint);
}

SeenFacets seen_facets(float cosine, float variance) {
  SeenFacets facets;
  HWY_DYNAMIC_DISPATCH(FacetsSeen)(cosine, variance, facets);
  return facets;
}

void unhidden_cosines(std::span<const float> cosine, float level_cosine, float variance_all,
                      float drawn, std::span<float> unhidden) {
  HWY_DYNAMIC_DISPATCH(UnhiddenCosines)(cosine, level_cosine, variance_all, drawn, unhidden);
}

void tilted_normals(std::span<const glm::vec3> to_eye, float least_cos, std::span<glm::vec3> normal,
                    std::span<float> cosine) {
  HWY_DYNAMIC_DISPATCH(TiltedNormals)(to_eye, least_cos, normal, cosine);
}

void water_light(const Shading& shading, std::span<const glm::vec3> to_eye,
                 std::span<glm::vec3> light) {
  HWY_DYNAMIC_DISPATCH(LightOfWater)(shading, to_eye, light);
}

void sky_light(const Shading& shading, std::span<const float> x_px, std::span<const float> y_px,
               std::span<glm::vec3> light) {
  HWY_DYNAMIC_DISPATCH(Sky)(shading, x_px, y_px, light);
}

void foam_cover(const SlopeLayer& lace, std::span<const glm::vec3> p_rel, float level_m,
                std::span<const float> amount, std::span<float> cover) {
  HWY_DYNAMIC_DISPATCH(Cover)(lace, p_rel, level_m, amount, cover);
}

void swash_edge(const Swash& swash, std::span<const glm::vec3> p_rel, std::span<float> edge_m,
                std::span<float> retreat) {
  HWY_DYNAMIC_DISPATCH(Edge)(swash, p_rel, edge_m, retreat);
}

void footprints(const ViewRays& rays, std::span<const float> depth, std::span<const float> cos_view,
                std::span<float> across, std::span<float> level) {
  HWY_DYNAMIC_DISPATCH(Footprints)(rays, depth, cos_view, across, level);
}

void add_slopes(const SlopeLayer& layer, std::span<const glm::vec3> p_rel,
                std::span<const float> level_m, std::span<glm::vec3> slopes) {
  HWY_DYNAMIC_DISPATCH(LayerSlopes)(layer, p_rel, level_m, slopes);
}

void add_sine(const SineLayer& sine, std::span<const glm::vec3> p_rel,
              std::span<const float> level_m, std::span<glm::vec3> slopes) {
  HWY_DYNAMIC_DISPATCH(SineSlopes)(sine, p_rel, level_m, slopes);
}

void path_through_water(const Media& media, std::span<const float> cos_eye,
                        std::span<const float> apparent_m, std::span<float> depth_m,
                        std::span<float> length_m) {
  HWY_DYNAMIC_DISPATCH(Path)(media, cos_eye, apparent_m, depth_m, length_m);
}

void absorb_in_water(const Media& media, std::span<const float> length_m, glm::vec3 light,
                     std::span<glm::vec3> seen) {
  HWY_DYNAMIC_DISPATCH(Absorb)(media, length_m, light, seen);
}

void through_water(const Media& media, glm::vec3 daylight, std::span<const float> length_m,
                   std::span<const float> deeper_m, glm::vec3 light, std::span<glm::vec3> seen) {
  HWY_DYNAMIC_DISPATCH(UnderWater)(media, daylight, length_m, deeper_m, light, seen);
}

void endless_water(const Media& media, glm::vec3 daylight, std::span<const float> w,
                   std::span<glm::vec3> seen) {
  HWY_DYNAMIC_DISPATCH(Endless)(media, daylight, w, seen);
}

void see_fog(const Fog& fog, const FogStart& start, std::span<const glm::vec3> direction,
             std::span<const float> distance_m, std::span<glm::vec3> passes,
             std::span<glm::vec3> added) {
  HWY_DYNAMIC_DISPATCH(SeeFogAlong)(fog, start, direction, distance_m, passes, added);
}

void star_light(const Stars& stars, std::span<const glm::vec3> direction, float radius,
                std::span<glm::vec3> light) {
  HWY_DYNAMIC_DISPATCH(StarsIn)(stars, direction, radius, light);
}

void haze(const Shading& shading, std::span<const float> distance_m, glm::vec3 to_eye,
          glm::vec3 light, std::span<glm::vec3> seen) {
  HWY_DYNAMIC_DISPATCH(HazeBetween)(shading, distance_m, to_eye, light, seen);
}

void find_seen(ViewKind kind, const Media& media, float level_rel_m,
               std::span<const glm::vec3> p_shown, std::span<glm::vec3> p_rel) {
  HWY_DYNAMIC_DISPATCH(Find)(kind, media, level_rel_m, p_shown, p_rel);
}

void encode_srgb(std::span<const float> linear, std::span<float> code) {
  HWY_DYNAMIC_DISPATCH(Srgb)(linear, code);
}

void to_byte(std::span<const float> linear, float exposure, std::span<const float> dither,
             std::span<int> byte) {
  HWY_DYNAMIC_DISPATCH(Bytes)(linear, exposure, dither, byte);
}

void light_code(std::span<const float> light, std::span<int> byte, std::span<float> decoded) {
  HWY_DYNAMIC_DISPATCH(LightCode)(light, byte, decoded);
}

void pixel_noise(std::span<const float> x_px, std::span<const float> y_px, std::span<float> noise) {
  HWY_DYNAMIC_DISPATCH(Noise)(x_px, y_px, noise);
}

}  // namespace swell::render
#endif  // HWY_ONCE
