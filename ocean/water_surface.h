// The water's surface that is drawn, as something to ask: heights, slopes, rays, what is under
// water, at any place and time. The renderer moves its vertices with the same heights(), so that
// a drawn vertex and an answer at its place are the same bits; within a triangle the picture is
// flat and differs from the answer by what the triangle cuts off.
// Programs get one of a scene from scene/water.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "math/parallel.h"
#include "ocean/below/motion.h"
#include "ocean/open_sea/whitecaps.h"
#include "ocean/water.h"

namespace swell::ocean {

// Where a ray meets the surface.
struct WaterHit {
  double distance_m = 0.0;
  glm::dvec3 p_world{0.0};
  bool from_above = true;  // the ray comes out of the air
};

enum class MotionPlace : std::uint8_t { kInWater, kAbove, kInGround };

// How the water moves at a point, 0 out of the water.
struct WaterMotion {
  MotionPlace place = MotionPlace::kInWater;
  glm::vec3 velocity_mps{0.0f};       // east, north, up
  glm::vec3 acceleration_mps2{0.0f};  // the velocity's rate at a place that stands still
  float pressure_pa = 0.0f;           // of the waves alone
};

// A closed hull of triangles in the world, whose corners run counter-clockwise as seen from
// outside.
struct HullMesh {
  std::span<const glm::dvec3> p_world;
  std::span<const glm::uvec3> triangles;
};

// A force in newtons and its moment about a point in newton metres: east, north, up.
struct Load {
  glm::dvec3 force_n{0.0}, moment_nm{0.0};
};

struct HullLoads {
  Load buoyancy;       // of the pressure that still water would have there
  Load froude_krylov;  // of the waves' pressure
};

inline constexpr double kSeaDensity_kg_m3 = 1025.0;

// Looks at a sea at one time; all that it is made from has to outlive it, unchanged. All members
// may be called from many threads at once. Points are world x, y below 1e9 m.
class WaterSurface {
 public:
  // `frame` is of the parts' sea.
  WaterSurface(const WaterParts& parts, const SeaFrame& frame);

  // z of the surface: the sea's waves, of a limited area inside it, fading to the mean level over
  // its last tenth, and lower where the water is shallower than the waves are high, so that they do
  // not dig into the sand. On rivers and lakes their levels, with the waves of wakes. Near a coast
  // the sea's waves make room for the trains that know its floor, by their share. Over land 0. A
  // picture has these heights, bit for bit, at the vertices of its mesh, out to where its triangles
  // become wider than the waves (docs/understand/lod.md); inside a triangle with the longest edge s
  // it is at most L s / 2 off, L the waves' steepest slope. Spans of one length that do not
  // overlap. Allocates nothing. 25 ns a point for three patches, 45 with terrain; alone, without a
  // batch, 200. With `longest_patches` the shorter waves of the open sea are left out, by patches.
  void heights(std::span<const glm::dvec2> p_world, std::span<float> height_m,
               std::size_t longest_patches = SIZE_MAX) const;
  float height(glm::dvec2 p_world) const;

  // dz/dx and dz/dy: of the waves their own slopes (smoother than the difference of two heights,
  // which are linear between samples), where they fade with the fading's difference over 0.25 m.
  void slopes(std::span<const glm::dvec2> p_world, std::span<glm::vec2> slope) const;

  // Unit vectors (-dz/dx, -dz/dy, 1) / length.
  void normals(std::span<const glm::dvec2> p_world, std::span<glm::vec3> normal) const;

  // Velocity of the water at the surface in m/s: east, north, up; up is the rate of height().
  // Linear theory: of deep water for the sea's waves (where crests are sharp, of the water that
  // they have brought there), of water of the local depth for the trains of a coast, blended as the
  // heights are, and the current of rivers. `velocity` is of the same time, from
  // advance_velocity(). 60 ns a point, with the trains of a coast 45 more a train.
  void velocities(std::span<const glm::dvec2> p_world, const VelocityFrame& velocity,
                  std::span<glm::vec3> velocity_mps) const;

