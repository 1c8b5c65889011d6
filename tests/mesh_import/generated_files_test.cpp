// 30 made-up files of each format: each is read as what was written, or refused in one line.
#include "mesh_import/generated_files.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "mesh_import/mesh_files.h"
#include "shapes/mesh_file.h"

namespace swell::shapes {
namespace {

TEST(GeneratedFiles, EachIsReadAsItWasWrittenOrRefusedInOneLine) {
  int read = 0, refused = 0;
  for (const GeneratedFile& file : generate_mesh_files(mesh_folder("generated"))) {
    SCOPED_TRACE(file.path.filename().string() + " " + file.broken);
    try {
      const MeshOfFile mesh = load_mesh(file.path.string(), scene::UpAxis::kByFormat);
      ++read;
      ASSERT_EQ(file.broken, "");
      EXPECT_EQ(mesh.levels.front().triangles.size(), file.triangles);
      const double size = glm::length(glm::dvec3(file.high - file.low));
      EXPECT_LT(glm::distance(mesh.low, glm::dvec3(file.low)), 2e-5 * size + 1e-6);
      EXPECT_LT(glm::distance(mesh.high, glm::dvec3(file.high)), 2e-5 * size + 1e-6);
    } catch (const std::runtime_error& error) {
      ++refused;
      const std::string fault = error.what();
      EXPECT_NE(file.broken, "") << fault;
      EXPECT_NE(fault, "");
      EXPECT_EQ(fault.find('\n'), std::string::npos);
      EXPECT_LT(fault.size(), 400u);
    }
  }
  EXPECT_EQ(read + refused, 4 * kGeneratedFiles);
  EXPECT_GT(refused, 10);
}

}  // namespace
}  // namespace swell::shapes
