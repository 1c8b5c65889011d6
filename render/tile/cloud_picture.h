// The volumetric clouds of a window: rays for every eighth pixel of every eighth row, for every
// fourth where those differ (in small pictures and from high up for half of these), and what a
// pixel sees up to its own depth from the four nodes around it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace swell::render {

struct Shading;
struct StageRun;
struct VolumeClouds;

struct CloudPicture {
  static constexpr int kMostStepLog2 = 2, kLeastStepLog2 = 1;
  static constexpr std::size_t kPadding = 32;  // nodes after a row's last, for whole vectors

  bool any = false;
  std::uint8_t step_log2 = kMostStepLog2;  // less in small pictures and from high up
  int columns = 0, rows = 0;
  std::size_t stride = 0;
  // Nodes at pixels (s i, s j), s = 2^step_log2: the light of clouds as it arrives (red, green,
  // blue), the part of what lies behind that they hide, and this times the distances where they
  // begin and end.
  static constexpr std::size_t kChannels = 6, kOpacity = 3, kFront = 4, kBack = 5;
  std::array<std::vector<float>, kChannels> nodes;

  // How far a node's ray meets nothing [m], at nodes whose rays were followed.
  std::vector<float> clear;
  // At (i, j), both odd: not 0 if the four coarse nodes around show about the same.
  std::vector<std::int32_t> even;

  int step() const { return 1 << step_log2; }
  std::size_t index(int i, int j) const { return static_cast<std::size_t>(j) * stride + i; }
};

// Draws the clouds that the window of `shading` sees. picture_scale: how small the picture is
// drawn; where it will be enlarged, nodes lie as many of its pixels apart as in one of full size.
void draw_clouds(const Shading& shading, const VolumeClouds& clouds, float picture_scale,
                 CloudPicture& picture, const StageRun& run);

}  // namespace swell::render
