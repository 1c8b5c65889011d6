// What the parts of a scene's world take to make, said before they are made.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "scene/scene.h"

namespace swell::render {

struct PartNeed {
  std::string_view name;  // as PartMaker::share() has it
  double seconds;         // typically, on two threads
  std::size_t bytes;      // at most, with what is needed while it is made
};

// Each part once. Reads no more than the heads of files.
std::vector<PartNeed> part_needs(const scene::Scene& scene);

}  // namespace swell::render
