// Weighted sums of tables, which most of the making of an atmosphere is.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>

namespace swell::sky {

// Adds parts[k] from[k step + i] to to[i], for all i < count and k in their order: rounded after
// each product and each sum, so that the bits are those of a scalar loop. `to` lies apart from what
// is added. Thread safe.
void add_parts(std::span<const float> parts, const float* from, std::size_t step, std::size_t count,
               float* to);

// Adds parts of colours likewise.
inline void add_parts(std::span<const float> parts, const glm::vec3* from, std::size_t step,
                      std::size_t count, glm::vec3* to) {
  if (count > 0) add_parts(parts, &from->x, 3 * step, 3 * count, &to->x);
}

}  // namespace swell::sky
