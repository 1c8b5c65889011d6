// What lidars of the C interface take and give as Python has it.
#pragma once

#include <pybind11/numpy.h>
#include <swell.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "handles.h"
#include "tuples.h"

namespace swell_python {

using BeamArray = py::array_t<double, py::array::c_style | py::array::forcecast>;

struct ScanArguments {
  double t_s = 0.0;
  PoseTuple pose;  // its index counts for nothing
  std::optional<PoseTuple> end;
  double duration_s = 0.0;
  int moments = 0;
  std::array<double, 2> ranges_m{};
  double reach_m = 0.0, range_noise_m = 0.0;
  std::uint64_t seed = 0;
  std::vector<PoseTuple> poses;
  std::vector<DisturbanceTuple> disturbances;

  // All but the beams, what comes back, poses and disturbances.
  swell_lidar lidar() const {
    swell_lidar lidar{};
    lidar.size = sizeof(lidar);
    lidar.t_s = t_s;
    const auto set = [](const PoseTuple& from, double(&position)[3], double(&quaternion)[4]) {
      std::ranges::copy(std::get<1>(from), position);
      std::ranges::copy(std::get<2>(from), quaternion);
    };
    set(pose, lidar.position_m, lidar.quaternion_wxyz);
    set(end.value_or(pose), lidar.end_position_m, lidar.end_quaternion_wxyz);
    lidar.duration_s = duration_s;
    lidar.moments = moments;
    lidar.least_m = ranges_m[0];
    lidar.most_m = ranges_m[1];
    lidar.reach_m = reach_m;
    lidar.range_noise_m = range_noise_m;
    lidar.seed = seed;
    return lidar;
  }
};

// Beams [columns, beams of the model, 3].
inline py::array_t<double> spinning_beams(const char* name, int columns, double start_deg,
                                          double duration_s) {
  const std::size_t high = std::max(swell_lidar_beams(name), std::size_t{1});
  const std::size_t wide = columns > 0 && columns <= 1000000 ? std::size_t(columns) : 1;
  py::array_t<double> beams({wide, high, std::size_t{3}});
  check(swell_spinning_beams(name, columns, start_deg, duration_s, beams.mutable_data(),
                             wide * high));
  return beams;
}

// Beams [height, width, 3].
inline py::array_t<double> grid_beams(std::array<int, 2> size, std::array<double, 2> fov_deg,
                                      double duration_s) {
  const auto within = [](int n) { return n > 0 && n <= 8192 ? std::size_t(n) : 1; };
  const std::size_t wide = within(size[0]), high = within(size[1]);
  py::array_t<double> beams({high, wide, std::size_t{3}});
  check(swell_grid_beams(size[0], size[1], fov_deg[0], fov_deg[1], duration_s, beams.mutable_data(),
                         wide * high));
  return beams;
}

}  // namespace swell_python
