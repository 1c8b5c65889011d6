#include "texture/bump_sequence.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "math/check.h"
#include "texture/normal_map.h"

namespace swell::texture {
namespace {

// Differences of heights that can be made into slopes, root mean square.
constexpr double kLeastSlope = 1e-6, kMostSlope = 1e12;

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

// Slopes of normals that are no rounding, root mean square.
constexpr double kLeastNormalSlope = 0.01;

[[noreturn]] void refuse_sequence(std::string_view path, const std::string& text) {
  throw FileError(fmt::format("{}: {}", path_of_frame(path, 0), text));
}

BumpSequence sequence_of_heights(std::string_view path, std::span<const ImageF> heights) {
  const double slope = std::sqrt(moments_of(heights).slope2);
  if (!(slope >= kLeastSlope && slope <= kMostSlope))
    refuse_sequence(
        path, fmt::format("bump images, got heights that differ by {:.3g} from a pixel to the next "
                          "but one, allowed {} to {}",
                          slope, kLeastSlope, kMostSlope));
  return make_bump_sequence(heights);
}

// The slopes of a sequence's normals, frame after frame.
struct Slopes {
  std::vector<float> x, y;
};

Slopes slopes_of_normals(std::span<const ImageF> normals) {
  constexpr float kLeastUp = 0.05f;
  Slopes slopes;
  for (const ImageF& frame : normals)
    for (std::size_t n = 0; n < texels_of(frame); ++n) {
      const auto part = [&](std::size_t c) { return 2.0f * frame.pixels[3 * n + c] - 1.0f; };
      const float up = std::max(part(2), kLeastUp);
      slopes.x.push_back(-part(0) / up);
      slopes.y.push_back(-part(1) / up);
    }
  return slopes;
}

// Takes the mean away; returns the mean square of what is left.
double centre(std::vector<float>& values) {
  double sum = 0.0, squares = 0.0;
  for (const float value : values) sum += static_cast<double>(value);
  const auto count = static_cast<double>(values.size());
  for (float& value : values) {
    value -= static_cast<float>(sum / count);
    squares += double{value} * value;
  }
  return squares / count;
}

BumpSequence sequence_of_normals(std::string_view path, std::span<const ImageF> normals) {
  Slopes slopes = slopes_of_normals(normals);
  const double slope = std::sqrt(centre(slopes.x) + centre(slopes.y));
  if (!(slope >= kLeastNormalSlope))
    refuse_sequence(path, fmt::format("bump images, got normals with slopes of {:.3g}, allowed {} "
                                      "and more",
                                      slope, kLeastNormalSlope));
  const auto strength = static_cast<float>(double{kBumpSlope} / slope);
  for (float& value : slopes.x) value *= strength;
  for (float& value : slopes.y) value *= strength;
  BumpSequence sequence;
  sequence.size = normals[0].width;
  const std::size_t texels = texels_of(normals[0]);
  for (std::size_t f = 0; f < normals.size(); ++f) {
    const auto of_frame = [&](const std::vector<float>& values) {
      return std::span(values).subspan(f * texels, texels);
    };
    sequence.normals.push_back(
        encode_normals(sequence.size, sequence.size, of_frame(slopes.x), of_frame(slopes.y)));
    sequence.details.push_back(
        {sequence.size, sequence.size, 1, std::vector<std::uint8_t>(texels, 128)});
  }
  return sequence;
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
  const std::size_t texels = static_cast<std::size_t>(sequence.size) * sequence.size;
  frame.slope_x.resize(texels);
  frame.slope_y.resize(texels);
  const std::uint8_t *a = sequence.normals[now].pixels.data(),
                     *b = sequence.normals[next].pixels.data();
  const auto blend = [weight](std::uint8_t from, std::uint8_t to) {
    const float x = from;
    return x + weight * (static_cast<float>(to) - x) - 127.5f;
  };
  for (std::size_t n = 0; n < texels; ++n) {
    const float x = blend(a[3 * n], b[3 * n]), y = blend(a[3 * n + 1], b[3 * n + 1]);
    const float z = blend(a[3 * n + 2], b[3 * n + 2]);
    frame.slope_x[n] = -x / z;
    frame.slope_y[n] = -y / z;
  }
  const Image8 &detail_a = sequence.details[now], &detail_b = sequence.details[next];
  const auto channels = static_cast<std::size_t>(detail_a.channels);
  frame.detail.resize(channels);
  for (std::size_t c = 0; c < channels; ++c) {
    frame.detail[c].resize(texels);
    for (std::size_t n = 0; n < texels; ++n) {
      const std::size_t at = channels * n + c;
      frame.detail[c][n] = blend(detail_a.pixels[at], detail_b.pixels[at]) / 127.5f;
    }
  }
}

BumpSequence read_bump_sequence(std::string_view path, int frames, BumpPictures pictures) {
  const std::vector<std::string> paths = paths_of_frames(path, frames);
  if (pictures == BumpPictures::kNormals)
    return sequence_of_normals(path, read_square_frames(paths, "bump image", 3));
  return sequence_of_heights(path, read_square_frames(paths, "bump image", 1));
}

void read_bump_details(std::string_view path, BumpSequence& sequence) {
  const auto frames = static_cast<int>(sequence.normals.size());
  ColourFrames colours = read_colour_frames(paths_of_frames(path, frames), sequence.size);
  const glm::vec3 mean = colours.mean;
  sequence.tint = mean / std::max({mean.x, mean.y, mean.z, 1e-6f});
  sequence.details = std::move(colours.frames);
}

}  // namespace swell::texture
