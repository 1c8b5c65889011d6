#include "texture/normal_map.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "math/check.h"
#include "math/elementary.h"
#include "math/random.h"

namespace swell::texture {
namespace {

int neighbour(int i, int step, int count, Edges edges) {
  const int next = i + step;
  if (edges == Edges::kClamped) return std::clamp(next, 0, count - 1);
  return next < 0 ? next + count : next % count;
}

std::uint8_t normal_byte(float component) {
  return static_cast<std::uint8_t>(std::nearbyint(127.5f * (component + 1.0f)));
}

// Gradient noise on a square lattice that stands at an angle: (u, v) lies at (a u - b v, b u + a v)
// in cells. A map made of one lattice shows its axes; a sum over several angles does not. Integers
// a and b make the map tile at u = 1 and v = 1: those steps lead to lattice points.
class TiltedNoise {
 public:
  // a and b without common divisor.
  TiltedNoise(int a, int b, std::uint64_t seed) : a_(a), b_(b), points_(a * a + b * b) {
    // The tile holds a^2 + b^2 lattice points. (i, j) -> i + step j modulo that many numbers them:
    // it takes (a, b) and (-b, a) to 0, because step = b / a.
    while ((step_ * a_ - b_) % points_ != 0) ++step_;
    // Directions evenly round the circle, dealt out at random: no direction is preferred.
    std::vector<int> deal(points_);
    for (int n = 0; n < points_; ++n) deal[n] = n;
    for (std::uint64_t n = points_ - 1; n > 0; --n) {
      std::swap(deal[n], deal[random_bits(seed, n) % (n + 1)]);
    }
    const double turn = random_uniform(seed, 0);
    for (const int n : deal) {
      gradients_.push_back(sin_cos_turns((n + turn) / points_));
    }
  }

  double at(double u, double v) const {
    const double x = a_ * u - b_ * v, y = b_ * u + a_ * v;
    const double i = std::floor(x), j = std::floor(y);
    const double fx = x - i, fy = y - j;
    const auto corner = [&](int di, int dj) {
      const SinCos& g = gradients_[number(static_cast<int>(i) + di, static_cast<int>(j) + dj)];
      return g.cos * (fx - di) + g.sin * (fy - dj);
    };
    const double wx = fade(fx), wy = fade(fy);
    const double lower = corner(0, 0) + wx * (corner(1, 0) - corner(0, 0));
    const double upper = corner(0, 1) + wx * (corner(1, 1) - corner(0, 1));
    return lower + wy * (upper - lower);
  }

 private:
  static double fade(double t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); }
  int number(int i, int j) const {
    const int n = (i + step_ * j) % points_;
    return n < 0 ? n + points_ : n;
  }

  int a_, b_, points_, step_ = 0;
  std::vector<SinCos> gradients_;
};

void add_noise(const TiltedNoise& noise, double amplitude, ImageF& heights) {
  const double turn = 1.0 / heights.width;
  for (int y = 0; y < heights.height; ++y) {
    for (int x = 0; x < heights.width; ++x) {
      heights.at(x, y, 0) += static_cast<float>(amplitude * noise.at(x * turn, y * turn));
    }
  }
}

}  // namespace

void compute_slopes(const ImageF& heights, Edges edges, float strength, std::span<float> slope_x,
                    std::span<float> slope_y) {
  const int width = heights.width, height = heights.height;
  const std::size_t texels = std::size_t{1} * width * height;
  SWELL_CHECK(heights.channels == 1 && heights.pixels.size() == texels, "size={}x{}x{}", width,
              height, heights.channels);
  SWELL_CHECK(slope_x.size() == texels && slope_y.size() == texels, "x={} y={} texels={}",
              slope_x.size(), slope_y.size(), texels);
  std::size_t n = 0;
  for (int y = 0; y < height; ++y) {
    const int below = neighbour(y, -1, height, edges), above = neighbour(y, 1, height, edges);
    for (int x = 0; x < width; ++x, ++n) {
      const int left = neighbour(x, -1, width, edges), right = neighbour(x, 1, width, edges);
      slope_x[n] = strength * (heights.at(right, y, 0) - heights.at(left, y, 0));
      slope_y[n] = strength * (heights.at(x, above, 0) - heights.at(x, below, 0));
    }
  }
}

Image8 encode_normals(int width, int height, std::span<const float> slope_x,
                      std::span<const float> slope_y) {
  const std::size_t texels = std::size_t{1} * width * height;
  Image8 map{width, height, 3, std::vector<std::uint8_t>(3 * texels)};
  for (std::size_t n = 0; n < texels; ++n) {
    const float x = -slope_x[n], y = -slope_y[n];
    const float length = std::sqrt(x * x + y * y + 1.0f);
    map.pixels[3 * n] = normal_byte(x / length);
    map.pixels[3 * n + 1] = normal_byte(y / length);
    map.pixels[3 * n + 2] = normal_byte(1.0f / length);
  }
  return map;
}

Image8 make_normal_map(const ImageF& heights, Edges edges, float strength) {
  const std::size_t texels = std::size_t{1} * heights.width * heights.height;
  std::vector<float> slope_x(texels), slope_y(texels);
  compute_slopes(heights, edges, strength, slope_x, slope_y);
  return encode_normals(heights.width, heights.height, slope_x, slope_y);
}

SlopeMap make_bump_slopes(int size, std::uint64_t seed) {
  SWELL_CHECK(size >= 32 && size <= 4096 && std::has_single_bit(static_cast<unsigned>(size)),
              "size={}", size);
  // About 4, 8, 15 and 30 cells a side, at 14, 30, 42 and 64 degrees.
  constexpr std::array<std::array<int, 2>, 4> kLattices = {{{4, 1}, {7, 4}, {11, 10}, {13, 27}}};
  const std::size_t texels = std::size_t{1} * size * size;
  ImageF heights{size, size, 1, std::vector<float>(texels)};
  for (std::size_t n = 0; n < kLattices.size(); ++n) {
    const auto [a, b] = kLattices[n];
    const double cells = std::sqrt(static_cast<double>(a * a + b * b));
    if (n > 0 && 6.0 * cells > size) break;
    // Heights fall as lengths do: the same steepness.
    add_noise(TiltedNoise(a, b, random_bits(seed, n)), 1.0 / cells, heights);
  }
  SlopeMap map{size, std::vector<float>(texels), std::vector<float>(texels)};
  compute_slopes(heights, Edges::kPeriodic, 1.0f, map.x, map.y);
  double squares = 0.0;
  for (std::size_t n = 0; n < texels; ++n) {
    squares += double{map.x[n]} * map.x[n] + double{map.y[n]} * map.y[n];
  }
  const float scale = static_cast<float>(std::sqrt(static_cast<double>(texels) / squares));
  for (std::size_t n = 0; n < texels; ++n) {
    map.x[n] *= scale;
    map.y[n] *= scale;
  }
  return map;
}

}  // namespace swell::texture
