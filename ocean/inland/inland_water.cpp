#include "ocean/inland/inland_water.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "math/smoothstep.h"
#include "texture/perlin.h"

namespace swell::ocean {
namespace {

constexpr double kSamplesAcross = 4.0;  // the narrowest river
constexpr double kLeastSpacing_m = 1.0, kMostSpacing_m = 4.0;
constexpr double kEarthGravity_mps2 = 9.81;

// Foam where water runs as fast as its waves (Froude's number), and where it falls.
float whiteness(const WaterPlace& place, double speed_mps) {
  if (place.width_m == 0.0) return 0.0f;
  const double froude = speed_mps / std::sqrt(kEarthGravity_mps2 * 0.66 * place.depth_m);
  const double fast = smoothstep(0.35, 1.0, froude), steep = smoothstep(0.02, 0.08, place.fall);
  return static_cast<float>(std::max(fast, steep) * (1.0 - place.sea_share));
}

// The water at p, of rivers and of lakes that were filled.
std::optional<WaterPlace> water_at(const RiverNetwork& network, const LakeFill& fill,
                                   glm::dvec2 p) {
  const std::optional<WaterPlace> place = network.water_near(p);
  const std::optional<double> level_m = fill.level_near(p);
  if (!level_m || (place && place->outside_m < 0.0)) return place;
  WaterPlace lake;
  lake.level_m = *level_m;
  lake.outside_m = 0.0;
  lake.in_lake = true;
  lake.speed_share = 0.0;
  return lake;
}

// The lattice's spacing: half as wide where that shows an obstacle which falls between its points.
double spacing_around(std::span<const Obstacle> obstacles, double coarse_m) {
  const bool is_between = std::ranges::any_of(obstacles, [&](const Obstacle& o) {
    const double half_m = std::min(o.half_m.x, o.half_m.y);
    return half_m >= 0.25 * coarse_m && half_m < coarse_m;
  });
  return is_between ? std::max(0.5 * coarse_m, kLeastSpacing_m) : coarse_m;
}

// The mean of the flow over a cell's width, and no further than the bank: so what lies between
// samples takes its part of the water away.
glm::dvec2 mean_current(const RiverFlow& flow, const WaterPlace& place, glm::dvec2 p,
                        double spacing_m) {
  const double half_m = std::clamp(-place.outside_m, kFlowDifference_m, 0.5 * spacing_m);
  return river_current(flow, place, p, half_m);
}

// Marks the cells that are drawn: all of such a cell is near water, some of it is wet, and it is
// not the sea's.
void mark_wet_cells(const std::array<bool, kInlandSamples>& near, const InlandSample* samples,
                    InlandBlock& block) {
  block.low_m = HUGE_VALF, block.high_m = -HUGE_VALF;
  for (int j = 0; j < kInlandBlock; ++j)
    for (int i = 0; i < kInlandBlock; ++i) {
      const std::size_t n = static_cast<std::size_t>(j) * kInlandSide + i;
      const std::array<std::size_t, 4> at = {n, n + 1, n + kInlandSide, n + kInlandSide + 1};
      const bool is_near = std::ranges::all_of(at, [&](std::size_t k) { return near[k]; });
      const bool is_own =
          std::ranges::any_of(at, [&](std::size_t k) { return samples[k].sea_share < 1.0f; });
      if (!is_near || !is_own) continue;
      block.wet[static_cast<std::size_t>(j) * kInlandBlock + i] = 1;
      ++block.wet_cells;
      for (const std::size_t k : at) {
        block.low_m = std::min(block.low_m, samples[k].level_m);
        block.high_m = std::max(block.high_m, samples[k].level_m);
        block.sea |= samples[k].sea_share > 0.0f;
      }
    }
}

}  // namespace

InlandWater::InlandWater(const RiverNetwork& network, const LakeFill& fill,
                         const terrain::HeightGrid& land, std::span<const Obstacle> obstacles,
                         Workers& workers) {
  const double coarse_m =
      std::clamp(network.least_width_m() / kSamplesAcross, kLeastSpacing_m, kMostSpacing_m);
  const auto try_spacing = [&](double spacing_m) {
    spacing_m_ = spacing_m;
    const double margin_m = std::max(2.5 * land.grid.spacing_m, 2.0 * spacing_m_);
    return find_blocks(network, fill, land.grid, margin_m, workers) <= kMostInlandBlocks;
  };
  const double fine_m = spacing_around(obstacles, coarse_m);
  if (!(fine_m < coarse_m && try_spacing(fine_m)) && !try_spacing(coarse_m))
    throw RiverError(
        std::string(kRiverKey), "more rivers and lakes than fit the lattice",
        fmt::format("{} blocks of {:.0f} m", kMostInlandBlocks, spacing_m_ * kInlandBlock));
  fill_samples(network, fill, land, obstacles, workers);
  for (const InlandBlock& block : blocks_) highest_m_ = std::max(highest_m_, block.high_m);
}

void InlandWater::fill_samples(const RiverNetwork& network, const LakeFill& fill,
                               const terrain::HeightGrid& land, std::span<const Obstacle> obstacles,
                               Workers& workers) {
  const double margin_m = std::max(2.5 * land.grid.spacing_m, 2.0 * spacing_m_);
  const RiverFlow flow(network);
  std::optional<RiverFlow> parted;
  if (!obstacles.empty()) parted.emplace(network, obstacles);
  const texture::PerlinNoise noise(17);
  samples_.resize(blocks_.size() * kInlandSamples);
  undisturbed_.resize(blocks_.size());
  workers.for_each(blocks_.size(), [&](std::size_t b, int) {
    InlandBlock& block = blocks_[b];
    InlandSample* const samples = &samples_[b * kInlandSamples];
    std::array<bool, kInlandSamples> near{};
    std::vector<glm::vec2> undisturbed;
    if (parted) undisturbed.resize(kInlandSamples);
    bool is_parted = false;
    for (int j = 0; j < kInlandSide; ++j)
      for (int i = 0; i < kInlandSide; ++i) {
        const glm::dvec2 p = point(block.first_cell + glm::ivec2(i, j));
        const std::size_t n = static_cast<std::size_t>(j) * kInlandSide + i;
        InlandSample& sample = samples[n];
        const std::optional<WaterPlace> place = water_at(network, fill, p);
        if (!place) continue;
        near[n] = place->outside_m < margin_m;
        glm::dvec2 v = river_current(flow, *place, p);
        if (parted) undisturbed[n] = v;
        if (parted && parted->is_parted(p)) {
          is_parted = true;
          v = mean_current(*parted, *place, p, spacing_m_);
        }
        sample.level_m = static_cast<float>(place->level_m);
        sample.depth_m = static_cast<float>(place->level_m - terrain::height_at(land, p));
        sample.east_mps = static_cast<float>(v.x);
        sample.north_mps = static_cast<float>(v.y);
        sample.white = whiteness(*place, glm::length(v));
        sample.sea_share = static_cast<float>(place->sea_share);
        sample.phase = static_cast<float>(noise.fractal2(p.x / 9.0, p.y / 9.0, 2, 0.5));
        sample.near = 1.0f;
      }
    mark_wet_cells(near, samples, block);
    if (is_parted) undisturbed_[b] = std::move(undisturbed);
  });
}

// Finds the blocks of the lattice that hold any water, or are within the margin of some.
std::size_t InlandWater::find_blocks(const RiverNetwork& network, const LakeFill& fill,
                                     const terrain::Grid& land, double margin_m, Workers& workers) {
  const glm::dvec2 low = glm::max(glm::min(network.low(), fill.low), land.min_world);
  const glm::dvec2 high =
      glm::min(glm::max(network.high(), fill.high), land.min_world + land.extent_m());
  const double block_m = spacing_m_ * kInlandBlock;
  corner_ = low;
  blocks_x_ = std::max(1, static_cast<int>(std::ceil((high.x - low.x) / block_m)));
  blocks_y_ = std::max(1, static_cast<int>(std::ceil((high.y - low.y) / block_m)));
  block_index_.assign(static_cast<std::size_t>(blocks_x_) * blocks_y_, -1);
  std::vector<std::uint8_t> holds(block_index_.size(), 0);
  const auto columns = static_cast<std::size_t>(blocks_x_);
  workers.for_each(holds.size(), [&](std::size_t n, int) {
    const glm::dvec2 corner = corner_ + block_m * glm::dvec2(n % columns, n / columns);
    const auto near = network.water_near(corner + 0.5 * block_m);
    holds[n] =
        (near && near->outside_m < 0.75 * block_m + margin_m) || fill.touches(corner, block_m);
  });
  blocks_.clear();
  for (std::size_t n = 0; n < holds.size(); ++n) {
    if (!holds[n]) continue;
    block_index_[n] = static_cast<std::int32_t>(blocks_.size());
    InlandBlock block;
    block.first_cell = kInlandBlock * glm::ivec2(n % columns, n / columns);
    blocks_.push_back(block);
  }
  return blocks_.size();
}

std::optional<InlandWater::Place> InlandWater::place_of(glm::dvec2 p) const {
  glm::dvec2 cells = (p - corner_) / spacing_m_;
  const glm::dvec2 block = glm::floor(cells / static_cast<double>(kInlandBlock));
  if (!(block.x >= 0.0 && block.y >= 0.0 && block.x < blocks_x_ && block.y < blocks_y_))
    return std::nullopt;
  const std::int32_t n = block_index_[static_cast<std::size_t>(block.y) * blocks_x_ +
                                      static_cast<std::size_t>(block.x)];
  if (n < 0) return std::nullopt;
  cells -= static_cast<double>(kInlandBlock) * block;
  const auto i = static_cast<std::size_t>(cells.x), j = static_cast<std::size_t>(cells.y);
  if (!blocks_[static_cast<std::size_t>(n)].wet[j * kInlandBlock + i]) return std::nullopt;
  cells -= glm::dvec2(i, j);
  return Place{static_cast<std::size_t>(n) * kInlandSamples + j * kInlandSide + i, cells};
}

std::optional<InlandSample> InlandWater::at(glm::dvec2 p) const {
  const std::optional<Place> place = place_of(p);
  if (!place) return std::nullopt;
  const InlandSample* const s = &samples_[place->sample];
  const auto x = static_cast<float>(place->cells.x), y = static_cast<float>(place->cells.y);
  const auto blend = [&](float InlandSample::*value) {
    const float south = s[0].*value + x * (s[1].*value - s[0].*value);
    const float north =
        s[kInlandSide].*value + x * (s[kInlandSide + 1].*value - s[kInlandSide].*value);
    return south + y * (north - south);
  };
  return InlandSample{blend(&InlandSample::level_m),  blend(&InlandSample::depth_m),
                      blend(&InlandSample::east_mps), blend(&InlandSample::north_mps),
                      blend(&InlandSample::white),    blend(&InlandSample::sea_share),
                      blend(&InlandSample::phase),    blend(&InlandSample::near)};
}

glm::vec2 InlandWater::undisturbed_current(glm::dvec2 p) const {
  const std::optional<Place> place = place_of(p);
  if (!place) return glm::vec2(0.0f);
  const std::vector<glm::vec2>& of_block = undisturbed_[place->sample / kInlandSamples];
  if (of_block.empty()) {
    const InlandSample sample = *at(p);
    return {sample.east_mps, sample.north_mps};
  }
  const glm::vec2* const s = &of_block[place->sample % kInlandSamples];
  const glm::vec2 t(place->cells);
  return glm::mix(glm::mix(s[0], s[1], t.x), glm::mix(s[kInlandSide], s[kInlandSide + 1], t.x),
                  t.y);
}

float InlandWater::sea_share(glm::dvec2 p) const {
  const std::optional<InlandSample> sample = at(p);
  return sample ? sample->sea_share : 1.0f;
}

}  // namespace swell::ocean
