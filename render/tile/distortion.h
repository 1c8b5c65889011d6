// How the water's slopes displace what is seen in it and through it.
#pragma once

#include <array>

#include "math/view.h"

namespace swell::scene {
struct Scene;
}

namespace swell::render {

struct MaterialInputs;

// Of what is mirrored. By `least` and `by_sine` it fades where the surface is seen edge-on.
struct Distortion {
  float px_per_slope = 0.0f;
  float by_sine = 6.0f,
        least = 0.1f;   // factor: the sine of the eye's elevation times this, bounded
  float across = 0.5f;  // to the side, over that up and down
};

// What is seen through the water is displaced by less, the other way.
inline constexpr float kRefractedDistortion = -0.5f;

Distortion make_distortion(const scene::Scene& scene, const View& camera);

// Neighbouring pixels look past each other through waves: finer patterns would be noise. How many
// mip levels coarser they are seen, by the log2 of a pixel's footprint [m] from kFirst_m on;
// repeated for wide vectors.
struct RefractionBlur {
  static constexpr int kEntries = 8;
  static constexpr float kFirst_m = -7.0f;
  std::array<float, 2 * kEntries> levels{}, levels_by_next{};
  float by_sine = 1.0f, least = 1.0f;  // as Distortion's
};

RefractionBlur make_refraction_blur(const MaterialInputs& in, const View& camera);

}  // namespace swell::render
