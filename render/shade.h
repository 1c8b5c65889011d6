// Shading: every visible pixel once, in full SIMD packets, material by material. Everything a
// pixel needs follows from its position in the window, its depth and its material, so that no
// per-triangle data is fetched; slopes come from maps at the pixel's own place in the world.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "ocean/sea.h"
#include "raster/pass.h"
#include "scene/object_mesh.h"
#include "texture/packed_map.h"

namespace swell::render {

// Radiance in 8-bit lookup images is stored as sqrt(radiance / kLookupRange) * 255: even steps for
// the eye, and headroom over white.
inline constexpr float kLookupRange = 2.0f;

inline constexpr float kCosSunRim = 0.99998f, kCosSunCore = 0.999992f;

inline constexpr int kMaxTilePixels = 64 * 64;
// The sea's patches and two layers of ripples.
inline constexpr int kMaxSlopeLayers = static_cast<int>(ocean::kMaxPatches) + 2;
inline constexpr int kTableLevels =
    8;  // mip levels a shader tells apart; coarser ones hold nothing

// A periodic slope map laid over the sea or the land.
struct SlopeLayer {
  const texture::PackedMap2* map = nullptr;
  float inv_length = 1.0f;           // turns of the map per metre
  float u_eye = 0.0f, v_eye = 0.0f;  // map position under the eye, [0, 1)
  float log2_texels_per_m = 0.0f;
  float gain = 1.0f;        // multiplies the slopes
  float uv_noise_m = 0.0f;  // how far the coordinates are perturbed
  int levels = 1;           // levels below this hold detail
  // Slope variance that each mip level has lost, after gain; repeated for wide vectors.
  std::array<float, 2 * kTableLevels> lost_variance{};
};

// A sine wave's slopes: amplitude_slope * cos(2 pi (cycles_per_m . p_rel + cycles)).
struct SineLayer {
  float kx = 0.0f, ky = 0.0f;  // cycles per metre
  float cycles = 0.0f;         // under the eye
  float slope_x = 0.0f, slope_y = 0.0f;
  float wavelength_log2 = 0.0f;
};

// An off-screen picture that water looks into, at `scale` of the window's size.
struct LookupImage {
  const texture::RgbaImage* image = nullptr;
  float scale_x = 1.0f, scale_y = 1.0f;
};

enum class ViewKind : std::uint8_t {
  kWindow,      // as seen
  kReflection,  // mirrored in z = 0
  kRefraction,  // below z = 0 squeezed towards it
};

// A floating object in a frame. Its axes are divided by its sizes: a point p_rel has the mesh's
// coordinates (right, ahead, up) . (p_rel - bottom_rel), and a normal (x, y, z) of the mesh is
// x right + y ahead + z up in the world, but for its length.
struct ObjectInstance {
  glm::vec3 right{1, 0, 0}, ahead{0, 1, 0}, up{0, 0, 1};
  glm::vec3 bottom_rel{0.0f};
  float waterline_rel_m = 0.0f;  // height of its waterline above the eye
  glm::vec3 colour{0.0f};
};

// Which triangle of which object a primitive is.
struct ObjectPrimitive {
  const scene::ObjectTriangle* triangle = nullptr;
  const ObjectInstance* object = nullptr;
};

// Constants of a frame and view. Colours are linear RGB, positions relative to the eye.
struct ShadeContext {
  raster::Viewport viewport;
  raster::TileGrid grid;
  // Primitives below the first number are water, those from the second on objects, between them
  // lies terrain.
  std::uint32_t water_primitives = 0, first_object = raster::kNoPrimitive;
  ViewKind kind = ViewKind::kWindow;

  // p_rel = depth (ray + x_px ray_dx + y_px ray_dy), depth = near_m / z.
  glm::vec3 ray{0.0f}, ray_dx{0.0f}, ray_dy{0.0f};
  float near_m = 0.25f;
  float eye_z = 0.0f;
  float pixel_angle = 0.001f;  // size of a pixel at depth 1

