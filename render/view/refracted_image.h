// Where things on the other side of the water's surface appear.
//
// Light goes straight in water and in air and is bent at the level between them: by Snell's law
// sin(t_air) = n sin(t_water), t the angles to the vertical. An eye on one side sees a point on the
// other in the direction t of its own medium, on the vertical through the point: there its image
// lies for eyes beside each other. (The image for eyes above each other lies elsewhere.)
#pragma once

#include <algorithm>
#include <cmath>

#include "math/elementary.h"

namespace swell::render {

// A way of light between two points on either side of the level.
struct BentWay {
  float air_m;         // height of the point in air over the level, over 0
  float water_m;       // depth of the one in water, at least 0
  float horizontal_m;  // between them, at least 0
};

// No point in air is taken as nearer to the level than this: a grazing ray would have no angle.
inline constexpr float kLeastAirHeight_m = 1e-3f;

// x = tan(t_air) of the way, the root of air x + water x / sqrt(n^2 + (n^2 - 1) x^2) = horizontal,
// which rises ever less steeply. Halley's method from a bound below the root, always three steps:
// the angle is right to 1e-5 rad where the point in air is 0.05 m high, to 6e-4 rad everywhere; the
// one in water to 4e-5 rad.
inline float tan_in_air(const BentWay& way, float n) {
  const float n2 = n * n, m2 = n2 - 1.0f, air = std::max(way.air_m, kLeastAirHeight_m);
  float x = std::max((way.horizontal_m - way.water_m / std::sqrt(std::max(m2, 1e-6f))) / air,
                     way.horizontal_m / (air + way.water_m / n));
  for (int step = 0; step < 3; ++step) {
    const float g = n2 + m2 * x * x, inv_g = 1.0f / g, inv_s = std::sqrt(inv_g);
    const float water = way.water_m * inv_s;
    const float miss = (air + water) * x - way.horizontal_m;
    const float bent = water * n2 * inv_g;
    const float slope = air + bent, curve = 3.0f * bent * m2 * x * inv_g;
    x -= miss * slope / (slope * slope + 0.5f * miss * curve);
  }
  return x;
}

// How far below the level an eye in air sees the image of a point in water [m].
inline float apparent_depth_m(const BentWay& way, float n) {
  const float x = tan_in_air(way, n), n2 = n * n;
  return way.water_m / std::sqrt(n2 + (n2 - 1.0f) * x * x);
}

// Apparent over true depth by two straight lines, for water of 1.333, by the angle in air [rad];
// within 0.081 of Snell's law.
// Source: Ma, Zhu, Gong, 2006.
inline float paper_depth_ratio(float angle_in_air) {
  return angle_in_air <= 0.8f ? 0.75f - 0.16f * angle_in_air : 1.26f - 0.8f * angle_in_air;
}

// As apparent_depth_m(), with that ratio.
inline float paper_depth_m(const BentWay& way, float n) {
  const auto x = static_cast<double>(tan_in_air(way, n));
  return way.water_m * paper_depth_ratio(static_cast<float>(atan2(x, 1.0)));
}

// That ratio of the point whose image, with it, an eye in air sees so far below the level, along a
// ray of this tan(angle to the vertical), at least 0: not quite that of the ray's angle. The root
// of air x + water(x) tan(t_water) = horizontal, which rises, by Newton's method.
inline float paper_depth_ratio_seen(float air_m, float image_depth_m, float tan_seen, float n) {
  const float n2 = n * n, m2 = n2 - 1.0f, air = std::max(air_m, kLeastAirHeight_m);
  const float horizontal_m = (air + image_depth_m) * tan_seen;
  const auto ratio = [](float x) {
    return paper_depth_ratio(static_cast<float>(atan2(static_cast<double>(x), 1.0)));
  };
  float x = tan_seen, k = ratio(x);
  for (int step = 0; step < 6; ++step) {
    const float inv_g = 1.0f / (n2 + m2 * x * x), inv_s = std::sqrt(inv_g), inv_k = 1.0f / k;
    const float k_x = (k > 0.622f ? -0.16f : -0.8f) / (1.0f + x * x);
    const float miss = air * x + image_depth_m * x * inv_s * inv_k - horizontal_m;
    const float slope = air + image_depth_m * inv_k * inv_s * (n2 * inv_g - x * k_x * inv_k);
    x = std::max(x - miss / slope, 0.0f);
    k = ratio(x);
  }
  return k;
}

// How far above the level an eye in water sees the image of a point in air [m]. Points on the level
// that lie further away than Snell's window is wide appear at the window's rim, high above it.
inline float apparent_height_m(const BentWay& way, float n) {
  const float x = tan_in_air(way, n), n2 = n * n, m2 = n2 - 1.0f;
  // Two forms of one number, each where it does not lose digits.
  if (x < 1.0f) return way.air_m * std::sqrt(n2 + m2 * x * x);
  return std::max(way.horizontal_m * std::sqrt(n2 / (x * x) + m2) - way.water_m, 0.0f);
}

}  // namespace swell::render
