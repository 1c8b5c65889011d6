// Mesh files, through the importer's code: a letter for the format, then the file. What the
// importer writes of a file that it takes is what its reader takes.
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "fuzz/expect.h"
#include "fuzz/scratch_parent.h"
#include "mesh_import/asset_file.h"
#include "mesh_import/asset_textures.h"
#include "mesh_import/flatten_mesh.h"
#include "shapes/flat_mesh.h"

namespace swell::fuzz {
namespace {

std::string name_of(char letter) {
  switch (letter) {
    case 'g':
      return "mesh.gltf";
    case 'b':
      return "mesh.glb";
    case 's':
      return "mesh.stl";
    case 'd':
      return "mesh.dae";
    default:
      return "mesh.obj";
  }
}

// As swell_mesh_import does it.
std::vector<char> import(const std::filesystem::path& file) {
  mesh_import::LooseMesh loose = mesh_import::read_asset(file, scene::UpAxis::kByFormat);
  mesh_import::add_normals(loose);
  shapes::FlatMesh flat;
  mesh_import::join_vertices(loose, flat);
  flat.textures = mesh_import::decode_textures(loose.textures, file.parent_path());
  mesh_import::add_levels(flat);
  std::vector<char> stream;
  shapes::write_flat_mesh(flat, [&](const void* bytes, std::size_t size) {
    const char* const from = static_cast<const char*>(bytes);
    stream.insert(stream.end(), from, from + size);
  });
  return stream;
}

void read_mesh(std::span<const char> input) {
  static const ScratchFolder folder(scratch_parent());
  if (input.empty()) return;
  const auto file =
      folder.write(name_of(input[0]), std::string_view(input.begin() + 1, input.end()));
  std::vector<char> stream;
  try {
    stream = import(file);
  } catch (const mesh_import::Refused&) {
    return;
  }
  shapes::read_flat_mesh(stream);
}

}  // namespace
}  // namespace swell::fuzz

// Assimp leaves some of a broken file's parts behind, in a process that ends with the file.
extern "C" const char* __lsan_default_suppressions() { return "leak:libassimp"; }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  swell::fuzz::read_mesh({reinterpret_cast<const char*>(data), size});
  return 0;
}
