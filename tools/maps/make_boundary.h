// swell-bench terrain --make-boundary: the water boundary of a scene's terrain as a picture
// (terrain/boundary.h).
#pragma once

#include <string>

#include "apps/shared/command_line.h"
#include "apps/shared/notices.h"

namespace swell::apps {

struct BoundaryOptions {
  std::string file;          // empty: none is asked for
  std::string bank_normals;  // a picture besides; likewise
  SceneChoice scene;
};

void add_boundary_options(CommandLine& line, BoundaryOptions& options);

// Makes it, writes it and says on standard output what it is. Throws OptionError,
// texture::FileError, scene::SceneError.
void make_boundary(const BoundaryOptions& options, int threads);

}  // namespace swell::apps
