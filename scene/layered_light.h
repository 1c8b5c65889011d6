// Light that air in level layers scatters once or more: for a sun that has not set, whose light
// changes much more upwards than across. The sun's own rays cross a round earth's air; and as light
// that comes across is from where the sun stands higher or lower, each order has a first power of
// that change.
//
// High up, under a sun below 10 degrees, means are too large: at 6 km by up to 9 % in red.
//
// Source: S. Chandrasekhar, Radiative Transfer, 1950, section 48 (modes of azimuth); K. Stamnes et
// al., Numerically stable algorithm for discrete-ordinate-method radiative transfer in multiple
// scattering and emitting layered media, 1988 (streams by Gauss, moments of the phase function);
// A. Dahlback, K. Stamnes, A new spherical model for computing the radiation field available for
// photolysis and heating at twilight, 1991 (level layers, a round earth for the sun's rays).
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "scene/air_paths.h"
#include "scene/light_moments.h"

namespace swell::scene {

// Directions of light: as many above eye height as below.
inline constexpr int kStreams = kDegrees, kHalf = kStreams / 2;

// What a layer between two heights does to light of a channel, by stream.
using StreamRow = std::array<float, kHalf>;
struct Layer {
  StreamRow depth;      // along the stream
  StreamRow passes;     // the part of light that does
  StreamRow near, far;  // what arrives at its one side of light from there, and from the other's
  StreamRow reach_m;    // how far off in the plane that light is from, in the mean
  StreamRow across_m;   // from one side to the other
};

// At a height, of a channel: the parts of light lost there that are scattered.
struct Scatters {
  float rayleigh = 0.0f, haze = 0.0f;
};

struct Layers {
  std::array<double, kHalf> sine, weight;  // Gauss' nodes in [0, 1]
  // K_lm at the streams, those above and then those below: by moment; and by mode, times the
  // weight.
  std::array<std::array<float, kStreams>, kMoments> of_degree{};
  std::array<std::array<std::array<float, kDegrees>, kStreams>, kModes> of_stream{};
  std::vector<std::array<Layer, 3>> layers;      // between neighbours of the rows of air_paths.h
  std::vector<std::array<Scatters, 3>> heights;  // kSourceHeights
};
Layers make_layers(const Air& air);  // once for all elevations of the sun

// In light of irradiance 1, by height.
struct LayeredLight {
  std::vector<glm::vec3> mean;   // radiance over all directions
  std::vector<glm::vec3> zonal;  // moment (2, 0) of what molecules make of it
  std::vector<glm::vec3> haze;   // moments of what haze makes of it: kHazeHeights for each
};
// sine: of the sun's elevation, > 0. The same bits on any thread; about 1 ms.
LayeredLight scatter_in_layers(const Atmosphere& atmosphere, const Layers& layers, double sine);

}  // namespace swell::scene
