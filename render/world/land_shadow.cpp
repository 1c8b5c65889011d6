#include "render/world/land_shadow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "math/check.h"
#include "math/for_each_row.h"
#include "math/large_array.h"

namespace swell::render {
namespace {

constexpr int kGroundSize = 512;
constexpr int kTexelsOfSide = 512;        // of the land's side, or its samples if they are fewer
constexpr int kMostMargin_texels = 2048;  // how far shadows reach beyond the land
constexpr double kLeastTan = 0.0035;      // lower suns shade as far as this one
constexpr float kMostCode = 65535.0f;

// Drops [m] along a texel of the lines that touch the sun's lower and upper rims.
struct SunDrop {
  float lower_m, upper_m;
};

SunDrop sun_drop(double tan_sun, double texel_m) {
  const auto turned = [&](double by) { return (tan_sun + by) / (1.0 - tan_sun * by); };
  return {static_cast<float>(texel_m * std::max(turned(-kSunRadius_rad), 0.0)),
          static_cast<float>(texel_m * turned(kSunRadius_rad))};
}

// The land's square in the directions along and across the sun's.
struct Extent {
  glm::dvec2 low{std::numeric_limits<double>::infinity()}, high{-low};
};

Extent extent_of(const terrain::Grid& grid, glm::dvec2 away, glm::dvec2 left) {
  Extent extent;
  for (const glm::ivec2& corner : {glm::ivec2(0, 0), {1, 0}, {0, 1}, {1, 1}}) {
    const glm::dvec2 p =
        grid.point(corner.x * (grid.samples_x - 1), corner.y * (grid.samples_y - 1));
    const glm::dvec2 q(glm::dot(p, away), glm::dot(p, left));
    extent.low = glm::min(extent.low, q);
    extent.high = glm::max(extent.high, q);
  }
  return extent;
}

void lay_out(const terrain::HeightGrid& land, double tan_sun, LandShadow& s) {
  const Extent extent = extent_of(land.grid, s.away, s.left());
  s.texel_m = std::max(land.grid.spacing_m, land.grid.size_m() / kTexelsOfSide);
  s.corner_world = extent.low.x * s.away + extent.low.y * s.left();
  const auto texels = [&](double m) { return static_cast<int>(std::ceil(m / s.texel_m)) + 2; };
  // As far as the land stands before the sun's lower rim.
  const double above_m = static_cast<double>(land.highest_m) - LandShadow::kLowest_m;
  const double drop = static_cast<double>(sun_drop(tan_sun, 1.0).lower_m);
  const double margin_m = std::clamp(above_m / std::max(drop, 1e-6), 0.0,
                                     static_cast<double>(kMostMargin_texels) * s.texel_m);
  const glm::dvec2 size_m = extent.high - extent.low;
  s.texels_along = texels(size_m.x + margin_m);
  s.texels_across = texels(size_m.y);
  s.step_m = (std::max(land.highest_m, 0.0f) - LandShadow::kLowest_m) / kMostCode;
}

// Goes from the sun away along a row of heights. What is within half a texel of a point does not
// shade it.
void sweep_row(std::span<const float> height_m, SunDrop drop, float step_m,
               std::span<std::uint32_t> bounds) {
  constexpr float kNothing = -1e9f;
  float dark = kNothing, lit = kNothing;
  const auto code = [&](float z_m) {
    return std::clamp((z_m - LandShadow::kLowest_m) / step_m, 0.0f, kMostCode);
  };
  for (std::size_t i = 0; i < height_m.size(); ++i) {
    dark -= drop.upper_m;
    lit -= drop.lower_m;
    bounds[i] = static_cast<std::uint32_t>(code(dark)) |
                static_cast<std::uint32_t>(std::ceil(code(lit))) << 16;
    // The sea floor shades nothing.
    if (height_m[i] <= 0.0f) continue;
    dark = std::max(dark, height_m[i]);
    lit = std::max(lit, height_m[i]);
  }
}

// Softens the far ends of rows that stop where there still is shadow.
void fade_out(LandShadow& s, Workers& workers) {
  constexpr int kFaded = 64;
  if (s.texels_along <= kMostMargin_texels) return;
  for_each_row(s.texels_across, workers, [&](int across) {
    std::uint32_t* row = s.bounds.data() + static_cast<std::size_t>(across) * s.texels_along;
    for (int i = 0; i < kFaded; ++i) {
      std::uint32_t& b = row[s.texels_along - 1 - i];
      const auto scaled = [&](std::uint32_t code) { return code * i / kFaded; };
      b = scaled(b & 0xffffu) | scaled(b >> 16) << 16;
    }
  });
}

float lit_above_m(const LandShadow& s, int along, int across) {
  const std::size_t i = static_cast<std::size_t>(across) * s.texels_along + along;
  return LandShadow::kLowest_m + s.step_m * static_cast<float>(s.bounds[i] >> 16);
}

// Sweeps all rows, and finds in which texels anything on the ground or above it is shaded.
void sweep(const terrain::HeightGrid& land, SunDrop drop, LandShadow& s, Workers& workers) {
  const int n = s.texels_along;
  resize_large(s.bounds, static_cast<std::size_t>(n) * s.texels_across);
  std::vector<glm::ivec2> shaded(s.texels_across, glm::ivec2(n, 0));  // texels of each row
  for_each_row(s.texels_across, workers, [&](int across) {
    std::vector<glm::dvec2> p(n);
    std::vector<float> height_m(n);
    for (int i = 0; i < n; ++i)
      p[i] = s.corner_world +
             s.texel_m * (static_cast<double>(i) * s.away + static_cast<double>(across) * s.left());
    terrain::sample_heights(land, p, height_m);
    const std::size_t first = static_cast<std::size_t>(across) * n;
    sweep_row(height_m, drop, s.step_m, std::span(s.bounds).subspan(first, n));
    for (int i = 0; i < n; ++i) {
      if (lit_above_m(s, i, across) <= std::max(height_m[i], LandShadow::kLowest_m)) continue;
      shaded[across] = {std::min(shaded[across].x, i), i + 1};
    }
  });
  fade_out(s, workers);
  s.begin = {n, s.texels_across};
  for (int across = 0; across < s.texels_across; ++across) {
    if (shaded[across].x >= shaded[across].y) continue;
    s.begin = glm::min(s.begin, {shaded[across].x, across});
    s.end = glm::max(s.end, {shaded[across].y, across + 1});
  }
  // A texel further each way, for what is bilinear.
  s.begin = glm::max(s.begin - 1, 0);
  s.end = glm::min(s.end + 1, {n, s.texels_across});
  if (s.begin.x >= s.end.x) s.begin = s.end = glm::ivec2(0);
}

void find_blocks(LandShadow& s, Workers& workers) {
  constexpr int kSide = 1 << LandShadow::kBlock_log2;
  s.blocks_along = (s.texels_along + kSide - 1) / kSide;
  const int blocks_across = (s.texels_across + kSide - 1) / kSide;
  s.block_lit_above_m.resize(static_cast<std::size_t>(s.blocks_along) * blocks_across);
  for_each_row(blocks_across, workers, [&](int across) {
    for (int along = 0; along < s.blocks_along; ++along) {
      float most = LandShadow::kLowest_m;
      for (int j = kSide * across; j <= std::min(kSide * (across + 1), s.texels_across - 1); ++j)
        for (int i = kSide * along; i <= std::min(kSide * (along + 1), s.texels_along - 1); ++i)
          most = std::max(most, lit_above_m(s, i, j));
      s.block_lit_above_m[static_cast<std::size_t>(across) * s.blocks_along + along] = most;
    }
  });
}

// The sun on the ground over its square.
void light_ground(const terrain::HeightGrid& land, glm::dvec3 sun, double water_index,
                  LandShadow& s, Workers& workers) {
  if (s.is_empty()) return;
  constexpr int n = kGroundSize;
  const terrain::Grid grid{land.grid.min_world, land.grid.size_m() / n, n, n};
  const glm::dvec2 slant = underwater_slant(sun, water_index);
  std::vector<float> lit(grid.size());
  const std::vector<float> none(grid.size(), 0.0f);
  for_each_row(n, workers, [&](int j) {
    std::array<glm::dvec2, n> p;
    for (int i = 0; i < n; ++i) p[i] = grid.point(i, j);
    const auto row = std::span(lit).subspan(grid.index(0, j), n);
    terrain::sample_heights(land, p, row);
    for (int i = 0; i < n; ++i) {
      const double height_m = row[i], depth_m = std::max(-height_m, 0.0);
      const double part = sun_visible_at(s, p[i] + depth_m * slant, std::max(height_m, 0.0));
      row[i] = static_cast<float>(2.0 * part - 1.0);
    }
  });
  if (std::ranges::all_of(lit, [](float x) { return x >= 0.99f; })) return;
  texture::pack_map2(n, lit, none, 1.0f / 127.0f, s.ground, 0.0f, &workers);
}

}  // namespace

glm::dvec2 underwater_slant(glm::dvec3 sun_direction, double water_index) {
  const glm::dvec2 sideways = glm::dvec2(sun_direction) / water_index;
  return sideways / std::sqrt(1.0 - glm::dot(sideways, sideways));
}

std::optional<LandShadow> cast_land_shadow(const terrain::HeightGrid& land,
                                           glm::dvec3 sun_direction, double water_index,
                                           Workers& workers) {
  SWELL_CHECK(std::abs(glm::length(sun_direction) - 1.0) < 1e-3, "sun_direction=({}, {}, {})",
              sun_direction.x, sun_direction.y, sun_direction.z);
  if (sun_direction.z <= 0.0) return std::nullopt;
  LandShadow shadow;
  const double level = glm::length(glm::dvec2(sun_direction));
  if (level > 1e-6) shadow.away = -glm::dvec2(sun_direction) / level;
  const double tan_sun = std::clamp(sun_direction.z / std::max(level, 1e-6), kLeastTan, 1e2);
  lay_out(land, tan_sun, shadow);
  sweep(land, sun_drop(tan_sun, shadow.texel_m), shadow, workers);
  find_blocks(shadow, workers);
  light_ground(land, sun_direction, water_index, shadow, workers);
  return shadow;
}

ShadowBounds shadow_bounds_at(const LandShadow& shadow, glm::dvec2 p_world) {
  const glm::dvec2 from_corner = (p_world - shadow.corner_world) / shadow.texel_m;
  const glm::dvec2 q(glm::dot(from_corner, shadow.away), glm::dot(from_corner, shadow.left()));
  const glm::dvec2 last(shadow.end - 1);
  if (!(q.x >= shadow.begin.x && q.y >= shadow.begin.y && q.x < last.x && q.y < last.y))
    return {LandShadow::kLowest_m, LandShadow::kLowest_m};
  const glm::ivec2 at(q);
  const glm::dvec2 t = q - glm::dvec2(at);
  const auto between = [&](int shift) {
    const auto code = [&](int i, int j) {
      const std::size_t index = static_cast<std::size_t>(at.y + j) * shadow.texels_along + at.x + i;
      return static_cast<double>(shadow.bounds[index] >> shift & 0xffffu);
    };
    const double low = std::lerp(code(0, 0), code(1, 0), t.x);
    const double high = std::lerp(code(0, 1), code(1, 1), t.x);
    return LandShadow::kLowest_m + shadow.step_m * static_cast<float>(std::lerp(low, high, t.y));
  };
  return {between(0), between(16)};
}

double sun_visible_at(const LandShadow& shadow, glm::dvec2 p_world, double z_m) {
  const ShadowBounds bounds = shadow_bounds_at(shadow, p_world);
  const float range_m = std::max(bounds.lit_above_m - bounds.dark_below_m, shadow.step_m);
  const float lit = (static_cast<float>(z_m) - bounds.dark_below_m) / range_m;
  return disc_part(std::clamp(lit, 0.0f, 1.0f));
}

}  // namespace swell::render
