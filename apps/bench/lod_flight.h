// swell-bench lod: all of the original module's work along a low flight over four sine waves.
// Source: Elykov et al., 2000: waves, level of detail, vertices, normals, texture coordinates.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "apps/shared/report.h"
#include "math/parallel.h"

namespace swell::apps {

struct Flight {
  int triangles = 1500, frames = 300;
  double speed_mps = 30.0;  // 0: a still camera
  int operations = 0;       // splits and merges a frame at most; 0: any number
  int groups = 1;           // of priorities, one of which is worked out anew in a frame
};

struct FlightRow {
  double speed_mps = 0.0;
  int triangles = 0, frames = 0;        // triangles of the last frame
  Spread lod_ms{}, module_ms{};         // over frames
  std::int64_t splits = 0, merges = 0;  // of all frames together
  double ns_per_leaf() const { return lod_ms.median * 1e6 / triangles; }
};

// Flies once round a circle in two minutes, ten metres above the sea, 60 frames a second; the
// first triangulation is not counted.
FlightRow measure_flight(const Flight& flight, Workers& workers);

std::string flight_table(std::span<const FlightRow> rows);

}  // namespace swell::apps
