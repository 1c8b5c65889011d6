// How the water at the surface moves under wave trains: linear theory in water of the local depth,
// from the same phases and amplitudes as the heights.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "ocean/below/motion.h"
#include "ocean/coast/coast.h"

namespace swell::ocean {

// Velocities (east, north, up) in m/s at world points at time t_s (finite), as long as p_world. Up
// is exactly the rate of sample_trains()'s heights. Along each train
//   u = a omega cosh k(z + h) / sinh kh  at z = 0,  which is  a g k / omega
// by the dispersion relation, with a the train's height over its own mean and k = 2 pi grad theta
// of the place: deep water moves on circles, shallow water by a sqrt(g / h). Being linear it leaves
// out the Stokes drift, the undertow and the fronts of breaking waves. Allocates nothing; may be
// called from many threads at once. 45 ns a point and train.
//
// Source: any text on linear water waves; Dean and Dalrymple, Water Wave Mechanics for Engineers
// and Scientists, 1991, chapter 4.
void sample_train_velocities(const TrainSea& sea, double t_s, std::span<const glm::dvec2> p_world,
                             std::span<glm::vec3> velocity_mps);

// Gives these velocities times the trains' share of the surface: the part that sample_coast()'s
// heights move by. Points without a share cost nothing more.
void sample_coast_velocities(const CoastSea& coast, double t_s, std::span<const glm::dvec2> p_world,
                             std::span<glm::vec3> velocity_mps);

// The motion below the surface, likewise, of no more than kPointChunk points: each train by its
// wave number there and the depth that is given. Its velocity at the surface is the one above. The
// head's mean is the heights' own, which sharp crests leave below 0 on the whole depth.
void sample_coast_motions(const CoastSea& coast, double t_s, const PointsBelow& points,
                          std::span<Motion> motion);

}  // namespace swell::ocean
