#include "render/shadows/shadow_reach.h"

#include <algorithm>

#include "math/earth.h"
#include "render/world/land_shadow.h"

namespace swell::render {

Corners corners_of(const ShadowCaster& caster, const ObjectShadows& shadows, float highest_rel_m) {
  constexpr auto kRadius = static_cast<float>(kSunRadius_rad);
  Corners corners;
  const float near_m = caster.near_m;
  for (int i = 0; near_m > 0.0f && i < 8; ++i)
    corners.add(caster.waterline.middle_rel +
                near_m * glm::vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  if (caster.reach_m <= 0.0f) return corners;
  const Outline& o = caster.outline;
  const float highest_m = o.lowest_m + (Outline::kRows - 1) / o.rows_per_m;
  // Down to the lowest that is shaded, from the place's height and from the outline's highest one.
  const float height_m = caster.place_rel.z + highest_m * shadows.up.z +
                         std::max(o.most_depth_m, 0.0f) * shadows.sun.z - shadows.lowest_rel_m;
  // A little further for what is soft there.
  const float sine = std::max(shadows.sun.z, 1e-4f);
  const float way_m =
      std::min(caster.reach_m, std::max(height_m, 0.0f) / sine * (1.0f + 2.0f * kRadius / sine));
  // Nothing nearer to the sun than `begin` is as low as highest_rel_m.
  const float lowest_m = o.lowest_m - way_m * kRadius;
  const float begin = std::min(
      (highest_rel_m - caster.place_rel.z - lowest_m * shadows.up.z) / sine, o.most_depth_m);
  for (int i = 0; i < 16; ++i) {
    const float way = i & 8 ? way_m : o.most_depth_m - begin, soft = way * kRadius;
    const float x = i & 1 ? o.right_most_m + soft : o.left_most_m - soft;
    const float y = i & 2 ? highest_m + soft : o.lowest_m - soft;
    const float z = (i & 4 ? o.most_depth_m : o.least_depth_m) - way;
    corners.add(caster.place_rel + x * shadows.right + y * shadows.up + z * shadows.sun);
  }
  return corners;
}

float most_drop_m(const Corners& corners, float drop_per_m2) {
  float farthest_m = 0.0f;
  for (int i = 0; i < corners.count; ++i)
    farthest_m = std::max(farthest_m, glm::length(glm::vec2(corners.p[i])));
  farthest_m += 2.0f * kDeepestShadow_m;
  return farthest_m * farthest_m * drop_per_m2;
}

}  // namespace swell::render
