#include "apps/bench/picture_difference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "math/check.h"

namespace swell::apps {
namespace {

constexpr int kColours = 3;

int colour_of(std::uint32_t pixel, int colour) { return pixel >> (8 * colour) & 0xff; }

int step_between(std::uint32_t a, std::uint32_t b, int colour) {
  return std::abs(colour_of(a, colour) - colour_of(b, colour));
}

}  // namespace

PictureDifference picture_difference(std::span<const std::uint32_t> a,
                                     std::span<const std::uint32_t> b) {
  SWELL_CHECK(!a.empty() && a.size() == b.size(), "{} and {} pixels", a.size(), b.size());
  std::array<std::uint64_t, 256> count{};
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int c = 0; c < kColours; ++c)
      ++count[static_cast<std::size_t>(step_between(a[i], b[i], c))];

  PictureDifference result;
  const double values = kColours * static_cast<double>(a.size());
  double sum = 0.0, squares = 0.0, so_far = 0.0;
  for (int step = 0; step < 256; ++step) {
    const auto n = static_cast<double>(count[static_cast<std::size_t>(step)]);
    sum += n * step;
    squares += n * step * step;
    if (so_far < 0.99 * values) result.p99 = step;
    if (n > 0.0) result.max = step;
    so_far += n;
  }
  result.mean = sum / values;
  result.psnr_db = squares > 0.0 ? 10.0 * std::log10(255.0 * 255.0 * values / squares) : 99.0;
  return result;
}

std::vector<std::uint32_t> difference_picture(std::span<const std::uint32_t> a,
                                              std::span<const std::uint32_t> b, int gain) {
  SWELL_CHECK(a.size() == b.size(), "{} and {} pixels", a.size(), b.size());
  std::vector<std::uint32_t> picture(a.size(), 0xff000000u);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int c = 0; c < kColours; ++c)
      picture[i] |= static_cast<std::uint32_t>(std::min(gain * step_between(a[i], b[i], c), 255))
                    << (8 * c);
  return picture;
}

}  // namespace swell::apps
