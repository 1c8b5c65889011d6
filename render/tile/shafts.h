// Shafts of light under water, as shaders look for them (shafts-inl.h): the sun's part of the light
// that water scatters to the eye is brighter where waves gather it and missing in shadow.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

namespace swell::render {

struct MaterialInputs;
struct RenderView;
struct ViewRays;

struct Shafts {
  float reach_m = 0.0f;  // rays are followed so far; 0: no shafts
  // What light loses on its way to the eye, and daylight on its way down; mean of the channels.
  float lost_per_m = 0.0f, daylight_lost_per_m = 0.0f;
  float diffused_per_m = 0.0f;  // of sunlight on its way down: it comes from all sides then
  float contrast = 1.0f;        // what makes up for the net's blur over long steps
  float eye_depth_m = 0.0f;
  glm::vec3 to_sun{0.0f, 0.0f, 1.0f};  // where its light comes from under water, unit
  float sun_part = 0.0f;               // of the light that enters the water
  int step_log2 = 0;                   // pixels between nodes
};

// The shafts over a tile, at nodes every few pixels and one more along each side, row by row: how
// much more light than the mean is scattered near the eye (low 16 bits) and beyond.
struct ShaftNodes {
  static constexpr int kLeastStep_log2 = 1, kMostStep_log2 = 3;
  static constexpr int kMostAlong = (64 >> kLeastStep_log2) + 1;
  static constexpr int kPadding = 16;
  alignas(64) std::array<std::int32_t, kMostAlong * kMostAlong + kPadding> code{};
};

// Makes the shafts for the window of an eye under water; other views have none.
Shafts make_shafts(const MaterialInputs& in, const RenderView& view, const ViewRays& rays,
                   glm::vec2 entry);

}  // namespace swell::render
