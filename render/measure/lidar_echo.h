// How much of a lidar's light comes back, and whether it is seen: in parts of what a white matt
// surface met squarely sends back, which is the surface's reflectance times the cosine of the
// incidence for matt ones.
//
// A light of 905 nm, at which
//   leaves reflect 0.45    Jacquemoud, Baret, PROSPECT: A Model of Leaf Optical Properties, 1990
//   bark reflects 0.3      Williams, A Comparison of Spectral Reflectance Properties at the Needle,
//                          Branch, and Canopy Levels for Selected Conifer Species, 1991
//   foam 0.33              Koepke, Effective Reflectance of Oceanic Whitecaps, 1984 (0.55 in the
//                          visible); Frouin, Schwindling, Deschamps, Spectral Reflectance of Sea
//                          Foam, 1996 (40 % less there)
//   paint as its colour    the mean of the three, also of meshes and forms: pigments have no rule
//   ground by its covers   render/measure/lidar_ground.h
// and a metre of water swallows all but a thousandth (Hale, Querry, Optical Constants of Water,
// 1973): none comes back from below.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace swell::render {

inline constexpr double kLeafReflectance = 0.45, kBarkReflectance = 0.3, kFoamReflectance = 0.33;
inline constexpr double kWaterMirror = 0.0198;  // Fresnel, straight on, n = 1.328

// The mean square slope, of both axes together, of water in a wind U10 [m/s] >= 0, without that of
// the waves that are there as a surface; at least 0.001.
// Source: Cox, Munk, Measurement of the Roughness of the Sea Surface, 1954: 0.003 + 0.00512 U.
double unresolved_slope(double wind_speed_mps, double resolved);

// The echo of clear water: of its facets those mirror the beam back that stand square to it. The
// radiance of a sea of facets is F p(slope) / (4 cos(theta) cos(beta)^4) for light of irradiance 1
// across it; here the tilt beta of the facets is the beam's angle theta to the vertical. A white
// surface has 1 / pi. `slope`: dz/dx and dz/dy of the surface, about which facets spread as a
// Gaussian; `along`: where the beam goes, of length 1. 0 for beams that go up; never over 1.
// Source: Cox, Munk, ibid.; the form in Bufton, Hoge, Swift, Airborne Measurements of Laser
// Backscatter from the Ocean Surface, 1983.
double clear_water_echo(glm::dvec3 along, glm::dvec2 slope, double unresolved);

// The echo of water that foam hides this part of.
double water_echo(double clear, double foam, double cos_incidence);

// Whether a receiver sees an echo: its power goes with echo / range^2, is 1 of the threshold for
// an echo of 0.1 from reach_m, and varies by a tenth of itself: `gaussian` is of mean 0 and
// deviation 1. With q = (echo / 0.1) (reach / range)^2 one is seen as often as a standard normal
// number is below 10 (1 - 1 / q). All are with reach_m 0.
bool is_detected(double echo, double range_m, double reach_m, double gaussian);

}  // namespace swell::render
