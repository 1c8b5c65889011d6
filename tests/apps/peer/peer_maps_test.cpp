// The one place of the peer that knows how Swell packs its maps.
#include "tools/peer/peer_maps.h"

#include <gtest/gtest.h>

#include <vector>

namespace swell::apps {
namespace {

constexpr int kSize = 8;

// Values that are whole steps of 1/127 and differ from texel to texel.
float value_a(int x, int y) { return static_cast<float>(x - 2 * y) / 127.0f; }
float value_b(int x, int y) { return static_cast<float>(3 * x + y) / 127.0f; }

texture::PackedMap2 small_map() {
  std::vector<float> a, b;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      a.push_back(value_a(x, y));
      b.push_back(value_b(x, y));
    }
  texture::PackedMap2 map;
  texture::pack_map2(kSize, a, b, 1.0f / 127.0f, map);
  return map;
}

TEST(PeerMaps, TexelsAreThoseThatWerePacked) {
  const texture::PackedMap2 map = small_map();
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const glm::vec2 found = texel(map, 0, x, y);
      EXPECT_FLOAT_EQ(found.x, value_a(x, y)) << x << " " << y;
      EXPECT_FLOAT_EQ(found.y, value_b(x, y)) << x << " " << y;
    }
}

// A sample s of the texture, as the shader decodes it, is the byte's value.
TEST(PeerMaps, TheScaleDecodesBytes) {
  const texture::PackedMap2 map = small_map();
  const render::SlopeLayer layer = render::make_layer(map, 16.0, 2.0f, {}, {});
  const glm::vec4 scale = texture_scale(layer);
  const float sample = (127.0f + 128.0f) / 255.0f;
  EXPECT_NEAR(sample * scale.x + scale.y, 2.0f, 1e-5f);
  EXPECT_FLOAT_EQ(scale.z, 4.0f * map.lost_variance.back());
}

// Swell's first texel lies under (0, 0), OpenGL's at half a texel.
TEST(PeerMaps, PlacesAreHalfATexelFurther) {
  const texture::PackedMap2 map = small_map();
  const glm::vec4 place = texture_place(render::make_layer(map, 16.0, 1.0f, {4.0, 8.0}, {}));
  EXPECT_FLOAT_EQ(place.x, 1.0f / 16.0f);
  EXPECT_FLOAT_EQ(place.y, 0.25f + 0.5f / kSize);
  EXPECT_FLOAT_EQ(place.z, 0.5f + 0.5f / kSize);
  EXPECT_FLOAT_EQ(place.w, -1.0f);
}

}  // namespace
}  // namespace swell::apps
