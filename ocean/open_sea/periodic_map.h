// A map of heights that is periodic in space and in time, made by a cellular automaton
// (ocean/open_sea/wave_automaton.h) whose last frames are blended into its first.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace swell::ocean {

inline constexpr int kMinMapSize = 16, kMaxMapSize = 512;      // samples a side, a power of two
inline constexpr int kMinMapFrames = 4, kMaxMapFrames = 1024;  // of a loop
inline constexpr std::size_t kMaxMapSamples = std::size_t{1} << 23;  // of all frames

// Heights of variance about 1 and their slopes, as whole numbers: value = code * scale. Slopes are
// dh/dx and dh/dy in heights per side of the map; they are kept apart, as codes of heights are too
// coarse to take slopes from. Sample (i, j) of frame f is [(f * size + j) * size + i]; rows go
// north.
struct PeriodicMap {
  int size = 0;         // a power of two, so that places wrap by a mask
  int frames = 0;       // in a loop
  int bits = 16;        // of a code, 8 or 16
  double travel = 1.0;  // sides of the map that its waves run in a loop
  float height_scale = 1.0f, slope_scale = 1.0f;
  std::vector<std::int16_t> height, slope_x, slope_y;
  // These are measured on what the codes say.
  double variance = 0.0, slope_variance = 0.0;  // slopes of both axes together
  double slope_variance_y = 0.0;                // of that along y
  double peak = 0.0;                            // the most |height|

  std::size_t frame_samples() const { return static_cast<std::size_t>(size) * size; }
  // Root mean square slope over that of the height, in rad per side of the map.
  double mean_wave_number() const;
};

// How the automaton is disturbed first.
enum class FirstDisturbance : std::uint8_t { kGusts, kDrops, kHeights };

struct MapRecipe {
  int size = 128, frames = 128, bits = 16;
  double courant = 0.5;     // over 0 to kMostCourant
  int steps_per_frame = 2;  // of the automaton, [1, 64]
  double blend = 0.25;      // part of the loop in which its end becomes its beginning, [0.05, 0.5]
  FirstDisturbance first = FirstDisturbance::kGusts;
  double to_rad = 0.0, spreading = 4.0, peak_waves = 4.0;  // of gusts; see Gusts
  int drops = 40;                                          // [1, 10000]
  double drop_cells = 3.0;                                 // radius, [1, 64]
  std::vector<float> heights;                              // size x size, finite
  std::uint64_t seed = 1;
};

// Throws std::invalid_argument naming the value and what is allowed. 128 frames of 128 x 128: about
// 40 ms.
PeriodicMap make_periodic_map(const MapRecipe& recipe);

// Four frames around a time, and their weights: the cubic of Catmull and Rom, which a frame's own
// time gives its own bits.
struct MapTime {
  int frame[4] = {};
  float weight[4] = {};
  float rate[4] = {};  // change of the weights, per loop
};

// `loops`, finite: time in loops of the map.
MapTime map_time(const PeriodicMap& map, double loops);

// The map as a file's bytes, and back; `name` is that of the file in messages. Format, little
// endian: "SWELLMAP", version 1, size, frames, bits (4 bytes each), travel, height scale, slope
// scale (8-byte floats), then heights, slopes along x and along y as codes, frame by frame. Nothing
// that bytes say is believed: throws std::invalid_argument "NAME: ..., allowed ...".
std::vector<std::uint8_t> encode_map(const PeriodicMap& map);
PeriodicMap decode_map(std::span<const std::uint8_t> bytes, const std::string& name);

// Reads a file of a map, at most kMaxMapSamples large. Throws as decode_map().
PeriodicMap read_map(const std::string& path);

}  // namespace swell::ocean
