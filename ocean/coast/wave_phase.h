// The phase of one wave train over a sea floor, worked out once: crests are where theta(x, y) -
// t / T is whole. Waves shorten, turn and steepen as the water gets shallower.
//
// Sources: Elykov, Belago, Kuzikovsky, Nekrasov, 2000, after Peachey, Modeling Waves and Surf,
// SIGGRAPH 1986 (the phase as an integral of k); Snell's law, Green's law and energy flux as in any
// text on water waves.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "terrain/sea_floor.h"

namespace swell::ocean {

// A long-crested wave as it is in deep water.
struct WaveTrain {
  double amplitude_m = 0.0;     // half the height, >= 0
  double period_s = 10.0;       // > 0
  glm::dvec2 travel{0.0, 1.0};  // unit vector it travels along: x east, y north
  double phase_cycles = 0.0;    // added to theta
  double gravity_mps2 = 9.81;
};

enum class PhaseMethod {
  // theta = (1 / 2 pi) integral of k along the straight line of travel, from where that line enters
  // the grid; there theta is the deep-water wave's. The paper's way: crests turn because k differs
  // from line to line, but waves run straight through headlands and islands, and where lines of
  // unequal depth part, |grad theta| is no longer k / (2 pi). On a plane beach, at an angle a to
  // its normal, k along the contours is Snell's k_inf sin a, and k across them
  //   (k - k_inf sin^2 a) / cos a  for Snell's  sqrt(k^2 - k_inf^2 sin^2 a):
  // right to first order in e = k / k_inf - 1, too much by k_inf e^2 sin^2 a / (2 cos^3 a) for
  // little e and by 1 / cos a at the shore. (The paper has k = sqrt(k_inf / h) below h = 0.05 L and
  // k_inf / sqrt(tanh(k_inf h)) above 0.25 L; here k solves k tanh(k h) = k_inf exactly
  // everywhere.)
  kStraight,
  // |grad theta| = k / (2 pi): first arrivals, bent by the floor and round headlands. On the
  // borders that the wave comes in through, it obeys Snell's law for straight contours along the
  // border's mean one. Land casts shadows; what gets into them has crept round its corners
  // (diffraction proper is not modelled).
  kEikonal,
};

// For the samples of a floor's grid.
struct WavePhase {
  // theta in cycles, unwrapped, continuous over the water. Land next to water continues the
  // water's, so that a bilinear sample is right up to the shore; elsewhere without waves: 0.
  std::vector<double> cycles;
  // Height over deep-water height before breaking: Ks, with the eikonal also the spreading of the
  // rays, Kr = sqrt(distance between rays in deep water / here) <= 2. 0 on land and in shadow.
  std::vector<float> amplitude;
};

// The least depth waves are computed for; shallower water counts as this deep.
inline constexpr double kShallowestDepth = 0.05;

// Throws std::invalid_argument for a bad floor (see check_sea_floor) or train. About 0.15
// microseconds a sample with either method.
WavePhase make_wave_phase(const terrain::HeightGrid& floor, const WaveTrain& train,
                          PhaseMethod method);

// k = 2 pi grad theta in rad/m at p_world: central differences, bilinear between samples. 0 where
// there are no waves all around. Points beyond the grid are moved to its border.
glm::dvec2 wave_vector_at(const terrain::Grid& grid, const WavePhase& phase, glm::dvec2 p_world);

// Waves break where the height of all trains together, twice the sum of their amplitudes, would
// exceed this part of the depth.
inline constexpr double kBreakingRatio = 0.78;

// A direction turned by an angle, counter-clockwise.
glm::dvec2 turned(glm::dvec2 travel, double angle_rad);

// The factor in [0, 1] that brings trains whose amplitudes sum to sum_m down to what water of
// depth_m carries; 0 on land.
double breaking_factor(double sum_m, double depth_m);

}  // namespace swell::ocean
