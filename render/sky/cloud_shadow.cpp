#include "render/sky/cloud_shadow.h"

#include <algorithm>
#include <cmath>

#include "math/for_each_row.h"
#include "render/frame/parts.h"
#include "render/frame/profile.h"
#include "render/sky/clouds.h"
#include "render/sky/sky_maps.h"
#include "render/sky/volume_clouds.h"
#include "render/world/world_state.h"
#include "sky/sky_light.h"

namespace swell::render {
namespace {

constexpr float kShadowsFrom = 0.02f;  // sine of the light's elevation: lower, they reach too far

void pack_level(const std::vector<std::uint8_t>& bytes, std::vector<std::uint32_t>& words) {
  constexpr int n = CloudShadow::kSide, stride = CloudShadow::kStride;
  words.resize(static_cast<std::size_t>(n) * n);
  for (int y = 0; y < n; ++y) {
    const std::uint8_t* const row = bytes.data() + static_cast<std::ptrdiff_t>(y) * stride;
    const std::uint8_t* const next = row + stride;
    for (int x = 0; x < n; ++x)
      words[static_cast<std::size_t>(y) * n + x] =
          static_cast<std::uint32_t>(row[x] | row[x + 1] << 8 | next[x] << 16) |
          static_cast<std::uint32_t>(next[x + 1]) << 24;
  }
}

}  // namespace

void advance_cloud_shadow(const WorldState& world, const Clouds& deck, const VolumeClouds& volume,
                          glm::dvec3 eye, PartSet without, CloudShadow& shadow,
                          const StageRun& run) {
  const SkyMaps& sky = *world.sky;
  const CloudLight& light = sky.cloud_light;
  const bool has_deck = deck.any && light.overcast < 1.0f;
  shadow.any = (has_deck || volume.any()) && !without.has(Part::kCloudShadows) &&
               sky.to_light.z > kShadowsFrom && sky.irradiance != glm::vec3(0.0f);
  if (!shadow.any) return;
  CloudShadowRow in;
  shadow.slant = in.slant = glm::vec2(sky.to_light) / sky.to_light.z;
  shadow.mean = 1.0f;
  shadow.lit_all_m = static_cast<float>(sky::kCloudHeight_m);
  shadow.lit_from_m = 0.85f * shadow.lit_all_m;
  if (has_deck) {
    in.deck = &deck;
    in.deck_lit = light.direct_part / (1.0f - light.overcast);
    in.most = glm::mix(1.0f / in.deck_lit, 1.0f, light.overcast);
  }
  if (volume.any()) {
    in.volume = &volume;
    shadow.mean = volume.volume->mean_sunlight;
    shadow.lit_from_m = volume.volume->base_m, shadow.lit_all_m = volume.volume->top_m;
  }
  shadow.most = in.most;

  constexpr int n = CloudShadow::kSide, rows = n + 1;
  std::array<glm::dvec2, CloudShadow::kLevels> corner_m;
  for (std::size_t level = 0; level < CloudShadow::kLevels; ++level) {
    const auto texel_m = static_cast<double>(CloudShadow::kTexels_m[level]);
    const glm::dvec2 corner = glm::floor(glm::dvec2(eye) / texel_m) - 0.5 * n;
    shadow.eye[level] = glm::vec2(glm::dvec2(eye) / texel_m - corner);
    corner_m[level] = corner * texel_m - glm::dvec2(eye);
    shadow.bytes[level].resize(static_cast<std::size_t>(rows) * CloudShadow::kStride);
  }
  for_each_row(CloudShadow::kLevels * rows, run.workers, [&](int i) {
    const auto level = static_cast<std::size_t>(i / rows);
    const int y = i % rows;
    CloudShadowRow row = in;
    row.texel_m = CloudShadow::kTexels_m[level];
    row.first_m = glm::vec2(corner_m[level]) + glm::vec2(0.0f, static_cast<float>(y) * row.texel_m);
    write_cloud_shadow_row(
        row, shadow.bytes[level].data() + static_cast<std::ptrdiff_t>(y) * CloudShadow::kStride);
  });
  for (std::size_t level = 0; level < CloudShadow::kLevels; ++level)
    pack_level(shadow.bytes[level], shadow.words[level]);
}

}  // namespace swell::render
