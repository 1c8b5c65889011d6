// The corners of a tree's triangles, which face the eye and sway.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "ocean/open_sea/sea.h"
#include "render/view/trees_drawn.h"

namespace swell::render {

struct Forest;

// What sways trees at a time.
struct Sway {
  glm::vec2 wind;   // where it goes to, times how far a tree of height 1 bends
  glm::vec2 turns;  // of two swings, in time
};
Sway sway_at(const ocean::SeaDescription& sea, double t_s);

// Triangles of a drawn tree's crown; those after them are its trunk.
std::uint32_t crown_triangles(const DrawnTree& drawn);

// Writes the corners of all its triangles, 3 drawn.triangles, relative to the eye.
void write_corners(const Forest& forest, const Sway& at, const DrawnTree& drawn, glm::vec3* p);

}  // namespace swell::render
