// What the ground sends back of a lidar's light, by what covers it.
#pragma once

#include <glm/glm.hpp>

namespace swell::render {

struct WorldState;

// The reflectance at 905 nm of the world's land at a place on it, in [0, 1]: the mean of its covers
// (render/world/ground_cover.h), as much of each as the picture's maps have there.
//   grass          0.45    as leaves (render/measure/lidar_echo.h)
//   straw, reeds   0.4     Elvidge, Visible and Near Infrared Reflectance Characteristics of Dry
//                          Plant Materials, 1990
//   rock, soil,    red     the red of their colours: spectra of minerals rise slowly from there
//   sand                   (Baumgardner et al., Reflectance Properties of Soils, 1985)
//   wet sand       half    Lobell, Asner, Moisture Effects on Soil Reflectance, 2002
// What grows reflects the red of its colour where that is more: a white cover is snow, which
// reflects 0.8 to 0.9 (Warren, Optical Properties of Snow, 1982). Squares of terrain.checker_m are
// as they are drawn. Litter under trees counts as the ground there.
double ground_reflectance(const WorldState& world, glm::dvec3 p_world);

}  // namespace swell::render
