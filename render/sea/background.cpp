#include "render/sea/background.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "math/check.h"

namespace swell::render {
namespace {

constexpr std::size_t kMostVertices = 2048;

}  // namespace

Background::Background(const View& view, const ocean::Sea& sea, float bound_m, float error_px)
    : forward_(view.forward),
      eye_z_(static_cast<float>(view.eye_world.z)),
      bound_m_(bound_m),
      most_detail_(static_cast<int>(sea.description().patch_lengths_m.size())) {
  SWELL_CHECK(error_px > 0.0f, "error_px={}", error_px);
  const float f_x = 0.5f * static_cast<float>(view.width_px) / view.tan_half_x;
  const float f_y = 0.5f * static_cast<float>(view.height_px) / view.tan_half_y;
  error_per_f_ = error_px / std::max(f_x, f_y);
  left_out_m_[0] = bound_m;
  for (int k = 1; k < most_detail_; ++k)
    left_out_m_[k] = static_cast<float>(sea.short_wave_bound_m(static_cast<std::size_t>(k)));
}

int Background::detail_at(glm::vec2 offset_m) const {
  // Wherever waves lift the vertex, it is at least this deep.
  const float depth_m = glm::dot(forward_, glm::vec3(offset_m, -eye_z_)) - bound_m_;
  if (!(depth_m > 0.0f)) return most_detail_;
  const float allowed_m = error_per_f_ * depth_m * depth_m / glm::length(offset_m);
  int detail = 0;
  while (detail < most_detail_ && left_out_m_[detail] > allowed_m) ++detail;
  return detail;
}

void background_heights(const Background& background, const ocean::WaterSurface& surface,
                        std::span<const glm::dvec2> p_world, std::span<const glm::vec2> offset_m,
                        std::span<float> height_m) {
  SWELL_CHECK(p_world.size() <= kMostVertices && offset_m.size() == p_world.size() &&
                  height_m.size() == p_world.size(),
              "{} vertices, {} offsets, {} heights", p_world.size(), offset_m.size(),
              height_m.size());
  std::array<std::uint8_t, kMostVertices> detail;
  for (std::size_t i = 0; i < p_world.size(); ++i)
    detail[i] = static_cast<std::uint8_t>(background.detail_at(offset_m[i]));

  // Vertices of one detail side by side.
  std::array<glm::dvec2, kMostVertices> p;
  std::array<float, kMostVertices> result;
  std::array<std::uint16_t, kMostVertices> vertex;
  for (int k = 0; k <= background.most_detail(); ++k) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < p_world.size(); ++i) {
      vertex[count] = static_cast<std::uint16_t>(i);
      p[count] = p_world[i];
      count += detail[i] == k;
    }
    const auto heights = std::span(result).first(count);
    if (k == 0)
      std::ranges::fill(heights, 0.0f);
    else
      surface.heights(std::span(p).first(count), heights, static_cast<std::size_t>(k));
    for (std::size_t i = 0; i < count; ++i) height_m[vertex[i]] = heights[i];
  }
}

}  // namespace swell::render
