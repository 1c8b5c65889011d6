// Objects: paint, metal or a picture above the water, seen through it below.
#if defined(SWELL_RENDER_MATERIALS_OBJECT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_MATERIALS_OBJECT_INL_H_
#undef SWELL_RENDER_MATERIALS_OBJECT_INL_H_
#else
#define SWELL_RENDER_MATERIALS_OBJECT_INL_H_
#endif

#include "render/materials/checker-inl.h"
#include "render/materials/implicit-inl.h"
#include "render/materials/object.h"
#include "render/materials/reflected_caustics-inl.h"
#include "render/packets/fresnel-inl.h"
#include "render/packets/lanes3-inl.h"
#include "render/sky/fog-inl.h"
#include "render/sky/sky_map-inl.h"
#include "render/tile/caustics-inl.h"
#include "render/tile/self_shadow-inl.h"
#include "render/tile/shading_result-inl.h"
#include "render/tile/sun_shadow-inl.h"
#include "render/tile/through_water-inl.h"
#include "texture/mip_image.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// What a packet's pixels show of their objects.
struct ObjectSurface {
  V3 normal;  // unit, on the side that is seen
  V3 albedo;  // of metal: what it mirrors
  V roughness, metalness, translucency;
};

// The height of each pixel's waterline relative to the eye.
HWY_INLINE V WaterlineOf(const ObjectPrimitive* const* primitive) {
  HWY_ALIGN float waterline[Lanes3::kCount];
  for (std::size_t i = 0; i < Lanes3::kCount; ++i)
    waterline[i] = primitive[i]->object->waterline_rel_m;
  return hn::Load(D(), waterline);
}

// What lies on a triangle at q of its mesh's box, in a picture `footprint` m of which a pixel
// shows.
inline glm::vec3 TexelAt(const ObjectPrimitive& primitive, glm::vec3 q, float log2_footprint_m,
                         bool has_textures) {
  const shapes::ObjectMesh& mesh = *primitive.object->mesh;
  const shapes::TriangleTexture& t =
      mesh.textured[static_cast<std::size_t>(primitive.triangle - mesh.triangles.data())];
  if (t.texture < 0) return glm::vec3(1.0f);
  const texture::MipImage& image = (*mesh.textures)[static_cast<std::size_t>(t.texture)];
  const float level =
      log2_footprint_m + primitive.object->log2_units_per_m + t.log2_texels_per_unit;
  const auto at = [&](const glm::vec4& plane) {
    return plane[0] + q.x * plane[1] + q.y * plane[2] + q.z * plane[3];
  };
  return texture::sample(image, at(t.u), at(t.v), has_textures ? level : 1e9f);
}

// Returns an object's squares per unit on one of its triangles: 0 across the triangle, where a
// square would end just there.
inline glm::vec3 SquaresAlong(const ObjectPrimitive& primitive) {
  glm::vec3 squares = primitive.object->squares_per_unit;
  if (squares.x <= 0.0f) return squares;
  const glm::vec3 n = glm::abs(primitive.triangle->flat_normal / squares);
  squares[n.x > n.y ? (n.x > n.z ? 0 : 2) : (n.y > n.z ? 1 : 2)] = 0.0f;
  return squares;
}

// What a packet's triangles and their objects hold, a lane each.
struct ObjectLanes {
  Lanes3 bottom, right, ahead, up, at_origin, along_x, along_y, along_z, albedo, flat;
  Lanes3 finish;  // roughness, metalness, translucency
  Lanes3 squares;
  HWY_ALIGN float squares_per_m[Lanes3::kCount];
  bool has_pictures = false, has_squares = false;

  HWY_INLINE explicit ObjectLanes(const ObjectPrimitive* const* primitive) {
    for (std::size_t i = 0; i < Lanes3::kCount; ++i) {
      const ObjectInstance& object = *primitive[i]->object;
      const shapes::ObjectTriangle& triangle = *primitive[i]->triangle;
      bottom.Set(i, object.bottom_rel);
      right.Set(i, object.right);
      ahead.Set(i, object.ahead);
      up.Set(i, object.up);
      at_origin.Set(i, triangle.normal_at_origin);
      along_x.Set(i, triangle.normal_along_x);
      along_y.Set(i, triangle.normal_along_y);
      along_z.Set(i, triangle.normal_along_z);
      flat.Set(i, triangle.flat_normal);
      const float paint = triangle.painted ? 1.0f : 0.0f;
      const glm::vec3 tint = triangle.tint, colour = object.colour;
      const auto painted = [&](float t, float c) { return t * (paint * c + (1.0f - paint)); };
      albedo.Set(i,
                 {painted(tint.x, colour.x), painted(tint.y, colour.y), painted(tint.z, colour.z)});
      const glm::vec2 own(triangle.roughness, triangle.metalness);
      const glm::vec2 its = triangle.painted ? glm::vec2(object.roughness, object.metalness) : own;
      finish.Set(i, {its.x, its.y, triangle.translucency});
      has_pictures |= !object.mesh->textured.empty();
      has_squares |= object.squares_per_m > 0.0f;
      squares_per_m[i] = object.squares_per_m;
      squares.Set(i, SquaresAlong(*primitive[i]));
    }
  }
};

