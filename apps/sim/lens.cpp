#include "apps/sim/lens.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swell::apps {
namespace {

constexpr int kNewtonSteps = 30, kMostSide_px = 8192;
constexpr double kSlack_px = 0.01, kDone = 1e-14;

struct Direction {
  double x, y;
};

// The direction that the lens shows at `seen`, by Newton's method; none where it does not get
// there, or lies beyond the first fold, where the determinant changes its sign.
std::optional<Direction> undistorted(const Distortion& lens, Direction seen, double focal_px) {
  const auto [k1, k2, p1, p2, k3] = lens;
  Direction at = seen;
  double det = 1.0;
  for (int step = 0; step < kNewtonSteps; ++step) {
    const auto [x, y] = at;
    const auto [u, v] = distorted(lens, x, y);
    const double r2 = x * x + y * y;
    const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
    const double slope = 2.0 * (k1 + r2 * (2.0 * k2 + r2 * 3.0 * k3));  // of it, over r, by r
    const double ux = radial + x * x * slope + 2.0 * p1 * y + 6.0 * p2 * x;
    const double uy = x * y * slope + 2.0 * p1 * x + 2.0 * p2 * y;
    const double vy = radial + y * y * slope + 6.0 * p1 * y + 2.0 * p2 * x;
    det = ux * vy - uy * uy;  // symmetric: vx is uy
    const double off_u = u - seen.x, off_v = v - seen.y;
    if (std::max(std::abs(off_u), std::abs(off_v)) < kDone) break;
    at.x -= (vy * off_u - uy * off_v) / det;
    at.y -= (ux * off_v - uy * off_u) / det;
  }
  const auto [u, v] = distorted(lens, at.x, at.y);
  const double off_px = std::max(std::abs(u - seen.x), std::abs(v - seen.y)) * focal_px;
  if (!(off_px < kSlack_px && det > 0.0)) return std::nullopt;
  return at;
}

}  // namespace

std::array<double, 2> distorted(const Distortion& lens, double x, double y) {
  const auto [k1, k2, p1, p2, k3] = lens;
  const double r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  return {x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
          y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y};
}

std::optional<LensLookup> LensLookup::find(const Intrinsics& k, int width_px, int height_px,
                                           const Distortion& lens) {
  LensLookup lookup;
  double low_x = std::numeric_limits<double>::infinity(), low_y = low_x;
  double high_x = -low_x, high_y = -low_x;
  for (int row = 0; row < height_px; ++row)
    for (int column = 0; column < width_px; ++column) {
      const Direction seen = {(column + 0.5 - k.cx) / k.fx, (row + 0.5 - k.cy) / k.fy};
      const auto found = undistorted(lens, seen, std::max(k.fx, k.fy));
      if (!found) return std::nullopt;
      const double x = k.fx * found->x, y = k.fy * found->y;
      lookup.x_.push_back(x);
      lookup.y_.push_back(y);
      low_x = std::min(low_x, x), high_x = std::max(high_x, x);
      low_y = std::min(low_y, y), high_y = std::max(high_y, y);
    }
  // A pixel more on each side, to blend with.
  const double left = std::floor(low_x) - 1.0, top = std::floor(low_y) - 1.0;
  const double width = std::ceil(high_x) - left + 2.0, height = std::ceil(high_y) - top + 2.0;
  if (!(width <= kMostSide_px && height <= kMostSide_px)) return std::nullopt;
  lookup.wide_ = {k.fx, k.fy, -left, -top};
  lookup.wide_width_px_ = static_cast<int>(width);
  lookup.wide_height_px_ = static_cast<int>(height);
  for (double& x : lookup.x_) x -= left;
  for (double& y : lookup.y_) y -= top;
  return lookup;
}

void LensLookup::blend(std::span<const std::uint32_t> rgba, std::span<std::uint8_t> rgb) const {
  const auto stride = static_cast<std::size_t>(wide_width_px_);
  for (std::size_t pixel = 0; pixel < x_.size(); ++pixel) {
    const double x = x_[pixel] - 0.5, y = y_[pixel] - 0.5;
    const double i = std::floor(x), j = std::floor(y);
    const double a = x - i, b = y - j;
    const std::size_t at = static_cast<std::size_t>(j) * stride + static_cast<std::size_t>(i);
    for (std::size_t c = 0; c < 3; ++c) {
      const auto value = [&](std::size_t place) {
        return static_cast<double>(rgba[place] >> (8 * c) & 0xff);
      };
      const double upper = (1.0 - a) * value(at) + a * value(at + 1);
      const double lower = (1.0 - a) * value(at + stride) + a * value(at + stride + 1);
      rgb[3 * pixel + c] =
          static_cast<std::uint8_t>(std::floor((1.0 - b) * upper + b * lower + 0.5));
    }
  }
}

}  // namespace swell::apps
