// Where the drawn water cuts the near plane: the pixels' rays begin there, in air or in water.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "raster/pass.h"
#include "render/view/render_view.h"

namespace swell::render {

struct Meshes;
struct StageRun;
struct Surface;

// What a part of the picture looks through first.
enum class Begins : std::uint8_t { kInAir, kInWater, kInBoth };

// The height of the near plane over the drawn water, at nodes kStep_px apart from the picture's
// upper left corner on; on straight lines between them.
struct Crossing {
  static constexpr int kStep_px = 16;

  Begins picture = Begins::kInAir;
  int columns = 0;              // of nodes, which go a step beyond the picture
  std::vector<float> above_m;   // if the picture begins in both
  std::vector<int> near_water;  // working memory: triangles

  // Whether pixels of the box begin in air, in water or in both. The picture must begin in both.
  Begins begins(const raster::PixelBox& box) const;
  // Returns `above_m` at a pixel's centre: below 0 where it begins in water.
  float above(int x_px, int y_px) const;
  // About how many pixels lie between a pixel and the line, as its cell between four nodes has it.
  float rows_away(int x_px, int y_px) const;
  // No pixel of the pixel's cell is nearer than this.
  float least_rows_away(int x_px, int y_px) const;

 private:
  float per_px(const float* upper) const;
};

// Finds the crossing by the sea's triangles at their heights of this frame, or where the eye is in
// a river or a lake by its level. The picture begins as the eye does where no wave can reach the
// near plane. 0.1 to 1 ms where one can.
void find_crossing(const Surface& sea, const View& view, const WaterAtEye& water,
                   float most_height_m, Crossing& line);

// Maps the land into the views anew, as an eye on the other side of the surface needs it.
void map_land(const Meshes& meshes, FrameViews views, const StageRun& run);

}  // namespace swell::render
