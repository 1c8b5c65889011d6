// A tile's lattice of nodes on every fourth pixel, with straight lines between them.
#if defined(SWELL_RENDER_TILE_LATTICE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_TILE_LATTICE_INL_H_
#undef SWELL_RENDER_TILE_LATTICE_INL_H_
#else
#define SWELL_RENDER_TILE_LATTICE_INL_H_
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "render/packets/packet-inl.h"
#include "render/tile/scratch.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// The sky of a tile lies on straight lines between nodes on every fourth pixel: of every fourth row
// for what changes slowly, of each row for the noise of clouds, which lie flat.
constexpr int kStepLog2 = 2, kStep = 1 << kStepLog2;
constexpr float kMostStepAngle = 0.006f;  // more, and too much of the sky lies between two nodes

// Nodes along one side, for so many pixels.
constexpr int nodes_along(int pixels) { return (pixels - 1) / kStep + 2; }

// Calls visit(x_px, y_px, store) for packets that hold the first `rows` rows of a tile's nodes,
// which are every kStep pixels; store(values, channel) puts a packet's values into a channel.
template <class Visit>
HWY_INLINE void ForEachNodes(const raster::PixelBox& box, int rows, const Visit& visit) {
  const D d;
  constexpr int kPacket = static_cast<int>(kLanes), kStride = static_cast<int>(SkyNodes::kStride);
  const auto place = [&](VI node, int first_px) HWY_ATTR {
    return MulAdd(hn::ConvertTo(d, node), static_cast<float>(kStep), static_cast<float>(first_px));
  };
  const int columns = nodes_along(box.width_px);
  // A whole tile has a column more than fills packets: that one goes down.
  const int last = columns - 1, across = columns % kPacket == 1 ? last : columns;
  for (int row = 0; row < rows; ++row) {
    const V y_px = place(hn::Set(DI(), row), box.y0_px);
    for (int column = 0; column < across; column += kPacket)
      visit(place(CountFrom(column), box.x0_px), y_px, [&](V values, float* channel) HWY_ATTR {
        hn::StoreU(values, d, channel + row * kStride + column);
      });
  }
  if (across == columns) return;
  const V x_px = place(hn::Set(DI(), last), box.x0_px);
  for (int row = 0; row < rows; row += kPacket) {
    const int count = std::min(rows - row, kPacket);
    const VI down = Min(CountFrom(row), hn::Set(DI(), rows - 1));
    visit(x_px, place(down, box.y0_px), [&](V values, float* channel) HWY_ATTR {
      HWY_ALIGN std::array<float, kLanes> value;
      hn::Store(values, d, value.data());
      for (int i = 0; i < count; ++i) channel[(row + i) * kStride + last] = value[i];
    });
  }
}

// Where a row of pixels lies between two rows of nodes; `row` in pixels.
struct BetweenRows {
  std::size_t at;  // of the upper row's first node
  V below;

  HWY_INLINE explicit BetweenRows(int row)
      : at(static_cast<std::size_t>(row / kStep) * SkyNodes::kStride),
        below(Constant(static_cast<float>(row % kStep) / static_cast<float>(kStep))) {}

  // The nodes from `column` on of a channel.
  HWY_INLINE V operator()(const float* HWY_RESTRICT nodes, std::size_t column) const {
    const D d;
    const float* const upper = nodes + at + column;
    return Lerp(hn::LoadU(d, upper), hn::LoadU(d, upper + SkyNodes::kStride), below);
  }
};

// Nodes a, b, c ... to pixels: a, a, a, a, b ... and what lies between them and the next nodes.
HWY_INLINE V ToPixels(V nodes) {
  const D d;
  const DI di;
  const VI lane = hn::Iota(di, 0);
  const VI left = hn::ShiftRight<kStepLog2>(lane), right = left + 1;
  const V part = hn::ConvertTo(d, lane & (kStep - 1)) * (1.0f / static_cast<float>(kStep));
  return Lerp(hn::TableLookupLanes(nodes, hn::IndicesFromVec(d, left)),
              hn::TableLookupLanes(nodes, hn::IndicesFromVec(d, right)), part);
}

// Whether what the air does in a direction lies on straight lines between nodes: of fog Blinn's
// lobe, which is 1 - l wide.
inline bool IsAirOnLattice(const Shading& s) {
  const float step = kStep * s.rays.pixel_angle;
  return step <= kMostStepAngle && 1.0f - std::abs(s.media.fog.forward) > 10.0f * step;
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
