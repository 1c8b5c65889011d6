// The rows of a map, shared by threads.
#pragma once

#include <algorithm>
#include <cstddef>

#include "math/parallel.h"
#include "math/stop.h"

namespace swell {

// Calls body(j) for each row j of a map of so many rows, with several rows to a piece of work.
template <class Body>
void for_each_row(int rows, Workers& workers, const Body& body) {
  constexpr int kRows = 16;
  workers.for_each(static_cast<std::size_t>((rows + kRows - 1) / kRows), [&](std::size_t n, int) {
    const int first = static_cast<int>(n) * kRows;
    for (int j = first; j < std::min(first + kRows, rows); ++j) {
      check_stop();
      body(j);
    }
  });
}

}  // namespace swell
