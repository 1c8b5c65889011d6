// swell-bench shading: what a pixel costs, from the times of tiles that show one thing alone.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "apps/shared/json.h"

namespace swell::apps {

struct ShadedTile {
  enum class Shows { kWater, kSky, kOther } shows = Shows::kOther;  // in all of its pixels
  int pixels = 0;                                                   // in the window
  double us = 0.0;
};
using ShadedFrame = std::vector<ShadedTile>;  // by number

// PixelCost is taken from the tiles that show one kind in more than half of the frames: the time of
// all of them, each the median of these frames, divided by their pixels. Other programs that
// interrupt most frames in a few tiles do not count so.
struct PixelCost {
  int tiles = 0;
  double ns = 0.0, cycles = 0.0;
};
struct ShadingReport {
  int frames = 0;
  double clock_ghz = 0.0;  // as assumed for all frames
  PixelCost water, sky;
};

// At least one frame, all of as many tiles; a tile's pixels are the same in all.
ShadingReport report_shading(std::span<const ShadedFrame> frames, double clock_ghz);

std::string shading_text(const ShadingReport& report);
Json shading_json(const ShadingReport& report);  // null for what no tile shows alone

}  // namespace swell::apps
