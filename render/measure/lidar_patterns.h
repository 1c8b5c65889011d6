// Patterns of lidars' beams: lists of directions and times, as LidarScan takes them.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "render/measure/lidar.h"

namespace swell::render {

// A lidar whose beams stand above each other and turn: the elevations of the lowest and the
// highest. Sources: Velodyne LiDAR, VLP-16 User Manual 63-9243 (16 beams, -15 to 15 deg by 2);
// HDL-32E User's Manual 63-9113 (32 beams, -30.67 to 10.67 deg by 4/3); Ouster, OS1 Datasheet,
// revision 7 (64 or 128 beams, -22.5 to 22.5 deg, evenly).
struct SpinningModel {
  std::string_view name;
  int beams;
  double lowest_deg, highest_deg;  // the others lie evenly between

  double elevation_deg(int beam) const {
    return lowest_deg + (highest_deg - lowest_deg) * beam / (beams - 1);
  }
};

// "vlp-16", "hdl-32e", "os1-64", "os1-128".
std::span<const SpinningModel> spinning_models();

// The model of a name; nullptr for others.
const SpinningModel* find_spinning_model(std::string_view name);

struct Turn {
  int columns = 1024;              // >= 1
  double duration_s = 0.1;         // of the turn; 0: all at once
  double start_azimuth_rad = 0.0;  // of the first column
  bool clockwise = true;           // as seen from above
};

// Column after column, in each from the lowest beam up; those of a column leave together.
std::vector<LidarBeam> spinning_beams(const SpinningModel& model, const Turn& turn);

// A solid-state lidar's grid or a depth camera's: width x height directions at even angles, rows
// from the top, from left to right. They are the middles of the cells of a field of view in
// (0, 2 pi] x (0, pi].
struct BeamGrid {
  int width = 1, height = 1;
  double width_rad = 1.0, height_rad = 1.0;
  double duration_s = 0.0;  // of all rows, one after the other
};
std::vector<LidarBeam> grid_beams(const BeamGrid& grid);

}  // namespace swell::render
