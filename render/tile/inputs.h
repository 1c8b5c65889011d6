// What materials are filled from, once a view.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "math/view.h"
#include "render/frame/parts.h"
#include "render/view/surfaces.h"

namespace swell::texture {
struct RgbaImage;
}

namespace swell::scene {
struct Scene;
}

namespace swell::render {

struct Light;
struct Media;
struct ObjectGeometry;
struct RenderView;
struct SeaMaps;
struct TreeGeometry;
struct WorldState;

// An off-screen picture that water looks into, at `scale` of the window's size.
struct PlanarMap {
  const texture::RgbaImage* image = nullptr;
  float scale_x = 1.0f, scale_y = 1.0f;
  // In which rows [begin, end) of the image lookups may find anything, begin | end << 16, of every
  // 8 columns of texels; null where nothing is known of it.
  static constexpr int kColumnsLog2 = 3;
  const std::uint32_t* shown_rows = nullptr;
};

// How the water's slopes displace what it mirrors: less where the surface is seen edge-on.
struct Distortion {
  float px_per_slope = 0.0f;
  // Multiplied by the sine of the eye's elevation times by_sine, in [least, 1].
  float by_sine = 6.0f, least = 0.1f;
  float across = 0.5f;  // to the side, over that up and down
};

// What is seen through the water is displaced by less, the other way.
inline constexpr float kRefractedDistortion = -0.5f;

Distortion make_distortion(const scene::Scene& scene, const View& camera);

// What rivers and lakes at about this level mirror.
struct RiverImage {
  PlanarMap map;
  float level_m = 0.0f;
  float share = 0.0f;  // how much of it shows
};

// What materials that have triangles of their own place them by.
struct PlaceInputs {
  const WorldState& world;
  double t_s;
  const View& view;  // the window's camera
  PartSet without;
};

struct MaterialInputs {
  const WorldState& world;
  double t_s;
  const SeaMaps& sea;
  const ObjectGeometry& objects;
  const Light& light;
  const Media& media;
  PartSet without;
  PlanarMap reflection = {}, refraction = {};     // once they are drawn
  std::span<const RiverImage> river_images = {};  // likewise
  // How far out the water's vertices show waves.
  double wave_reach_m = std::numeric_limits<double>::infinity();
  const TreeGeometry* trees = nullptr;  // none: no trees are drawn
};

}  // namespace swell::render
