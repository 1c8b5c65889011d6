#include "ocean/coast/coast.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/check.h"
#include "math/elementary.h"
#include "ocean/spectrum/point_chunk.h"

namespace swell::ocean {
namespace {

// 1 inside the grid, falling to 0 over a rim that is a tenth to three tenths of its side wide: it
// waves, or trains would end in straight lines.
double inside_grid(const terrain::Grid& grid, int i, int j) {
  const auto part = [](int k, int samples) { return k / std::max(samples - 1.0, 1.0); };
  const auto rim = [](double across, double along) {
    const double width = 0.2 + 0.06 * sin(11.0 * along + 1.0) + 0.04 * sin(27.0 * along);
    return smoothstep(0.0, width, std::min(across, 1.0 - across));
  };
  const double x = part(i, grid.samples_x), y = part(j, grid.samples_y);
  return rim(x, y) * rim(y, x);
}

float share_at(const CoastSea& coast, glm::dvec2 p_world) {
  const terrain::Grid& grid = coast.trains.grid;
  const glm::dvec2 at = (p_world - grid.min_world) / grid.spacing_m;
  const glm::dvec2 last(grid.samples_x - 1, grid.samples_y - 1);
  if (!(at.x >= 0.0 && at.y >= 0.0 && at.x < last.x && at.y < last.y)) return 0.0f;
  const int i = static_cast<int>(at.x), j = static_cast<int>(at.y);
  const auto fx = static_cast<float>(at.x - i), fy = static_cast<float>(at.y - j);
  const float* s = coast.share.data() + grid.index(i, j);
  const float* upper = s + grid.samples_x;
  const float low = s[0] + fx * (s[1] - s[0]), high = upper[0] + fx * (upper[1] - upper[0]);
  return low + fy * (high - low);
}

// The largest difference between neighbouring samples of the share or its spectrum_weight(), as a
// slope in both directions together.
float share_slope_per_m(const CoastSea& coast) {
  const terrain::Grid& grid = coast.trains.grid;
  const auto difference = [&](std::size_t a, std::size_t b) {
    const float s = coast.share[a], t = coast.share[b];
    return std::max(std::abs(s - t), std::abs(spectrum_weight(s) - spectrum_weight(t)));
  };
  float by_x = 0.0f, by_y = 0.0f;
  for (int j = 0; j < grid.samples_y; ++j)
    for (int i = 0; i < grid.samples_x; ++i) {
      const std::size_t k = grid.index(i, j);
      if (i > 0) by_x = std::max(by_x, difference(k, k - 1));
      if (j > 0) by_y = std::max(by_y, difference(k, grid.index(i, j - 1)));
    }
  return std::sqrt(by_x * by_x + by_y * by_y) / static_cast<float>(grid.spacing_m);
}

}  // namespace

CoastSea make_coast_sea(const terrain::HeightGrid& floor, const WaveSystem& wind, int train_count,
                        std::uint64_t seed, PhaseMethod method, bool blend, Workers& workers) {
  return make_coast_sea(floor, wind, make_trains(wind, train_count, seed), method, blend, workers);
}

CoastSea make_coast_sea(const terrain::HeightGrid& floor, const WaveSystem& wind,
                        std::span<const WaveTrain> trains, PhaseMethod method, bool blend,
                        Workers& workers, std::span<const std::vector<float>> kept) {
  CoastSea coast;
  coast.trains = make_train_sea(floor, trains, method, workers, kept);
  const double f = wind.peak_hz > 0.0 ? wind.peak_hz : 1.0;
  const double wavelength = wind.gravity_mps2 / (2.0 * kPi * f * f);
  coast.peak_wavelength_m = static_cast<float>(wavelength);
  coast.share.resize(floor.grid.size());
  workers.for_each(static_cast<std::size_t>(floor.grid.samples_y), [&](std::size_t row, int) {
    const int j = static_cast<int>(row);
    for (int i = 0; i < floor.grid.samples_x; ++i) {
      const std::size_t k = floor.grid.index(i, j);
      const double depth = depth_of_sample(floor, k);
      const double shallow =
          blend ? 1.0 - smoothstep(kShallow * wavelength, kDeep * wavelength, depth) : 1.0;
      // A sine, so that spectrum_weight(), the cosine, is smooth as well.
      coast.share[k] = static_cast<float>(sin(0.5 * kPi * shallow * inside_grid(floor.grid, i, j)));
    }
  });
  coast.share_slope_per_m = share_slope_per_m(coast);
  return coast;
}

void sample_coast_share(const CoastSea& coast, std::span<const glm::dvec2> p_world,
                        std::span<float> share) {
  SWELL_CHECK(p_world.size() == share.size(), "{} points, {} shares", p_world.size(), share.size());
  for (std::size_t i = 0; i < p_world.size(); ++i) share[i] = share_at(coast, p_world[i]);
}

void sample_coast(const CoastSea& coast, double t_s, std::span<const glm::dvec2> p_world,
                  std::span<float> height_m, std::span<float> share) {
  SWELL_CHECK(p_world.size() == height_m.size() && p_world.size() == share.size(),
              "{} points, {} heights, {} shares", p_world.size(), height_m.size(), share.size());
  std::array<glm::dvec2, kPointChunk> near;
  std::array<std::size_t, kPointChunk> place;
  std::array<float, kPointChunk> z;
  for (std::size_t first = 0; first < p_world.size(); first += kPointChunk) {
    const std::size_t end = std::min(first + kPointChunk, p_world.size());
    std::size_t count = 0;
    for (std::size_t i = first; i < end; ++i) {
      share[i] = share_at(coast, p_world[i]);
      height_m[i] = 0.0f;
      if (share[i] == 0.0f) continue;
      near[count] = p_world[i];
      place[count++] = i;
    }
    sample_trains(coast.trains, t_s, std::span(near).first(count), std::span(z).first(count));
    for (std::size_t k = 0; k < count; ++k) height_m[place[k]] = z[k] * share[place[k]];
  }
}

}  // namespace swell::ocean
