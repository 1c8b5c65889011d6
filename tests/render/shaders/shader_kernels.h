// The shaders' parts on arrays, on the SIMD target selected now. Neighbours in an array share a
// packet, so that its lanes may take different ways.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "render/materials/list.h"
#include "render/shade/shade_tile.h"

namespace swell::render {

// ---- Water

struct GlintSurface {
  glm::vec3 sun_direction{0, 0, 1};
  glm::vec2 slope{0.0f};
  float variance = 0.01f;  // of both axes together
  float reflectance = 1.0f;
};
// Radiance of the sun's mirror image per irradiance, by direction to the eye and the area that is
// seen over the level's.
void sun_glint(const GlintSurface& surface, std::span<const glm::vec3> to_eye,
               std::span<const float> area, std::span<float> glint);

// Light that leaves open water at its mean level towards the eye: shading's Water as its shader
// shows it, without planar maps.
void water_light(const Shading& shading, std::span<const glm::vec3> to_eye,
                 std::span<glm::vec3> light);

// How facets with slopes of one variance are seen.
struct SeenFacets {
  float cosine, mirroring, reflecting, area;  // SeenCosine() and the like
};
SeenFacets seen_facets(float cosine, float variance);
// Calls UnhiddenCosine() for each cosine.
void unhidden_cosines(std::span<const float> cosine, float level_cosine, float variance_all,
                      float drawn, std::span<float> unhidden);

// TiltToEye() of unit normals seen from unit vectors to the eye: the tilted normals and cosines.
void tilted_normals(std::span<const glm::vec3> to_eye, float least_cos, std::span<glm::vec3> normal,
                    std::span<float> cosine);

void foam_cover(const SlopeLayer& lace, std::span<const glm::vec3> p_rel, float level_m,
                std::span<const float> amount, std::span<float> cover);

void swash_edge(const Swash& swash, std::span<const glm::vec3> p_rel, std::span<float> edge_m,
                std::span<float> retreat);

// ---- Levels of detail

// log2 of the footprint [m] across the view and on a surface that the eye meets at cos_view.
void footprints(const ViewRays& rays, std::span<const float> depth, std::span<const float> cos_view,
                std::span<float> across, std::span<float> level);

// Slopes along x and y, and the variance of those too fine to see.
void add_slopes(const SlopeLayer& layer, std::span<const glm::vec3> p_rel,
                std::span<const float> level_m, std::span<glm::vec3> slopes);
void add_sine(const SineLayer& sine, std::span<const glm::vec3> p_rel,
              std::span<const float> level_m, std::span<glm::vec3> slopes);

// ---- Media

// What fog leaves of light, and adds, on ways of a direction and a length; those of 1e7 m and more
// end in the sky.
void see_fog(const Fog& fog, const FogStart& start, std::span<const glm::vec3> direction,
             std::span<const float> distance_m, std::span<glm::vec3> passes,
             std::span<glm::vec3> added);

// Radiance of stars in directions of length 1.
void star_light(const Stars& stars, std::span<const glm::vec3> direction, float radius,
                std::span<glm::vec3> light);

void path_through_water(const Media& media, std::span<const float> cos_eye,
                        std::span<const float> apparent_m, std::span<float> depth_m,
                        std::span<float> length_m);
void absorb_in_water(const Media& media, std::span<const float> length_m, glm::vec3 light,
                     std::span<glm::vec3> seen);
// Straight ways under water, and ways without end that go down by w a metre.
void through_water(const Media& media, glm::vec3 daylight, std::span<const float> length_m,
                   std::span<const float> deeper_m, glm::vec3 light, std::span<glm::vec3> seen);
void endless_water(const Media& media, glm::vec3 daylight, std::span<const float> w,
                   std::span<glm::vec3> seen);
// Along straight ways through the air over a flat or round sea.
void haze(const Shading& shading, std::span<const float> distance_m, glm::vec3 to_eye,
          glm::vec3 light, std::span<glm::vec3> seen);

// Where the points that a view shows at p_shown (relative to the eye) really are, in
// a view that mirrors or squeezes; level_rel_m is the water's level over the eye.
void find_seen(ViewKind kind, const Media& media, float level_rel_m,
               std::span<const glm::vec3> p_shown, std::span<glm::vec3> p_rel);

// ---- The sky

// The sky's light at places of the window, each on its own.
void sky_light(const Shading& shading, std::span<const float> x_px, std::span<const float> y_px,
               std::span<glm::vec3> light);

// ---- The picture

void encode_srgb(std::span<const float> linear, std::span<float> code);
void to_byte(std::span<const float> linear, float exposure, std::span<const float> dither,
             std::span<int> byte);
// Bytes of planar maps, and the light that they stand for.
void light_code(std::span<const float> light, std::span<int> byte, std::span<float> decoded);
void pixel_noise(std::span<const float> x_px, std::span<const float> y_px, std::span<float> noise);

}  // namespace swell::render
