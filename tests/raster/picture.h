// What the rasterizer's tests share: drawing a pass into one picture, and an oracle of coverage
// written from the fill rule alone.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <vector>

#include "math/parallel.h"
#include "math/simd_target.h"
#include "raster/pass.h"

namespace swell::raster {

// Words around every tile that nothing may change.
inline constexpr std::size_t kGuard = 16;
inline constexpr float kGuardDepth = -77.0f;
inline constexpr std::uint32_t kGuardPrimitive = 0xABCD1234u;

// A whole viewport, row by row.
struct Picture {
  int width_px = 0, height_px = 0;
  std::vector<float> depth;
  std::vector<std::uint32_t> primitive;
  int covered = 0;  // as draw_tile counted
  PassStatistics statistics;

  std::uint32_t primitive_at(int x, int y) const { return primitive[y * width_px + x]; }
  float depth_at(int x, int y) const { return depth[y * width_px + x]; }
  bool same_bits(const Picture& other) const;
};

// Draws with guard words around every tile, and expects what draw_tile promises: guards and the
// outside of the viewport untouched or empty, depth 0 where nothing is, a true count. `samples` is
// what the pass is prepared with.
Picture draw_picture(std::span<const Draw> draws, Viewport viewport, int tile_size_px,
                     Workers& workers, int samples = 0);
Picture draw_picture(const Draw& draw, Viewport viewport, int tile_size_px = 32);

struct Configuration {
  SimdTarget target;
  int tile_size_px;
  int threads;
};
inline constexpr int kThreadCounts[] = {1, 3};

// Every available SIMD target x tile size x thread count.
std::vector<Configuration> all_configurations(std::span<const int> thread_counts);

// How far the next float is.
inline double ulp(float v) {
  return double{std::nextafter(v, std::numeric_limits<float>::infinity())} - double{v};
}

// Restores the SIMD target at scope exit.
class ScopedSimdTarget {
 public:
  explicit ScopedSimdTarget(SimdTarget target) : before_(current_simd_target()) {
    select_simd_target(target);
  }
  ~ScopedSimdTarget() { select_simd_target(before_); }
  ScopedSimdTarget(const ScopedSimdTarget&) = delete;
  ScopedSimdTarget& operator=(const ScopedSimdTarget&) = delete;

 private:
  SimdTarget before_;
};

// The vertex seen at window point (x_px, y_px). Exact for sizes and w that are powers of two and
// coordinates that float holds.
glm::vec4 clip_from_window(double x_px, double y_px, double depth, double w, Viewport viewport);

struct Point {
  std::int64_t x, y;  // window, 1/256 px
};
using Triangle = std::array<Point, 3>;
glm::vec4 clip_from_fx8(const Point& p, double depth, double w, Viewport viewport);

enum class Ties { kTopLeft, kBottomLeft };

// True if the triangle covers the point, in 64-bit integers.
bool covers_point(const Triangle& t, const Point& p, Ties ties = Ties::kTopLeft);

// True if the triangle covers the centre of pixel (x, y).
bool covers(const Triangle& t, int x, int y, Ties ties = Ties::kTopLeft);

// 113 bits of mantissa.
#if defined(__x86_64__)
using Quad = __float128;
#else
using Quad = long double;
static_assert(std::numeric_limits<Quad>::digits == 113);
#endif

// The exact line through two vertices of any w: a window point's signed distance [px].
class ExactLine {
 public:
  ExactLine(const glm::vec4& p, const glm::vec4& q, Viewport viewport);
  double distance(double x_px, double y_px) const;

 private:
  Quad a_, b_, c_;
  double length_;
};

// A small generator on the library's counter-based numbers.
class Random {
 public:
  explicit Random(std::uint64_t seed) : seed_(seed) {}
  double uniform();  // [0, 1)
  double between(double low, double high) { return low + (high - low) * uniform(); }
  std::int64_t integer(std::int64_t low, std::int64_t high);  // inclusive
  std::uint64_t bits();

 private:
  std::uint64_t seed_, counter_ = 0;
};

}  // namespace swell::raster
