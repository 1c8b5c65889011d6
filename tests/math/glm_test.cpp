// The configuration of GLM that every folder inherits: plain IEEE arithmetic, defined members.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <type_traits>

namespace swell {
namespace {

#ifndef GLM_FORCE_PURE
#error "GLM must be pure: its SIMD paths use approximate reciprocals"
#endif
#ifdef GLM_FORCE_INTRINSICS
#error "GLM_FORCE_INTRINSICS would bring the SIMD paths back"
#endif
#ifdef GLM_FORCE_DEFAULT_ALIGNED_GENTYPES
#error "aligned GLM types select the SIMD paths"
#endif

static_assert(GLM_CONFIG_SIMD == GLM_DISABLE);
static_assert(GLM_CONFIG_CTOR_INIT == GLM_CTOR_INITIALIZER_LIST);
static_assert((GLM_CONFIG_CLIP_CONTROL & GLM_CLIP_CONTROL_ZO_BIT) != 0);
static_assert(sizeof(glm::vec3) == 12 && alignof(glm::vec3) == 4);
static_assert(sizeof(glm::vec4) == 16 && alignof(glm::vec4) == 4);
static_assert(sizeof(glm::dvec3) == 24 && sizeof(glm::mat4) == 64);

std::uint32_t bits(float x) { return std::bit_cast<std::uint32_t>(x); }

TEST(Glm, DefaultConstructorsSetEveryMember) {
  EXPECT_EQ(glm::vec3(), glm::vec3(0.0f));
  EXPECT_EQ(glm::vec4(), glm::vec4(0.0f));
  EXPECT_EQ(glm::mat4(), glm::mat4(1.0f));
}

// v * (1 / sqrt(v . v)), each operation rounded: what the formula gives, not what SIMD guesses.
TEST(Glm, NormalizeGivesTheBitsOfExactlyRoundedOperations) {
  for (const glm::vec3& v : {glm::vec3(1, 2, 3), glm::vec3(-0.1f, 1e3f, 7), glm::vec3(3, 4, 0)}) {
    const volatile float xx = v.x * v.x, yy = v.y * v.y, zz = v.z * v.z;
    const volatile float xy = xx + yy;
    const volatile float squared = xy + zz;
    const volatile float root = std::sqrt(static_cast<float>(squared));
    const float scale = 1.0f / root;
    const glm::vec3 n = glm::normalize(v);
    EXPECT_EQ(bits(n.x), bits(v.x * scale));
    EXPECT_EQ(bits(n.y), bits(v.y * scale));
    EXPECT_EQ(bits(n.z), bits(v.z * scale));
  }
}

TEST(Glm, NormalizeGivesItsGoldenBits) {
  const glm::vec3 n = glm::normalize(glm::vec3(1, 2, 3));
  EXPECT_EQ(bits(n.x), 0x3e88d677u) << std::hex << bits(n.x);
  EXPECT_EQ(bits(n.y), 0x3f08d677u) << std::hex << bits(n.y);
  EXPECT_EQ(bits(n.z), 0x3f4d41b2u) << std::hex << bits(n.z);
}

TEST(Glm, InverseGivesItsGoldenBits) {
  const glm::mat4 m(2, 0.5f, 0.25f, 0, -1, 3, 0.125f, 0, 0.7f, -0.3f, 1.5f, 0.1f, 4, 5, 6, 1);
  const glm::mat4 inverse = glm::inverse(m);
  std::uint32_t hash = 2166136261u;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      hash = (hash ^ bits(inverse[column][row])) * 16777619u;
      EXPECT_NEAR((m * inverse)[column][row], column == row ? 1.0f : 0.0f, 1e-5f);
    }
  }
  EXPECT_EQ(hash, 0xcc4693b4u) << std::hex << hash;
}

}  // namespace
}  // namespace swell