// Multiplies the albedo by what the meshes' pictures show at q, pixels of this footprint wide.
HWY_INLINE void TakePictures(const ObjectPrimitive* const* primitive, bool has_textures, V3 q,
                             V footprint, Lanes3& albedo) {
  HWY_ALIGN float x[Lanes3::kCount], y[Lanes3::kCount], z[Lanes3::kCount], size[Lanes3::kCount];
  hn::Store(q.x, D(), x);
  hn::Store(q.y, D(), y);
  hn::Store(q.z, D(), z);
  hn::Store(footprint, D(), size);
  for (std::size_t i = 0; i < Lanes3::kCount; ++i) {
    if (primitive[i]->object->mesh->textured.empty()) continue;
    const glm::vec3 texel = TexelAt(*primitive[i], {x[i], y[i], z[i]}, size[i], has_textures);
    albedo.Set(i, {albedo.x[i] * texel.x, albedo.y[i] * texel.y, albedo.z[i] * texel.z});
  }
}

// What the triangles hold at points p relative to the eye.
HWY_INLINE ObjectSurface SampleObject(const Object& material, const ViewRays& rays,
                                      const ObjectPrimitive* const* primitive,
                                      const Packet& packet) {
  ObjectLanes lanes(primitive);
  // To the mesh's coordinates, the normal there, and back.
  const V3 q_rel = packet.p - lanes.bottom.Load();
  const V3 q = {Dot(q_rel, lanes.right.Load()), Dot(q_rel, lanes.ahead.Load()),
                Dot(q_rel, lanes.up.Load())};
  const auto to_world = [&](V3 n) HWY_ATTR {
    return MulAdd(lanes.right.Load(), n.x, MulAdd(lanes.ahead.Load(), n.y, lanes.up.Load() * n.z));
  };
  V3 n_mesh = MulAdd(
      lanes.along_x.Load(), q.x,
      MulAdd(lanes.along_y.Load(), q.y, MulAdd(lanes.along_z.Load(), q.z, lanes.at_origin.Load())));
  const auto of_implicits = TakeImplicitNormals(primitive, q, n_mesh);
  const V3 n = to_world(n_mesh);
  // A surface without a back has the normal of the side that is seen.
  const V inverse = InverseSqrt(Max(Dot(n, n), 1e-30f));
  const auto from_behind =
      hn::AndNot(of_implicits, Dot(to_world(lanes.flat.Load()), packet.to_eye) < 0.0f);
  const V3 finishes = lanes.finish.Load();
  ObjectSurface surface = {n * IfThenElse(from_behind, -inverse, inverse), lanes.albedo.Load(),
                           finishes.x, finishes.y, finishes.z};
  if (lanes.has_squares) {
    const V half_m = HalfFootprint(rays, packet, Dot(surface.normal, packet.to_eye));
    const V half_px = half_m * hn::Load(D(), lanes.squares_per_m);
    surface.albedo = surface.albedo * CheckeredPaint(lanes.squares.Load(), q, half_px);
  }
  if (!lanes.has_pictures) return surface;
  const V footprint = FootprintLevel(FootprintAcross(rays, packet),
                                     Max(Abs(Dot(surface.normal, packet.to_eye)), 0.05f));
  TakePictures(primitive, material.has_textures, q, footprint, lanes.albedo);
  surface.albedo = lanes.albedo.Load();
  return surface;
}

// Light that a matt surface sends back: of the sun, straight and reflected by waves, of the sky
// above, of the sea below.
HWY_INLINE V3 MattLight(const Light& light, glm::vec3 sea_light, const ObjectSurface& s,
                        const LightSeen& seen, V reflected) {
  const V facing = Dot(s.normal, Constant(light.sun_direction));
  const V lit = Max(facing, -facing * s.translucency);
  const V cos_sun = MulAdd(Max(lit, 0.0f), seen.sun, reflected);
  const V sky_seen = MulAdd(s.normal.z, 0.5f, 0.5f);
  const V3 around = Lerp(Constant(sea_light), Constant(light.ambient), sky_seen) * seen.ambient;
  const V matt = 1.0f - s.metalness;
  return s.albedo * matt * MulAdd(Constant(light.sun_irradiance), cos_sun * 0.318309886f, around);
}

