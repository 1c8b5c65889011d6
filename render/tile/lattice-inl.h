// A tile's lattice of nodes on every fourth pixel, with straight lines between them.
#if defined(SWELL_RENDER_TILE_LATTICE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_TILE_LATTICE_INL_H_
#undef SWELL_RENDER_TILE_LATTICE_INL_H_
#else
#define SWELL_RENDER_TILE_LATTICE_INL_H_
#endif

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
