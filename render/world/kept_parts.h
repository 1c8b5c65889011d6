// The parts of a world by the hash of their names and of what they are made of
// (render/world/part_maker.h).
#pragma once

#include <map>
#include <memory>

#include "math/value_hash.h"

namespace swell::render {

// Null: nothing comes of these inputs.
using KeptParts = std::map<ValueHash, std::shared_ptr<const void>>;

}  // namespace swell::render
