// Random pictures of the shipped scenes, for tests that look at the meshes they are drawn with.
#pragma once

#include <cmath>
#include <cstdint>

#include "math/random.h"
#include "render/shot.h"
#include "scene/water.h"

namespace swell::render {

// Random eyes within 2 km of the origin, times from a day ago to a day ahead.
struct Look {
  View view;
  double t_s;
};
inline Look random_look(int n, int width_px, int height_px) {
  const auto dice = [&](int i) {
    return random_uniform(77, static_cast<std::uint64_t>(8 * n + i));
  };
  const glm::dvec3 eye(4000.0 * (dice(0) - 0.5), 4000.0 * (dice(1) - 0.5), 2.0 + 60.0 * dice(2));
  return {make_view(eye, 6.3 * dice(3), -0.5 * dice(4), 0.9, 0.25f, width_px, height_px),
          172800.0 * (dice(5) - 0.5)};
}

// The corner plus whole steps of a power of two: exact.
inline glm::dvec2 place_of(const Surface& drawn, std::size_t vertex) {
  const lod::Domain& domain = drawn.domain;
  const double step_m = std::ldexp(domain.size_m, -domain.lattice_bits);
  const glm::ivec2 lattice = drawn.mesh.lattice[vertex];
  return {domain.min_world.x + step_m * lattice.x, domain.min_world.y + step_m * lattice.y};
}

// Whether the vertex lies so near that waves are drawn in full (render/view/wave_reach.h).
inline bool shows_all_waves(const Surface& drawn, const View& view, std::size_t vertex) {
  const auto eye_z = static_cast<float>(view.eye_world.z);
  const float distance_m = std::hypot(glm::length(drawn.offset[vertex]), eye_z);
  return distance_m < 0.79f * static_cast<float>(drawn.statistics.reach_m);
}

// Draws so many random looks and gives each and what it was drawn with to
// check(look, surface of the same time, drawn water).
template <class Check>
void draw_looks(const scene::Scene& scene, int count, glm::ivec2 size_px, int triangles,
                Check check) {
  const World world = world_of(scene);
  const scene::Water water(scene);
  ocean::SeaFrame frame;
  Shot shot;
  for (int n = 0; n < count; ++n) {
    const Look look = random_look(n, size_px.x, size_px.y);
    shot.draw(world, look.view, look.t_s, {.water_triangles = triangles});
    check(look, water.at(look.t_s, frame, shot.workers), shot.state().meshes.water);
  }
}

}  // namespace swell::render
