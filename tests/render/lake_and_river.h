// Land for scenes of tests.
#pragma once

namespace swell::render {

// A beach with the sea in the north, and a river that comes down to it from a small lake; the
// river's table is the last.
inline constexpr const char* kLakeAndRiver = R"(
[terrain]
coast_m = [[-100, 0], [100, 0]]
beach_slope = 0.03
beach_size_m = 520
floor_depth_m = 5
[[lake]]
name = "lake"
level_m = 4.0
outline_m = [[-25, -215], [25, -215], [20, -185], [-20, -185]]
depth_m = 2
[[river]]
from = "lake"
path_m = [[0, -195], [8, -150], [-8, -100], [0, -40], [0, 40]]
width_m = [9]
depth_m = [1]
surface_m = [4, 2.6, 1.4, 0.3, 0]
)";

}  // namespace swell::render
