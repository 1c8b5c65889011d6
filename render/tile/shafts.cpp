#include "render/tile/shafts.h"

#include <algorithm>

#include "render/frame/parts.h"
#include "render/sea/sea_maps.h"
#include "render/tile/inputs.h"
#include "render/tile/shading.h"
#include "render/view/render_view.h"

namespace swell::render {
namespace {

// Shafts further away than twice the way on which water takes away 1 - 1/e of the light, or
// than this, are too dim and too many to be told apart.
constexpr float kUsualReach = 2.0f, kMostShaftReach_m = 40.0f;
constexpr float kDiffused = 0.5f;   // of the light that is lost
constexpr float kBlurred_m = 8.0f;  // rays of this reach show half of the net's contrast
constexpr float kMostNodeAngle = 0.016f;
constexpr float kLeastDepth_m = 0.3f;  // of an eye in a crest

float mean(glm::vec3 v) { return (v.x + v.y + v.z) * (1.0f / 3.0f); }

}  // namespace

Shafts make_shafts(const MaterialInputs& in, const RenderView& view, const ViewRays& rays,
                   glm::vec2 entry) {
  Shafts shafts;
  const Media& media = in.media;
  const bool has_pattern = in.sea.caustics.patches > 0;
  if (view.kind != ViewKind::kWindow || !media.submerged || !has_pattern ||
      in.without.has(Part::kShafts))
    return shafts;
  // Shafts have the colours that are scattered: the others do not reach far.
  const glm::vec3 shown = media.scattered / std::max(mean(media.scattered), 1e-12f);
  shafts.lost_per_m = std::max(mean(shown * media.absorption_per_m), 1e-3f);
  shafts.daylight_lost_per_m = mean(shown * media.daylight_lost_per_m);
  shafts.reach_m = std::min(kUsualReach / shafts.lost_per_m, kMostShaftReach_m);
  shafts.diffused_per_m = kDiffused * shafts.lost_per_m;
  shafts.contrast = 1.0f + shafts.reach_m / kBlurred_m;
  shafts.eye_depth_m = std::max(media.eye_depth_m, kLeastDepth_m);
  shafts.to_sun = glm::normalize(glm::vec3(entry, 1.0f));
  shafts.sun_part = mean(media.body_sun) / std::max(mean(media.body), 1e-12f);
  shafts.step_log2 = ShaftNodes::kMostStep_log2;
  while (shafts.step_log2 > ShaftNodes::kLeastStep_log2 &&
         static_cast<float>(1 << shafts.step_log2) * rays.pixel_angle > kMostNodeAngle)
    --shafts.step_log2;
  return shafts;
}

}  // namespace swell::render
