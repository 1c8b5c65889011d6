#include "render/world/ground_cover.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/for_each_row.h"
#include "math/large_array.h"
#include "math/smoothstep.h"

namespace swell::render {
namespace {

float clamp_to(float x, float low, float high) { return std::clamp(x, low, high); }

struct Heights {
  int size;
  const std::vector<float>& height_m;

  bool holds(int i, int j) const { return i >= 0 && j >= 0 && i < size && j < size; }
  float at(int i, int j) const { return height_m[static_cast<std::size_t>(j) * size + i]; }
  // [m a sample]
  glm::vec2 slope(int i, int j) const {
    const int i0 = std::max(i - 2, 0), i1 = std::min(i + 2, size - 1);
    const int j0 = std::max(j - 2, 0), j1 = std::min(j + 2, size - 1);
    return {(at(i1, j) - at(i0, j)) / static_cast<float>(i1 - i0),
            (at(i, j1) - at(i, j0)) / static_cast<float>(j1 - j0)};
  }
};

// cos^2 of the horizon's elevation above the plane of a slope at (i, j), in the direction (di, dj):
// the least of samples whose distances double.
float open_towards(const Heights& heights, int i, int j, glm::ivec2 direction, glm::vec2 slope,
                   float step_m) {
  const float at = heights.at(i, j);
  const float way_m = step_m * glm::length(glm::vec2(direction));
  const float rise_m = glm::dot(slope, glm::vec2(direction));
  float open = 1.0f;
  for (int n = 2; n <= heights.size / 8; n *= 2) {
    if (!heights.holds(i + n * direction.x, j + n * direction.y)) break;
    const float above =
        heights.at(i + n * direction.x, j + n * direction.y) - at - static_cast<float>(n) * rise_m;
    if (above <= 0.0f) continue;
    const float away = static_cast<float>(n) * way_m;
    open = std::min(open, away * away / (away * away + above * above));
  }
  return open;
}

float sky_seen_at(const Heights& heights, int i, int j, float step_m) {
  constexpr std::array<glm::ivec2, 8> kDirections = {
      {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
  const glm::vec2 slope = heights.slope(i, j);
  float sum = 0.0f;
  for (const glm::ivec2& direction : kDirections)
    sum += open_towards(heights, i, j, direction, slope, step_m);
  return sum / 8.0f;
}

// Means over 2 radius + 1 samples of a row, whose first and last one go on.
void blur_row(int size, int radius, const float* from, float* to) {
  const auto at = [&](int i) { return from[std::clamp(i, 0, size - 1)]; };
  double sum = 0.0;
  for (int i = -radius; i <= radius; ++i) sum += at(i);
  for (int i = 0; i < size; ++i) {
    to[i] = static_cast<float>(sum / (2 * radius + 1));
    sum += at(i + radius + 1) - at(i - radius);
  }
}

constexpr int kColumnsATask = 64;

// Means over 2 radius + 1 samples of columns [first, first + kColumnsATask), side by side: samples
// of one column alone lie in few sets of the processor's caches.
void blur_columns(int size, int radius, int first, const float* from, float* to) {
  const int count = std::min(kColumnsATask, size - first);
  const auto row = [&](int j) {
    return from + static_cast<std::size_t>(std::clamp(j, 0, size - 1)) * size + first;
  };
  std::array<double, kColumnsATask> sum{};
  for (int j = -radius; j <= radius; ++j)
    for (int i = 0; i < count; ++i) sum[i] += row(j)[i];
  for (int j = 0; j < size; ++j) {
    float* const means = to + static_cast<std::size_t>(j) * size + first;
    const float *const next = row(j + radius + 1), *const last = row(j - radius);
    for (int i = 0; i < count; ++i) {
      means[i] = static_cast<float>(sum[i] / (2 * radius + 1));
      sum[i] += next[i] - last[i];
    }
  }
}

}  // namespace

GroundCover cover_of(const GroundPlace& place, const terrain::GroundMaterials& materials) {
  const auto from_m = static_cast<float>(materials.grass_from_m);
  const auto rock_slope = static_cast<float>(materials.rock_slope);
  const float above = place.height_m - from_m + 1.4f * place.patchiness;
  const float steepness = place.steepness * (1.0f + 0.3f * place.clumps);
  const float rock = smoothstep(0.75f * rock_slope, 1.15f * rock_slope, steepness);
  // Reeds by the beach, grass behind them; less of both where it is steep.
  const float growth = smoothstep(0.0f, 1.6f, above) *
                       (1.0f - 0.5f * smoothstep(0.5f, 0.95f, steepness / rock_slope));
  const float wetness = 0.64f + 0.4f * place.hollow + 0.45f * place.patchiness +
                        0.45f * place.clumps - 0.12f * steepness / rock_slope;
  const float inland = smoothstep(0.8f, 4.5f, above + 0.8f * place.clumps);
  const float lush = inland * smoothstep(0.05f, 0.75f, wetness);
  const float grown = growth * (1.0f - rock);
  const float thin = 0.75f + 0.2f * clamp_to(place.clumps, -1.0f, 1.0f);
  GroundCover cover;
  cover[Cover::kGrass] = grown * lush;
  cover[Cover::kDry] = grown * (1.0f - lush) * thin;
  cover[Cover::kRock] = rock;
  return cover;
}

glm::vec3 bare_ground(float height_m, const terrain::GroundMaterials& materials) {
  const auto from_m = static_cast<float>(materials.grass_from_m);
  const glm::vec3 dry = glm::mix(materials.sand, materials.soil,
                                 smoothstep(from_m, from_m + kSandToSoil_m, height_m));
  return glm::mix(dry * kWetSand, dry, smoothstep(kWetSandEnd_m, kWetSandBegin_m, height_m));
}

// Wet sand passes into the floor's colours, with grey-green growth, within two metres of depth.
glm::vec3 ground_albedo(const GroundPlace& place, const terrain::GroundMaterials& materials) {
  const GroundCover cover = cover_of(place, materials);
  glm::vec3 land(0.0f);
  float bare = 1.0f;
  for (std::size_t n = 0; n < kMappedCovers; ++n) {
    const auto of = static_cast<Cover>(n);
    land += cover[of] * kCoverTraits[of].mean(materials);
    bare -= cover[of];
  }
  land += bare * bare_ground(place.height_m, materials);
  const glm::vec3 sand = materials.sand * (1.0f + 0.08f * place.patchiness);
  const glm::vec3 reef(0.16f, 0.19f, 0.13f);
  const glm::vec3 floor = glm::mix(sand, reef, 0.75f * smoothstep(0.15f, 0.5f, place.patchiness));
  return glm::mix(land, floor, smoothstep(0.1f, 2.0f, -place.height_m));
}

LargeArray<float> find_hollows(int size, const std::vector<float>& height_m, double step_m,
                               Workers& workers) {
  const int radius = std::max(size / 32, 1);
  auto along_x = make_large<float>(height_m.size()), mean = make_large<float>(height_m.size());
  for_each_row(size, workers, [&](int j) {
    const std::size_t row = static_cast<std::size_t>(j) * size;
    blur_row(size, radius, height_m.data() + row, along_x.data() + row);
  });
  workers.for_each((size + kColumnsATask - 1) / kColumnsATask, [&](std::size_t task, int) {
    blur_columns(size, radius, static_cast<int>(task) * kColumnsATask, along_x.data(), mean.data());
  });
  // A hollow a tenth as deep as its surroundings are wide is as wet as can be.
  const float per_m = 10.0f / static_cast<float>(radius * step_m);
  for_each_row(size, workers, [&](int j) {
    const std::size_t row = static_cast<std::size_t>(j) * size;
    for (std::size_t k = row; k < row + size; ++k)
      mean[k] = clamp_to((mean[k] - height_m[k]) * per_m, -1.0f, 1.0f);
  });
  return mean;
}

LargeArray<float> find_sky_seen(int size, const std::vector<float>& height_m, double step_m,
                                Workers& workers) {
  constexpr int kStride = 4;
  const Heights heights{size, height_m};
  const int coarse = std::max(size / kStride, 1) + 1;
  std::vector<float> open(static_cast<std::size_t>(coarse) * coarse);
  auto seen = make_large<float>(height_m.size());
  for_each_row(coarse, workers, [&](int j) {
    for (int i = 0; i < coarse; ++i)
      open[static_cast<std::size_t>(j) * coarse + i] =
          sky_seen_at(heights, std::min(kStride * i, size - 1), std::min(kStride * j, size - 1),
                      static_cast<float>(step_m));
  });
  for_each_row(size, workers, [&](int j) {
    const float* const row = open.data() + static_cast<std::size_t>(j / kStride) * coarse;
    const float y = static_cast<float>(j % kStride) / kStride;
    for (int i = 0; i < size; ++i) {
      const float* const at = row + i / kStride;
      const float x = static_cast<float>(i % kStride) / kStride;
      seen[static_cast<std::size_t>(j) * size + i] =
          glm::mix(glm::mix(at[0], at[1], x), glm::mix(at[coarse], at[coarse + 1], x), y);
    }
  });
  return seen;
}

}  // namespace swell::render
