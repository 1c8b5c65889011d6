#include <algorithm>
#include <array>
#include <limits>

#include "math/check.h"
#include "render/picture/label_tile.h"
#include "render/tile/shading.h"
#include "render/world/land_rays.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/picture/label_tile_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/packets/packet-inl.h"
#include "render/world/world_state.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// --- Stores: of the first `count` lanes

HWY_INLINE void StoreLanes(V v, std::size_t count, float* to) {
  if (count == kLanes)
    hn::StoreU(v, D(), to);
  else
    hn::BlendedStore(v, hn::FirstN(D(), count), D(), to);
}

HWY_INLINE void StoreLanes(VU v, std::size_t count, std::uint32_t* to) {
  if (count == kLanes)
    hn::StoreU(v, DU(), to);
  else
    hn::BlendedStore(v, hn::FirstN(DU(), count), DU(), to);
}

HWY_INLINE void StoreLanes(V3 v, std::size_t count, glm::vec3* to) {
  static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
  if (count == kLanes) return hn::StoreInterleaved3(v.x, v.y, v.z, D(), &to->x);
  HWY_ALIGN std::array<glm::vec3, kLanes> all;
  hn::StoreInterleaved3(v.x, v.y, v.z, D(), &all[0].x);
  std::copy_n(all.begin(), count, to);
}

HWY_INLINE void StoreLanes(V x, V y, std::size_t count, glm::vec2* to) {
  static_assert(sizeof(glm::vec2) == 2 * sizeof(float));
  if (count == kLanes) return hn::StoreInterleaved2(x, y, D(), &to->x);
  HWY_ALIGN std::array<glm::vec2, kLanes> all;
  hn::StoreInterleaved2(x, y, D(), &all[0].x);
  std::copy_n(all.begin(), count, to);
}

HWY_INLINE void StoreBytes(V v, std::size_t count, std::uint8_t* to) {
  const hn::Rebind<std::uint8_t, D> d8;
  HWY_ALIGN std::array<std::uint8_t, kLanes> all;
  hn::StoreU(hn::DemoteTo(d8, hn::ConvertTo(DI(), v)), d8, all.data());
  std::copy_n(all.data(), count, to);
}

// --- Pixels

// A packet of neighbours in a row.
struct LabelPacket {
  V x_px, y_px;  // whole pixel numbers
  V z;           // as in the depth buffer; 0 where the sky is seen
  V depth;       // [m]; +inf where the sky is seen
  V3 ray;        // of depth 1
  VU primitive;
  M is_sky, is_water;
  std::size_t tile_at;  // of the first pixel in the tile's buffers
  std::size_t count;    // of pixels in the picture
};

HWY_INLINE M InRange(const PrimitiveRanges& ranges, SurfaceKind kind, VU primitive) {
  const std::uint32_t begin = ranges.begin(kind), size = ranges.end(kind) - begin;
  return hn::RebindMask(D(), primitive - begin < size);
}

// What packets are made from. A copy, so that storing labels cannot be thought to change it.
struct PacketSource {
  ViewRays rays;
  PrimitiveRanges primitives;
  raster::PixelBox box;
  int tile_size_px;
  const float* depth;  // null: open sky
  const std::uint32_t* primitive;
};

HWY_INLINE LabelPacket LoadPacket(const PacketSource& s, int x, int y) {
  const D d;
  const DU du;
  LabelPacket p;
  p.tile_at = static_cast<std::size_t>(y) * s.tile_size_px + x;
  p.count = std::min(kLanes, static_cast<std::size_t>(s.box.width_px - x));
  p.x_px = hn::ConvertTo(d, CountFrom(s.box.x0_px + x));
  p.y_px = Constant(static_cast<float>(s.box.y0_px + y));
  p.ray = RayAt(s.rays, p.x_px, p.y_px);
  const bool open_sky = !s.depth;
  p.primitive =
      open_sky ? hn::Set(du, raster::kNoPrimitive) : hn::LoadU(du, s.primitive + p.tile_at);
  p.is_sky = hn::RebindMask(d, p.primitive == hn::Set(du, raster::kNoPrimitive));
  p.is_water = hn::MaskFromVec(hn::Zero(d));
  for (const SurfaceKind kind : kAllSurfaces)
    if (kSurfaceTraits[kind].is_water)
      p.is_water = p.is_water | InRange(s.primitives, kind, p.primitive);
  // So far that floats have no depth for it, a surface is not at infinity all the same.
  const V z = open_sky ? hn::Zero(d) : hn::LoadU(d, s.depth + p.tile_at);
  p.z = hn::IfThenZeroElse(p.is_sky, Max(z, 1e-30f));
  p.depth = IfThenElse(p.is_sky, std::numeric_limits<float>::infinity(), s.rays.near_m / p.z);
  return p;
}

