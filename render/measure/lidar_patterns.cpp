#include "render/measure/lidar_patterns.h"

#include <algorithm>
#include <array>

#include "math/check.h"
#include "math/elementary.h"

namespace swell::render {
namespace {

constexpr std::array<SpinningModel, 4> kSpinningModels = {{
    {"vlp-16", 16, -15.0, 15.0},
    {"hdl-32e", 32, -92.0 / 3.0, 32.0 / 3.0},
    {"os1-64", 64, -22.5, 22.5},
    {"os1-128", 128, -22.5, 22.5},
}};

}  // namespace

std::span<const SpinningModel> spinning_models() { return kSpinningModels; }

const SpinningModel* find_spinning_model(std::string_view name) {
  const auto found = std::ranges::find(kSpinningModels, name, &SpinningModel::name);
  return found == kSpinningModels.end() ? nullptr : &*found;
}

std::vector<LidarBeam> spinning_beams(const SpinningModel& model, const Turn& turn) {
  SWELL_CHECK(turn.columns >= 1, "columns={}", turn.columns);
  std::vector<LidarBeam> beams;
  beams.reserve(static_cast<std::size_t>(turn.columns) * static_cast<std::size_t>(model.beams));
  for (int column = 0; column < turn.columns; ++column) {
    const double part = static_cast<double>(column) / turn.columns;
    const double turned_deg = turn.clockwise ? -360.0 * part : 360.0 * part;
    for (int beam = 0; beam < model.beams; ++beam)
      beams.push_back({turn.start_azimuth_rad + radians(turned_deg),
                       radians(model.elevation_deg(beam)), part * turn.duration_s});
  }
  return beams;
}

std::vector<LidarBeam> grid_beams(const BeamGrid& grid) {
  SWELL_CHECK(grid.width >= 1 && grid.height >= 1, "{} x {} beams", grid.width, grid.height);
  std::vector<LidarBeam> beams;
  beams.reserve(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height));
  const auto offset = [](int i, int count) { return 0.5 - (i + 0.5) / count; };
  for (int row = 0; row < grid.height; ++row)
    for (int column = 0; column < grid.width; ++column)
      beams.push_back({grid.width_rad * offset(column, grid.width),
                       grid.height_rad * offset(row, grid.height),
                       grid.duration_s * row / grid.height});
  return beams;
}

}  // namespace swell::render
