// The water of rivers and lakes. Its optics are the sea's (water-inl.h); its ripples and its foam
// are carried by the flow.
#if defined(SWELL_RENDER_MATERIALS_RIVER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_MATERIALS_RIVER_INL_H_
#undef SWELL_RENDER_MATERIALS_RIVER_INL_H_
#else
#define SWELL_RENDER_MATERIALS_RIVER_INL_H_
#endif

#include <algorithm>
#include <array>
#include <span>

#include "ocean/inland/inland_sample.h"
#include "render/materials/river.h"
#include "render/materials/river_bed-inl.h"
#include "render/materials/terrain.h"
#include "render/tile/caustics-inl.h"
#include "render/tile/through_water-inl.h"
#include "render/view/rivers_drawn.h"
#include "render/water/topside-inl.h"
#include "render/water/underside-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// What the lattice holds at a packet (ocean::InlandSample).
struct RiverAt {
  V level, depth, east, north, white, sea_share, phase;
};

// A sample's eight floats are one vector, or two.
using DSample = hn::CappedTag<float, 8>;
using VSample = hn::Vec<DSample>;

// The columns of four rows, in each block of four lanes.
HWY_INLINE std::array<VSample, 4> TransposeBlocks(const VSample* r) {
  const DSample d;
  const hn::Repartition<double, DSample> d64;
  const auto low01 = hn::BitCast(d64, hn::InterleaveLower(d, r[0], r[1]));
  const auto low23 = hn::BitCast(d64, hn::InterleaveLower(d, r[2], r[3]));
  const auto high01 = hn::BitCast(d64, hn::InterleaveUpper(d, r[0], r[1]));
  const auto high23 = hn::BitCast(d64, hn::InterleaveUpper(d, r[2], r[3]));
  return {hn::BitCast(d, hn::InterleaveLower(d64, low01, low23)),
          hn::BitCast(d, hn::InterleaveUpper(d64, low01, low23)),
          hn::BitCast(d, hn::InterleaveLower(d64, high01, high23)),
          hn::BitCast(d, hn::InterleaveUpper(d64, high01, high23))};
}

#if HWY_ARCH_X86
// The columns of eight rows.
HWY_INLINE void Transpose(std::array<VSample, 8>& rows) {
  const DSample d;
  const std::array<VSample, 4> low = TransposeBlocks(&rows[0]), high = TransposeBlocks(&rows[4]);
  for (std::size_t c = 0; c < 4; ++c) {
    rows[c] = hn::ConcatLowerLower(d, high[c], low[c]);
    rows[c + 4] = hn::ConcatUpperUpper(d, high[c], low[c]);
  }
}
#endif

// The members of the samples from number `at` on, blended by (s, t). A lane's samples are whole
// vectors: gathers of single members take ten times as long.
HWY_INLINE void BlendSamples(const ocean::InlandSample* samples, VI at, V s, V t,
                             std::array<V, 8>& members) {
  const D d;
  const DSample ds;
  static_assert(sizeof(ocean::InlandSample) == 8 * sizeof(float));
  constexpr std::size_t kRow = 8 * ocean::kInlandSide;
  alignas(64) std::int32_t number[kLanes];
  alignas(64) float east[kLanes], north[kLanes];
  hn::Store(at, DI(), number);
  hn::Store(s, d, east);
  hn::Store(t, d, north);
  // From a member of a lane's sample on.
  const auto blended = [&](std::size_t lane, std::size_t member) HWY_ATTR {
    const auto lerp = [](VSample a, VSample b, VSample by)
                          HWY_ATTR { return MulAdd(b - a, by, a); };
    const float* const p = &samples[number[lane]].level_m + member;
    const VSample x = hn::Set(ds, east[lane]);
    return lerp(lerp(hn::LoadU(ds, p), hn::LoadU(ds, p + 8), x),
                lerp(hn::LoadU(ds, p + kRow), hn::LoadU(ds, p + kRow + 8), x),
                hn::Set(ds, north[lane]));
  };
#if HWY_ARCH_X86
  std::array<std::array<VSample, 8>, kLanes / 8> columns;
  for (std::size_t lane = 0; lane < kLanes; ++lane) columns[lane / 8][lane % 8] = blended(lane, 0);
  for (auto& eight : columns) Transpose(eight);
#if HWY_TARGET == HWY_AVX2
  members = columns[0];
#else
  for (std::size_t m = 0; m < members.size(); ++m)
    members[m] = hn::Combine(d, columns[1][m], columns[0][m]);
#endif
#else
  for (std::size_t m = 0; m < members.size(); m += 4) {
    std::array<VSample, 4> rows;
    for (std::size_t lane = 0; lane < 4; ++lane) rows[lane] = blended(lane, m);
    std::ranges::copy(TransposeBlocks(rows.data()),
                      members.begin() + static_cast<std::ptrdiff_t>(m));
  }
#endif
}

