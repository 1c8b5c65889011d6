// Dynamic bump: a looping sequence of pairs of small pictures, a normal map and the detail that
// goes with it, both made from heights.
// Source: Ma, Zhu, Gong, 2006.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "texture/image/image.h"

namespace swell::texture {

// Pictures of size x size texels that repeat beyond their edges, row 0 in the south.
struct BumpSequence {
  int size = 0;
  std::vector<Image8> normals;  // red, green, blue: make_normal_map
  std::vector<Image8> details;  // grey: 127.5 (detail + 1), in [-1, 1], mean of all frames about 0
};

// Root mean square length of (slope x, slope y) that a sequence's normals are made with.
inline constexpr float kBumpSlope = 0.4f;
// Standard deviation of a sequence's details: crests are brighter than troughs.
inline constexpr float kBumpDetail = 0.25f;

// Most texels of all frames, and sides of a frame.
inline constexpr std::size_t kMostBumpTexels = std::size_t{1} << 24;
inline constexpr int kLeastBumpSize = 32, kMostBumpSize = 512;

// From heights in any unit, frames of one channel and one size, a power of two in [32, 512]; at
// least one frame, which is not flat. One strength for all frames makes their slopes kBumpSlope.
BumpSequence make_bump_sequence(std::span<const ImageF> heights);

// A frame between two: size * size values each, row-major, the slopes as their normals have them.
struct BumpFrame {
  std::vector<float> slope_x, slope_y, detail;
};

// The sequence at a part of its loop in [0, 1]: between frames the normals and details are blended,
// the last with the first. The same bits for 0 and 1. `frame` keeps its capacity.
void blend_frames(const BumpSequence& sequence, double loop_part, BumpFrame& frame);

// The number of a frame in the path of its file.
inline constexpr std::string_view kFrameNumber = "%04d";

// A path with the number in place of kFrameNumber, which it has.
std::string path_of_frame(std::string_view path, int frame);

// Reads frames 0 to frames - 1 of a sequence's heights: the first channel of PNG, EXR, HDR, TIFF or
// PNM files, north on top. Throws FileError for what read_image() refuses, frames that are no
// squares of one size (a power of two in [32, 512]) or more than kMostBumpTexels, and for flat
// ones.
BumpSequence read_bump_sequence(std::string_view path, int frames);

}  // namespace swell::texture
