// Where the objects of a recipe stand in a sample.
#pragma once

#include <string>
#include <vector>

#include "math/view.h"
#include "render/frame.h"
#include "scene/file/recipe.h"

namespace swell::apps {

// Settings that add a sample's objects to the scene of `world`: in the view, between their
// distances, where the water is deep enough to float them, apart from each other and from what is
// there at t_s. What finds no such place in kMostPlaces draws is left out. A pure function of the
// recipe, the sample and the world.
std::vector<std::string> place_objects(const scene::Recipe& recipe, int sample,
                                       const render::World& world, const View& view, double t_s);

inline constexpr int kMostPlaces = 64;

}  // namespace swell::apps
