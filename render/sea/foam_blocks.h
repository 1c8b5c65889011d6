// Where a map of foam has any, so that looking it up can be spared.
#pragma once

#include <array>
#include <cstdint>

namespace swell::render {

// Bit i of row j is of the texels from (8 i, 16 j) on, and is set where a sample there, bilinear on
// a level up to kFinest, may find some.
struct FoamBlocks {
  static constexpr int kColumns = 32, kRows = 16, kFinest = 2;
  alignas(64) std::array<std::uint32_t, kRows> row{};
  bool are_few = false;  // so that looking spares samples
};

}  // namespace swell::render
