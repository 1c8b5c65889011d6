// What rays see of clouds, on arrays, on the SIMD target selected now.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "render/sky/volume_clouds.h"
#include "render/tile/cloud_picture.h"

namespace swell::render {

struct RaySeen {
  float opacity, sun, sky, front, back;
  bool operator==(const RaySeen&) const = default;
};

// A cloud as dense everywhere between `begin` and `end`, lit evenly from all sides.
struct EvenCloud {
  float begin_m, end_m, density;
};
void follow_even_clouds(std::span<const EvenCloud> clouds, float step_m, float far_m,
                        float extinction_per_m, std::span<RaySeen> seen);

// Rays from the eye of `clouds`; directions of length 1.
void see_clouds(const VolumeClouds& clouds, std::span<const glm::vec3> directions, float farthest_m,
                std::span<RaySeen> seen);

// The same by CloudRayQueue. Leaves alone what rays see that do not come among clouds.
void see_clouds_queued(const VolumeClouds& clouds, std::span<const glm::vec3> directions,
                       float farthest_m, std::span<RaySeen> seen);

// LayClouds() of one node over black at distances.
void lay_even_cloud(glm::vec3 light, float opacity, float front_m, float back_m,
                    std::span<const float> distance_m, std::span<glm::vec3> laid);

// DropletPhase()
void droplet_phase(std::span<const float> cosine, float part, std::span<float> phase);

}  // namespace swell::render
