// The stages of a frame, and what a trace tells of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "math/enum_table.h"

namespace swell::render {

// The stages of a frame, in order: rows of the profile, the bench table and the trace.
enum class Stage : std::uint8_t {
  kSea,          // advance the waves, make their maps
  kTriangulate,  // adapt the triangulations
  kDisplace,     // displace vertices, transform them
  kTrees,        // choose which trees are drawn, and place them
  kVisibility,   // clip, set up, bin, find what is visible
  kRays,         // rays to forms and to land without triangles
  kPlanarMaps,   // reflection and refraction images
  kClouds,       // rays through volumetric clouds
  kShade,        // shade and resolve every visible pixel once; labels
};
inline constexpr std::size_t kStages = kEnumerators<Stage>;
inline constexpr auto kStageNames = enum_words<Stage>({
    {Stage::kSea, "sea"},
    {Stage::kTriangulate, "triangulate"},
    {Stage::kDisplace, "displace"},
    {Stage::kTrees, "trees"},
    {Stage::kVisibility, "visibility"},
    {Stage::kRays, "rays"},
    {Stage::kPlanarMaps, "lookups"},
    {Stage::kClouds, "clouds"},
    {Stage::kShade, "shade"},
});
constexpr std::string_view stage_name(Stage stage) { return kStageNames[stage]; }

// What happened when, for --trace: one row per stage and thread.
struct TraceEvent {
  Stage stage;
  int thread;               // worker slot
  double start_us, end_us;  // since the frame's start
};

}  // namespace swell::render
