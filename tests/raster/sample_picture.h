// What the tests of samples share: a pass drawn with every sample of every pixel, and the sample
// positions and an oracle of coverage written apart from the library's.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "raster/picture.h"
#include "raster/samples.h"

namespace swell::raster {

constexpr int kSampleCounts[] = {4, 8};  // a pixel

// Every sample of a viewport, pixels row by row.
struct SamplePicture {
  int width_px = 0, height_px = 0, samples = 0;
  std::vector<float> depth;
  std::vector<std::uint32_t> primitive;
  PassStatistics statistics;

  std::size_t index(int x, int y, int s) const {
    return static_cast<std::size_t>(y * width_px + x) * static_cast<std::size_t>(samples) +
           static_cast<std::size_t>(s);
  }
  std::uint32_t primitive_at(int x, int y, int s) const { return primitive[index(x, y, s)]; }
  // The share of the pixel's samples that any triangle covers.
  double coverage(int x, int y) const;
  bool same_bits(const SamplePicture& other) const;
};

// Draws all samples with guard words around every tile's buffers, and expects what draw_samples
// promises: guards untouched, nothing outside the viewport, depth 0 where nothing is, a true count.
SamplePicture draw_sample_picture(std::span<const Draw> draws, Viewport viewport, int samples,
                                  int tile_size_px, Workers& workers);
SamplePicture draw_sample_picture(const Draw& draw, Viewport viewport, int samples,
                                  int tile_size_px = 32);

// The marks of a whole viewport, one number a pixel, 0 or 1.
std::vector<int> mark_picture(std::span<const Draw> draws, Viewport viewport, int samples,
                              int tile_size_px, std::uint32_t first_primitive,
                              std::uint32_t end_primitive);

// All pixels of a tile.
PixelMask full_mask(int tile_size_px);

// Sample s of pixel (x, y) in the window, from the tables of the Vulkan specification.
Point sample_point(int x, int y, int s, int samples);

// Triangles given on the grid of 1/256 px, each of one depth all over.
struct FlatSoup {
  std::vector<Triangle> triangles;
  std::vector<float> z;
  std::vector<glm::vec4> p_clip;
  std::vector<std::uint32_t> indices;

  Draw draw() const { return {.p_clip = p_clip, .indices = indices}; }
  void add(const Triangle& t, float depth, Viewport viewport);
};

// A triangle of any kind: smaller than the gap between samples, thin and long, huge, without area,
// with corners on the grid of samples, of either winding.
Triangle any_triangle(Random& random, Viewport viewport);

// `count` of them with few different depths, so that depths are often equal.
FlatSoup random_flat_soup(Random& random, int count, Viewport viewport);

}  // namespace swell::raster
