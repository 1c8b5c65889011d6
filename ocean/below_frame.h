// The waves of patches, sines and wakes below the surface at one time: fields of samples at the
// depths of a ladder, made when points need them. Patches and wakes are carried down mode by mode
// from what they are at the surface, so that they meet it (ocean/below/surface_modes.h).
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "ocean/below/depth_ladder.h"
#include "ocean/below/motion.h"
#include "ocean/below/surface_modes.h"
#include "ocean/open_sea/sea.h"
#include "ocean/velocity.h"

namespace swell::ocean {

// Fields are made by transforms, of which each makes one or two: always the same ones together, so
// that what is asked for first changes no bit.
inline constexpr std::size_t kTransformsBelow = 4;

// The fields at a rung, as heights of frames, and the transforms that have been made.
struct RungBelow {
  std::array<SeaFrame, kMotionFields> field;
  std::array<bool, kTransformsBelow> has_patches{};
  std::array<std::array<bool, kTransformsBelow>, kMostWakeWindows> has_window{};
};

struct BelowFrame {
  // Of one time; they have to outlive it, unchanged. velocity: null if none is asked for.
  const Sea* sea = nullptr;
  const SeaFrame* surface = nullptr;
  const VelocityFrame* velocity = nullptr;
  // Storage, and what has been made so far.
  std::vector<SurfaceModes> patches, windows;
  std::vector<RungBelow> rungs;
  std::vector<float> planes;
  // Working storage of those who ask.
  std::vector<glm::dvec2> p_world;
  std::vector<WaterColumn> column;
  std::vector<float> below_m, depth_m;
};

// Begins a time: that of `surface`, filled from `sea` by advance() and advance_wakes(), and of
// `velocity`, from advance_velocity(). Costs nothing before there are points.
void begin_below(const Sea& sea, const SeaFrame& surface, const VelocityFrame* velocity,
                 BelowFrame& below);

// Makes the fields that these points need and that are not there yet.
void make_below(const PointsBelow& points, BelowFrame& below, Workers& workers);

// Adds the motion of the patches and the sines, and of the wakes, at no more than kPointChunk
// points, of which make_below() has been told. May be called from many threads at once.
void add_sea_below(const BelowFrame& below, const PointsBelow& points, std::span<Motion> motion);
void add_wakes_below(const BelowFrame& below, const PointsBelow& points, std::span<Motion> motion);

}  // namespace swell::ocean
