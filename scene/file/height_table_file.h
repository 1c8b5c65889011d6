// The pictures of tables of heights (scene/height_table.h).
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace swell::scene {

struct HeightFrames;

// A picture's first channel, its top row the last in v; as terrain::TerrainDescription's: EXR and
// HDR hold metres, of others black is low_m and white high_m.
struct HeightPictures {
  std::string path;  // with frames > 1: texture::kFrameNumber in it stands for 0 to frames - 1
  int frames = 1;
  double low_m = 0.0, high_m = 1.0;
  bool bicubic = false;  // posts between the picture's, four to each (terrain/bicubic.h)
};

inline constexpr int kMostTableSide = 2049, kMostTableFrames = 256;
inline constexpr double kMostTableHeight_m = 1000.0;
// Of all frames, after any interpolation, in squares of the longer side: 8 bytes each.
inline constexpr std::size_t kMostTablePosts = std::size_t{1} << 24;

std::vector<std::string> paths_of(const HeightPictures& pictures);

// Throws std::runtime_error in one line: FILE: what, got what, allowed what.
std::shared_ptr<const HeightFrames> read_heights(const HeightPictures& pictures);

}  // namespace swell::scene
