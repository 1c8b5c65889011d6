#include "render/tile/caustics.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/elementary.h"
#include "math/view.h"
#include "ocean/open_sea/sea.h"
#include "render/frame/parts.h"
#include "render/packets/slope_layer.h"
#include "render/sea/sea_maps.h"
#include "render/sky/light.h"
#include "render/tile/inputs.h"
#include "render/world/near_shore_map.h"
#include "render/world/world_state.h"

namespace swell::render {

RefractionBlur make_refraction_blur(const MaterialInputs& in, const View& camera) {
  // Slope variance, both axes together, by which footprints of 2^level_m metres and twice that
  // differ: about what neighbouring pixels do.
  std::array<float, RefractionBlur::kEntries + 1> levels{};
  const auto add = [&](const SlopeLayer& layer) {
    for (std::size_t i = 0; i < levels.size(); ++i) {
      const float level_m = RefractionBlur::kFirst_m + static_cast<float>(i);
      levels[i] += lost_variance(layer, level_m + 1.0f) - lost_variance(layer, level_m);
    }
  };
  for (std::size_t i = 0; i < in.sea.patch_slopes.size(); ++i) {
    const ocean::PatchFrame& patch = in.sea.frame.patches[i];
    add(make_patch_layer(in.sea.patch_slopes[i], patch.length_m, patch.tiling, {}));
  }
  const Ripples ripples = make_ripples(in, {});
  for (int i = 0; i < ripples.count; ++i) add(ripples.layers[static_cast<std::size_t>(i)]);

  const Distortion distortion = make_distortion(in.world.scene, camera);
  const double px_per_slope =
      std::abs(kRefractedDistortion) * distortion.across * distortion.px_per_slope;
  for (float& level : levels) {
    const double px = px_per_slope * std::sqrt(0.5 * std::max(level, 0.0f));
    level = static_cast<float>(log(std::max(px, 1e-3)) * 1.4426950408889634);
  }
  RefractionBlur blur;
  for (std::size_t i = 0; i < blur.levels.size(); ++i) {
    const std::size_t entry = i % RefractionBlur::kEntries;
    blur.levels[i] = levels[entry];
    blur.levels_by_next[i] = levels[entry + 1] - levels[entry];
  }
  blur.by_sine = distortion.by_sine;
  blur.least = std::max(distortion.least, 0.01f);
  return blur;
}

Caustics make_caustics(const MaterialInputs& in, glm::dvec2 eye) {
  const CausticMaps& maps = in.sea.caustics;
  Caustics caustics;
  caustics.patches = maps.patches;
  caustics.depth_m = maps.depth_m;
  caustics.strength = static_cast<float>(in.world.scene.water.caustics);
  if (const NearShoreMap* const shore = in.world.near_shore.get();
      shore && shore->fronts && !in.without.has(Part::kSurfFronts))
    caustics.per_surf_depth = static_cast<float>(1.0 / shore->zone.depth_m);
  caustics.throws_up = maps.throws_up;
  caustics.reflected_from = -mirrored_slant(in.light.sun_direction);
  if (maps.patches > 0 && !in.without.has(Part::kCausticBend)) {
    caustics.bend_m = static_cast<float>(in.world.scene.water.caustic_distortion);
    caustics.ripples = make_ripples(in, eye);
  }
  for (std::size_t p = 0; p < maps.patches; ++p) {
    CausticPatch& patch = caustics.patch[p];
    for (std::size_t k = 0; k < CausticMaps::kDepths; ++k)
      patch.map[k] = &maps.map[p * CausticMaps::kDepths + k];
    patch.mirrored = &maps.mirrored[p];
    patch.mirrored_m = maps.height_m[p];
    const double size = patch.map[0]->size;
    const glm::dvec2 length_m = maps.length_m[p];
    patch.texels_fx8_per_m = static_cast<float>(256.0 * size / length_m.x);
    patch.y_texels_fx8_per_m = static_cast<float>(256.0 * size / length_m.y);
    // The values lie half a texel before the points of the waves.
    patch.x_eye_fx8 = static_cast<float>(256.0 * size) * fraction(eye.x / length_m.x) + 128.0f;
    patch.y_eye_fx8 = static_cast<float>(256.0 * size) * fraction(eye.y / length_m.y) + 128.0f;
    const double finest_m = std::min(length_m.x, length_m.y);
    patch.log2_texels_per_m = static_cast<float>(log(size / finest_m) * 1.4426950408889634);
  }
  return caustics;
}

}  // namespace swell::render
