#include "render/world/part_needs.h"

#include <algorithm>
#include <set>
#include <string>

#include "ocean/open_sea/periodic_map.h"
#include "ocean/open_sea/small_sea.h"
#include "scene/coast.h"
#include "terrain/bicubic.h"
#include "terrain/described_samples.h"
#include "terrain/terrain.h"
#include "terrain/trees.h"
#include "texture/image/image_io.h"
#include "texture/square_frames.h"

namespace swell::render {
namespace {

// What was measured, and a quarter more.
constexpr std::size_t operator""_MB(unsigned long long n) { return n << 20; }

std::size_t square(int side) {
  return static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
}

PartNeed need(std::string_view name, double seconds, std::size_t bytes) {
  return {name, seconds, bytes};
}

void add_textures(const scene::Scene& scene, std::vector<PartNeed>& needs) {
  needs.push_back(need("foam", 0.04, 8_MB));
  needs.push_back(need("ground", 0.04, 8_MB));
  needs.push_back(need("bump", 0.02, 8_MB));
  if (scene.ripples.kind == scene::RippleKind::kSequence) {
    const int side =
        scene.ripples.sequence.empty() ? ocean::SmallSea{}.size : texture::kMostFrameSize;
    const std::size_t texels = static_cast<std::size_t>(scene.ripples.frames) * square(side);
    needs.push_back(need("ripples", 1.0, 40 * std::min(texels, texture::kMostFrameTexels)));
  }
  if (scene.water.glitter == scene::Glitter::kProjective) needs.push_back(need("sun", 0.01, 4_MB));
  if (!scene.water.texture.empty()) {
    const int side_px =
        texture::side_at_most_px(scene.water.texture, texture::ReadLimits{}.max_side_px);
    needs.push_back(need("water texture", 0.1, 40 * square(side_px)));
  }
}

// Samples of the land that rays meet.
std::size_t ray_samples(const terrain::TerrainDescription& terrain, int side) {
  return square(terrain.bicubic ? std::min(4 * side, terrain::kMostRefined) : side);
}

void add_land(const scene::Scene& scene, std::vector<PartNeed>& needs) {
  const terrain::TerrainDescription& terrain = *scene.terrain;
  const int side = terrain::samples_at_most(terrain);
  needs.push_back(need("land", 1.5, 160_MB + 40 * square(side)));
  if (!scene.rivers.empty() || !scene.lakes.empty())
    needs.push_back(need("inland water", 0.03, 160_MB));
  if (scene.detail.terrain_method == scene::TerrainMethod::kRays)
    needs.push_back(need("land rays", 0.04, 24 * ray_samples(terrain, side)));
  needs.push_back(need("shelter", 0.1, 64_MB));
  needs.push_back(need("near shore", 0.02, 64_MB));
  needs.push_back(need("land shadow", 0.1, 64_MB));
  if (!scene.trees.empty())
    needs.push_back(need("forest", 0.7, 128_MB + 128 * terrain::kMostTrees));
}

void add_coast(const scene::Scene& scene, std::vector<PartNeed>& needs) {
  const int cells = static_cast<int>(scene::coast_cells_at_most(scene));
  const std::size_t samples = square(cells) * static_cast<std::size_t>(scene.coast.trains);
  needs.push_back(need("coast", 2e-7 * static_cast<double>(samples), 16_MB + 64 * samples));
  needs.push_back(need("coast maps", 0.05, 16_MB));
}

// Of files the largest that is allowed is counted: what they hold shows when they are read.
void add_shapes(const scene::Scene& scene, std::vector<PartNeed>& needs) {
  constexpr std::size_t kMostOfMesh = 2048_MB;
  const auto is_mesh = [](const scene::FloatingObject& object) {
    return scene::kObjectKinds[object.kind].is_of_file &&
           object.kind != scene::ObjectKind::kImplicit;
  };
  std::set<std::string> files;
  for (const scene::FloatingObject& object : scene.objects)
    if (is_mesh(object)) files.insert(object.file);
  needs.push_back(need("shape", 0.05, 16_MB + kMostOfMesh * files.size()));
}

void add_sea(const scene::Scene& scene, std::vector<PartNeed>& needs) {
  const ocean::SeaDescription& sea = scene.sea;
  constexpr std::size_t kBytesOfSample = 20;  // 12 of them while the map is made
  std::size_t bytes = 32_MB + 128 * sea.patch_lengths_m.size() * square(sea.resolution);
  bytes += kBytesOfSample * ocean::kMaxMapSamples * sea.maps.size();
  if (sea.map_set != ocean::MapSet::kNone) bytes += 128_MB;
  needs.push_back(need("sea", sea.has_maps() ? 0.2 : 0.04, bytes));
  needs.push_back(need("whitecaps", 0.02, 32_MB));
}

}  // namespace

std::vector<PartNeed> part_needs(const scene::Scene& scene) {
  std::vector<PartNeed> needs = {need("air", 0.3, 16_MB), need("sky", 0.3, 32_MB)};
  add_shapes(scene, needs);
  add_sea(scene, needs);
  add_textures(scene, needs);
  if (scene.clouds.kind != scene::CloudKind::kNone) needs.push_back(need("clouds", 0.4, 128_MB));
  if (scene.terrain) add_land(scene, needs);
  if (scene.terrain && scene::has_trains(scene.coast.model)) add_coast(scene, needs);
  const auto drifters =
      static_cast<std::size_t>(std::ranges::count_if(scene.objects, &scene::FloatingObject::drift));
  if (drifters > 0) needs.push_back(need("drift", 0.2, 16_MB + 4_MB * drifters));
  return needs;
}

}  // namespace swell::render
