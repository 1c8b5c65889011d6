// How far two pictures of one size differ.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace swell::apps {

// PictureDifference describes |a - b| over all pixels and their three colours, in steps of 8 bits.
struct PictureDifference {
  double mean = 0.0;
  int p99 = 0, max = 0;
  double psnr_db = 0.0;  // against the full range; 99 for equal pictures
};

// Pixels as render::Target::rgba, at least one.
PictureDifference picture_difference(std::span<const std::uint32_t> a,
                                     std::span<const std::uint32_t> b);

// |a - b| times `gain`, at most 255, as a picture.
std::vector<std::uint32_t> difference_picture(std::span<const std::uint32_t> a,
                                              std::span<const std::uint32_t> b, int gain);

}  // namespace swell::apps
