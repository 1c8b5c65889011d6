#include "tools/peer/peer_maps.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace swell::apps {
namespace {

void set_sampling(const Gl& gl, GLint minify, GLint wrap, int last_level) {
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, minify);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, last_level);
}

// Halves a periodic map, size x size. OpenGL's texels of a level lie between those of the finer
// one, Swell's on every second one, smoothed by [1 2 1] / 4. Between them [1 3 3 1] / 8 comes
// closest: open_ocean then differs by 1.6 of 255 on average, with Swell's levels interpolated at
// OpenGL's texels by 2.0, with a box [1 1] / 2 by 2.3.
void filter_down(const std::vector<glm::vec2>& from, int size, std::vector<glm::vec2>& rows,
                 std::vector<glm::vec2>& to) {
  const int half = size / 2, mask = size - 1;
  const auto blend = [](glm::vec2 a, glm::vec2 b, glm::vec2 c, glm::vec2 d) {
    return (a + d + 3.0f * (b + c)) / 8.0f;
  };
  rows.resize(static_cast<std::size_t>(size) * half);
  for (int y = 0; y < size; ++y) {
    const glm::vec2* const v = from.data() + static_cast<std::ptrdiff_t>(y) * size;
    for (int x = 0; x < half; ++x)
      rows[static_cast<std::size_t>(y) * half + x] =
          blend(v[(2 * x - 1) & mask], v[2 * x], v[2 * x + 1], v[(2 * x + 2) & mask]);
  }
  to.resize(static_cast<std::size_t>(half) * half);
  for (int y = 0; y < half; ++y) {
    const auto row = [&](int j) {
      return rows.data() + static_cast<std::ptrdiff_t>(j & mask) * half;
    };
    for (int x = 0; x < half; ++x)
      to[static_cast<std::size_t>(y) * half + x] =
          blend(row(2 * y - 1)[x], row(2 * y)[x], row(2 * y + 1)[x], row(2 * y + 2)[x]);
  }
}

std::uint8_t signed_code(float value, float scale) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value / scale, -127.0f, 127.0f)) + 128);
}

}  // namespace

glm::vec2 texel(const texture::PackedMap2& map, int level, int x, int y) {
  const int size = map.size >> level;
  const texture::PackedQuad quad =
      map.words[map.level_offset[static_cast<std::size_t>(level)] +
                static_cast<std::size_t>(y) * static_cast<std::size_t>(size) +
                static_cast<std::size_t>(x)]
          .fine;
  const auto byte = [&](int n) { return static_cast<std::int8_t>(quad >> (8 * n)); };
  return map.scale * glm::vec2(byte(0), byte(4));
}

namespace {

// The coarsest level that a sample reads.
int last_level(const texture::PackedMap2& map, Levels levels) {
  return levels == Levels::kBlended ? std::min(map.detail_levels, map.levels - 1)
                                    : map.detail_levels - 1;
}

}  // namespace

void PeerMaps::upload_level(const render::SlopeLayer& layer, Levels levels, int level) {
  const texture::PackedMap2& map = *layer.map;
  const int size = map.size >> level;
  const bool is_empty = levels == Levels::kBlended && level == map.detail_levels;
  const float lost =
      is_empty ? map.lost_variance.back() : map.lost_variance[static_cast<std::size_t>(level)];
  const float all_lost = std::max(map.lost_variance.back(), 1e-30f);
  const auto variance = static_cast<std::uint8_t>(std::lround(255.0f * lost / all_lost));
  bytes_.resize(4 * values_.size());
  for (std::size_t i = 0; i < values_.size(); ++i) {
    bytes_[4 * i] = is_empty ? 128 : signed_code(values_[i].x, map.scale);
    bytes_[4 * i + 1] = is_empty ? 128 : signed_code(values_[i].y, map.scale);
    bytes_[4 * i + 2] = variance;
  }
  gl_.TexImage2D(GL_TEXTURE_2D, level, GL_RGBA8, size, size, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 bytes_.data());
}

