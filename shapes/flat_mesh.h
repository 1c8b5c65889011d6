// What the importer of mesh files (mesh_import/) hands to the program that asked it: a mesh as flat
// arrays, in one stream of bytes.
//
// FlatHeader; vertices; per level its indices and a material number a triangle; materials; per
// texture its texels. All numbers are little-endian, as both programs are of one machine.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace swell::shapes {

inline constexpr std::uint32_t kFlatMagic = 0x324d5753;  // "SWM2"

// Most of what a file may hold.
inline constexpr std::uint32_t kMostMeshTriangles = 10'000'000;
inline constexpr std::uint32_t kMostMeshMaterials = 1024;
inline constexpr std::uint32_t kMostMeshTextures = 64;
inline constexpr std::uint32_t kMostMeshTexels = 1u << 24;  // of all textures of a file together
inline constexpr int kMostTextureSide_px = 8192;
inline constexpr std::uint32_t kMostMeshLevels = 8;
inline constexpr std::uint64_t kMostMeshFileBytes = 512ull << 20;

struct FlatHeader {
  std::uint32_t magic = kFlatMagic;
  std::uint32_t vertices = 0, materials = 0, textures = 0;
  std::uint32_t levels = 0;                                // finest first; at most kMostMeshLevels
  std::array<std::uint32_t, kMostMeshLevels> triangles{};  // of each level
  std::array<float, kMostMeshLevels> error{};              // the same
};

// Axes right, ahead, up, in units of the file.
struct FlatVertex {
  std::array<float, 3> position{};
  std::array<float, 3> normal{};  // unit
  std::array<float, 2> uv{};      // v down
};

struct FlatMaterial {
  std::array<float, 3> colour{1.0f, 1.0f, 1.0f};  // linear reflectance, in [0, 1]
  float roughness = 1.0f, metalness = 0.0f;       // in [0, 1]
  std::int32_t texture = -1;                      // that the colour multiplies; -1: none
  std::uint32_t painted = 0;                      // 1: the file says nothing of it
};

struct FlatTexture {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint32_t> texels;  // sRGB, R in the low byte
};

struct FlatLevel {
  std::vector<std::uint32_t> indices;   // 3 a triangle
  std::vector<std::uint32_t> material;  // of each triangle
  // How far it lies from the first level, in parts of the mesh's largest side; in [0, 1e3].
  float error = 0.0f;
};

struct FlatMesh {
  std::vector<FlatVertex> vertices;
  std::vector<FlatLevel> levels;
  std::vector<FlatMaterial> materials;
  std::vector<FlatTexture> textures;
};

// Hands each piece of the stream to `write`.
template <class Write>
void write_flat_mesh(const FlatMesh& mesh, const Write& write) {
  const auto write_all = [&](const auto& values) {
    write(values.data(), values.size() * sizeof(values[0]));
  };
  FlatHeader header;
  header.vertices = static_cast<std::uint32_t>(mesh.vertices.size());
  header.materials = static_cast<std::uint32_t>(mesh.materials.size());
  header.textures = static_cast<std::uint32_t>(mesh.textures.size());
  header.levels = static_cast<std::uint32_t>(mesh.levels.size());
  for (std::size_t i = 0; i < mesh.levels.size(); ++i) {
    header.triangles[i] = static_cast<std::uint32_t>(mesh.levels[i].material.size());
    header.error[i] = mesh.levels[i].error;
  }
  write(&header, sizeof header);
  write_all(mesh.vertices);
  for (const FlatLevel& level : mesh.levels) write_all(level.indices), write_all(level.material);
  write_all(mesh.materials);
  for (const FlatTexture& texture : mesh.textures) {
    write(&texture.width, sizeof texture.width);
    write(&texture.height, sizeof texture.height);
    write_all(texture.texels);
  }
}

// The mesh in the bytes, every number of which is as the comments above say: sizes within the
// bounds, indices of what is there, finite places, and something to draw. Throws std::runtime_error
// with what is wrong.
FlatMesh read_flat_mesh(std::span<const char> bytes);

}  // namespace swell::shapes
