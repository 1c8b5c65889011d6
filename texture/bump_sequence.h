// Dynamic bump: a looping sequence of pairs of small pictures, a normal map and the detail that
// goes with it, both made from heights, or read.
// Source: Ma, Zhu, Gong, 2006.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "texture/image/image.h"
#include "texture/square_frames.h"

namespace swell::texture {

// Pictures of size x size texels that repeat beyond their edges, row 0 in the south.
struct BumpSequence {
  int size = 0;
  std::vector<Image8> normals;  // red, green, blue: make_normal_map
  // Grey or RGB: 127.5 (detail + 1), in [-1, 1], each channel's mean of all frames about 0. Light
  // is multiplied by tint (1 + detail).
  std::vector<Image8> details;
  glm::vec3 tint{1.0f};
};

// Root mean square length of (slope x, slope y) that a sequence's normals are made with.
inline constexpr float kBumpSlope = 0.4f;
// Standard deviation of a sequence's own details: crests are brighter than troughs.
inline constexpr float kBumpDetail = 0.25f;

// From heights in any unit, frames of one channel and one size, a power of two in [32, 512]; at
// least one frame, which is not flat. One strength for all frames makes their slopes kBumpSlope.
BumpSequence make_bump_sequence(std::span<const ImageF> heights);

// A frame between two: size * size values each, row-major, the slopes as their normals have them.
struct BumpFrame {
  std::vector<float> slope_x, slope_y;
  std::vector<std::vector<float>> detail;  // one a channel
};

// The sequence at a part of its loop in [0, 1]: between frames the normals and details are blended,
// the last with the first. The same bits for 0 and 1. `frame` keeps its capacity.
void blend_frames(const BumpSequence& sequence, double loop_part, BumpFrame& frame);

// What the pictures of a sequence hold.
enum class BumpPictures : std::uint8_t {
  kHeights,  // in any unit
  kNormals,  // 2 RGB - 1: to the east, to the north, up
};

// Reads frames 0 to frames - 1 of a sequence. The slopes of normals have no mean and, as those of
// heights, one strength that makes them kBumpSlope; normals alone have no details. Throws FileError
// as read_square_frames(), and for flat frames.
BumpSequence read_bump_sequence(std::string_view path, int frames,
                                BumpPictures pictures = BumpPictures::kHeights);

// Gives a sequence the colours of pictures in place of its details, one a frame, of the same size:
// they tint light by their colour over that of the brightest channel's mean, at most twice their
// mean. Throws FileError as read_colour_frames().
void read_bump_details(std::string_view path, BumpSequence& sequence);

}  // namespace swell::texture
