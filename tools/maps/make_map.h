// swell-bench waves --make-map: files of periodic maps (ocean/open_sea/periodic_map.h).
#pragma once

#include <string>

#include "apps/shared/command_line.h"
#include "ocean/open_sea/periodic_map.h"

namespace swell::apps {

struct MapOptions {
  std::string file;             // empty: no map is asked for
  std::string start = "gusts";  // or "drops", or a square picture of heights
  double wind_from_deg = 0.0;
  int seed = 1;
  ocean::MapRecipe recipe;
};

void add_map_options(CommandLine& line, MapOptions& options);

// Makes the map, writes it and says on standard output what it is. Throws OptionError,
// texture::FileError, std::invalid_argument.
void make_map(const MapOptions& options);

}  // namespace swell::apps
