// Volumetric clouds of a scene: a layer to the horizon, or cumulus clouds that stand where the
// scene places them.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace swell::scene {

enum class CloudKind : std::uint8_t {
  kNone,
  kLayer,   // to the horizon; it repeats after kCloudPeriods size_m
  kPlaced,  // bounded by functions (CloudField::cumulus)
};

// How the light of the sun is found in a cloud.
enum class CloudRays : std::uint8_t {
  kVolume,  // in a volume of depths towards the sun, made when the world is
  kRays,    // along a second ray from each sample
};

// A cumulus cloud: an ellipsoid F = 1 - |q|^2 >= 0 with its lower part cut off at the base,
// deformed by perturbations that the seed chooses.
struct Cumulus {
  glm::dvec2 position_m{0.0};  // of its middle at t = 0, east and north
  double width_m = 1500.0;
  double height_m = 1100.0;  // over the base
  int lobes = 12;            // perturbations
  std::uint64_t seed = 1;

  bool operator==(const Cumulus&) const = default;
};

struct CloudField {
  CloudKind kind = CloudKind::kNone;
  double base_m = 900.0, top_m = 2600.0;  // a layer's top; of placed clouds the base alone counts
  double cover = 0.4;                     // part of the plane under the layer's clouds
  double size_m = 2400.0;                 // wavelength of the largest forms
  double extinction_per_m = 0.03;         // in the middle of clouds
  double towers = 0.5;                    // 0: tops of one height, 1: few that tower
  double raggedness = 0.5;                // how deep small forms cut into the edge
  double threshold = 0.0;                 // thinner than this part is cut off
  double wind_factor = 1.2;               // drift over the wind at 10 m
  double change_mps = 1.0;                // how fast small forms rise through the edge
  CloudRays rays = CloudRays::kVolume;
  bool powder = false;  // darker edges towards the sun, which real clouds do not have
  std::uint64_t seed = 3;
  std::vector<Cumulus> cumulus;  // at most kMaxCumulus

  bool operator==(const CloudField&) const = default;
};

inline constexpr std::size_t kMaxCumulus = 64;
inline constexpr int kCloudPeriods = 8;
// Placed clouds fit into a square of this side.
inline constexpr double kMostCloudSquare_m = 40000.0;

}  // namespace swell::scene
