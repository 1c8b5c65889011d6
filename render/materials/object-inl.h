// Floating objects: painted steel above the water, seen through it below.
#if defined(SWELL_RENDER_MATERIALS_OBJECT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_MATERIALS_OBJECT_INL_H_
#undef SWELL_RENDER_MATERIALS_OBJECT_INL_H_
#else
#define SWELL_RENDER_MATERIALS_OBJECT_INL_H_
#endif

#include "render/materials/caustics-inl.h"
#include "render/materials/fresnel-inl.h"
#include "render/materials/object.h"
#include "render/tile/sun_shadow-inl.h"
#include "render/tile/surfel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// What a packet's pixels show of their objects.
struct ObjectSurface {
  V3 normal;  // unit
  V3 albedo;
};

// A vector a lane, filled one by one: objects cover few pixels, and what their triangles hold is
// too much for gathers to be quick.
struct Lanes3 {
  static constexpr std::size_t kCount = hn::MaxLanes(D());
  HWY_ALIGN float x[kCount];
  HWY_ALIGN float y[kCount];
  HWY_ALIGN float z[kCount];

  void Set(std::size_t lane, glm::vec3 v) { x[lane] = v.x, y[lane] = v.y, z[lane] = v.z; }
  V3 Load() const { return {hn::Load(D(), x), hn::Load(D(), y), hn::Load(D(), z)}; }
};

// The height of each pixel's waterline relative to the eye.
HWY_INLINE V WaterlineOf(const ObjectPrimitive* const* primitive) {
  HWY_ALIGN float waterline[Lanes3::kCount];
  for (std::size_t i = 0; i < Lanes3::kCount; ++i)
    waterline[i] = primitive[i]->object->waterline_rel_m;
  return hn::Load(D(), waterline);
}

// What the triangles hold at points p relative to the eye.
HWY_INLINE ObjectSurface SampleObject(const ObjectPrimitive* const* primitive, V3 p) {
  Lanes3 bottom, right, ahead, up, at_origin, along_x, along_y, along_z, albedo;
  for (std::size_t i = 0; i < Lanes3::kCount; ++i) {
    const ObjectInstance& object = *primitive[i]->object;
    const scene::ObjectTriangle& triangle = *primitive[i]->triangle;
    bottom.Set(i, object.bottom_rel);
    right.Set(i, object.right);
    ahead.Set(i, object.ahead);
    up.Set(i, object.up);
    at_origin.Set(i, triangle.normal_at_origin);
    along_x.Set(i, triangle.normal_along_x);
    along_y.Set(i, triangle.normal_along_y);
    along_z.Set(i, triangle.normal_along_z);
    const float paint = triangle.painted ? 1.0f : 0.0f;
    const glm::vec3 tint = triangle.tint, colour = object.colour;
    const auto painted = [&](float t, float c) { return t * (paint * c + (1.0f - paint)); };
    albedo.Set(i,
               {painted(tint.x, colour.x), painted(tint.y, colour.y), painted(tint.z, colour.z)});
  }
  // To the mesh's coordinates, the normal there, and back.
  const V3 q = Sum(p, Scale(bottom.Load(), Constant(-1.0f)));
  const V3 normal =
      ScaleAdd(along_x.Load(), Dot(q, right.Load()),
               ScaleAdd(along_y.Load(), Dot(q, ahead.Load()),
                        ScaleAdd(along_z.Load(), Dot(q, up.Load()), at_origin.Load())));
  const V3 n = ScaleAdd(right.Load(), normal.x,
                        ScaleAdd(ahead.Load(), normal.y, Scale(up.Load(), normal.z)));
  return {Scale(n, InverseSqrt(hn::Max(Dot(n, n), Constant(1e-30f)))), albedo.Load()};
}

// Light that a matt surface sends back: of the sun, of the sky above, of the sea below.
HWY_INLINE V3 MattLight(const Light& light, glm::vec3 sea_light, const ObjectSurface& s,
                        V sun_visible) {
  const V cos_sun =
      hn::Mul(hn::Max(Dot(s.normal, Constant(light.sun_direction)), hn::Zero(D())), sun_visible);
  const V sky_seen = hn::MulAdd(s.normal.z, Constant(0.5f), Constant(0.5f));
  const V3 around = Lerp(Constant(sea_light), Constant(light.ambient), sky_seen);
  return Product(s.albedo, ScaleAdd(Constant(light.sun_irradiance),
                                    hn::Mul(cos_sun, Constant(0.318309886f)), around));
}

