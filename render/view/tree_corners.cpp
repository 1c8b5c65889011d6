#include "render/view/tree_corners.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/elementary.h"
#include "ocean/open_sea/sea_state.h"
#include "render/world/forest.h"
#include "shapes/tree_shape.h"

namespace swell::render {

Sway sway_at(const ocean::SeaDescription& sea, double t_s) {
  const double blows = std::min(sea.wind_speed_mps / 20.0, 1.0);
  const SinCos from = {sin(sea.wind_from_rad), cos(sea.wind_from_rad)};
  const auto turns = [&](double per_s) {
    const double t = t_s * (sea.loop_s > 0.0 ? ocean::looping_frequency(per_s, sea.loop_s) : per_s);
    return static_cast<float>(t - std::floor(t));
  };
  return {glm::vec2(-from.sin, -from.cos) * static_cast<float>(0.035 * blows),
          {turns(0.31), turns(0.47)}};
}

std::uint32_t crown_triangles(const DrawnTree& drawn) {
  return static_cast<std::uint32_t>(std::ceil(drawn.leaves));
}

namespace {

// How a tree faces the eye and sways.
struct TreePose {
  glm::vec3 right, up;  // across the view
  glm::vec2 sway{0.0f},
      flutter{0.0f};  // of the top [m]; sine and cosine of the leaves' swing, in metres
  float crown_m, leaf_height_m;
};

TreePose pose_of(const Sway& at, const DrawnTree& drawn) {
  TreePose pose;
  pose.crown_m = drawn.height_m - drawn.crown_begin_m;
  const glm::vec3 from_eye = drawn.foot_rel + glm::vec3(0.0f, 0.0f, 0.5f * drawn.height_m);
  const float level2 = from_eye.x * from_eye.x + from_eye.y * from_eye.y;
  const float level = std::sqrt(std::max(level2, 1e-6f));
  const float distance = std::sqrt(level2 + from_eye.z * from_eye.z + 1e-6f);
  const glm::vec2 ahead = glm::vec2(from_eye) / level;
  const float rise = from_eye.z / distance, along = level / distance;
  pose.right = {ahead.y, -ahead.x, 0.0f};
  pose.up = {-rise * ahead.x, -rise * ahead.y, along};
  // From above a crown is as high in the picture as it is broad.
  const float tall = along * pose.crown_m, flat = rise * 2.0f * drawn.radius_m;
  pose.leaf_height_m = std::sqrt(tall * tall + flat * flat);
  if (drawn.sways == 0.0f) return pose;
  const float phase = static_cast<float>(drawn.looks & 0xffff) * (1.0f / 65536.0f);
  const SinCos slow = sin_cos_turns(static_cast<double>(at.turns.x + phase));
  const SinCos quick = sin_cos_turns(static_cast<double>(at.turns.y + 7.0f * phase));
  const float bends = 0.6f + 0.4f * static_cast<float>(0.6 * slow.sin + 0.4 * quick.sin);
  const float far_m = drawn.sways * drawn.height_m;
  pose.sway = at.wind * (far_m * bends);
  pose.flutter =
      glm::vec2(quick.cos, quick.sin) * (0.25f * far_m * std::sqrt(glm::dot(at.wind, at.wind)));
  return pose;
}

// Which of eight sides a tree shows of its species' shape: what is right of the trunk and ahead of
// it, from the shape to the world.
struct ShapeSide {
  glm::vec2 right, ahead;
};

ShapeSide side_of(const DrawnTree& drawn) {
  const auto sign = [&](std::uint32_t bit) { return (drawn.looks & bit) != 0 ? -1.0f : 1.0f; };
  const bool across = (drawn.looks & 4) != 0;
  return {across ? glm::vec2(0.0f, sign(1)) : glm::vec2(sign(1), 0.0f),
          across ? glm::vec2(sign(2), 0.0f) : glm::vec2(0.0f, sign(2))};
}

// The corners of a tree's triangles.
void write_crown(const shapes::TreeShape& shape, const DrawnTree& drawn, const TreePose& pose,
                 glm::vec3* p) {
  const float size = drawn.leaf_size;
  const ShapeSide side = side_of(drawn);
  const std::uint32_t count = crown_triangles(drawn);
  for (std::uint32_t n = 0; n < count; ++n) {
    const shapes::TreeLeaf& leaf = shape.leaves[n];
    const float grown = std::sqrt(std::min(drawn.leaves - static_cast<float>(n), 1.0f));
    const glm::vec3 at = shapes::leaf_middle(shape, leaf, size);
    const float flutter =
        at.z * (pose.flutter.x * leaf.flutter.x + pose.flutter.y * leaf.flutter.y) * (1.0f - size);
    const glm::vec2 from_trunk =
        (side.right * at.x + side.ahead * at.y) * drawn.radius_m + pose.sway * (at.z * at.z);
    const glm::vec3 middle = drawn.foot_rel +
                             glm::vec3(from_trunk, drawn.crown_begin_m + at.z * pose.crown_m) +
                             pose.right * flutter;
    const glm::vec3 bent = shape.is_blades ? glm::vec3(pose.sway, 0.0f) : glm::vec3(0.0f);
    for (const glm::vec2& corner : leaf.corner) {
      const glm::vec2 c = shapes::leaf_corner(shape, corner, size, grown);
      *p++ = middle + pose.right * (c.x * drawn.radius_m) + pose.up * (c.y * pose.leaf_height_m) +
             bent * (c.y * c.y);
    }
  }
}

// A strip from under the ground into the crown, narrower above.
void write_trunk(const DrawnTree& drawn, const TreePose& pose, glm::vec3* p) {
  const glm::vec3 foot = drawn.foot_rel - glm::vec3(0.0f, 0.0f, 0.1f * drawn.height_m);
  const glm::vec3 top = drawn.foot_rel + glm::vec3(pose.sway * 0.36f, 0.7f * drawn.height_m);
  const glm::vec3 wide = pose.right * (1.15f * drawn.trunk_m);
  const glm::vec3 narrow = pose.right * (0.35f * drawn.trunk_m);
  const std::array<glm::vec3, 6> corners = {foot - wide, foot + wide,  top + narrow,
                                            foot - wide, top + narrow, top - narrow};
  std::ranges::copy(corners, p);
}

}  // namespace

void write_corners(const Forest& forest, const Sway& at, const DrawnTree& drawn, glm::vec3* p) {
  const TreePose pose = pose_of(at, drawn);
  write_crown(forest.shapes[drawn.species], drawn, pose, p);
  const std::uint32_t crown = crown_triangles(drawn);
  if (drawn.triangles > crown) write_trunk(drawn, pose, p + std::size_t{3} * crown);
}

}  // namespace swell::render
