// Layers of periodic maps as the sea's waves: which there are, and their samples at a time.
#pragma once

#include <memory>
#include <vector>

#include "math/parallel.h"
#include "ocean/open_sea/map_layer.h"
#include "ocean/open_sea/periodic_map.h"
#include "ocean/open_sea/sea.h"

namespace swell::ocean {

// A map laid over the sea.
struct MapWaves {
  std::shared_ptr<const PeriodicMap> map;  // layers of a set share one
  glm::dvec2 length_m{0.0};
  double square_m = 0.0;  // side of the square over which its mean wave would be as long
  double loops_per_s = 0.0;
  double first_loops = 0.0;      // at t = 0
  int first_x = 0, first_y = 0;  // sample at the world's origin
  double metres = 0.0;           // of a height of 1
  double variance_m2 = 0.0, slope_variance = 0.0;

  double peak_m() const { return metres * map->peak; }
  // Returns the wave number of a wave with the map's root mean square slope and height.
  double wave_number_rad_m() const { return map->mean_wave_number() / square_m; }
};

// The layers of the description's set and of its maps, whose files are read. Throws
// std::invalid_argument for a file that is no map, and for values out of the ranges of MapLayer.
std::vector<MapWaves> make_map_waves(const SeaDescription& sea);

// How many layers that will be.
std::size_t count_map_layers(const SeaDescription& sea);

// The step of packed heights: 1.25 / 32767 of the map's peak, over which no time between frames is
// higher. They are off by half of it at most.
float packed_step_m(const MapWaves& waves);

// Fills the heights and slopes of patches, which have their sizes, one for each of `waves`, at time
// t_s (wave_time_s()), and their packed heights, if they have some.
void sample_maps(std::span<const MapWaves> waves, double t_s, std::span<PatchFrame> patches,
                 Workers& workers);

// Fills height_m of the patches x, y and z with the water's velocity at the surface at t_s [m/s]:
// z with the rate of the heights, x and y with the velocity of waves of deep water with this rate,
// i k / |k| times it. `storage` is working storage.
void sample_map_velocities(const MapWaves& waves, double t_s, PatchFrame& x, PatchFrame& y,
                           PatchFrame& z, std::vector<float>& storage, Workers& workers);

}  // namespace swell::ocean