// What a table says of a packet's primitives, an entry of kWords words each; of the sky's lanes
// what it says of entry 0.
template <std::size_t kWords>
struct Entries {
  const float* base;
  std::uint32_t one;  // the entry of all lanes, if is_one
  bool is_one;
  VI at;

  template <class Entry>
  HWY_INLINE Entries(std::span<const Entry> table, const LabelPacket& p)
      : base(reinterpret_cast<const float*>(table.data())) {
    static_assert(sizeof(Entry) == kWords * sizeof(float));
    const DU du;
    const VU number = IfThenZeroElse(hn::RebindMask(du, p.is_sky), p.primitive);
    // Neighbours often share a triangle, and gathers are slow.
    one = hn::GetLane(number);
    is_one = hn::AllTrue(du, number == hn::Set(du, one));
    at = hn::BitCast(DI(), number * hn::Set(du, kWords));
  }
  HWY_INLINE V Word(std::size_t i) const {
    return is_one ? Constant(base[kWords * one + i]) : hn::GatherIndex(D(), base + i, at);
  }
};

HWY_INLINE V3 OnlyWhere(const M& where, V3 v) {
  return {IfThenElseZero(where, v.x), IfThenElseZero(where, v.y), IfThenElseZero(where, v.z)};
}

// --- Labels

// A table's numbers of what is seen; the sky has its own.
HWY_INLINE VU NumberOf(std::span<const std::uint32_t> table, const LabelPacket& p,
                       std::uint32_t of_sky) {
  const DU du;
  if (hn::AllTrue(D(), p.is_sky)) return hn::Set(du, of_sky);
  const VU number = hn::BitCast(du, Entries<1>(table, p).Word(0));
  return IfThenElse(hn::RebindMask(du, p.is_sky), hn::Set(du, of_sky), number);
}

HWY_INLINE VU IdOf(const LabelSources& in, const LabelPacket& p) {
  return NumberOf(in.tables.id, p, kSkyId);
}

HWY_INLINE VU ClassOf(const LabelSources& in, const LabelPacket& p, V foam) {
  const DU du;
  const M is_foam = p.is_water & (foam > 0.5f);
  return IfThenElse(hn::RebindMask(du, is_foam), hn::Set(du, kFoamClass),
                    NumberOf(in.tables.klass, p, kSkyClass));
}