HWY_INLINE RiverAt SampleRiver(const River& river, const Packet& packet) {
  const D d;
  const DI di;
  const V per_m = Constant(river.cells_per_m);
  const V x = (packet.p.x - river.corner_rel.x) * per_m;
  const V y = (packet.p.y - river.corner_rel.y) * per_m;
  constexpr float kCells = ocean::kInlandBlock;
  const auto block_of = [&](V cells, int blocks) HWY_ATTR {
    return TruncateToInt(Clamp(cells * (1.0f / kCells), 0.0f, static_cast<float>(blocks) - 0.5f));
  };
  const VI bx = block_of(x, river.blocks_x), by = block_of(y, river.blocks_y);
  const VI block = hn::GatherIndex(di, river.block_index, by * river.blocks_x + bx);
  const auto in_block = [&](V cells, VI b) HWY_ATTR {
    return Clamp(NegMulAdd(hn::ConvertTo(d, b), kCells, cells), 0.0f, kCells - 1.0f / 1024.0f);
  };
  const V u = in_block(x, bx), v = in_block(y, by);
  const VI i = TruncateToInt(u), j = TruncateToInt(v);
  const V s = u - hn::ConvertTo(d, i), t = v - hn::ConvertTo(d, j);
  // Beside the lattice any block will do: nothing of the river is drawn there.
  const VI first = Max(block, hn::Zero(di)) * static_cast<int>(ocean::kInlandSamples);
  const VI at = first + j * ocean::kInlandSide + i;
  std::array<V, 8> value;
  BlendSamples(river.samples, at, s, t, value);
  return {value[0], value[1], value[2], value[3], value[4], value[5], value[6]};
}

// Two copies of a pattern are carried by the flow, each from where it was half a cycle before to
// where it is half a cycle after, and fade in and out half a cycle apart: the squares of their
// weights, a sine and a cosine, add up to 1 at all times, so that a pattern of mean 0 neither
// pulses nor stretches. A copy begins each cycle with another piece of the pattern.
struct CarriedCopy {
  V3 p;  // where the pattern's point is
  V weight;
};

HWY_INLINE std::array<CarriedCopy, 2> CarriedAt(const River& river, const RiverAt& at, V3 p) {
  const D d;
  const V turns = at.phase + river.cycles;
  V sine, cosine;
  SinCosTurns(d, (turns - Floor(turns)) * 0.5f, sine, cosine);
  const auto copy = [&](V copy_turns, V weight) HWY_ATTR {
    const V whole = Floor(copy_turns), phase = copy_turns - whole;
    const V carried_s = (phase - 0.5f) * static_cast<float>(kCarried_s);
    const V number = whole + river.cycle_number;
    const auto jump = [&](float step) HWY_ATTR {
      const V steps = number * step;
      return (steps - Floor(steps)) * 7.0f;
    };
    return CarriedCopy{{NegMulAdd(at.east, carried_s, p.x) + jump(0.754877666f),
                        NegMulAdd(at.north, carried_s, p.y) + jump(0.569840291f), p.z},
                       weight};
  };
  return {copy(turns, sine), copy(turns + 0.5f, Abs(cosine))};
}

// The slopes of the sea where a river ends.
static HWY_NOINLINE void SeaSlopes(const Shading& s, std::span<const Packet> packets,
                                   WaterSlopes* found) {
  const Water& water = s.material<Water>();
  if (water.trains.on)
    SampleWater<true>(water, s.rays, packets, found);
  else
    SampleWater<false>(water, s.rays, packets, found);
}

