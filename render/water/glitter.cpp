#include "render/water/glitter.h"

#include <cmath>

#include "render/frame/parts.h"
#include "render/sky/light.h"
#include "render/world/land_shadow.h"
#include "render/world/sun_texture.h"
#include "render/world/world_state.h"

namespace swell::render {

Glitter make_glitter(const MaterialInputs& in) {
  Glitter glitter;
  const SunTexture* const sun_texture = in.world.textures.sun_texture.get();
  if (!sun_texture || in.without.has(Part::kSunTexture)) return glitter;
  const glm::vec3 sun = in.light.sun_direction;
  const float level = std::sqrt(sun.x * sun.x + sun.y * sun.y);
  // Any direction will do under a sun straight above.
  const glm::vec2 towards = level > 1e-6f ? glm::vec2(sun) / level : glm::vec2(0.0f, 1.0f);
  glitter.sun_texture = &sun_texture->image;
  glitter.ahead = {sun.x, sun.y, -sun.z};
  glitter.right = {towards.y, -towards.x, 0.0f};
  glitter.up = {sun.z * towards.x, sun.z * towards.y, level};
  glitter.per_slope = static_cast<float>(in.world.scene.water.glitter_distortion);
  glitter.disc_variance = static_cast<float>(0.25 * kSunRadius_rad * kSunRadius_rad);
  glitter.brightness = 1.0f / sun_texture->whole;
  return glitter;
}

}  // namespace swell::render