// What varnish or metal mirrors of sky and sun, to the eye in direction to_eye. Rough varnish
// mirrors less of the sky, as sea air dulls paint: half at the common roughness of 0.42.
HWY_INLINE V3 Gloss(const Light& light, glm::vec3 sea_light, const ObjectSurface& s, V3 to_eye,
                    V sun_visible) {
  const D d;
  const V zero = hn::Zero(d);
  const V cos_eye = Max(Dot(s.normal, to_eye), zero);
  const V dull = Max(NegMulAdd(s.roughness, 1.0f / 0.84f, 1.0f), zero);
  const V varnish = FresnelReflectance(d, Max(cos_eye, 0.1f), 1.5f) * dull;
  const auto mirrored = [&](V dielectric) HWY_ATTR {
    return Lerp(V3{dielectric, dielectric, dielectric}, s.albedo, s.metalness);
  };
  V3 r = MulAdd(s.normal, cos_eye + cos_eye, -to_eye);
  // Rays that go down meet the sea, which is darker. Dull paint spreads what it mirrors: a line
  // between the two would be drawn on everything round.
  const V below = Clamp(MulAdd(r.z, -1.6f, 0.5f), 0.0f, 1.0f);
  const V sea = below * below * NegMulAdd(below, 2.0f, 3.0f);
  const V lowest = Constant(0.02f), over = r.z - lowest;
  r.z = MulAdd(over + Sqrt(MulAdd(over, over, 0.01f)), 0.5f, lowest);
  const V3 sky =
      Lerp(SoftSkyRadiance(*light.sky_soft, r, Sqrt(Dot(r, r))), Constant(sea_light), sea);

  // Blinn and Phong's highlight, normalised, with the exponent n = 2 / roughness^4 - 2.
  const V3 half = to_eye + Constant(light.sun_direction);
  const V cos_half = Max(Dot(s.normal, half), zero) * InverseSqrt(Max(Dot(half, half), 1e-6f));
  const V alpha = Max(s.roughness * s.roughness, 0.0025f);
  const V exponent = 2.0f / (alpha * alpha) - 2.0f;
  const V log2 = Log2(d, Clamp(cos_half, 1e-6f, 1.0f));
  const V highlight = Exp2(d, log2 * exponent);
  const V gain = (exponent + 8.0f) * (1.0f / (8.0f * 3.14159265f));
  const V cos_sun = Max(Dot(s.normal, Constant(light.sun_direction)), zero) * sun_visible;
  const V sun = highlight * cos_sun * gain;
  const V3 of_sun = mirrored(Constant(0.04f)) * Constant(light.sun_irradiance);
  return MulAdd(of_sun, sun, sky * mirrored(varnish));
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

// What the lanes' objects leave of the sun on themselves.
HWY_INLINE V SunOverOwn(const Shading& s, const ObjectPacket& objects, const Packet& packet,
                        const V3& normal) {
  std::array<const SunDepth*, Lanes3::kCount> maps;
  const SunDepth* any = nullptr;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    maps[i] = objects[i]->object->self_shadow;
    if (maps[i]) any = maps[i];
  }
  return any ? SunOverOwn(*s.sun_shadow.objects, maps, packet.p, normal) : Constant(1.0f);
}

// A hull in the water shows no gloss.
template <ViewKind kView>
struct Shader<Object, kView> {
  const Object& object;

  HWY_INLINE ShadingResult operator()(const Shading& s, const TilePixels& tile, const Lanes& lanes,
                                      const Packet& packet) const {
    const ObjectPacket objects = ObjectsAt(s, lanes);
    const ObjectSurface surface = SampleObject(object, s.rays, objects.data(), packet);
    // What the object itself is before does not tell on the light from the water.
    V over_others = SunVisible(s, tile, packet, NumbersOf(objects));
    if (s.sun_shadow.under_trees.map) {
      const V above_m = packet.p.z - WaterlineOf(objects.data());
      over_others = over_others * SunUnderTrees(s, packet, Max(above_m, 0.0f));
    }
    if (s.media.fog.on) over_others = over_others * SunOverFog(s.media.fog, packet.p.z);
    V sun_visible = over_others * SunOverOwn(s, objects, packet, surface.normal);
    V reflected = hn::Zero(D());
    const V level_m = FootprintAcross(s.rays, packet);
    if (ShowsWaterSide<kView>(s.media))
      sun_visible = sun_visible *
                    GatheredSun(s, packet.p, PatternLevel<kView>(s.caustics.blur, packet, level_m));
    else
      reflected = over_others * ReflectedCaustics(s, packet.p, surface.normal, level_m);
    const V3 matt = MattLight(s.light, object.sea_light, surface,
                              {sun_visible, AmbientUnderClouds(s, packet.p)}, reflected);
    if (ShowsWaterSide<kView>(s.media)) return {matt, surface.normal};
    return {matt + Gloss(s.light, object.sea_light, surface, packet.to_eye, sun_visible),
            surface.normal};
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
