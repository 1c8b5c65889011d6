// Pictures that are nothing but rays over a map of heights, to be timed.
#pragma once

#include "math/parallel.h"
#include "terrain/height_pyramid.h"

namespace swell::apps {

inline constexpr double kHillsSide_m = 16384.0;

// Hills up to 600 m high, rough down to the posts, on a square about the origin: octaves of
// bilinear noise, 0.57 times as high each. cells: a side, 8 or more. 0.2 us of one core a post.
terrain::HeightPyramid make_hills(int cells, Workers& workers);

// From 700 m up, looking east, 50 degrees high.
struct RayPicture {
  int width_px = 1280, height_px = 720;
  double pitch_deg = 10.0;  // down
  bool beams = true;        // rays begin behind beams, as in frames; false: at the eye
  bool stops = true;        // at blocks of terrain::kBlock_px; false: down to the posts
};

// A ray through each pixel, once, and those that fill squares of 8 x 8.
void cast_picture(const terrain::HeightPyramid& map, const RayPicture& picture, Workers& workers);

}  // namespace swell::apps
