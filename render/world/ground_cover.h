// What the ground is made of, by its height, steepness and wetness, and how much of the sky it
// sees.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "math/enum_table.h"
#include "math/parallel.h"
#include "terrain/terrain.h"
#include "texture/cover_map.h"

namespace swell::render {

// What a place is like.
struct GroundPlace {
  float height_m, steepness;  // above the sea; rise over way
  float hollow;               // in [-1, 1]: 1 in a valley, where it is wet, -1 on a ridge
  float patchiness, clumps;   // noise about 0, in [-1, 1] and a little more
};

// What the ground is made of. Maps hold the parts of those before kSoil, in [0, 1]; the rest is
// bare, soil and sand by the height. To add one: a line here, its row, and its part in cover_of().
enum class Cover : std::uint8_t { kGrass, kDry, kRock, kSoil, kSand };
inline constexpr std::size_t kCovers = kEnumerators<Cover>;
inline constexpr auto kMappedCovers = static_cast<std::size_t>(Cover::kSoil);

struct CoverTraits {
  glm::vec3 (*mean)(const terrain::GroundMaterials&);  // linear reflectance
  glm::vec3 variation;  // of each channel with the pattern's shade, as part of the mean
  float relief;         // multiplies the slopes of the ground's detail
  bool has_strata = false;
};
inline constexpr auto kCoverTraits = enum_table<Cover, CoverTraits>({
    {Cover::kGrass, {[](const auto& m) { return m.grass; }, {0.62f, 0.42f, 0.40f}, 1.5f}},
    {Cover::kDry, {[](const auto& m) { return m.dry; }, {0.36f, 0.38f, 0.45f}, 1.3f}},
    {Cover::kRock, {[](const auto& m) { return m.rock; }, {0.42f, 0.42f, 0.42f}, 2.4f, true}},
    {Cover::kSoil, {[](const auto& m) { return m.soil; }, {0.35f, 0.32f, 0.28f}, 1.0f}},
    {Cover::kSand, {[](const auto& m) { return m.sand; }, {0.09f, 0.10f, 0.12f}, 0.5f}},
});

// The mapped parts of a place; they add up to at most 1.
class GroundCover {
 public:
  float& operator[](Cover cover) { return parts_[static_cast<std::size_t>(cover)]; }
  float operator[](Cover cover) const { return parts_[static_cast<std::size_t>(cover)]; }

 private:
  std::array<float, kMappedCovers> parts_{};
};

GroundCover cover_of(const GroundPlace& place, const terrain::GroundMaterials& materials);

// Maps of these parts and, in the channel after them, of how much of the sky the ground sees.
inline constexpr std::size_t kSkySeenChannel = kMappedCovers;
using CoverMaps = std::array<texture::CoverMap, kSkySeenChannel / 4 + 1>;

// Up to this far above terrain::GroundMaterials::grass_from_m bare ground turns from sand to soil.
inline constexpr float kSandToSoil_m = 7.0f;

// What wet sand at the sea reflects of what dry sand does, and up to which height [m].
inline constexpr float kWetSand = 0.62f, kWetSandBegin_m = 0.7f, kWetSandEnd_m = 0.1f;

// Mean linear reflectance of bare ground, and of all of a place; below the sea that of its floor.
glm::vec3 bare_ground(float height_m, const terrain::GroundMaterials& materials);
glm::vec3 ground_albedo(const GroundPlace& place, const terrain::GroundMaterials& materials);

// Over a square of heights, size x size samples step_m apart: hollow() by how deep a place lies
// below the mean of its surroundings, 1/32 of the side to each hand.
LargeArray<float> find_hollows(int size, const std::vector<float>& height_m, double step_m,
                               Workers& workers);

// The part of the sky that the ground sees where the ground around rises above the plane that it
// lies in, over what that plane would see: the mean of cos^2 of the horizon's elevation in eight
// directions. At every 4th sample, blended between them; 1 on a plane. Linear in the samples; 30 ms
// for 1024 x 1024 on two threads.
LargeArray<float> find_sky_seen(int size, const std::vector<float>& height_m, double step_m,
                                Workers& workers);

}  // namespace swell::render
