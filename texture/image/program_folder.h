// Where the files lie that belong to the program: the module for images, the importer of meshes.
#pragma once

#include <array>
#include <filesystem>
#include <string_view>

namespace swell::texture {

// The folder of the program, or of the shared library that this code is part of.
std::filesystem::path folder_of_this_code();

// Where a file of ours may be, the likeliest first: in ../lib/swell from the program, beside it.
std::array<std::filesystem::path, 2> places_beside_program(std::string_view file);

// The folder that the module for images was loaded from, which this loads: programs that embed the
// library find that module where the system looks. Throws as image_codec().
std::filesystem::path folder_of_image_codec();

}  // namespace swell::texture
