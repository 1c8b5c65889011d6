// swell-bench optics: what water of two triangles adds to a frame of small, middle and large
// scenes. Source: Ma, Zhu, Gong, 2006, table 2.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/shared/json.h"
#include "apps/shared/options.h"

namespace swell::apps {

// A frame's time without the water and with it.
struct WaterCost {
  double dry_ms = 0.0, wet_ms = 0.0;

  double water_share() const { return 1.0 - dry_ms / wet_ms; }  // of the frame with the water
};

// A row of the paper's table, on a GeForce FX 5600.
struct PaperRow {
  int triangles;  // of the scene, without the water
  double dry_per_s, wet_per_s;

  WaterCost cost() const { return {1e3 / dry_per_s, 1e3 / wet_per_s}; }
};
inline constexpr std::array<PaperRow, 3> kPaperRows = {
    {{13912, 61.0, 55.0}, {27824, 46.0, 45.0}, {41736, 39.0, 39.0}}};

// A scene where nothing but the water moves, seen from where its camera begins.
struct StillScene {
  render::World world;
  View view;
  render::FrameOptions frame;
  int land_triangles = 0, object_triangles = 0;  // of what the view may show
};

// The world's scene on two triangles of water, with exactly so many of land and objects together.
// Land does not come in every number: if need be, one of the objects is left out. None if that does
// not help or there is no land.
std::optional<StillScene> make_still_scene(const render::World& world, const FrameSetup& setup,
                                           int triangles, Workers& workers);

struct OpticsRow {
  int land_triangles = 0, object_triangles = 0;
  WaterCost cost;           // medians, as what follows of frames with the water
  double shading_ms = 0.0;  // which grows with edges alone
  double lookups_ms = 0.0;  // to draw what the water looks into
};

// Draws each frame without and with the water, by turns.
OpticsRow measure_water(const StillScene& still, int frames, Workers& workers);

// One row for each of the paper's.
std::string optics_text(std::span<const OpticsRow> rows);
Json optics_json(std::span<const OpticsRow> rows);

}  // namespace swell::apps
