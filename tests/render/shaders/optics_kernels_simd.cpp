#include "render/shaders/optics_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/shaders/optics_kernels_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <utility>

#include "render/packets/fresnel-inl.h"
#include "render/water/topside-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

void Fresnel(std::span<const float> cos_theta, float n, std::span<float> reflectance) {
  const hn::ScalableTag<float> d;
  HWY_ALIGN float lanes[hn::MaxLanes(d)];
  for (std::size_t i = 0; i < cos_theta.size(); ++i) {
    hn::Store(FresnelReflectance(d, hn::Set(d, cos_theta[i]), n), d, lanes);
    reflectance[i] = lanes[i % hn::Lanes(d)];
  }
}

// The points from `first` on, the last one repeated, each seen along its own ray.
Packet PacketAt(std::span<const glm::vec3> p_rel, std::size_t first) {
  HWY_ALIGN float x[kLanes], y[kLanes], z[kLanes];
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const glm::vec3 p = p_rel[std::min(first + lane, p_rel.size() - 1)];
    x[lane] = p.x, y[lane] = p.y, z[lane] = p.z;
  }
  const D d;
  Packet packet;
  packet.x_px = packet.y_px = hn::Zero(d);
  packet.p = {hn::Load(d, x), hn::Load(d, y), hn::Load(d, z)};
  packet.depth = packet.distance = Sqrt(Dot(packet.p, packet.p));
  packet.to_eye = packet.p * (-1.0f / packet.distance);
  return packet;
}

void StoreSeen(const WaterSlopes& s, std::span<SeenWater> seen, std::size_t first) {
  HWY_ALIGN float lanes[4][kLanes];
  const V values[4] = {s.slope_x, s.slope_y, s.variance, s.foam.cover};
  for (int i = 0; i < 4; ++i) hn::Store(values[i], D(), lanes[i]);
  for (std::size_t lane = 0; lane < kLanes && first + lane < seen.size(); ++lane)
    seen[first + lane] = {{lanes[0][lane], lanes[1][lane]}, lanes[2][lane], lanes[3][lane]};
}

template <bool kCoast>
void SampleAll(const Water& water, const ViewRays& rays, std::size_t packets_at_once,
               std::span<const glm::vec3> p_rel, std::span<SeenWater> seen) {
  PerPacket<Packet> packets;
  PerPacket<WaterSlopes> found;
  for (std::size_t i = 0; i < seen.size(); i += packets_at_once * kLanes) {
    for (std::size_t k = 0; k < packets_at_once; ++k) packets[k] = PacketAt(p_rel, i + k * kLanes);
    SampleWater<kCoast>(water, rays, std::span(packets.data(), packets_at_once), found.data());
    for (std::size_t k = 0; k < packets_at_once; ++k) StoreSeen(found[k], seen, i + k * kLanes);
  }
}

void SampleInPackets(const Water& water, const ViewRays& rays, int packets_at_once,
                     std::span<const glm::vec3> p_rel, std::span<SeenWater> seen) {
  const auto at_once = static_cast<std::size_t>(packets_at_once);
  if (water.knows_land())
    SampleAll<true>(water, rays, at_once, p_rel, seen);
  else
    SampleAll<false>(water, rays, at_once, p_rel, seen);
}

// One lookup a packet, in all of its lanes.
void LookUpAll(const Water& water, const PlanarMap& map, std::span<const DistortedLookUp> lookups,
               std::span<glm::vec3> light) {
  for (std::size_t i = 0; i < lookups.size(); ++i) {
    const DistortedLookUp& l = lookups[i];
    Packet packet;
    packet.x_px = Constant(l.at_px.x), packet.y_px = Constant(l.at_px.y);
    packet.to_eye = Constant(glm::vec3(0.0f, 0.0f, l.to_eye_z));
    WaterSlopes slopes;
    slopes.slope_x = Constant(l.slope.x), slopes.slope_y = Constant(l.slope.y);
    slopes.variance = hn::Zero(D());
    const V3 seen = LookUpDistorted<false>(water, map, packet, slopes, l.sign).light;
    light[i] = {hn::GetLane(seen.x), hn::GetLane(seen.y), hn::GetLane(seen.z)};
  }
}

// One lookup a packet, in all of its lanes.
void LookUpAllSoftly(const PlanarMap& map, std::span<const SoftLookUp> lookups,
                     std::span<FoundSoftly> found) {
  for (std::size_t i = 0; i < lookups.size(); ++i) {
    const SoftLookUp& l = lookups[i];
    const V x = Constant(l.at_px.x), y = Constant(l.at_px.y);
    // The variance is of both axes together.
    const V variance = Constant(2.0f + kGlassVariance);
    const Looked looked = LookUpSoftly(map, x, y, variance, Constant(l.spread_px * l.spread_px));
    found[i] = {hn::GetLane(looked.alpha), MayShow(map, x, y)};
  }
}

void GlitterAt(const Glitter& glitter, std::span<const glm::vec3> to_eye, glm::vec3 normal,
               float variance, std::span<float> light) {
  for (std::size_t i = 0; i < to_eye.size(); ++i)
    light[i] = hn::GetLane(
        ProjectedGlitter(glitter, Constant(to_eye[i]), Constant(normal), Constant(variance)));
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::render {

HWY_EXPORT(Fresnel);
HWY_EXPORT(SampleInPackets);
HWY_EXPORT(LookUpAll);
HWY_EXPORT(LookUpAllSoftly);
HWY_EXPORT(GlitterAt);

void fresnel_reflectance(std::span<const float> cos_theta, float n, std::span<float> reflectance) {
  HWY_DYNAMIC_DISPATCH(Fresnel)(cos_theta, n, reflectance);
}

void sample_water(const Water& water, const ViewRays& rays, int packets_at_once,
                  std::span<const glm::vec3> p_rel, std::span<SeenWater> seen) {
  HWY_DYNAMIC_DISPATCH(SampleInPackets)(water, rays, packets_at_once, p_rel, seen);
}

void look_up_distorted(const Water& water, const PlanarMap& map,
                       std::span<const DistortedLookUp> lookups, std::span<glm::vec3> light) {
  HWY_DYNAMIC_DISPATCH(LookUpAll)(water, map, lookups, light);
}

void look_up_softly(const PlanarMap& map, std::span<const SoftLookUp> lookups,
                    std::span<FoundSoftly> found) {
  HWY_DYNAMIC_DISPATCH(LookUpAllSoftly)(map, lookups, found);
}

void projected_glitter(const Glitter& glitter, std::span<const glm::vec3> to_eye, glm::vec3 normal,
                       float variance, std::span<float> light) {
  HWY_DYNAMIC_DISPATCH(GlitterAt)(glitter, to_eye, normal, variance, light);
}

}  // namespace swell::render
#endif  // HWY_ONCE
