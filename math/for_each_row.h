// The rows of a map, shared by threads.
#pragma once

#include <algorithm>
#include <cstddef>

#include "math/parallel.h"
#include "math/stop.h"

namespace swell {

// Rows of a map that are one piece of work.
inline constexpr int kRowsOfPiece = 16;

// Calls body(first, end) for pieces of a map of so many rows.
template <class Body>
void for_each_piece(int rows, Workers& workers, const Body& body) {
  const int pieces = (rows + kRowsOfPiece - 1) / kRowsOfPiece;
  workers.for_each(static_cast<std::size_t>(pieces), [&](std::size_t n, int) {
    const int first = static_cast<int>(n) * kRowsOfPiece;
    body(first, std::min(first + kRowsOfPiece, rows));
  });
}

// Calls body(j) for each row j of a map of so many rows.
template <class Body>
void for_each_row(int rows, Workers& workers, const Body& body) {
  for_each_piece(rows, workers, [&](int first, int end) {
    for (int j = first; j < end; ++j) {
      check_stop();
      body(j);
    }
  });
}

}  // namespace swell
