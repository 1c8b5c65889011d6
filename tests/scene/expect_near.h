#pragma once

#include <gtest/gtest.h>

#include <glm/glm.hpp>

namespace swell::scene {

inline void expect_near(glm::dvec3 value, glm::dvec3 expected, double tolerance) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(value[i], expected[i], tolerance) << i;
}

}  // namespace swell::scene
