// Where pixels of wide pictures look, which a Projection (math/view.h) says.
//
// Rays are given in the optical frame: x to the right of the picture, y down, z ahead. Places in
// the picture count from its upper left corner; the first pixel's centre is (0.5, 0.5).
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>

#include "math/view.h"

namespace swell {

// A fisheye's polynomial, and its derivative.
double fisheye_radius(const std::array<double, 4>& bend, double theta_rad);
double fisheye_radius_slope(const std::array<double, 4>& bend, double theta_rad);

// Whether the radius grows with the angle up to half_fov_rad, so that each place shows one ray.
bool is_one_to_one(const std::array<double, 4>& bend, double half_fov_rad);

// The fisheye whose cone of fov_rad in (0, 2 pi] touches the nearer edges of a picture.
Projection fisheye_of_fov(double fov_rad, const std::array<double, 4>& bend, int width_px,
                          int height_px);

// The unit ray that the place p_px of a picture of a wide projection shows; none where it shows
// nothing: outside a fisheye's cone. By Newton's method, to 1e-13 of the angle. Fisheyes have to be
// one to one.
std::optional<glm::dvec3> ray_at(const Projection& projection, glm::ivec2 size_px, glm::dvec2 p_px);

// The place that shows a ray of any length over 0: the inverse; none outside a fisheye's cone.
std::optional<glm::dvec2> place_of(const Projection& projection, glm::ivec2 size_px,
                                   glm::dvec3 ray);

}  // namespace swell
