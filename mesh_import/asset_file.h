// The one door to the Open Asset Import Library: a mesh file as loose triangles.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "scene/objects.h"
#include "shapes/flat_mesh.h"

namespace swell::mesh_import {

// Why a file is refused; one line.
class Refused : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Is told what will be read next: the bytes of each file once, the texels of a picture, and for
// each triangle that stands in more places than one kInputsPerCopiedTriangle.
using InputCounter = std::function<void(std::uint64_t)>;
inline void ignore_inputs(std::uint64_t) {}
inline constexpr std::uint64_t kInputsPerCopiedTriangle = 8;

// A picture on triangles: a file's path, or what the mesh file holds of it.
struct TextureSource {
  std::filesystem::path path;
  std::vector<char> bytes;              // of an image file, if there is no path
  std::uint32_t width = 0, height = 0;  // of raw texels, if there is neither
  std::vector<std::uint32_t> texels;
};

// Three vertices a triangle. Axes as of an object: right, ahead, up.
struct LooseMesh {
  std::vector<shapes::FlatVertex> corners;
  std::vector<bool> has_normals;        // of each triangle
  std::vector<std::uint32_t> material;  // the same
  std::vector<shapes::FlatMaterial> materials;
  std::vector<TextureSource> textures;
};

// Reads an OBJ, glTF, GLB, STL or COLLADA file with the files that it names in its folder or below.
// Throws Refused, and std::bad_alloc.
LooseMesh read_asset(const std::filesystem::path& file, scene::UpAxis up,
                     const InputCounter& count_inputs = ignore_inputs);

}  // namespace swell::mesh_import