HWY_INLINE V3 ShadedNormal(const LabelTile& tile, const LabelPacket& p) {
  const D d;
  if (hn::AllTrue(d, p.is_sky)) return {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  const ShadedLabels& s = *tile.shaded;
  return OnlyWhere(!p.is_sky, {hn::LoadU(d, s.normal_x.data() + p.tile_at),
                               hn::LoadU(d, s.normal_y.data() + p.tile_at),
                               hn::LoadU(d, s.normal_z.data() + p.tile_at)});
}

// Sets the normals of land that rays find.
HWY_INLINE void TakeCastLand(const LabelSources& in, const LabelPacket& p, V3& normal) {
  const D d;
  HWY_ALIGN std::array<std::uint32_t, kLanes> primitive;
  HWY_ALIGN std::array<float, kLanes> rel_x, rel_y, x, y, z;
  hn::Store(p.primitive, DU(), primitive.data());
  hn::Store(p.depth * p.ray.x, d, rel_x.data());
  hn::Store(p.depth * p.ray.y, d, rel_y.data());
  hn::Store(normal.x, d, x.data());
  hn::Store(normal.y, d, y.data());
  hn::Store(normal.z, d, z.data());
  for (std::size_t lane = 0; lane < p.count; ++lane) {
    if (!in.shading.primitives.holds(SurfaceKind::kTerrain, primitive[lane])) continue;
    const glm::dvec2 at = glm::dvec2(in.tables.eye_world) + glm::dvec2(rel_x[lane], rel_y[lane]);
    const glm::vec3 n = terrain::normal_at(in.world.land_rays->at(at), at);
    x[lane] = n.x, y[lane] = n.y, z[lane] = n.z;
  }
  normal = {hn::Load(d, x.data()), hn::Load(d, y.data()), hn::Load(d, z.data())};
}

HWY_INLINE V3 GeometricNormal(const LabelSources& in, const LabelTile& tile, const LabelPacket& p) {
  const D d;
  if (hn::AllTrue(d, p.is_sky)) return {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  const Entries<3> n(std::span<const glm::vec3>(in.tables.normal), p);
  V3 normal = OnlyWhere(!p.is_sky, {n.Word(0), n.Word(1), n.Word(2)});
  if (in.world.land_rays) TakeCastLand(in, p, normal);
  if (!tile.shaded) return normal;
  const M is_implicit = hn::AndNot(p.is_sky, Dot(normal, normal) == hn::Zero(d));
  if (hn::AllFalse(d, is_implicit)) return normal;
  const V3 shaded = ShadedNormal(tile, p);
  return {IfThenElse(is_implicit, shaded.x, normal.x), IfThenElse(is_implicit, shaded.y, normal.y),
          IfThenElse(is_implicit, shaded.z, normal.z)};
}

// What the shader has left of the water; 0 elsewhere.
template <class Plane>
HWY_INLINE V OfWater(const Plane& plane, const LabelPacket& p) {
  const D d;
  if (hn::AllFalse(d, p.is_water)) return hn::Zero(d);
  return IfThenElseZero(p.is_water, hn::LoadU(d, plane.data() + p.tile_at));
}

HWY_INLINE V FoamOf(const LabelTile& tile, const LabelPacket& p) {
  if (!tile.shaded) return hn::Zero(D());
  return OfWater(tile.shaded->foam_cover, p);
}

// How far the sea has sunk at (x, y) relative to the eye, on a round earth.
HWY_INLINE V DropOf(const ViewRays& rays, V x, V y) {
  return MulAdd(x, x, y * y) * rays.drop_per_m2;
}

HWY_INLINE V ElevationOf(const Shading& s, const LabelPacket& p) {
  const V height = MulAdd(p.depth, p.ray.z, s.rays.eye_z);
  const V drop = DropOf(s.rays, p.depth * p.ray.x, p.depth * p.ray.y);
  return IfThenElseZero(p.is_water, height + drop);
}

// How far what is seen moves in the world to the next frame.
HWY_INLINE V3 MoveOf(const LabelSources& in, const LabelPacket& p) {
  const D d;
  if (hn::AllTrue(d, p.is_sky)) return {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  const Entries<12> m(std::span<const AffineMove>(in.tables.move), p);
  const V depth = IfThenZeroElse(p.is_sky, p.depth);
  const V x = depth * p.ray.x, y = depth * p.ray.y;
  const V z = MulAdd(depth, p.ray.z, DropOf(in.shading.rays, x, y));
  const auto along = [&](std::size_t axis) HWY_ATTR {
    return MulAdd(m.Word(axis), x,
                  MulAdd(m.Word(3 + axis), y, MulAdd(m.Word(6 + axis), z, m.Word(9 + axis))));
  };
  const V zero = hn::Zero(d);
  if (hn::AllTrue(d, p.is_water | p.is_sky))  // water rises, and no more
    return OnlyWhere(p.is_water, {zero, zero, along(2)});
  return OnlyWhere(!p.is_sky, {along(0), along(1), along(2)});
}

// m v + b
HWY_INLINE V3 MultiplyAdd(const glm::mat3& m, V3 v, V3 b) {
  return MulAdd(Constant(m[0]), v.x, MulAdd(Constant(m[1]), v.y, MulAdd(Constant(m[2]), v.z, b)));
}

// CameraMotion's formula: with q = (x, y, 1) and m what is added to q, the point moves by
// (m.xy - q.xy m.z) / (1 + m.z).
HWY_INLINE void StoreMotion(const LabelSources& in, const LabelPacket& p, glm::vec2* to) {
  const CameraMotion& camera = in.tables.camera;
  const raster::Viewport viewport = in.shading.viewport;
  const V x = p.x_px + (0.5f - 0.5f * static_cast<float>(viewport.width_px));
  const V y = p.y_px + (0.5f - 0.5f * static_cast<float>(viewport.height_px));
  const V inverse_depth = p.z * (1.0f / in.shading.rays.near_m);
  const V3 moved = MultiplyAdd(camera.next, MoveOf(in, p), Constant(camera.shift));
  const V3 added = MultiplyAdd(camera.turn, {x, y, Constant(1.0f)}, moved * inverse_depth);
  const V ahead = 1.0f + added.z;
  const M is_ahead = ahead > 1e-6f;
  const V inverse = 1.0f / IfThenElse(is_ahead, ahead, 1.0f);
  const V dx = NegMulAdd(x, added.z, added.x) * inverse;
  const V dy = NegMulAdd(y, added.z, added.y) * inverse;
  StoreLanes(IfThenElseZero(is_ahead, dx), IfThenElseZero(is_ahead, dy), p.count, to);
}

// Calls put(packet, at) for the tile's packets; `at`: of the first pixel in the picture. What `put`
// does not use of a packet costs nothing.
template <class Put>
HWY_INLINE void ForPackets(const LabelSources& in, const LabelTile& tile, const Put& put) {
  const Shading& s = in.shading;
  const PacketSource source{s.rays,
                            s.primitives,
                            raster::tile_box(s.viewport, s.grid, tile.number),
                            s.grid.tile_size_px,
                            tile.depth.empty() ? nullptr : tile.depth.data(),
                            tile.primitive.data()};
  const raster::PixelBox box = source.box;
  const auto width_px = static_cast<std::size_t>(s.viewport.width_px);
  for (int y = 0; y < box.height_px; ++y)
    for (int x = 0; x < box.width_px; x += static_cast<int>(kLanes))
      put(LoadPacket(source, x, y),
          static_cast<std::size_t>(box.y0_px + y) * width_px + box.x0_px + x);
}

HWY_INLINE V FlagsOf(const LabelTile& tile, const LabelPacket& p) {
  const D d;
  const V of_water = tile.shaded ? OfWater(tile.shaded->flags, p) : hn::Zero(d);
  if (tile.in_water.empty()) return of_water;
  const hn::Rebind<std::uint8_t, D> d8;
  const V in_water =
      hn::ConvertTo(d, hn::PromoteTo(DI(), hn::LoadU(d8, tile.in_water.data() + p.tile_at)));
  return MulAdd(in_water, static_cast<float>(kSeenInWater), of_water);
}

// What needs no more of a packet than its depth or its primitives: a loop each, which leaves out
// the rest of the packet, takes half the instructions that one loop takes.
HWY_INLINE void FillPlainLabels(const LabelSources& in, const LabelTile& tile, Labels& labels) {
  const LabelSet set = in.tables.set;
  if (needs_depth(set))
    ForPackets(in, tile, [&](const LabelPacket& p, std::size_t at) HWY_ATTR {
      StoreLanes(p.depth, p.count, &labels.depth_m[at]);
    });
  if (set.has(Label::kId))
    ForPackets(in, tile, [&](const LabelPacket& p, std::size_t at) HWY_ATTR {
      StoreLanes(IdOf(in, p), p.count, &labels.id[at]);
    });
  if (set.has(Label::kClass))
    ForPackets(in, tile, [&](const LabelPacket& p, std::size_t at) HWY_ATTR {
      StoreLanes(ClassOf(in, p, FoamOf(tile, p)), p.count, &labels.klass[at]);
    });
}

// The others in one loop: a loop each took 1.1 times as long a frame with all of them.
HWY_INLINE void FillOtherLabels(const LabelSources& in, const LabelTile& tile, Labels& labels) {
  const LabelSet set = in.tables.set;
  ForPackets(in, tile, [&](const LabelPacket& p, std::size_t at) HWY_ATTR {
    if (set.has(Label::kNormal)) StoreLanes(ShadedNormal(tile, p), p.count, &labels.normal[at]);
    if (set.has(Label::kGeometricNormal))
      StoreLanes(GeometricNormal(in, tile, p), p.count, &labels.geometric_normal[at]);
    if (set.has(Label::kMotion)) StoreMotion(in, p, &labels.motion_px[at]);
    if (set.has(Label::kElevation))
      StoreLanes(ElevationOf(in.shading, p), p.count, &labels.elevation_m[at]);
    if (set.has(Label::kFoam)) StoreLanes(FoamOf(tile, p), p.count, &labels.foam[at]);
    if (set.has(Label::kFlags)) StoreBytes(FlagsOf(tile, p), p.count, &labels.flags[at]);
  });
}

void FillTile(const LabelSources& in, const LabelTile& tile, Labels& labels) {
  FillPlainLabels(in, tile, labels);
  constexpr std::array kOthers = {Label::kNormal, Label::kGeometricNormal,
                                  Label::kMotion, Label::kElevation,
                                  Label::kFoam,   Label::kFlags};
  const LabelSet set = in.tables.set;
  if (std::any_of(kOthers.begin(), kOthers.end(), [&](Label label) { return set.has(label); }))
    FillOtherLabels(in, tile, labels);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::render {

HWY_EXPORT(FillTile);

void resize_labels(LabelSet set, raster::Viewport viewport, Labels& labels) {
  const std::size_t pixels = static_cast<std::size_t>(viewport.width_px) * viewport.height_px;
  labels.set = set;
  for (const LabelInfo& info : label_table())
    std::visit(
        [&](const auto values) {
          if constexpr (std::is_member_pointer_v<decltype(values)>)
            (labels.*values).resize(set.has(info.label) ? pixels : 0);
        },
        info.values);
  if (needs_depth(set)) labels.depth_m.resize(pixels);
}

void fill_label_tile(const LabelSources& in, const LabelTile& tile, Labels& labels) {
  const auto side = static_cast<std::size_t>(in.shading.grid.tile_size_px);
  SWELL_CHECK(tile.depth.size() == tile.primitive.size() &&
                  (tile.depth.empty() || tile.depth.size() == side * side),
              "depth={} primitive={} tile_size_px={}", tile.depth.size(), tile.primitive.size(),
              side);
  HWY_DYNAMIC_DISPATCH(FillTile)(in, tile, labels);
}

}  // namespace swell::render
#endif  // HWY_ONCE
