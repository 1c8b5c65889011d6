#pragma once

#include "ocean/open_sea/periodic_map.h"

namespace swell::ocean {

inline MapRecipe small_recipe() {
  MapRecipe recipe;
  recipe.size = 32;
  recipe.frames = 64;
  recipe.peak_waves = 2.0;
  return recipe;
}

}  // namespace swell::ocean
