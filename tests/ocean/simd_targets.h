// Runs a test body on every SIMD target this machine has.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "math/simd_target.h"

namespace swell {

template <class Body>
void for_each_simd_target(Body body) {
  const SimdTarget before = current_simd_target();
  for (const SimdTarget target : simd_targets()) {
    if (!simd_target_available(target)) continue;
    select_simd_target(target);
    const testing::ScopedTrace trace(__FILE__, __LINE__, std::string(simd_target_name(target)));
    body();
  }
  select_simd_target(before);
}

}  // namespace swell