void PeerMaps::upload(const render::SlopeLayer& layer, Levels levels, GLuint texture) {
  const texture::PackedMap2& map = *layer.map;
  gl_.BindTexture(GL_TEXTURE_2D, texture);
  set_sampling(gl_, levels == Levels::kBlended ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR_MIPMAP_NEAREST,
               GL_REPEAT, last_level(map, levels));
  values_.resize(static_cast<std::size_t>(map.size) * map.size);
  for (int y = 0; y < map.size; ++y)
    for (int x = 0; x < map.size; ++x)
      values_[static_cast<std::size_t>(y) * map.size + x] = texel(map, 0, x, y);
  for (int level = 0; level <= last_level(map, levels); ++level) {
    if (level > 0) {
      filter_down(values_, map.size >> (level - 1), rows_, finer_);
      std::swap(values_, finer_);
    }
    upload_level(layer, levels, level);
  }
}

GLuint PeerMaps::slopes(const render::SlopeLayer& layer, Levels levels, bool changed) {
  const auto [entry, is_new] = textures_.try_emplace(layer.map, 0);
  if (is_new) gl_.GenTextures(1, &entry->second);
  if (is_new || changed) upload(layer, levels, entry->second);
  return entry->second;
}

// The texture of a map that does not change, and whether it has to be filled.
std::pair<GLuint, bool> PeerMaps::still(const void* map) {
  const auto [entry, is_new] = textures_.try_emplace(map, 0);
  if (is_new) {
    gl_.GenTextures(1, &entry->second);
    gl_.BindTexture(GL_TEXTURE_2D, entry->second);
    set_sampling(gl_, GL_LINEAR, GL_CLAMP_TO_EDGE, 0);
  }
  return {entry->second, is_new};
}

GLuint PeerMaps::image(const texture::RgbMap& map) {
  const auto [texture, is_new] = still(&map);
  if (!is_new) return texture;
  bytes_.clear();
  for (const texture::RgbWord& word : map.words)
    for (const int quad : {0, 4, 8, 12})
      bytes_.push_back(static_cast<std::uint8_t>(word.bytes[static_cast<std::size_t>(quad)] + 128));
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, map.size, map.size, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 bytes_.data());
  return texture;
}

GLuint PeerMaps::image(const texture::RgbaImage& image) {
  const auto [texture, is_new] = still(&image);
  if (!is_new) return texture;
  gl_.PixelStorei(GL_UNPACK_ROW_LENGTH, image.stride);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, image.width, image.height, 0, GL_RGBA,
                 GL_UNSIGNED_BYTE, image.texels.data());
  gl_.PixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  return texture;
}

GLuint PeerMaps::changing_image(const texture::SmoothImage& image) {
  const GLuint texture = still(&image).first;
  gl_.BindTexture(GL_TEXTURE_2D, texture);
  std::vector<std::uint16_t> codes;
  for (std::size_t i = 0; i < image.channels[0].size(); ++i)
    for (const std::vector<std::uint32_t>& words : image.channels)
      codes.push_back(static_cast<std::uint16_t>(words[i]));
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGB16, image.width, image.height, 0, GL_RGB,
                 GL_UNSIGNED_SHORT, codes.data());
  return texture;
}

glm::vec4 texture_place(const render::SlopeLayer& layer) {
  const float turns = 1.0f / (256.0f * static_cast<float>(layer.map->size));  // for 1/256 texels
  constexpr float kHalfTexel = 128.0f;
  return {layer.texels_fx8_per_m * turns, (layer.x_eye_fx8 + kHalfTexel) * turns,
          (layer.y_eye_fx8 + kHalfTexel) * turns, layer.log2_texels_per_m};
}

glm::vec4 texture_scale(const render::SlopeLayer& layer) {
  const float step = layer.map->scale * layer.gain;
  const float variance = layer.map->lost_variance.back() * layer.gain * layer.gain;
  return {255.0f * step, -128.0f * step, variance, layer.uv_noise_m};
}

}  // namespace swell::apps
