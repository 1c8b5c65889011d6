// Fog over the sea (sky/fog.h), for one frame.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "render/frame/parts.h"

namespace swell::render {

struct CloudShadow;
struct WorldState;

// Where a way through fog begins.
struct FogStart {
  float height_m = 0.0f;       // over the sea
  float above_m = 0.0f;        // fog straight up from there, as metres of that at sea level
  glm::vec3 sun_passes{1.0f};  // what is left there of the sun's beam
};

// One wave of the fog's density over the plane: 1 + amount sin(2 pi turns).
struct FogBank {
  glm::vec2 turns_per_m{0.0f};
  float turns = 0.0f;   // at the eye
  float cosine = 1.0f;  // of these turns
  float amount = 0.0f;
};

struct Fog {
  static constexpr std::size_t kMostBanks = 7;

  bool on = false;
  bool is_grey = true;          // the same in all channels
  bool is_exponential = false;  // or a slab
  bool is_paper = false;        // scene::FogScattering::kPaper
  glm::vec3 per_m{0.0f};
  float top_m = 1.0f;
  float drop_per_m2 = 0.0f;  // of a round earth
  // The part of haze whose place a slab takes: of the two the thicker counts, which may be the fog.
  float takes_haze = 1.0f;
  FogStart at_eye, at_sea;
  // Exposed. The sun's light over the fog, times (1 - l^2) / (4 pi).
  glm::vec3 to_sun{0, 0, 1};
  glm::vec3 scattered{0.0f};
  glm::vec3 even{0.0f};     // sky::FogLight
  glm::vec3 ambient{0.0f};  // the same
  // The parts of both that are the sun's.
  glm::vec3 even_sun{0.0f}, ambient_sun{0.0f};
  float forward = 0.0f;  // l
  float sun_sine = 1.0f;
  int bank_count = 0;
  std::array<FogBank, kMostBanks> banks;
  const CloudShadow* clouds = nullptr;  // in which there is less of the sun's light; none: nowhere
};

// eye_world: of the camera. What drifts with the wind is a function of t_s.
Fog make_fog(const WorldState& world, double t_s, glm::dvec3 eye_world, PartSet without);

}  // namespace swell::render
