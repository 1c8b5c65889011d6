// What the files of height images hold.
#pragma once

#include <filesystem>

namespace swell::terrain {

// Whether a picture file holds metres (true) or parts of white (false), by its name's extension:
// EXR and HDR hold metres.
bool holds_metres(const std::filesystem::path& path);

}  // namespace swell::terrain
