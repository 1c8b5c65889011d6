#include "render/world/water_texture.h"

#include <fmt/core.h>

#include <array>
#include <vector>

#include "render/world/world_state.h"
#include "scene/check_scene.h"
#include "scene/file/parameters.h"
#include "texture/bump_sequence.h"
#include "texture/square_frames.h"

namespace swell::render {
namespace {

texture::ColourFrames read_colours(const scene::Scene& scene) {
  try {
    return texture::read_colour_frames({scene.water.texture});
  } catch (const std::runtime_error& error) {
    throw scene::SceneError(scene::one_line(fmt::format(
        "{}: water.texture: {}", scene::place_of_key(scene, "water.texture"), error.what())));
  }
}

}  // namespace

WaterTexture build_water_texture(const scene::Scene& scene) {
  const texture::ColourFrames colours = read_colours(scene);
  const std::vector<std::uint8_t>& bytes = colours.frames.front().pixels;
  std::array<std::vector<float>, 3> channels;
  for (std::size_t n = 0; n < bytes.size(); ++n)
    channels[n % 3].push_back((static_cast<float>(bytes[n]) - 127.5f) / 127.5f);
  WaterTexture texture;
  texture.mean = colours.mean;
  pack_tint(colours.size, channels, texture.maps);
  return texture;
}

glm::vec3 mean_water_colour(const WorldState& world, bool has_sequence) {
  const Textures& textures = world.textures;
  const glm::vec3 colour = textures.water ? textures.water->mean : world.scene.water.body_colour;
  const bool is_tinted = has_sequence && textures.ripple_sequence &&
                         world.scene.ripples.lighting == scene::RippleLighting::kPaper;
  return is_tinted ? colour * textures.ripple_sequence->tint : colour;
}

}  // namespace swell::render