// What is the sea's alone has its very bits: the river's is left out where all lanes are.
HWY_INLINE V PassIntoSea(V river, V sea, V share) {
  return IfThenElse(share >= 1.0f, sea, Lerp(river, sea, share));
}
HWY_INLINE V3 PassIntoSea(V3 river, V3 sea, V share) {
  return {PassIntoSea(river.x, sea.x, share), PassIntoSea(river.y, sea.y, share),
          PassIntoSea(river.z, sea.z, share)};
}
HWY_INLINE WaterSlopes PassIntoSea(const WaterSlopes& a, const WaterSlopes& b, V share) {
  return {PassIntoSea(a.slope_x, b.slope_x, share),
          PassIntoSea(a.slope_y, b.slope_y, share),
          PassIntoSea(a.variance, b.variance, share),
          PassIntoSea(a.fine_variance, b.fine_variance, share),
          PassIntoSea(a.long_cosine, b.long_cosine, share),
          {PassIntoSea(a.foam.cover, b.foam.cover, share),
           PassIntoSea(a.foam.thickness, b.foam.thickness, share),
           PassIntoSea(a.foam.bubbles, b.foam.bubbles, share)},
          PassIntoSea(a.wake, b.wake, share)};
}

// Ripples of the flow, of the wind, and of wakes; foam where it is white.
HWY_INLINE WaterSlopes RiverSlopes(const Shading& shading, const River& river, const RiverAt& at,
                                   const Packet& packet) {
  const D d;
  const V zero = hn::Zero(d), one = Constant(1.0f);
  const Water& water = shading.material<Water>();
  const V level_m =
      FootprintLevel(FootprintAcross(shading.rays, packet), Clamp(packet.to_eye.z, kMinCos, 1.0f));
  const V speed = Sqrt(MulAdd(at.east, at.east, at.north * at.north));
  // How rough the flow is: root mean square slopes; none where they would not be seen, whatever
  // the lanes beside show.
  const V all_rough = MulAdd(at.white, 0.12f, Min(speed, 2.0f) * 0.045f);
  const V rough = IfThenElseZero(all_rough > 1e-3f, all_rough);
  WaterSlopes s = NoSlopes(Constant(river.base_variance), zero, packet.to_eye.z);
  const bool flows = !hn::AllFalse(d, rough > zero);
  const bool foams = !hn::AllFalse(d, at.white > 0.02f);
  if (flows) {
    V x = zero, y = zero, lost = zero, code = zero;
    for (const CarriedCopy& copy : CarriedAt(river, at, packet.p)) {
      V copy_x = zero, copy_y = zero, lost_long = zero, lost_short = zero;
      AddSlopes(river.long_ripples, copy.p, level_m, {zero, zero}, copy_x, copy_y, lost_long);
      AddSlopes(river.short_ripples, copy.p, level_m, {zero, zero}, copy_x, copy_y, lost_short);
      x = MulAdd(copy.weight, copy_x, x);
      y = MulAdd(copy.weight, copy_y, y);
      lost = lost_long + lost_short;
      if (!foams) continue;
      V threshold, unused;
      NearestSlopes(river.foam_lace, copy.p, level_m, threshold, unused);
      code = MulAdd(copy.weight, threshold, code);
    }
    // Not -0 where it is smooth: a packet that is smooth all over has 0.
    s.slope_x = IfThenElseZero(rough > zero, x * rough);
    s.slope_y = IfThenElseZero(rough > zero, y * rough);
    s.variance = MulAdd(rough * rough, lost, s.variance);
    if (foams) {
      // Never white all over: the lace moves.
      const V over = MulSub(at.white, 0.5f * (1.0f + kFoamRim), MulAdd(code, 0.5f, 0.5f));
      s.foam = FoamOfOver(IfThenElse(at.white > 0.02f, over, -1.0f));
    }
  }
  // The wind's, and where the water is too shallow for them none.
  const V share = Clamp(at.depth * 4.0f, 0.0f, 1.0f) * river.wind_share;
  V x = zero, y = zero, lost = zero;
  for (int i = water.first_ripples; i < water.layer_count; ++i)
    AddSlopes(water.layers[static_cast<std::size_t>(i)], packet.p, level_m, {zero, zero}, x, y,
              lost);
  s.slope_x = MulAdd(share, x, s.slope_x);
  s.slope_y = MulAdd(share, y, s.slope_y);
  s.variance = MulAdd(share * share, lost, s.variance);
  s.fine_variance = s.variance + MulAdd(rough * rough, one, share * share * water.short_variance);
  if (water.wakes.count > 0) AddWakes(water, packet.p, level_m, s);
  return s;
}

