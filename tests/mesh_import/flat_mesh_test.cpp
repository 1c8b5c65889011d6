// What comes from the importer is believed in nothing.
#include "shapes/flat_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>

#include "math/random.h"

namespace swell::shapes {
namespace {

FlatMesh small_mesh() {
  FlatMesh mesh;
  for (int i = 0; i < 4; ++i) {
    const auto x = static_cast<float>(i);
    mesh.vertices.push_back({{x, x * x, 1.0f - x}, {0.0f, 0.0f, 1.0f}, {0.25f * x, 0.5f}});
  }
  mesh.levels = {{{0, 1, 2, 1, 2, 3}, {0, 1}}, {{0, 1, 3}, {1}}};
  mesh.materials = {{}, {{0.5f, 0.25f, 1.0f}, 0.5f, 1.0f, 0, 0}};
  mesh.textures = {{2, 1, {0xff00ff00u, 0xff112233u}}};
  return mesh;
}

std::vector<char> stream_of(const FlatMesh& mesh) {
  std::vector<char> bytes;
  write_flat_mesh(mesh, [&](const void* from, std::size_t size) {
    const char* const first = static_cast<const char*>(from);
    bytes.insert(bytes.end(), first, first + size);
  });
  return bytes;
}

TEST(FlatMesh, ComesBackAsItWasWritten) {
  const FlatMesh mesh = small_mesh(), back = read_flat_mesh(stream_of(mesh));
  ASSERT_EQ(back.vertices.size(), 4u);
  EXPECT_EQ(back.vertices[3].position, mesh.vertices[3].position);
  EXPECT_EQ(back.vertices[2].uv, mesh.vertices[2].uv);
  ASSERT_EQ(back.levels.size(), 2u);
  EXPECT_EQ(back.levels[1].indices, mesh.levels[1].indices);
  EXPECT_EQ(back.levels[0].material, mesh.levels[0].material);
  EXPECT_EQ(back.materials[1].colour, mesh.materials[1].colour);
  EXPECT_EQ(back.textures[0].texels, mesh.textures[0].texels);
}

TEST(FlatMesh, EveryNumberThatIsWrongIsRefused) {
  const std::function<void(FlatMesh&)> faults[] = {
      [](FlatMesh& m) { m.levels[0].indices[4] = 4; },
      [](FlatMesh& m) { m.levels[1].material[0] = 2; },
      [](FlatMesh& m) { m.materials[0].texture = 1; },
      [](FlatMesh& m) { m.materials[0].texture = -2; },
      [](FlatMesh& m) { m.materials[1].roughness = NAN; },
      [](FlatMesh& m) { m.materials[1].colour[2] = 1.5f; },
      [](FlatMesh& m) { m.vertices[1].position[0] = INFINITY; },
      [](FlatMesh& m) { m.vertices[1].normal[1] = NAN; },
      [](FlatMesh& m) { m.vertices[1].uv[1] = NAN; },
      [](FlatMesh& m) { m.levels.clear(); },
      [](FlatMesh& m) { m.materials.clear(); },
      [](FlatMesh& m) { m.textures[0].width = 3; },
      [](FlatMesh& m) { m.textures[0].height = 0; },
  };
  for (std::size_t i = 0; i < std::size(faults); ++i) {
    FlatMesh mesh = small_mesh();
    faults[i](mesh);
    EXPECT_THROW(read_flat_mesh(stream_of(mesh)), std::runtime_error) << i;
  }
}

TEST(FlatMesh, AStreamOfAnyOtherLengthIsRefused) {
  const std::vector<char> whole = stream_of(small_mesh());
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_THROW(read_flat_mesh(std::span(whole).first(size)), std::runtime_error) << size;
  std::vector<char> longer = whole;
  longer.push_back(0);
  EXPECT_THROW(read_flat_mesh(longer), std::runtime_error);
}

TEST(FlatMesh, ChangedBytesGiveAMeshThatIsWholeOrAreRefused) {
  const std::vector<char> whole = stream_of(small_mesh());
  for (std::uint64_t i = 0; i < 20000; ++i) {
    std::vector<char> bytes = whole;
    for (std::uint64_t k = 0; k < 1 + i % 4; ++k) {
      const auto at =
          static_cast<std::size_t>(random_uniform(i, 2 * k) * static_cast<double>(bytes.size()));
      bytes[at] = static_cast<char>(static_cast<int>(256.0 * random_uniform(i, 2 * k + 1)));
    }
    try {
      const FlatMesh mesh = read_flat_mesh(bytes);
      for (const FlatLevel& level : mesh.levels)
        for (const std::uint32_t index : level.indices) ASSERT_LT(index, mesh.vertices.size());
    } catch (const std::runtime_error&) {
    }
  }
}

}  // namespace
}  // namespace swell::shapes
