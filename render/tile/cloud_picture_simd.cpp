#include <algorithm>
#include <array>
#include <vector>

#include "math/check.h"
#include "render/tile/cloud_rows.h"
#include "render/tile/shading.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/tile/cloud_picture_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
//
#include "render/sky/cloud_field-inl.h"
#include "render/sky/cloud_queue-inl.h"
#include "render/sky/sky_maps.h"
#include "render/tile/air-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// What a cloud shows at a distance along a ray of length 1, as a packet, for the air before it.
HWY_INLINE Packet CloudPacket(const Shading& s, V3 direction, V distance) {
  Packet packet;
  packet.x_px = packet.y_px = packet.depth = hn::Zero(D());
  packet.distance = distance;
  packet.p = direction * distance;
  packet.to_eye = -direction;
  const V horizontal2 = MulAdd(direction.x, direction.x, direction.y * direction.y);
  const V sunk = horizontal2 * distance * s.rays.drop_per_m2;
  packet.p.z = MulAdd(sunk, distance, packet.p.z);
  packet.to_eye.z = packet.to_eye.z - (sunk + sunk);
  return packet;
}

// What nodes show, in the channels of CloudPicture.
using NodeChannels = std::array<V, CloudPicture::kChannels>;

HWY_INLINE NodeChannels ChannelsOf(const Shading& s, const VolumeClouds& clouds, V3 direction,
                                   const CloudLightSeen& seen) {
  const D d;
  V3 light = {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  if (!hn::AllFalse(d, seen.opacity > 0.0f)) {
    // The air before what is hidden shows as much of the cloud as is seen.
    const V inverse = 1.0f / Max(seen.opacity, 1e-6f);
    const V3 own = RadianceOf(clouds, seen) * inverse;
    light = ThroughAir(s, CloudPacket(s, direction, seen.distance), own) * seen.opacity;
  }
  return {
      light.x, light.y, light.z, seen.opacity, seen.opacity * seen.front, seen.opacity * seen.back};
}

// Nodes of some rows to follow rays of, column by column, so that those of a packet lie together.
struct NodeList {
  struct Node {
    int i, j;
    float nearest_m;  // there is nothing before
  };
  static constexpr std::size_t kRows = 4;
  std::array<Node, kRows*(static_cast<std::size_t>(raster::kMaxViewport) + 8)> at;
  std::size_t count = 0;

  void add(int i, int j, float nearest_m) { at[count++] = {i, j, nearest_m}; }
};

// Puts what nodes of the mask show where they are, by their numbers in the list.
HWY_INLINE void PutNodes(const NodeList& list, V numbers, hn::Mask<D> mask,
                         const NodeChannels& channels, V clear, CloudPicture& picture) {
  const D d;
  HWY_ALIGN std::array<float, kLanes> number, value;
  const std::size_t count = hn::CountTrue(d, mask);
  const auto chosen = ChosenFirst(mask);
  hn::Store(hn::TableLookupLanes(numbers, chosen), d, number.data());
  const auto put = [&](V values, std::vector<float>& nodes) HWY_ATTR {
    hn::Store(hn::TableLookupLanes(values, chosen), d, value.data());
    for (std::size_t i = 0; i < count; ++i) {
      const NodeList::Node node = list.at[static_cast<std::size_t>(number[i])];
      nodes[picture.index(node.i, node.j)] = value[i];
    }
  };
  for (std::size_t c = 0; c < channels.size(); ++c) put(channels[c], picture.nodes[c]);
  put(clear, picture.clear);
}

void DrawNodes(const Shading& s, const VolumeClouds& clouds, const NodeList& list,
               CloudPicture& picture) {
  const D d;
  const auto step = static_cast<float>(picture.step());
  const auto end = [&](const LookingRays& rays, const CloudLightSeen& seen, hn::Mask<D> mask)
                       HWY_ATTR {
                         const NodeChannels channels = ChannelsOf(s, clouds, rays.direction, seen);
                         PutNodes(list, rays.number, mask, channels, seen.clear, picture);
                       };
  CloudRayQueue queue(clouds, end);
  const V none = hn::Zero(d);
  for (std::size_t n = 0; n < list.count; n += kLanes) {
    HWY_ALIGN std::array<float, kLanes> x_px, y_px, nearest_m;
    const std::size_t used = std::min(list.count - n, kLanes);
    for (std::size_t i = 0; i < kLanes; ++i) {
      const NodeList::Node node = list.at[n + std::min(i, used - 1)];
      x_px[i] = step * static_cast<float>(node.i), y_px[i] = step * static_cast<float>(node.j);
      nearest_m[i] = node.nearest_m;
    }
    const V3 ray = RayAt(s.rays, hn::Load(d, x_px.data()), hn::Load(d, y_px.data()));
    const FrameCloudField field(clouds, ray * InverseSqrt(Dot(ray, ray)));
    const CloudRayEnds ends =
        EndsAmongClouds(clouds, field, hn::Load(d, nearest_m.data()), Constant(kFarthestCloud_m));
    const V number = hn::ConvertTo(d, CountFrom(static_cast<int>(n)));
    const auto is_used = hn::FirstN(d, used), has_way = is_used & (ends.begin < ends.end);
    queue.Add(field, number, ends.begin, ends.end, has_way);
    const auto rest = hn::AndNot(has_way, is_used);
    if (!hn::AllFalse(d, rest))
      PutNodes(list, number, rest, {none, none, none, none, none, none},
               IfThenElseZero(ends.among_clouds, ends.end), picture);
  }
  queue.Finish();
}

// How far there is nothing around (i, j), by the nodes of multiples of `spacing`.
float NearestAround(const CloudPicture& picture, int i, int j, int spacing) {
  const int left = std::max((i - 1) / spacing * spacing, 0);
  const int right = std::min((i + spacing) / spacing * spacing, picture.columns - 1);
  const int above = std::max((j - 1) / spacing * spacing, 0);
  const int below = std::min((j + spacing) / spacing * spacing, picture.rows - 1);
  float nearest_m = kFarthestCloud_m;
  for (int row = above; row <= below; row += spacing)
    for (int column = left; column <= right; column += spacing)
      nearest_m = std::min(nearest_m, picture.clear[picture.index(column, row)]);
  return nearest_m;
}

// Nodes of multiples of `spacing` in rows j to j + 3 spacing, but for those of multiples of
// 2 spacing if those are `known`.
void CoarseCloudRows(const Shading& s, const VolumeClouds& clouds, int j, int spacing, bool known,
                     CloudPicture& picture) {
  NodeList list;
  const int end = std::min(j + static_cast<int>(NodeList::kRows) * spacing, picture.rows);
  for (int i = 0; i < picture.columns; i += spacing)
    for (int row = j; row < end; row += spacing) {
      if (!known)
        list.add(i, row, 0.0f);
      else if (i % (2 * spacing) != 0 || row % (2 * spacing) != 0)
        list.add(i, row, NearestAround(picture, i, row, 2 * spacing));
    }
  DrawNodes(s, clouds, list, picture);
}

// Whether the corners of the cell around (i, j), both odd, show about the same.
bool is_even(const CloudPicture& picture, int i, int j) {
  if (i < 0 || j < 0 || i >= picture.columns || j >= picture.rows) return true;
  return picture.even[picture.index(i, j)] != 0;
}

// Whether the corners of the cells around (i, j), (i + 2, j) and so on show about the same, in
// every other lane from the first on.
HWY_INLINE hn::Mask<D> AreEven(const CloudPicture& picture, int i, int j) {
  constexpr float kLeast = 0.02f, kLight = 0.12f, kDistance = 0.2f;
  const D d;
  const std::size_t above = picture.index(i - 1, j - 1), below = picture.index(i - 1, j + 1);
  auto is_even = hn::Zero(d) == hn::Zero(d);
  for (std::size_t channel = 0; channel < CloudPicture::kChannels; ++channel) {
    const float* const nodes = picture.nodes[channel].data();
    const V a = hn::LoadU(d, nodes + above), b = hn::LoadU(d, nodes + above + 2);
    const V c = hn::LoadU(d, nodes + below), e = hn::LoadU(d, nodes + below + 2);
    const V low = Min(Min(a, b), Min(c, e)), high = Max(Max(a, b), Max(c, e));
    const float part = channel > CloudPicture::kOpacity ? kDistance : kLight;
    const V most = MulAdd(high, part, kLeast);
    is_even = is_even & (high - low <= most);
  }
  return is_even;
}

void EvenCloudCells(int j, CloudPicture& picture) {
  const DI di;
  for (int i = 1; i < picture.columns; i += static_cast<int>(hn::Lanes(di))) {
    const auto even = hn::RebindMask(di, AreEven(picture, i, j));
    hn::StoreU(IfThenElseZero(even, hn::Set(di, 1)), di, &picture.even[picture.index(i, j)]);
  }
}

// Puts a node that is not coarse between coarse ones, or on the list if a cell beside it is not
// even.
void FineCloudNode(int i, int j, CloudPicture& picture, NodeList& list) {
  const int across = i % 2, down = j % 2;
  if (!is_even(picture, i - 1 + across, j - 1 + down) ||
      !is_even(picture, i + 1 - across, j + 1 - down)) {
    list.add(i, j, NearestAround(picture, i, j, 2));
    return;
  }
  const std::size_t here = picture.index(i, j);
  const auto x = static_cast<std::size_t>(across);
  const std::size_t y = static_cast<std::size_t>(down) * picture.stride;
  for (std::vector<float>& nodes : picture.nodes)
    nodes[here] = 0.25f * ((nodes[here - x - y] + nodes[here + x - y]) +
                           (nodes[here - x + y] + nodes[here + x + y]));
}

void FineCloudRows(const Shading& s, const VolumeClouds& clouds, int j, CloudPicture& picture) {
  NodeList list;
  for (int i = 0; i < picture.columns; ++i)
    for (int row = j; row < std::min(j + static_cast<int>(NodeList::kRows), picture.rows); ++row)
      if (i % 2 != 0 || row % 2 != 0) FineCloudNode(i, row, picture, list);
  DrawNodes(s, clouds, list, picture);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::render {

HWY_EXPORT(CoarseCloudRows);
HWY_EXPORT(EvenCloudCells);
HWY_EXPORT(FineCloudRows);

void write_coarse_clouds(const Shading& shading, const VolumeClouds& clouds, int j, int spacing,
                         bool known, CloudPicture& picture) {
  SWELL_CHECK(clouds.any() && j >= 0 && j < picture.rows && spacing > 0 && j % (4 * spacing) == 0,
              "row={} of {}, spacing={}", j, picture.rows, spacing);
  HWY_DYNAMIC_DISPATCH(CoarseCloudRows)(shading, clouds, j, spacing, known, picture);
}

void find_even_cells(int j, CloudPicture& picture) {
  SWELL_CHECK(j > 0 && j < picture.rows - 1 && j % 2 == 1, "row={} of {}", j, picture.rows);
  HWY_DYNAMIC_DISPATCH(EvenCloudCells)(j, picture);
}

void write_fine_clouds(const Shading& shading, const VolumeClouds& clouds, int j,
                       CloudPicture& picture) {
  SWELL_CHECK(clouds.any() && j >= 0 && j < picture.rows && j % 4 == 0, "row={} of {}", j,
              picture.rows);
  HWY_DYNAMIC_DISPATCH(FineCloudRows)(shading, clouds, j, picture);
}

}  // namespace swell::render
#endif  // HWY_ONCE