// What comes up: the water's own light, and the bed's through it, at the place that the bent ray
// meets, under the net of light that the sea's short waves make.
HWY_INLINE V3 BedLight(const Shading& s, const River& river, const RiverAt& at,
                       const Packet& packet, const WaterSlopes& slopes, V sun_visible) {
  const D d;
  const V one = Constant(1.0f), depth = Max(at.depth, 0.0f);
  const float inv_n = 1.0f / s.media.refraction_index;
  const V cos_eye = Clamp(packet.to_eye.z, 0.0f, 1.0f);
  const V sin_t = Sqrt(NegMulAdd(cos_eye, cos_eye, one)) * inv_n;
  const V cos_t = Sqrt(NegMulAdd(sin_t, sin_t, one));
  const V path = depth / cos_t;
  // Where the ray ends, moved by the slopes that it goes through.
  const V away = path * -inv_n, bend = depth * (1.0f - inv_n);
  const V3 p = {MulAdd(slopes.slope_x, bend, MulAdd(packet.to_eye.x, away, packet.p.x)),
                MulAdd(slopes.slope_y, bend, MulAdd(packet.to_eye.y, away, packet.p.y)),
                packet.p.z - depth};
  const V level_m = FootprintLevel(FootprintAcross(s.rays, packet), Clamp(cos_eye, 0.1f, 1.0f));
  const V height_m = packet.p.z + s.rays.eye_z;
  const V3 bed = FindBed(river, p, height_m, level_m);
  V gathered = sun_visible;
  const auto shows = ShowsShortCaustics(s.caustics, level_m) & (depth > 0.0f);
  if (!hn::AllFalse(d, shows)) {
    const V net = GatheredSunAt(s, 1, p, depth, level_m);
    gathered = IfThenElse(shows, sun_visible * net, sun_visible);
  }
  const V3 of_sky = Constant(river.sky_light) * AmbientUnderClouds(s, packet.p);
  const V3 lit = MulAdd(Constant(river.sun_light), gathered, of_sky) * bed;
  const V length = MulAdd(depth, kDaylightSlant, Min(path, 200.0f));
  return AbsorbInWater(s.media, {depth, length}, DeepWater(s, packet.p, sun_visible), lit);
}

// What a packet shows of rivers, with the sea's part where they end.
struct RiverSeen {
  RiverAt at;
  WaterSlopes slopes;
  bool meets_sea, is_river;  // in any lane
};

HWY_INLINE RiverSeen SeeRiver(const Shading& shading, const River& river, const Packet& packet) {
  const D d;
  const V zero = hn::Zero(d);
  RiverSeen seen = {SampleRiver(river, packet), NoSlopes(zero, zero, zero), false, false};
  // Looks pass into the sea's before the surface has.
  seen.at.sea_share = SmoothBlend(MulAdd(seen.at.sea_share, 2.0f, -0.2f));
  seen.meets_sea = !hn::AllFalse(d, seen.at.sea_share > 0.0f);
  seen.is_river = !hn::AllTrue(d, seen.at.sea_share >= 1.0f);
  if (seen.is_river) seen.slopes = RiverSlopes(shading, river, seen.at, packet);
  return seen;
}

// Its bed, and at its end what lies under the sea.
struct RiverBody {
  static constexpr FoamOpacity kFoam = {0.368f, 0.46f, 0.0f};

  const Shading& shading;
  const TilePixels& tile;
  const River& river;
  const Packet& packet;
  const RiverSeen& seen;

  HWY_INLINE V SunVisible() const {
    return ::swell::render::HWY_NAMESPACE::SunVisible(shading, tile, packet, Constant(-1.0f)) *
           SunUnderTrees(shading, packet, hn::Zero(D()));
  }

  HWY_INLINE Refracted Below(V sun_visible) const {
    const V zero = hn::Zero(D());
    const V sea_share = seen.at.sea_share;
    Refracted below = {Constant(shading.media.body), zero, {zero, zero, zero}};
    if (seen.is_river)
      below.light = BedLight(shading, river, seen.at, packet, seen.slopes, sun_visible);
    below.floor_added = below.light - Constant(shading.media.body);
    if (!seen.meets_sea) return below;
    const Refracted of_sea = RefractedLight(shading, shading.material<Water>(), packet, seen.slopes,
                                            sun_visible, tile.planar_maps.refraction);
    return {PassIntoSea(below.light, of_sea.light, sea_share),
            IfThenElseZero(sea_share > zero, of_sea.image_alpha),
            PassIntoSea(below.floor_added, of_sea.floor_added, sea_share)};
  }

  // An image of another level than the place's is not what is mirrored there.
  HWY_INLINE V ShareOfLevel(float level_m) const {
    const V off = Abs(packet.p.z - (level_m - shading.rays.eye_z));
    return Clamp(NegMulAdd(off, kMirrorFall_per_m, kMirrorFall_per_m * kMirrorGone_m), 0.0f, 1.0f);
  }