// What varnish mirrors of sky and sun, to the eye in direction to_eye.
HWY_INLINE V3 Gloss(const Light& light, glm::vec3 sea_light, const ObjectSurface& s, V3 to_eye,
                    V sun_visible) {
  const D d;
  const V zero = hn::Zero(d);
  const V cos_eye = hn::Max(Dot(s.normal, to_eye), zero);
  // Half of a polished surface's: sea air dulls paint.
  const V reflectance =
      hn::Mul(FresnelReflectance(d, hn::Max(cos_eye, Constant(0.1f)), 1.5f), Constant(0.5f));
  V3 r = ScaleAdd(s.normal, hn::Add(cos_eye, cos_eye), Scale(to_eye, Constant(-1.0f)));
  // Rays that go down meet the sea, which is darker. Dull paint spreads what it mirrors: a line
  // between the two would be drawn on everything round.
  const V below = Clamp(hn::MulAdd(r.z, Constant(-1.6f), Constant(0.5f)), 0.0f, 1.0f);
  const V sea =
      hn::Mul(hn::Mul(below, below), hn::NegMulAdd(below, Constant(2.0f), Constant(3.0f)));
  const V lowest = Constant(0.02f), over = hn::Sub(r.z, lowest);
  r.z = hn::MulAdd(hn::Add(over, hn::Sqrt(hn::MulAdd(over, over, Constant(0.01f)))), Constant(0.5f),
                   lowest);
  const V3 sky =
      Lerp(SoftSkyRadiance(*light.sky_soft, r, hn::Sqrt(Dot(r, r))), Constant(sea_light), sea);

  // Blinn and Phong's highlight with exponent 64, normalised.
  const V3 half = Sum(to_eye, Constant(light.sun_direction));
  const V cos_half = hn::Mul(hn::Max(Dot(s.normal, half), zero),
                             InverseSqrt(hn::Max(Dot(half, half), Constant(1e-6f))));
  V highlight = hn::Min(cos_half, Constant(1.0f));
  for (int i = 0; i < 6; ++i) highlight = hn::Mul(highlight, highlight);
  const V cos_sun =
      hn::Mul(hn::Max(Dot(s.normal, Constant(light.sun_direction)), zero), sun_visible);
  const V sun =
      hn::Mul(hn::Mul(highlight, cos_sun), Constant(0.04f * 72.0f / (8.0f * 3.14159265f)));
  return ScaleAdd(Constant(light.sun_irradiance), sun, Scale(sky, reflectance));
}

// What the lanes show.
using ObjectPacket = std::array<const ObjectPrimitive*, Lanes3::kCount>;
HWY_INLINE ObjectPacket ObjectsAt(const Shading& s, const Lanes& lanes) {
  const std::uint32_t first = s.primitives.begin(Object::kSurface);
  ObjectPacket packet;
  for (std::size_t lane = 0; lane < packet.size(); ++lane)
    packet[lane] = &s.material<Object>().primitives[lanes.primitive(lane) - first];
  return packet;
}

// Their numbers in the scene.
HWY_INLINE V NumbersOf(const ObjectPacket& objects) {
  HWY_ALIGN float number[Lanes3::kCount];
  for (std::size_t i = 0; i < Lanes3::kCount; ++i)
    number[i] = static_cast<float>(objects[i]->object->object);
  return hn::Load(D(), number);
}

// An object's images in the water begin at its own waterline.
HWY_INLINE V WaterLevel(const Object&, const Shading& s, const Lanes& lanes) {
  return WaterlineOf(ObjectsAt(s, lanes).data());
}

// A hull in the water shows no gloss.
template <ViewKind kView>
struct Shader<Object, kView> {
  const Object& object;

  HWY_INLINE Surfel operator()(const Shading& s, const TilePixels& tile, const Lanes& lanes,
                               const Packet& packet) const {
    const ObjectPacket objects = ObjectsAt(s, lanes);
    const ObjectSurface surface = SampleObject(objects.data(), packet.p);
    V sun_visible = SunVisible(s, tile, packet, NumbersOf(objects));
    if constexpr (kView == ViewKind::kRefraction)
      sun_visible = hn::Mul(sun_visible, GatheredSun(s, packet.p, FootprintAcross(s.rays, packet)));
    const V3 matt = MattLight(s.light, object.sea_light, surface, sun_visible);
    if constexpr (kView == ViewKind::kRefraction) return {matt, surface.normal};
    return {Sum(matt, Gloss(s.light, object.sea_light, surface, packet.to_eye, sun_visible)),
            surface.normal};
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
