// What the ground is made of, by its height, steepness and wetness, and how much of the sky it
// sees.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "math/parallel.h"
#include "terrain/terrain.h"

namespace swell::render {

// What a place is like.
struct GroundPlace {
  float height_m, steepness;  // above the sea; rise over way
  float hollow;               // in [-1, 1]: 1 in a valley, where it is wet, -1 on a ridge
  float patchiness, clumps;   // noise about 0, in [-1, 1] and a little more
};

// The parts of it that are covered by growth or rock, in [0, 1]; the rest is bare.
struct GroundCover {
  float grass, dry, rock;
};

GroundCover cover_of(const GroundPlace& place, const terrain::GroundMaterials& materials);

// Up to this far above terrain::GroundMaterials::grass_from_m bare ground turns from sand to soil.
inline constexpr float kSandToSoil_m = 7.0f;

// What wet sand at the sea reflects of what dry sand does, and up to which height [m].
inline constexpr float kWetSand = 0.62f, kWetSandBegin_m = 0.7f, kWetSandEnd_m = 0.1f;

// Mean linear reflectance of bare ground, and of all of a place; below the sea that of its floor.
glm::vec3 bare_ground(float height_m, const terrain::GroundMaterials& materials);
glm::vec3 ground_albedo(const GroundPlace& place, const terrain::GroundMaterials& materials);

// Over a square of heights, size x size samples step_m apart: hollow() by how deep a place lies
// below the mean of its surroundings, 1/32 of the side to each hand.
std::vector<float> find_hollows(int size, const std::vector<float>& height_m, double step_m,
                                Workers& workers);

// The part of the sky that the ground sees where the ground around rises above the plane that it
// lies in, over what that plane would see: the mean of cos^2 of the horizon's elevation in eight
// directions. At every 4th sample, blended between them; 1 on a plane. Linear in the samples; 30 ms
// for 1024 x 1024 on two threads.
std::vector<float> find_sky_seen(int size, const std::vector<float>& height_m, double step_m,
                                 Workers& workers);

}  // namespace swell::render
