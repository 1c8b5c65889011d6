// The one definition of the water: which waves there are, how they divide the surface, and what
// they add up to. Heights, slopes, velocities and bounds come from one list of sources in
// water_sources.h.
//
// The sources, in the order in which they take their room:
//   trains  the coast's, which know the sea floor; they leave the rest of their share
//   fronts  of surf, which follow the water boundary; likewise (ocean/coast/surf_fronts.h)
//   sea     spectrum waves on patches and sines: in the room that is left, lower in the lee of land
//           (ocean/coast/shelter.h), fading where the water is shallower than they are high
//   wakes   of what disturbs the water (ocean/wakes/wakes.h), which are in the frame: they take no
//   room
// All fade to the mean level over the last tenth of an area that has an end. Rivers and lakes have
// levels of their own (ocean/inland/inland_water.h): of the waves they have the wakes, and where a
// river ends the sea's as well, by its share.
//
// A source is a struct in water_sources.h with these members, for up to kPointChunk points at a
// time:
//   take_room(p, room)                       room[i] *= what it leaves to the sources after it
//   add_heights(frame, p, room, height_m)    adds z in m, with its fading, and takes its room
//   add_slopes(frame, p, room, slope)        adds dz/dx and dz/dy of these heights, takes its room
//   add_velocities(velocity, p, room, v)     adds m/s (east, north, up: dz/dt), takes its room
//   add_motions(below, points, room, motion) adds what there is below the surface, takes its room
// To add one: give WaterParts what it is made from, write the struct, name it in for_each_source()
// there, and count it in bounds_of() in water.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "ocean/below/motion.h"
#include "ocean/coast/coast.h"
#include "ocean/coast/shelter.h"
#include "ocean/coast/surf_fronts.h"
#include "ocean/inland/inland_water.h"
#include "ocean/open_sea/sea.h"
#include "ocean/sea_area.h"
#include "ocean/velocity.h"
#include "ocean/wakes/disturbance.h"
#include "terrain/height_grid.h"

namespace swell::ocean {

struct BelowFrame;

// What does not change with time; all of it has to outlive those who look at it, unchanged.
struct WaterParts {
  const Sea* sea = nullptr;  // never null where water is asked
  SeaArea area = {};
  const terrain::HeightGrid* land = nullptr;  // and the sea floor; null: deep everywhere
  const CoastSea* coast = nullptr;            // null: no trains
  WakeBounds wakes = {};                      // of all wakes that frames may have
  const Shelter* shelter = nullptr;           // of the sea's waves; null: open everywhere
  const InlandWater* inland = nullptr;        // null: no rivers, no lakes; has the same land
  const SurfFronts* fronts = nullptr;         // null: fronts of surf lift no water; needs land
  // The sea's surface alone, under that of rivers where they end: what its triangles are moved by.
  bool sea_alone = false;
};

// What the surface stays within, always and everywhere in practice (Sea::height_bound_m()).
struct WaterBounds {
  float height_m = 0.0f;   // |z|
  float slope = 0.0f;      // |dz/dx| and |dz/dy| of the waves, without what their fading adds
  double steepest = 0.0;   // the slope in any direction, fading and all
  float highest_m = 0.0f;  // z, of rivers and lakes as well
  // 0 without waves. The trains of a coast are of the spectrum's length, if there is one.
  double mean_wavelength_m = 0.0;
};

// The sea's waves fade over so much depth, from the ground's level down: on ground of slope 1 that
// adds shallow_steepness() to the surface's slope, as WaterBounds::steepest counts it.
double shallow_depth_m(const Sea& sea);
double shallow_steepness(const Sea& sea);

// May be asked by many threads at once. Points are world x, y below 1e9 m; spans of a call have one
// length and do not overlap. Frames are of the parts' sea. Allocates nothing.
class WaterBody {
 public:
  explicit WaterBody(const WaterParts& parts);

  const WaterParts& parts() const { return parts_; }
  const WaterBounds& bounds() const { return bounds_; }

  // z above mean sea level in metres at the frame's time. With `longest_patches` the shorter waves
  // of the open sea are left out, by patches.
  void heights(const SeaFrame& frame, std::span<const glm::dvec2> p_world,
               std::span<float> height_m, std::size_t longest_patches = SIZE_MAX) const;

  // dz/dx and dz/dy.
  void slopes(const SeaFrame& frame, std::span<const glm::dvec2> p_world,
              std::span<glm::vec2> slope) const;

  // m/s: east, north, up; with the current of rivers.
  void velocities(const VelocityFrame& velocity, std::span<const glm::dvec2> p_world,
                  std::span<glm::vec3> velocity_mps) const;

  // The motion below the surface. make_below() has made what the points need.
  void motions(const BelowFrame& below, const PointsBelow& points, std::span<Motion> motion) const;
  void find_columns(const SeaFrame& frame, std::span<const glm::dvec2> p_world,
                    std::span<WaterColumn> column) const;

  // m/s, east and north, of rivers: where water goes in the mean. 0 on the sea and on land.
  void currents(std::span<const glm::dvec2> p_world, std::span<glm::vec2> current_mps) const;

 private:
  WaterParts parts_;
  WaterBounds bounds_;
  float wave_height_m_;  // the sea's, significant
};

}  // namespace swell::ocean
