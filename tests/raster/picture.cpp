#include "raster/picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "math/random.h"

namespace swell::raster {
namespace {

struct GuardedTile {
  std::vector<float> depth;
  std::vector<std::uint32_t> primitive;

  explicit GuardedTile(std::size_t pixels)
      : depth(pixels + 2 * kGuard, kGuardDepth), primitive(pixels + 2 * kGuard, kGuardPrimitive) {}
  std::span<float> depth_span() { return std::span(depth).subspan(kGuard, pixels()); }
  std::span<std::uint32_t> primitive_span() {
    return std::span(primitive).subspan(kGuard, pixels());
  }
  std::size_t pixels() const { return depth.size() - 2 * kGuard; }
  bool guards_hold() const {
    for (std::size_t i = 0; i < kGuard; ++i) {
      const std::size_t j = depth.size() - 1 - i;
      if (depth[i] != kGuardDepth || depth[j] != kGuardDepth) return false;
      if (primitive[i] != kGuardPrimitive || primitive[j] != kGuardPrimitive) return false;
    }
    return true;
  }
};

// Copies a tile into the picture; returns the number of broken promises.
int place_tile(const TileGrid& grid, int tile, GuardedTile& from, Picture& to) {
  int broken = from.guards_hold() ? 0 : 1;
  const int size = grid.tile_size_px;
  const int x0 = tile % grid.tiles_x * size, y0 = tile / grid.tiles_x * size;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const float depth = from.depth_span()[y * size + x];
      const std::uint32_t primitive = from.primitive_span()[y * size + x];
      const bool inside = x0 + x < to.width_px && y0 + y < to.height_px;
      if (primitive == kNoPrimitive && !(depth == 0.0f)) ++broken;
      if (!(depth >= 0.0f && depth <= 1.0f)) ++broken;
      if (!inside && primitive != kNoPrimitive) ++broken;
      if (!inside) continue;
      to.depth[(y0 + y) * to.width_px + x0 + x] = depth;
      to.primitive[(y0 + y) * to.width_px + x0 + x] = primitive;
    }
  }
  return broken;
}

}  // namespace

bool Picture::same_bits(const Picture& other) const {
  return width_px == other.width_px && height_px == other.height_px &&
         std::memcmp(depth.data(), other.depth.data(), depth.size() * sizeof(float)) == 0 &&
         primitive == other.primitive && covered == other.covered;
}

Picture draw_picture(std::span<const Draw> draws, Viewport viewport, int tile_size_px,
                     Workers& workers, int samples) {
  Picture picture{viewport.width_px, viewport.height_px, {}, {}, 0, {}};
  const std::size_t pixels = static_cast<std::size_t>(viewport.width_px) * viewport.height_px;
  picture.depth.resize(pixels);
  picture.primitive.resize(pixels);
  Pass pass;
  prepare_pass(draws, viewport, tile_size_px, pass, workers, samples);
  picture.statistics = pass_statistics(pass);

  const TileGrid grid = tile_grid(viewport, tile_size_px);
  std::vector<int> covered(grid.count()), broken(grid.count());
  workers.for_each(grid.count(), [&](std::size_t t, int) {
    const int tile = static_cast<int>(t);
    GuardedTile buffers(static_cast<std::size_t>(tile_size_px) * tile_size_px);
    covered[t] = draw_tile(pass, tile, buffers.depth_span(), buffers.primitive_span());
    broken[t] = place_tile(grid, tile, buffers, picture);
    if (covered[t] > 0 && !tile_has_triangles(pass, tile)) ++broken[t];
  });
  for (int t = 0; t < grid.count(); ++t) picture.covered += covered[t];
  EXPECT_EQ(std::count(broken.begin(), broken.end(), 0), grid.count());
  EXPECT_EQ(picture.covered,
            static_cast<int>(pixels) -
                std::count(picture.primitive.begin(), picture.primitive.end(), kNoPrimitive));
  return picture;
}

Picture draw_picture(const Draw& draw, Viewport viewport, int tile_size_px) {
  Workers workers(1);
  return draw_picture(std::span(&draw, 1), viewport, tile_size_px, workers);
}

std::vector<Configuration> all_configurations(std::span<const int> thread_counts) {
  std::vector<Configuration> all;
  for (const SimdTarget target : simd_targets()) {
    if (!simd_target_available(target)) continue;
    for (const int tile : {16, 32, 64}) {
      for (const int threads : thread_counts) all.push_back({target, tile, threads});
    }
  }
  return all;
}

glm::vec4 clip_from_window(double x_px, double y_px, double depth, double w, Viewport viewport) {
  const double x_ndc = 2.0 * x_px / viewport.width_px - 1.0;
  const double y_ndc = 1.0 - 2.0 * y_px / viewport.height_px;
  return glm::vec4(glm::dvec4(x_ndc * w, y_ndc * w, depth * w, w));
}

glm::vec4 clip_from_fx8(const Point& p, double depth, double w, Viewport viewport) {
  return clip_from_window(static_cast<double>(p.x) / 256.0, static_cast<double>(p.y) / 256.0, depth,
                          w, viewport);
}

bool covers_point(const Triangle& t, const Point& p, Ties ties) {
  const std::int64_t area =
      (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[2].x - t[0].x) * (t[1].y - t[0].y);
  if (area == 0) return false;
  for (int i = 0; i < 3; ++i) {
    const Point &a = t[i], &b = t[(i + 1) % 3], &c = t[(i + 2) % 3];
    std::int64_t e = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    if (area < 0) e = -e;
    if (e < 0) return false;
    if (e > 0) continue;
    // On the edge. Horizontal: owned if the triangle lies below (above, for bottom-left).
    if (a.y == b.y) {
      if ((c.y > a.y) != (ties == Ties::kTopLeft)) return false;
      continue;
    }
    // Otherwise: owned if the third vertex lies to the right.
    const Point &up = a.y < b.y ? a : b, &low = a.y < b.y ? b : a;
    if ((c.x - up.x) * (low.y - up.y) - (low.x - up.x) * (c.y - up.y) < 0) return false;
  }
  return true;
}

bool covers(const Triangle& t, int x, int y, Ties ties) {
  return covers_point(t, {256 * std::int64_t{x} + 128, 256 * std::int64_t{y} + 128}, ties);
}

ExactLine::ExactLine(const glm::vec4& p, const glm::vec4& q, Viewport viewport) {
  const Quad px = p.x, py = p.y, pw = p.w, qx = q.x, qy = q.y, qw = q.w;
  const Quad la = py * qw - pw * qy, lb = pw * qx - px * qw, lc = px * qy - py * qx;
  a_ = 2 * la / viewport.width_px, b_ = -2 * lb / viewport.height_px, c_ = lc - la + lb;
  length_ = std::hypot(static_cast<double>(a_), static_cast<double>(b_));
}

double ExactLine::distance(double x_px, double y_px) const {
  return static_cast<double>(a_ * x_px + b_ * y_px + c_) / length_;
}

double Random::uniform() { return random_uniform(seed_, counter_++); }

std::int64_t Random::integer(std::int64_t low, std::int64_t high) {
  return low + static_cast<std::int64_t>(random_bits(seed_, counter_++) %
                                         static_cast<std::uint64_t>(high - low + 1));
}

std::uint64_t Random::bits() { return random_bits(seed_, counter_++); }

}  // namespace swell::raster