  // Light.
  glm::vec3 sun_direction{0, 0, 1}, sun_irradiance{1.0f}, ambient{0.3f};
  const texture::RgbaImage* sky_sharp = nullptr;
  const texture::RgbaImage* sky_soft = nullptr;
  float inv_haze_m = 0.0f;
  float exposure = 1.0f;

  // Water.
  std::array<SlopeLayer, kMaxSlopeLayers> water_layers;  // patches, longest first, then ripples
  int water_layer_count = 0;
  int long_layer_count = 0;  // the first so many are of the sea's long waves
  SlopeLayer uv_noise;       // values in [-1, 1], not slopes
  // Near a coast: slopes of wave trains; their share, which the longest waves of the sea make room
  // for, and their foam. Not periodic: they hold where both coordinates lie in [0, 1).
  bool has_coast = false;
  SlopeLayer coast_slopes, coast_surf;
  SlopeLayer foam_pattern;     // thresholds of foam in [-1, 1], not slopes
  glm::vec3 foam_light{0.0f};  // radiance of foam
  float swash_m = 0.0f;        // height on the beach that sheets of water reach; 0: none
  float swash_cycles = 0.0f;   // time, in turns of the sheets' coming and going
  glm::vec3 swash_a{0.0f},
      swash_b{0.0f};  // their lag along the shore: cycles by x, y, under the eye
  std::array<SineLayer, ocean::kMaxSines> sines;
  int sine_count = 0;
  float base_variance = 0.001f;  // slope variance of ripples too fine for any map
  float refraction_index = 1.333f;
  glm::vec3 body{0.0f};        // radiance of deep water
  glm::vec3 crest_glow{0.0f};  // added where light shines through crests
  float inv_crest_height = 0.0f;
  glm::vec3 absorption_per_m{0.0f};
  LookupImage reflection, refraction;
  float distortion_px = 0.0f;                    // window pixels per unit of slope
  float max_distortion_px = 0.0f;                // bound of the displacement, each way
  glm::vec2 view_right{1, 0}, view_ahead{0, 1};  // of a level camera: horizontal unit vectors

  // Terrain.
  SlopeLayer terrain_slopes, terrain_detail;
  const texture::RgbaImage* terrain_albedo = nullptr;
  float albedo_texels_per_m = 0.0f, albedo_x_eye = 0.0f, albedo_y_eye = 0.0f;

  // Objects: of primitive first_object + n, in the window and the lookup images alike.
  std::span<const ObjectPrimitive> object_primitives;
  glm::vec3 sea_light{0.0f};  // mean radiance of the sea, seen from above
};

// What water in a tile can see in the lookup images.
struct TileLookups {
  bool reflection = false, refraction = false;
};

// Working memory of one thread.
struct ShadeScratch {
  alignas(64) std::array<float, kMaxTilePixels> red, green, blue;
  alignas(64) std::array<std::uint16_t, kMaxTilePixels + 64> water, terrain, objects, sky;
};

// Shades all pixels of a tile that lie in the window and writes their 8-bit sRGB values to `rgba`
// (the whole picture) and, unless empty, linear light to `linear` (RGB). `depth` and `primitive`
// are the tile's visibility buffer. Returns the number of surface (not sky) pixels shaded.
int shade_tile(const ShadeContext& context, int tile, std::span<const float> depth,
               std::span<const std::uint32_t> primitive, TileLookups lookups, ShadeScratch& scratch,
               std::span<std::uint32_t> rgba, std::span<float> linear);

// The same for a tile of open sky, without a visibility buffer.
void shade_sky_tile(const ShadeContext& context, int tile, ShadeScratch& scratch,
                    std::span<std::uint32_t> rgba, std::span<float> linear);

// Shades a tile of a reflection or refraction image: land and objects get their encoded radiance
// and alpha 255, the others 0.
void shade_lookup_tile(const ShadeContext& context, int tile, std::span<const float> depth,
                       std::span<const std::uint32_t> primitive, ShadeScratch& scratch,
                       texture::RgbaImage& image);

}  // namespace swell::render
