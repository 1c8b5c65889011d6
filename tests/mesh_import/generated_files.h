// Mesh files of four formats, made up here: their shapes, the ways in which a format may say the
// same, and what is wrong with some of them go by a number.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace swell {

inline constexpr int kGeneratedFiles = 30;  // of each format

struct GeneratedFile {
  std::filesystem::path path;
  std::string broken;  // what is wrong with it; empty: it is to be read
  // What a file that is to be read holds: how many triangles have an area, and the corners of the
  // box around them: right, ahead, up in units of the file, of COLLADA in metres.
  std::size_t triangles = 0;
  glm::vec3 low{0.0f}, high{0.0f};
};

// kGeneratedFiles OBJ, glTF, STL and COLLADA files each, with what they need beside them.
std::vector<GeneratedFile> generate_mesh_files(const std::filesystem::path& folder);

}  // namespace swell
