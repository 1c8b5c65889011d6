#include "render/sea/sea_maps.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "ocean/open_sea/sea.h"
#include "ocean/open_sea/sea_state.h"
#include "ocean/wakes/wakes.h"
#include "ocean/water_surface.h"
#include "render/world/coast_maps.h"
#include "render/world/world_state.h"

namespace swell::render {
namespace {

constexpr int kUvNoiseSize = texture::UvNoiseOptions{}.size;
constexpr double kUvNoiseCells_per_s = 0.25;
constexpr float kCoastSlopeScale = 1.5f / 127.0f;  // steeper fronts of breaking waves are clamped

void bake_coast(const WorldState& world, double t_s, SeaMaps& sea, Workers& workers) {
  constexpr std::size_t kPoints = static_cast<std::size_t>(kCoastMapSize) * kCoastMapSize;
  for (std::vector<float>* map : {&sea.coast_slope_x, &sea.coast_slope_y, &sea.coast_foam})
    map->resize(kPoints);
  const double t_wave_s = ocean::wave_time_s(world.scene.sea, t_s);
  ocean::bake_coast(world.coast_maps->waves, t_wave_s, sea.coast_slope_x, sea.coast_slope_y,
                    sea.coast_foam, workers);
}

// Nobody sees what has a two-thousandth of the slope variance of all patches.
float least_slope_variance(const ocean::SeaFrame& sea) {
  float all = 0.0f;
  for (const ocean::PatchFrame& patch : sea.patches) all += patch.slope_variance;
  return all / 2000.0f;
}

void pack_patch(const ocean::PatchFrame& patch, float least_variance, texture::PackedMap2& map) {
  // A scale fixed by the sea state, not by the frame, so that codes do not flicker.
  const float scale = 5.0f * std::sqrt(std::max(patch.slope_variance, 1e-8f)) / 127.0f;
  texture::pack_map2(patch.resolution, patch.slope_x, patch.slope_y, scale, map, least_variance);
}

// A sea that loops has whole cells of noise in its loop, two at least: one would stand still.
void pack_noise(const ocean::SeaDescription& description, double t_s, SeaMaps& sea) {
  sea.noise_cos.resize(kUvNoiseSize * kUvNoiseSize);
  sea.noise_sin.resize(kUvNoiseSize * kUvNoiseSize);
  if (const double loop_s = description.loop_s; loop_s == 0.0) {
    sea.noise.evaluate(kUvNoiseCells_per_s * t_s, sea.noise_cos, sea.noise_sin);
  } else {
    const double cells = std::max(2.0, std::nearbyint(kUvNoiseCells_per_s * loop_s));
    const double loops = ocean::wave_time_s(description, t_s) / loop_s;
    sea.noise.evaluate_looping(cells * loops, static_cast<int>(cells), sea.noise_cos,
                               sea.noise_sin);
  }
  texture::pack_map2(kUvNoiseSize, sea.noise_cos, sea.noise_sin, 1.0f / 127.0f, sea.uv_noise);
}

// The foam at the frame's time, as 2 foam - 1.
void pack_foam(const ocean::WhitecapFrame::Patch& patch, float past, std::vector<float>& values,
               texture::PackedMap1& map) {
  values.resize(patch.before.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const float before = ocean::foam_of_code(patch.before[i]);
    const float after = ocean::foam_of_code(patch.after[i]);
    values[i] = 2.0f * (before + past * (after - before)) - 1.0f;
  }
  texture::pack_map1(ocean::kFoamMapSize, values, map);
}

// The trains' whitecaps at the frame's time.
void pack_train_whitecaps(SeaMaps& sea) {
  const ocean::WhitecapFrame& frame = sea.whitecaps;
  const ocean::TrainSquare& trains = *frame.trains;
  sea.train_foam.resize(trains.part.size());
  sea.short_part.resize(trains.part.size());
  for (std::size_t i = 0; i < trains.part.size(); ++i) {
    const float before = ocean::foam_of_trains(frame.trains_before[i]);
    const float after = ocean::foam_of_trains(frame.trains_after[i]);
    const float foam = std::min(trains.part[i] * (before + frame.past * (after - before)), 1.0f);
    sea.train_foam[i] = 2.0f * foam - 1.0f;
    sea.short_part[i] = 2.0f * trains.short_part[i] - 1.0f;
  }
  texture::pack_map2(ocean::kFoamMapSize, sea.train_foam, sea.short_part, 1.0f / 127.0f,
                     sea.coast_whitecaps);
}

// Whether any of eight codes is foam that a map's byte shows: of those up to 11 it is 0.
bool shows_foam(const std::uint8_t* codes) {
  constexpr std::uint64_t kEach = 0x0101010101010101u;
  std::uint64_t code;
  std::memcpy(&code, codes, sizeof(code));
  const std::uint64_t over = (code & (0x7f * kEach)) + (0x7f - 11) * kEach;
  return ((over | code) & (0x80 * kEach)) != 0;
}

void pack_wake(const ocean::WakeWindow& window, std::vector<float>& values,
               texture::PackedMap2& slopes, texture::PackedMap1& foam) {
  texture::pack_map2(ocean::kWakeSamples, window.slope_x, window.slope_y, 0.0f, slopes);
  values.resize(window.foam.size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = 2.0f * window.foam[i] - 1.0f;
  texture::pack_map1(ocean::kWakeSamples, values, foam);
}

void leave_out_maps(const ocean::Sea& waves, ocean::SeaFrame& frame) {
  frame.patches.resize(waves.state().patches.size());
}

void leave_out_tiles(SeaMaps& sea) {
  for (ocean::PatchFrame& patch : sea.frame.patches) patch.tiling = {};
  for (ocean::WhitecapFrame::Patch& patch : sea.whitecaps.patches) patch.tiling = {};
}

}  // namespace

FoamBlocks find_foam_blocks(const ocean::WhitecapFrame::Patch& patch) {
  constexpr int kSize = ocean::kFoamMapSize, kSide = kSize / FoamBlocks::kColumns;
  static_assert(kSide == 8 && FoamBlocks::kRows * 2 == FoamBlocks::kColumns);
  constexpr int kCells = kSize / kSide;
  std::array<std::uint32_t, kCells> cells{};  // of kSide x kSide texels
  for (std::size_t j = 0; j < kSize; ++j)
    for (std::size_t i = 0; i < kCells; ++i) {
      const std::size_t at = j * kSize + i * kSide;
      const bool some = shows_foam(&patch.before[at]) || shows_foam(&patch.after[at]);
      cells[j / kSide] |= static_cast<std::uint32_t>(some) << i;
    }
  // A texel of level 2 is of those up to 3 around it, and a sample takes two: nothing further than
  // 7 away.
  FoamBlocks blocks;
  int count = 0;
  for (int j = 0; j < FoamBlocks::kRows; ++j) {
    std::uint32_t row = 0;
    for (int k = -1; k <= 2; ++k) row |= cells[static_cast<unsigned>(2 * j + k) % kCells];
    blocks.row[j] = row | std::rotl(row, 1) | std::rotr(row, 1);
    count += std::popcount(blocks.row[j]);
  }
  blocks.are_few = count <= FoamBlocks::kRows * FoamBlocks::kColumns / 2;
  return blocks;
}

void advance_waves(const WorldState& world, double t_s, std::span<const ocean::Disturbance> more,
                   PartSet without, ocean::SeaFrame& frame, Workers& workers) {
  ocean::advance(*world.sea, t_s, frame, workers, !without.has(Part::kCrests));
  frame.sheltered = !without.has(Part::kShelter);
  frame.has_fronts = !without.has(Part::kSurfFronts);
  frame.wakes.count = 0;
  if (!without.has(Part::kWakes))
    ocean::advance_wakes(world.disturbances, more, world.scene.sea.gravity_mps2, t_s, frame.wakes,
                         workers, world.shore.get());
}

void advance_sea(const WorldState& world, double t_s, std::span<const ocean::Disturbance> more,
                 PartSet without, SeaMaps& sea, const StageRun& run) {
  advance_waves(world, t_s, more, without, sea.frame, run.workers);
  if (without.has(Part::kMaps)) leave_out_maps(*world.sea, sea.frame);
  if (without.has(Part::kWater)) {  // things lie on the waves all the same
    sea.caustics.patches = 0;
    sea.caustics.throws_up = false;
    return;
  }
  const bool has_foam = !without.has(Part::kWhitecaps);
  if (has_foam) ocean::advance_whitecaps(*world.whitecaps, t_s, sea.whitecaps, run.workers);
  if (without.has(Part::kTiling)) leave_out_tiles(sea);
  const bool has_coast = world.coast != nullptr;
  if (has_coast) bake_coast(world, t_s, sea, run.workers);
  const std::size_t caustics = trace_caustics(world, sea.frame, without, sea.caustics, run);
  // Make the maps that shading looks into: the caustics, the wakes', the foam's, the waves', the
  // noise's, the coast's, the ripples'.
  const std::size_t foams = has_foam ? sea.whitecaps.patches.size() : 0;
  const std::size_t patches = sea.frame.patches.size(), noise = foams + patches;
  sea.foam.resize(foams);
  sea.foam_blocks.resize(foams);
  sea.foam_values.resize(foams);
  sea.patch_slopes.resize(patches);
  const std::size_t wakes = sea.frame.wakes.count;
  sea.wake_slopes.resize(std::max(sea.wake_slopes.size(), wakes));
  sea.wake_foam.resize(sea.wake_slopes.size());
  sea.wake_values.resize(sea.wake_slopes.size());
  const bool has_sequence = world.textures.ripple_sequence && !without.has(Part::kSequence);
  const bool has_train_foam = has_foam && sea.whitecaps.trains;
  const std::size_t ripples = noise + (has_coast ? 3 : 1) + (has_train_foam ? 1 : 0);
  run.for_each(caustics + wakes + ripples + (has_sequence ? 1 : 0), [&](std::size_t job, int) {
    if (job < caustics) return make_caustic_map(sea.caustics, job);
    if (job < caustics + wakes) {
      const std::size_t w = job - caustics;
      return pack_wake(sea.frame.wakes.windows[w], sea.wake_values[w], sea.wake_slopes[w],
                       sea.wake_foam[w]);
    }
    const std::size_t i = job - caustics - wakes;
    if (i < foams) {
      pack_foam(sea.whitecaps.patches[i], sea.whitecaps.past, sea.foam_values[i], sea.foam[i]);
      sea.foam_blocks[i] = find_foam_blocks(sea.whitecaps.patches[i]);
    } else if (i < noise)
      pack_patch(sea.frame.patches[i - foams], least_slope_variance(sea.frame),
                 sea.patch_slopes[i - foams]);
    else if (i == noise)
      pack_noise(world.scene.sea, t_s, sea);
    else if (i == ripples)
      pack_ripples(world.scene, *world.textures.ripple_sequence, t_s, sea.ripples);
    else if (has_train_foam && i == noise + 3)
      pack_train_whitecaps(sea);
    else if (i == noise + 1)
      texture::pack_map2(kCoastMapSize, sea.coast_slope_x, sea.coast_slope_y, kCoastSlopeScale,
                         sea.coast_slopes);
    else
      texture::pack_map2(kCoastMapSize, world.coast_maps->ceded, sea.coast_foam, 1.0f / 127.0f,
                         sea.coast_surf);
  });
}

ocean::WaterSurface water_surface(const WorldState& world, const SeaMaps& sea) {
  return water_surface(world, sea.frame);
}

}  // namespace swell::render