  // The water's motion at points (x, y, z), |z| at most 1e7 m, on and below the surface: linear
  // theory, each wave with its own decay (ocean/below/motion.h). The sea's waves are of deep water,
  // as at the surface; the trains of a coast and wakes have the depth there; the current of rivers
  // is the same on the whole depth. At z = surface the velocity has the bits of velocities(), and
  // the pressure is density g (surface - still level): with that of still water none is left. In
  // between a wave is off by what depth_ladder.h says. Accelerations are the rate of the waves'
  // velocity at the stretched depth; neither what the water carries along nor, with sharp crests,
  // what waves of second order have more is counted.
  // `below` is of the same time, from begin_below(), keeps what it makes, and is used by one call
  // at a time. The same bits in any order and with any workers. For 15 depths of the ladder, down
  // to 10 m, a sea of three patches takes 4 ms of one thread at a new time for the pressure, 30 ms
  // for all; a point then 0.6 us for the pressure, 6 us for all where points are far apart.
  void motions(std::span<const glm::dvec3> p_world, MotionParts parts, double density_kg_m3,
               BelowFrame& below, Workers& workers, std::span<WaterMotion> motion) const;

  // Forces on the part of a hull that is under the surface, where its triangles are cut, and their
  // moments about `about`. Both together are what the waves would press on if the hull were not
  // there. The mean over the middles of a triangle's edges is exact for pressures that are linear
  // over it: triangles with edges of a tenth of a wavelength are off by 1 %. Indices are below the
  // number of points; otherwise as motions(), of whose pressure it asks three points a triangle.
  HullLoads hull_loads(const HullMesh& hull, glm::dvec3 about, double density_kg_m3,
                       BelowFrame& below, Workers& workers) const;

  // The current at the surface in m/s, east and north: that of rivers, 0 elsewhere.
  void currents(std::span<const glm::dvec2> p_world, std::span<glm::vec2> current_mps) const;

  // The part of the surface that whitecaps of the open sea and of a coast's trains hide and the
  // surf of these, in [0, 1], as pictures have it in the mean over foam's lace. The foam of wakes
  // is counted where there is more of it; surf fronts of shores without trains are not. `whitecaps`
  // is of the same sea, coast and time, from advance_whitecaps(): of one made without the coast,
  // trains have no whitecaps.
  void foam(std::span<const glm::dvec2> p_world, const WhitecapFrame& whitecaps,
            std::span<float> foam) const;

  // Below or on the surface, and above the ground.
  bool in_water(glm::dvec3 p_world) const;

  // The first place where origin + s direction, 0 <= s <= max_distance_m, passes the surface. The
  // direction has any length over 0 (distances are in metres all the same); all finite. Steps as
  // far as the steepest waves allow, then bisects down to 0.1 um; heights have steps of the slope
  // times 1/65536 of the sample spacing. Two crossings less than 2 cm + s / 5000 apart may be
  // missed.
  std::optional<WaterHit> intersect(glm::dvec3 origin_world, glm::dvec3 direction,
                                    double max_distance_m) const;

  double t_s() const { return frame_->t_s; }
  const WaterBounds& bounds() const { return water_.bounds(); }
  float bound_m() const { return bounds().height_m; }  // |z| stays below in practice

 private:
  // Fills below.p_world and below.column.
  void find_columns(std::span<const glm::dvec3> p_world, BelowFrame& below, Workers& workers) const;
  // As motions(), but gives points above the surface that of the surface, and points in the ground
  // that of the ground.
  void nearest_motions(std::span<const glm::dvec3> p_world, MotionParts parts, double density_kg_m3,
                       BelowFrame& below, Workers& workers, std::span<WaterMotion> motion) const;

  WaterBody water_;
  const SeaFrame* frame_;
};

}  // namespace swell::ocean
