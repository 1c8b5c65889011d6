// Swell's maps as OpenGL textures.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <unordered_map>
#include <utility>
#include <vector>

#include "render/packets/slope_layer.h"
#include "texture/smooth_image.h"
#include "tools/peer/gl.h"

namespace swell::apps {

// The value of both channels at texel (x, y) of a level: the one place that knows how they are
// packed.
glm::vec2 texel(const texture::PackedMap2& map, int level, int x, int y);

// What a sample between two mip levels, or of the nearest one, reads.
enum class Levels : std::uint8_t {
  kBlended,  // past the last level with detail no slopes are left, and all of the variance is lost
  kNearest,  // the values of every level
};

// A texture is RGBA with 8 bits a channel, which llvmpipe samples fastest: the two channels as
// byte + 128, then the part of the map's variance that the level has lost.
class PeerMaps {
 public:
  explicit PeerMaps(const Gl& gl) : gl_(gl) {}

  // The texture of a map; made anew where `changed`, else at its first use. It repeats.
  GLuint slopes(const render::SlopeLayer& layer, Levels levels, bool changed);
  // The texture of an image that does not change; it is clamped at its edges.
  GLuint image(const texture::RgbaImage& image);
  GLuint image(const texture::RgbMap& map);
  // The roots of the values over the image's range, 16 bits a channel; made anew each time.
  GLuint changing_image(const texture::SmoothImage& image);

 private:
  std::pair<GLuint, bool> still(const void* map);
  void upload(const render::SlopeLayer& layer, Levels levels, GLuint texture);
  void upload_level(const render::SlopeLayer& layer, Levels levels, int level);

  const Gl& gl_;
  std::unordered_map<const void*, GLuint> textures_;
  std::vector<glm::vec2> values_, finer_, rows_;  // storage
  std::vector<std::uint8_t> bytes_;
};

// Where a map's texture lies: (turns of the map per metre, coordinates under the eye, log2 of
// texels per metre). Swell's texels lie on the lattice, OpenGL's half a texel further.
glm::vec4 texture_place(const render::SlopeLayer& layer);

// What turns a sample s of the texture into slopes and variance: slopes = s.rg x + y, lost variance
// = s.b z; w is the layer's uv_noise_m.
glm::vec4 texture_scale(const render::SlopeLayer& layer);

}  // namespace swell::apps
