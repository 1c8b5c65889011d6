// Objects as what stands in the light of others: what the sun sees of them, and where
// their hulls meet the water.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace swell::render {

// An outline in the plane across the sun's direction, row by row. Row i lies lowest_m +
// i / rows_per_m up; what it shows reaches from left_m to right_m, whose distances towards the sun
// are left_depth_m and right_depth_m. All from the object's place, along the axes of ObjectShadows.
struct Outline {
  static constexpr int kRows = 64;
  float lowest_m = 0.0f, rows_per_m = 1.0f;
  float left_most_m = 0.0f, right_most_m = 0.0f;
  float least_depth_m = 0.0f, most_depth_m = 0.0f;
  std::array<float, kRows> left_m{}, right_m{}, left_depth_m{}, right_depth_m{};
};

// Where a hull cuts the water: a point (x, y) of the plan, relative to its middle, lies at
// (x, y) . (right, ahead) in a circle or a square of radius 1.
struct Waterline {
  glm::vec3 middle_rel{0.0f};  // relative to the eye
  glm::vec2 right{1.0f, 0.0f}, ahead{0.0f, 1.0f};
  bool is_round = true;
  float radius_m = 1.0f;     // mean
  float freeboard_m = 1.0f;  // how high the hull stands over the water
  // Foam where water and hull move against each other: its amount at the hull, in [0, 1], how far
  // it reaches, and how the water moves now, 1 being as fast as it mostly does.
  float foam = 0.0f, foam_m = 0.1f;
  glm::vec2 flow{0.0f};
};

// Nothing under more water than this is in an object's shadow.
inline constexpr float kDeepestShadow_m = 20.0f;

struct ShadowCaster {
  static constexpr float kContact_m = 3.0f;  // how far a hull tells on the water around

  glm::vec3 place_rel{0.0f};  // its origin at the waterline, relative to the eye
  float reach_m = 0.0f;       // at this distance the sun is far broader than the object; 0: no sun
  float near_m = 0.0f;        // half the side of a cube that the hull tells on
  std::uint32_t object = 0;   // its index in the scene
  std::uint32_t part = 0;     // of its mesh
  Waterline waterline;
  Outline outline;
};

// A box around a caster's outline, across the sun's direction and from the object's place: what
// each point is held against first.
struct SunBox {
  glm::vec3 place{0.0f};  // relative to the eye: right, up, towards the sun
  float reach_m = 0.0f;
  float middle_m = 0.0f, half_width_m = 0.0f;      // to the right
  float middle_up_m = 0.0f, half_height_m = 0.0f;  // upwards
  float most_depth_m = 0.0f;
  float object = 0.0f;  // its index in the scene
};

// What the sun sees of one object: how far towards the sun the nearest of its surface is, on a
// square of points across the sun's direction. From the object's middle, along the axes of
// ObjectShadows.
struct SunDepth {
  static constexpr float kNothing_m = -1e9f;

  glm::vec3 middle_rel{0.0f};  // relative to the eye
  float first_m = 0.0f;        // right and up of the first point
  float points_per_m = 1.0f;
  int side = 0;           // points
  float strength = 1.0f;  // of the shadow, in [0, 1]
  std::uint32_t object = 0;
  float size_px = 0.0f;            // how large the object looks
  std::span<const float> depth_m;  // side rows of points, upwards; kNothing_m: none
};

// Those of a frame.
struct ObjectShadows {
  // Unit: towards the sun; level, to the right of who looks towards it; up, at right angles.
  glm::vec3 sun{0.0f, 0.0f, 1.0f}, right{1.0f, 0.0f, 0.0f}, up{0.0f, -1.0f, 0.0f};
  float lowest_rel_m = 0.0f;     // nothing below this is shaded, relative to the eye
  float sea_below_rel_m = 0.0f;  // no wave of the sea is higher, relative to the eye
  std::vector<ShadowCaster> casters;
  std::vector<SunBox> boxes;  // of the casters
  std::vector<SunDepth> own;  // of those large enough to be seen shading themselves
  std::vector<float> own_depth_m;
};

// Tiles [x0, x1) x [y0, y1).
struct TileSpan {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

// A part of a view, in pixels.
struct PixelSpan {
  float x0, y0, x1, y1;
  bool meets(const PixelSpan& other) const {
    return x0 <= other.x1 && other.x0 <= x1 && y0 <= other.y1 && other.y0 <= y1;
  }
};

// By tile: the casters that may tell on what it shows.
struct TileCasters {
  std::vector<PixelSpan> pixels;      // of each caster: those that it may tell on
  std::vector<PixelSpan> sea_pixels;  // those where it may tell on the sea
  std::vector<TileSpan> tiles;        // the same
  std::vector<std::uint32_t> first;   // of each tile, and the end
  std::vector<std::uint16_t> caster;  // indices into ObjectShadows::casters

  std::span<const std::uint16_t> of_tile(int tile) const {
    if (first.empty()) return {};
    return std::span(caster).subspan(first[tile], first[tile + 1] - first[tile]);
  }
};

}  // namespace swell::render
