// Light that air in level layers scatters once or more: for a sun that has not set, whose light
// changes much more upwards than across. Rays cross a round earth's layers, to which they lie
// flatter the lower they are, so that those near eye height turn from one stream to the next; and
// as light that comes across is from where the sun stands higher or lower, each order has a first
// power of that change.
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

#include "sky/air_paths.h"
#include "sky/light_moments.h"

namespace swell::sky {

// Directions of light: as many above eye height as below.
inline constexpr int kStreams = kDegrees, kHalf = kStreams / 2;

// What a layer between two heights does to light of a channel, by stream: these are named by their
// sines where they leave the layer.
using StreamRow = std::array<float, kHalf>;
struct Layer {
  StreamRow turned;     // the part of light that enters along the next stream
  StreamRow depth;      // along the stream
  StreamRow passes;     // the part of light that does
  StreamRow near, far;  // what arrives at its one side of light from there, and from the other's
  StreamRow reach_m;    // how far off in the plane that light is from, in the mean
  StreamRow across_m;   // from one side to the other
  // The lowest stream of a thick layer leaves it upwards where it came in, downwards.
  bool dips = false;
};

// At a height, of a channel: the parts of light lost there that are scattered.
struct Scatters {
  float rayleigh = 0.0f, haze = 0.0f;
};

struct Layers {
  std::array<double, kHalf> sine, weight;  // Gauss' nodes in [0, 1], from the highest
  // K_lm at the streams, those above and then those below: by moment; and by mode, times the
  // weight.
  std::array<std::array<float, kStreams>, kMoments> of_degree{};
  std::array<std::array<std::array<float, kDegrees>, kStreams>, kModes> of_stream{};
  // Between neighbours of the rows of air_paths.h, for light that goes down and up.
  std::vector<std::array<Layer, 3>> down, up;
  std::vector<std::array<Scatters, 3>> heights;  // kSourceHeights
};
Layers make_layers(const Air& air);  // once for all elevations of the sun

// In light of irradiance 1, by height.
struct LayeredLight {
  std::vector<glm::vec3> mean;  // radiance over all directions
  std::vector<glm::vec3>
      uneven;                   // moments (2, m) of what molecules make of it: kSourceHeights each
  std::vector<glm::vec3> haze;  // moments of what haze makes of it: kHazeHeights each
};
// sine: of the sun's elevation, > 0. The same bits on any thread; about 1 ms.
LayeredLight scatter_in_layers(const Atmosphere& atmosphere, const Layers& layers, double sine);

}  // namespace swell::sky
