// The water of rivers and lakes, as a sparse lattice of samples: what is drawn and what is asked.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "math/lattice.h"
#include "math/parallel.h"
#include "ocean/inland/inland_sample.h"
#include "ocean/inland/lake_fill.h"
#include "ocean/inland/obstacle.h"
#include "ocean/inland/river_flow.h"
#include "ocean/inland/river_network.h"
#include "terrain/height_grid.h"

namespace swell::ocean {

struct InlandBlock {
  glm::ivec2 first_cell{0};           // of the lattice
  float low_m = 0.0f, high_m = 0.0f;  // of the levels of its cells
  int wet_cells = 0;
  std::uint8_t sea = 0;                                         // any sample has a share of the sea
  std::array<std::uint8_t, kInlandBlock * kInlandBlock> wet{};  // per cell: to be drawn
};

// Read-only after it is made.
class InlandWater {
 public:
  // lakes: of the land before dig_beds(); land: after it; obstacles: which the flow parts before.
  // The same bits with any workers. Throws RiverError: more water than kMostInlandBlocks hold.
  InlandWater(const RiverNetwork& network, const LakeFill& lakes, const terrain::HeightGrid& land,
              std::span<const Obstacle> obstacles, Workers& workers);

  // Nothing where there is no river or lake: on dry land, too.
  std::optional<InlandSample> at(glm::dvec2 p) const;
  // The current that there would be at p without obstacles [m/s]: what runs against them.
  glm::vec2 undisturbed_current(glm::dvec2 p) const;
  // 1 where no river ends; 0 where the sea's waves do not come.
  float sea_share(glm::dvec2 p) const;
  float highest_m() const { return highest_m_; }

  // The lattice: cell (i, j) of block (bx, by) begins at corner + spacing_m (16 bx + i, 16 by + j).
  glm::dvec2 corner() const { return corner_; }
  // Neighbouring blocks have the same bits for the points that they share.
  glm::dvec2 point(glm::ivec2 cell) const {
    return lattice_point(corner_, spacing_m_, glm::dvec2(cell));
  }
  double spacing_m() const { return spacing_m_; }
  int blocks_x() const { return blocks_x_; }
  int blocks_y() const { return blocks_y_; }
  std::span<const std::int32_t> block_index() const { return block_index_; }  // -1: none there
  std::span<const InlandBlock> blocks() const { return blocks_; }
  std::span<const InlandSample> samples() const { return samples_; }  // block after block

 private:
  // Where the cell of a place is: its first sample, and how many cells p is from it.
  struct Place {
    std::size_t sample;
    glm::dvec2 cells;
  };
  // Returns how many.
  std::size_t find_blocks(const RiverNetwork& network, const LakeFill& fill,
                          const terrain::Grid& land, double margin_m, Workers& workers);
  void fill_samples(const RiverNetwork& network, const LakeFill& fill,
                    const terrain::HeightGrid& land, std::span<const Obstacle> obstacles,
                    Workers& workers);
  std::optional<Place> place_of(glm::dvec2 p) const;

  glm::dvec2 corner_{0.0};
  double spacing_m_ = 1.0;
  int blocks_x_ = 0, blocks_y_ = 0;
  std::vector<std::int32_t> block_index_;
  std::vector<InlandBlock> blocks_;
  std::vector<InlandSample> samples_;
  std::vector<std::vector<glm::vec2>> undisturbed_;  // of the samples of blocks with obstacles
  float highest_m_ = 0.0f;
};

inline constexpr std::size_t kMostInlandBlocks = 6000;

}  // namespace swell::ocean
