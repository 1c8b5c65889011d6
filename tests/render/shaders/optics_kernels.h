// The shaders' optics on arrays, on the SIMD target selected now.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "render/materials/list.h"
#include "render/shade/shade_tile.h"

namespace swell::render {

void fresnel_reflectance(std::span<const float> cos_theta, float n, std::span<float> reflectance);

// The water's slopes at p_rel (relative to the eye), the variance of those too fine to see and the
// part that foam hides, as the shader finds them with 1 or 3 packets side by side.
// water.knows_land() chooses its form.
struct SeenWater {
  glm::vec2 slope{0.0f};
  float variance = 0.0f, foam_cover = 0.0f;
  bool operator==(const SeenWater&) const = default;
};
// packets_at_once: 1 to 8.
void sample_water(const Water& water, const ViewRays& rays, int packets_at_once,
                  std::span<const glm::vec3> p_rel, std::span<SeenWater> seen);

// What LookUpDistorted() finds at a window position with these slopes of the water: codes.
struct DistortedLookUp {
  glm::vec2 at_px;
  glm::vec2 slope;    // along x and y of the world
  float to_eye_z;     // sine of the elevation at which the eye is seen
  float sign = 1.0f;  // -1: of what lies below
};
void look_up_distorted(const Water& water, const PlanarMap& map,
                       std::span<const DistortedLookUp> lookups, std::span<glm::vec3> light);

// What LookUpSoftly() finds at a window position where slopes spread it by spread_px.
struct SoftLookUp {
  glm::vec2 at_px;
  float spread_px;
};
struct FoundSoftly {
  float alpha = 0.0f;
  bool may_show = false;  // MayShow()
};
void look_up_softly(const PlanarMap& map, std::span<const SoftLookUp> lookups,
                    std::span<FoundSoftly> found);

// ProjectedGlitter() in these directions to the eye on water of one normal.
void projected_glitter(const Glitter& glitter, std::span<const glm::vec3> to_eye, glm::vec3 normal,
                       float variance, std::span<float> light);

}  // namespace swell::render
