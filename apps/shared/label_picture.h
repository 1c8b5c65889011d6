// Labels as pictures for people: false colours, as 8-bit sRGB with R in the low byte like
// render::Target::rgba. The sky is black but for motion.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "math/view.h"
#include "render/labels/labels.h"

namespace swell::apps {

// Grey by the logarithm: white at 1 m and nearer, black at 10 km and beyond.
std::uint32_t depth_colour(float depth_m);

// Red and green by a triangle wave over each 100 m east and north, black at its whole multiples and
// full half-way; blue as the grey of elevation_colour().
std::uint32_t position_colour(glm::dvec3 p_world);

// Each component from -1 (0) to 1 (255); black for the zero vector.
std::uint32_t normal_colour(glm::vec3 normal);

// A colour for each number, those of small numbers far apart: 0 black, 1 blue, 2 green, 3 red,
// 4 white.
std::uint32_t number_colour(std::uint32_t number);

// Hue by direction (right red, up green-yellow, left cyan, down violet), brightness by the
// logarithm of the length: black at 0, half at 0.8 px, full from 64 px on.
std::uint32_t motion_colour(glm::vec2 motion_px);

// Grey: black at -4 m and below, white at 4 m and above.
std::uint32_t elevation_colour(float elevation_m);

// Grey: black at 0, white at 1.
std::uint32_t share_colour(float share);

// Green for what is refracted, blue for what is mirrored, cyan for both.
std::uint32_t flags_colour(std::uint8_t flags);

// Fills `rgba`, which gets the view's size, with one label of a frame. The label is in labels.set;
// the view is the frame's.
void paint_label(render::Label label, const render::Labels& labels, const View& view,
                 std::vector<std::uint32_t>& rgba);

}  // namespace swell::apps
