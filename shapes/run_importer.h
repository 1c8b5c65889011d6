// The importer of mesh files as a process of its own. The library that it reads them with
// (Open Asset Import Library) is not ours to mend: what it makes of a broken or hostile file must
// not happen here.
#pragma once

#include <string>
#include <vector>

#include "scene/objects.h"

namespace swell::shapes {

inline constexpr int kMostImport_s = 120;  // an import takes, or else is ended

// What the importer writes of the file (shapes/flat_mesh.h). It is swell_mesh_import, looked for in
// ../lib/swell from the program (or the shared library that this code is part of), beside it, and
// beside the module for images (texture/image/image_codec.h).
// Throws std::runtime_error in one line: why the importer refuses the file, that it failed, took
// too long or too much, or is not there. Any number of threads may import at once.
std::vector<char> run_importer(const std::string& file, scene::UpAxis up);

}  // namespace swell::shapes
