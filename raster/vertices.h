// Step 1 of a pass: each vertex once, from clip space to the snapped window, with what the later
// steps ask of it as flags.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "raster/pass.h"

namespace swell::raster {

inline constexpr int kFractionBits = 8;               // of snapped window coordinates
inline constexpr int kPixelFx8 = 1 << kFractionBits;  // one pixel
inline constexpr int kHalfPixelFx8 = kPixelFx8 / 2;   // a pixel's centre
inline constexpr float kMinW = 1e-30f;                // stands for w > 0

// The guard band is |x| <= k w, |y| <= k w with k = 2 * 12288 / size - 1, which keeps every
// window coordinate within +-12288 px of 0: 22 bits and sign with 8 fraction bits, so edge
// functions fit 47 bits.
inline constexpr float kGuardPx = 12288.0f;

enum VertexFlag : std::uint32_t {
  kOutsideLeft = 1u << 0,
  kOutsideRight = 1u << 1,
  kOutsideTop = 1u << 2,
  kOutsideBottom = 1u << 3,
  kOutsideNear = 1u << 4,   // z > w
  kOutsideFar = 1u << 5,    // z < 0
  kOutsideW = 1u << 6,      // w < kMinW
  kOutsideUser = 1u << 7,   // clip distance < 0
  kOutsideGuard = 1u << 8,  // outside any plane of the guard band
  kOutsideUser2 = 1u << 9,  // second clip distance < 0
  kNotFinite = 1u << 10,    // a NaN or an infinity among the inputs; no other flag is set
};
// A triangle is out if all its vertices share one of these.
inline constexpr std::uint32_t kRejectFlags = 0xFFu | kOutsideUser2;
// A triangle with one of these at any vertex has to be clipped.
inline constexpr std::uint32_t kClipFlags =
    kOutsideNear | kOutsideFar | kOutsideW | kOutsideUser | kOutsideUser2 | kOutsideGuard;

// x_fx8, y_fx8 and depth hold values only without kClipFlags and kNotFinite; otherwise 0.
struct WindowVertex {
  std::int32_t x_fx8, y_fx8;  // window, 8 fraction bits, |.| <= 12288 px
  float depth;                // z / w in [0, 1]
  std::uint32_t flags;        // of VertexFlag
};

// Divides, maps to the window and snaps (round to nearest even) every vertex of p_clip, which may
// hold any bits. Clip distances are empty or as long as p_clip, as `out` is.
void project_vertices(std::span<const glm::vec4> p_clip, const ClipDistances& clip_distance,
                      Viewport viewport, std::span<WindowVertex> out);

}  // namespace swell::raster
