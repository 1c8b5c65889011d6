#include "texture/bump_sequence.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "math/check.h"
#include "texture/image/image_io.h"
#include "texture/normal_map.h"

namespace swell::texture {
namespace {

// Differences of heights that can be made into slopes, root mean square.
constexpr double kLeastSlope = 1e-6, kMostSlope = 1e12;

std::size_t texels_of(const ImageF& image) {
  return static_cast<std::size_t>(image.width) * image.height;
}

struct Moments {
  double slope2 = 0.0;                 // mean square of (x, y)'s length, for a strength of 1
  double height = 0.0, height2 = 0.0;  // means
};

Moments moments_of(std::span<const ImageF> heights) {
  Moments sum;
  std::vector<float> x(texels_of(heights[0])), y(x.size());
  for (const ImageF& frame : heights) {
    compute_slopes(frame, Edges::kPeriodic, 1.0f, x, y);
    for (std::size_t n = 0; n < x.size(); ++n) {
      const double h = frame.pixels[n];
      sum.slope2 += double{x[n]} * x[n] + double{y[n]} * y[n];
      sum.height += h;
      sum.height2 += h * h;
    }
  }
  const double scale = 1.0 / (static_cast<double>(x.size()) * static_cast<double>(heights.size()));
  return {sum.slope2 * scale, sum.height * scale, sum.height2 * scale};
}

// Heights in units of their deviation, times kBumpDetail.
Image8 make_detail(const ImageF& heights, const Moments& all) {
  const double deviation = std::sqrt(std::max(all.height2 - all.height * all.height, 1e-30));
  const double scale = static_cast<double>(kBumpDetail) / deviation;
  Image8 detail{heights.width, heights.height, 1, std::vector<std::uint8_t>(texels_of(heights))};
  for (std::size_t n = 0; n < detail.pixels.size(); ++n) {
    const double value = std::clamp((heights.pixels[n] - all.height) * scale, -1.0, 1.0);
    detail.pixels[n] = static_cast<std::uint8_t>(std::nearbyint(127.5 * (value + 1.0)));
  }
  return detail;
}

// ---- Files

[[noreturn]] void refuse_sequence(const std::string& path, const std::string& text) {
  throw FileError(fmt::format("{}: {}", path, text));
}

// Checked against the first frame's size.
ImageF read_frame(const std::string& path, int frames, int size) {
  const ImageF image = read_image(path, {.max_side_px = kMostBumpSize});
  const auto side = static_cast<unsigned>(image.width);
  const bool fits = image.width == image.height && image.width >= kLeastBumpSize &&
                    image.width <= kMostBumpSize && std::has_single_bit(side);
  if (!fits || (size > 0 && image.width != size))
    refuse_sequence(path, fmt::format("bump image, got {} x {} pixels, allowed a square of {}",
                                      image.width, image.height,
                                      size > 0 ? fmt::format("{}, as the first", size)
                                               : fmt::format("{} to {} a side, a power of two",
                                                             kLeastBumpSize, kMostBumpSize)));
  if (texels_of(image) * static_cast<std::size_t>(frames) > kMostBumpTexels)
    refuse_sequence(path, fmt::format("bump image, got {} frames of {} pixels a side, allowed {}",
                                      frames, image.width, kMostBumpTexels / texels_of(image)));
  ImageF heights{image.width, image.height, 1, std::vector<float>(texels_of(image))};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      heights.at(x, y, 0) = image.at(x, image.height - 1 - y, 0);
  return heights;
}

}  // namespace

BumpSequence make_bump_sequence(std::span<const ImageF> heights) {
  SWELL_CHECK(!heights.empty(), "frames={}", heights.size());
  const Moments all = moments_of(heights);
  SWELL_CHECK(all.slope2 > 0.0 && std::isfinite(all.slope2), "slope2={}", all.slope2);
  const auto strength = static_cast<float>(double{kBumpSlope} / std::sqrt(all.slope2));
  BumpSequence sequence;
  sequence.size = heights[0].width;
  for (const ImageF& frame : heights) {
    SWELL_CHECK(frame.width == sequence.size && frame.height == sequence.size, "size={}x{}",
                frame.width, frame.height);
    sequence.normals.push_back(make_normal_map(frame, Edges::kPeriodic, strength));
    sequence.details.push_back(make_detail(frame, all));
  }
  return sequence;
}

void blend_frames(const BumpSequence& sequence, double loop_part, BumpFrame& frame) {
  SWELL_CHECK(loop_part >= 0.0 && loop_part <= 1.0, "loop_part={}", loop_part);
  const std::size_t frames = sequence.normals.size();
  const double place = loop_part * static_cast<double>(frames), whole = std::floor(place);
  const std::size_t now = static_cast<std::size_t>(whole) % frames, next = (now + 1) % frames;
  const auto weight = static_cast<float>(place - whole);
  const std::uint8_t *a = sequence.normals[now].pixels.data(),
                     *b = sequence.normals[next].pixels.data();
  const std::uint8_t *detail_a = sequence.details[now].pixels.data(),
                     *detail_b = sequence.details[next].pixels.data();
  const std::size_t texels = static_cast<std::size_t>(sequence.size) * sequence.size;
  frame.slope_x.resize(texels);
  frame.slope_y.resize(texels);
  frame.detail.resize(texels);
  const auto blend = [weight](std::uint8_t from, std::uint8_t to) {
    const float x = from;
    return x + weight * (static_cast<float>(to) - x) - 127.5f;
  };
  for (std::size_t n = 0; n < texels; ++n) {
    const float x = blend(a[3 * n], b[3 * n]), y = blend(a[3 * n + 1], b[3 * n + 1]);
    const float z = blend(a[3 * n + 2], b[3 * n + 2]);
    frame.slope_x[n] = -x / z;
    frame.slope_y[n] = -y / z;
    frame.detail[n] = blend(detail_a[n], detail_b[n]) / 127.5f;
  }
}

std::string path_of_frame(std::string_view path, int frame) {
  const std::size_t at = path.find(kFrameNumber);
  SWELL_CHECK(at != std::string_view::npos, "path={}", path);
  return fmt::format("{}{:04d}{}", path.substr(0, at), frame,
                     path.substr(at + kFrameNumber.size()));
}

BumpSequence read_bump_sequence(std::string_view path, int frames) {
  std::vector<ImageF> heights;
  for (int frame = 0; frame < frames; ++frame)
    heights.push_back(
        read_frame(path_of_frame(path, frame), frames, frame > 0 ? heights[0].width : 0));
  const double slope = std::sqrt(moments_of(heights).slope2);
  if (!(slope >= kLeastSlope && slope <= kMostSlope))
    refuse_sequence(
        path_of_frame(path, 0),
        fmt::format("bump images, got heights that differ by {:.3g} from a pixel to the next but "
                    "one, allowed {} to {}",
                    slope, kLeastSlope, kMostSlope));
  return make_bump_sequence(heights);
}

}  // namespace swell::texture
