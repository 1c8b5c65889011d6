// Pictures as a lens distorts them, looked up in a wider pinhole picture: colours blended between
// four pixels, labels those of the nearest one, as the Python package has them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "math/view.h"

namespace swell::apps {

using Distortion = std::array<double, 5>;  // k1, k2, p1, p2, k3 of Brown and Conrady, as OpenCV's

// Where the lens shows the direction (x, y, 1) of the optical frame, as one of a camera without it.
std::array<double, 2> distorted(const Distortion& lens, double x, double y);

class LensLookup {
 public:
  // None if the lens folds the picture, does not reach its corners, or takes a pinhole picture of
  // over 8192 x 8192 pixels.
  static std::optional<LensLookup> find(const Intrinsics& k, int width_px, int height_px,
                                        const Distortion& lens);

  // Of the pinhole picture.
  const Intrinsics& wide_intrinsics() const { return wide_; }
  int wide_width_px() const { return wide_width_px_; }
  int wide_height_px() const { return wide_height_px_; }

  // 8-bit RGBA with R in the low byte of the pinhole picture to RGB bytes of the distorted one.
  void blend(std::span<const std::uint32_t> rgba, std::span<std::uint8_t> rgb) const;

  // The pixel of the pinhole picture that is nearest to a pixel of the distorted one.
  std::size_t nearest(std::size_t pixel) const {
    return static_cast<std::size_t>(y_[pixel]) * static_cast<std::size_t>(wide_width_px_) +
           static_cast<std::size_t>(x_[pixel]);
  }

 private:
  Intrinsics wide_;
  int wide_width_px_ = 0, wide_height_px_ = 0;
  std::vector<double> x_, y_;  // of each pixel's centre, in the pinhole picture
};

}  // namespace swell::apps
