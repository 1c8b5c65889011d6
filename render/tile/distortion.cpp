#include "render/tile/distortion.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"
#include "ocean/open_sea/sea.h"
#include "render/packets/slope_layer.h"
#include "render/sea/sea_maps.h"
#include "render/tile/inputs.h"
#include "render/tile/ripples.h"
#include "render/world/world_state.h"

namespace swell::render {
namespace {

// Slope variance, both axes together, by which footprints of 2^level_m metres and twice that
// differ: about what neighbouring pixels do.
float variance_between(const MaterialInputs& in, const Ripples& ripples, float level_m) {
  float variance = 0.0f;
  const auto add = [&](const SlopeLayer& layer) {
    variance += lost_variance(layer, level_m + 1.0f) - lost_variance(layer, level_m);
  };
  for (std::size_t i = 0; i < in.sea.patch_slopes.size(); ++i) {
    const ocean::PatchFrame& patch = in.sea.frame.patches[i];
    add(make_patch_layer(in.sea.patch_slopes[i], patch.length_m, patch.tiling, {}));
  }
  for (int i = 0; i < ripples.count; ++i) add(ripples.layers[static_cast<std::size_t>(i)]);
  return variance;
}

}  // namespace

Distortion make_distortion(const scene::Scene& scene, const View& camera) {
  Distortion distortion;
  distortion.px_per_slope = static_cast<float>(scene.water.distortion * camera.picture_height_px());
  if (scene.water.distortion_factor == scene::DistortionFactor::kPaper) {
    distortion.by_sine = 0.5f / camera.tan_half_y;
    distortion.least = 0.0f;
    distortion.across = 1.0f;
  }
  return distortion;
}

RefractionBlur make_refraction_blur(const MaterialInputs& in, const View& camera) {
  const Distortion distortion = make_distortion(in.world.scene, camera);
  const double px_per_slope =
      std::abs(kRefractedDistortion) * distortion.across * distortion.px_per_slope;
  const Ripples ripples = make_ripples(in, {});
  const auto levels_at = [&](int i) {
    const auto level_m = RefractionBlur::kFirst_m + static_cast<float>(i);
    const double px = px_per_slope * std::sqrt(0.5 * variance_between(in, ripples, level_m));
    return static_cast<float>(log(std::max(px, 1e-3)) * 1.4426950408889634);
  };
  RefractionBlur blur;
  for (int i = 0; i < RefractionBlur::kEntries; ++i)
    for (const int at : {i, i + RefractionBlur::kEntries}) {
      blur.levels[at] = levels_at(i);
      blur.levels_by_next[at] = levels_at(i + 1) - levels_at(i);
    }
  blur.by_sine = distortion.by_sine;
  blur.least = std::max(distortion.least, 0.01f);
  return blur;
}

}  // namespace swell::render