  HWY_INLINE Looked Mirrored(const Facing& f, V inv_variance, V3 floor) const {
    const D d;
    const V zero = hn::Zero(d);
    const Water& water = shading.material<Water>();
    const V sea_share = seen.at.sea_share;
    Looked mirrored = ReflectedLight(shading, packet, seen.slopes, f, inv_variance, floor, false);
    const auto lay_over = [&](const PlanarMap& map, V share) HWY_ATTR {
      const Looked image = LookUpDistorted<false>(water, map, packet, seen.slopes, 1.0f);
      const V part = image.alpha * share;
      mirrored = {Lerp(mirrored.light, image.light, part), Max(mirrored.alpha, part)};
    };
    const V by_sea = Max(sea_share, ShareOfLevel(0.0f));
    if (tile.planar_maps.reflection && !hn::AllFalse(d, by_sea > zero))
      lay_over(water.images.reflection, by_sea);
    if (river.images.empty()) return mirrored;
    const V not_by_sea = (1.0f - by_sea) * Clamp(NegMulAdd(sea_share, 4.0f, 1.0f), 0.0f, 1.0f);
    for (const RiverImage& image : river.images) {
      const V share = ShareOfLevel(image.level_m) * image.share * not_by_sea;
      if (!hn::AllFalse(d, share > zero)) lay_over(image.map, share);
    }
    return mirrored;
  }

  HWY_INLINE V Weight(const Facing& f) const { return f.reflectance; }
  HWY_INLINE V SunPath(const Facing&, V glint) const { return glint; }
  HWY_INLINE V SunOnFoam(const Facing&) const {
    return Constant(std::max(shading.light.sun_direction.z, 0.0f));
  }
};

// Not shown in planar maps.
template <ViewKind kView>
struct Shader<River, kView> {
  const River& river;

  HWY_INLINE ShadingResult operator()(const Shading&, const TilePixels&, const Lanes&,
                                      const Packet& packet) const {
    return {packet.p, packet.p};
  }
};

template <>
struct Shader<River, ViewKind::kWindow> {
  using Found = RiverSeen;
  const River& river;

  HWY_INLINE void LookUp(const Shading& shading, std::span<const Packet> packets,
                         RiverSeen* seen) const {
    bool meets_sea = false;
    for (std::size_t k = 0; k < packets.size(); ++k) {
      seen[k] = SeeRiver(shading, river, packets[k]);
      meets_sea |= seen[k].meets_sea;
    }
    if (!meets_sea) return;
    PerPacket<WaterSlopes> sea;
    SeaSlopes(shading, packets, sea.data());
    for (std::size_t k = 0; k < packets.size(); ++k)
      if (seen[k].meets_sea)
        seen[k].slopes = PassIntoSea(seen[k].slopes, sea[k], seen[k].at.sea_share);
  }

  HWY_INLINE ShadingResult operator()(const Shading& shading, const TilePixels& tile, const Lanes&,
                                      const Packet& packet, const RiverSeen& seen) const {
    return ShadeFromAbove(shading, tile, packet, seen.slopes,
                          RiverBody{shading, tile, river, packet, seen});
  }
};

// The surface from below, as the sea's, with its own slopes.
struct RiverUnderside {
  using Found = WaterSlopes;
  const River& river;

  HWY_INLINE void LookUp(const Shading& shading, std::span<const Packet> packets,
                         WaterSlopes* found) const {
    // Sampled as from above, along the same lines.
    PerPacket<Packet> turned;
    for (std::size_t k = 0; k < packets.size(); ++k) {
      turned[k] = packets[k];
      turned[k].to_eye = -packets[k].to_eye;
    }
    PerPacket<RiverSeen> seen;
    const Shader<River, ViewKind::kWindow> from_above{river};
    from_above.LookUp(shading, std::span(turned.data(), packets.size()), seen.data());
    for (std::size_t k = 0; k < packets.size(); ++k) found[k] = seen[k].slopes;
  }

  HWY_INLINE ShadingResult operator()(const Shading& shading, const TilePixels& tile,
                                      const Lanes& lanes, const Packet& packet,
                                      const WaterSlopes& slopes) const {
    return UndersideShader{shading.material<Water>()}(shading, tile, lanes, packet, slopes);
  }
};

template <ViewKind kView, class Use>
HWY_INLINE void WithShader(const River& river, const Use& use) {
  if constexpr (kView == ViewKind::kWindow) {
    if (river.submerged) return use(RiverUnderside{river});
  }
  use(Shader<River, kView>{river});
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
