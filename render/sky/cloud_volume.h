// The volumetric clouds of a world, tabulated where they stand at t = 0: their form, the light in
// them and their shadow. Wind moves all of it as one, so that nothing is made anew in a frame.
//
// Source: Vyatkin, Dolgovesov, 2019 (noise, height distribution, bounding functions, rays);
// K. Perlin, Improving Noise, 2002.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <tuple>
#include <vector>

#include "math/parallel.h"
#include "scene/clouds.h"

namespace swell::render {

// A table of bytes at the points of a lattice, side x side x levels, which repeats along x and y.
// The entry of a point holds, from the low byte up, the values at (x, y, z), (x, y, z + 1),
// (x, y + 1, z) and (x, y + 1, z + 1). A row ends with its first entry again, so that 64 bits from
// an entry on hold the eight corners of its cell.
struct CornerVolume {
  int side_log2 = 0, levels = 0;
  std::vector<std::uint32_t> entries;

  auto fields() { return std::tie(side_log2, levels, entries); }

  int side() const { return 1 << side_log2; }
};

// Packs side^2 levels bytes, x fastest.
CornerVolume pack_corners(int side_log2, int levels, const std::vector<std::uint8_t>& bytes);

// A cloud's form at a point is a number f that grows by about 1 in kEdge_m into the cloud. Small
// forms take up to `cut` from it, and what is left is the density, cut off at 1.
inline constexpr double kEdge_m = 100.0;
inline constexpr float kFormLow = -1.0f, kFormHigh = 3.0f;  // that bytes 0 and 255 stand for

struct CloudVolume {
  static constexpr int kSideLog2 = 8, kLightSideLog2 = 7, kDetailSideLog2 = 5;
  static constexpr int kCellLog2 = 1, kCell = 1 << kCellLog2;  // voxels
  static constexpr int kCellsLog2 = kSideLog2 - kCellLog2, kCells = 1 << kCellsLog2;
  static constexpr float kLightDepth = 8.0f;  // bytes of sunlight are exp(-depth / 8)

  bool repeats = true;  // a layer; else it stands alone, with nothing at its rim
  double voxel_m = 1.0;
  float level_m = 1.0f, base_m = 0.0f, top_m = 1.0f;
  glm::dvec2 corner_m{0.0};  // where voxel (0, 0) lies at t = 0
  CornerVolume form;         // of placed clouds; of a layer its sizes alone
  // Small forms in [0, 1], one period in each direction.
  CornerVolume detail;
  double detail_period_m = 800.0;
  float cut = 0.0f, extinction_per_m = 0.03f, threshold = 0.0f;
  float least_form = 0.0f;  // of which small forms may leave something
  // An entry a point of a lattice half as fine along x and y: from the low byte up the sunlight and
  // the skylight that reach it, and those of the next level. Rows are those of a CornerVolume.
  std::vector<std::uint32_t> light;
  // By cell of kCell^3 voxels: how many cells one may go along each axis before a cell with a
  // cloud; 0 in such a cell. Seven more bytes follow.
  std::vector<std::uint8_t> empty;
  int cell_levels = 1;
  // What the clouds leave of the sun under each column at the height of the base.
  std::vector<float> sunlight;
  float mean_sunlight = 1.0f;

  // A layer's form where it reaches `height` of its thickness: columns + bulge d - rise p(height),
  // d of the small forms, one of their points to a voxel, and p(h) = h (towers + (1 - towers) h)^2;
  // at most limit_per_m times the way to its base and its top. An entry of `columns` holds two
  // values of 16 bits, times column_step: at (x, y), in the low half, and (x, y + 1). So few bytes
  // that they stay in the caches, where a table of the form does not.
  std::vector<std::uint32_t> columns;
  float column_step = 1.0f, bulge = 0.0f, rise = 0.0f, towers = 0.0f, limit_per_m = 0.0f;

  auto fields() {
    return std::tie(repeats, voxel_m, level_m, base_m, top_m, corner_m, form, detail,
                    detail_period_m, cut, extinction_per_m, threshold, least_form, light, empty,
                    cell_levels, sunlight, mean_sunlight, columns, column_step, bulge, rise, towers,
                    limit_per_m);
  }

  bool is_layer() const { return !columns.empty(); }
  double side_m() const { return voxel_m * form.side(); }
};

// to_light: unit. Takes 0.2 s on two threads and 4 to 21 MB. The same bits with any workers.
CloudVolume build_cloud_volume(const scene::CloudField& field, glm::vec3 to_light,
                               Workers& workers);

// What build_cloud_volume() does row by row with vectors: light at `level` in row y of its lattice,
// and sunlight under row y.
void write_cloud_light_row(const CloudVolume& volume, glm::vec3 to_light, int level, int y,
                           std::uint16_t* row);
void write_cloud_sunlight_row(const CloudVolume& volume, glm::vec3 to_light, int y, float* row);

}  // namespace swell::render
