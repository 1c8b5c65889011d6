// Coarser levels: their outlines lie as near to the finest one's as they say.
#include <gtest/gtest.h>

#include <cmath>

#include "math/elementary.h"
#include "mesh_import/mesh_files.h"
#include "mesh_import/mesh_outline.h"
#include "shapes/mesh_file.h"

namespace swell::shapes {
namespace {

// Two points of the pictures.
double least_seen(const Outlines& outlines) {
  return 2.0 / (outlines.points_per_m() * outlines.largest_m());
}

TEST(MeshLevels, BuiltInShapesKeepTheirOutlines) {
  for (std::size_t k = 0; k < static_cast<std::size_t>(scene::ObjectKind::kMesh); ++k) {
    const auto kind = static_cast<scene::ObjectKind>(k);
    SCOPED_TRACE(scene::kObjectKindNames[k]);
    const bool is_round = kind == scene::ObjectKind::kSphere || kind == scene::ObjectKind::kBox;
    const Outlines outlines{kind == scene::ObjectKind::kPier ? 800 : 200,
                            is_round ? glm::dvec3(1.0) : common_object(kind).size_m};
    const ObjectMesh finest = make_object_mesh(kind, scene::TopMark::kSphere, kLevelSegments[0]);
    EXPECT_EQ(finest.error, 0.0f);
    float before = 0.0f;
    for (const int segments : kLevelSegments) {
      const ObjectMesh mesh = make_object_mesh(kind, scene::TopMark::kSphere, segments);
      EXPECT_GE(mesh.error, before);
      before = mesh.error;
      EXPECT_LT(outline_distance(finest, mesh, outlines, 8),
                static_cast<double>(mesh.error) + least_seen(outlines))
          << segments;
    }
  }
}

// A closed surface of rows from pole to pole.
template <class Radius>
LooseTriangles turned_body(int rows, int columns, const Radius& radius) {
  const auto point = [&](int i, int j) {
    const SinCos up = sin_cos_turns(0.5 * i / rows);
    const SinCos around = sin_cos_turns(static_cast<double>(j % columns) / columns);
    const double r = radius(static_cast<double>(i) / rows, static_cast<double>(j) / columns);
    return glm::vec3(2.0 * r * up.sin * around.cos, r * up.sin * around.sin, r * up.cos);
  };
  LooseTriangles body;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const glm::vec3 a = point(i, j), b = point(i + 1, j), c = point(i + 1, j + 1),
                      d = point(i, j + 1);
      if (i + 1 < rows) body.corners.insert(body.corners.end(), {a, b, c});
      if (i > 0) body.corners.insert(body.corners.end(), {a, c, d});
    }
  return body;
}

void add_box(glm::vec3 low, glm::vec3 high, LooseTriangles& to) {
  const LooseTriangles box = box_triangles(low, high);
  to.corners.insert(to.corners.end(), box.corners.begin(), box.corners.end());
}

TEST(MeshLevels, MeshesOfFilesKeepTheirOutlines) {
  const auto bumpy = [](double v, double u) {
    return 3.0 + 0.15 * sin(9.0 * 2.0 * kPi * u) * sin(8.0 * kPi * v);
  };
  const LooseTriangles ball = turned_body(80, 160, bumpy);
  // A hull with a mast and rails, which are thin.
  LooseTriangles ship = turned_body(60, 120, [](double, double) { return 3.0; });
  add_box({-0.05f, -0.05f, 2.5f}, {0.05f, 0.05f, 9.0f}, ship);
  for (int i = 0; i < 40; ++i) {
    const float x = -4.0f + 0.2f * static_cast<float>(i);
    add_box({x, 2.0f, 2.0f}, {x + 0.04f, 2.04f, 3.2f}, ship);
  }
  int coarser = 0;
  for (const LooseTriangles& triangles : {ball, ship}) {
    const std::filesystem::path file = mesh_folder("levels") / "a.stl";
    write_stl(file, triangles);
    const MeshOfFile mesh = load_mesh(file.string(), scene::UpAxis::kByFormat);
    const Outlines outlines{600, mesh.high - mesh.low};
    for (std::size_t level = 1; level < mesh.levels.size(); ++level, ++coarser) {
      SCOPED_TRACE(std::to_string(mesh.levels[level].triangles.size()) + " of " +
                   std::to_string(mesh.levels[0].triangles.size()) + " triangles");
      EXPECT_GT(mesh.levels[level].error, mesh.levels[level - 1].error);
      EXPECT_LT(outline_distance(mesh.levels[0], mesh.levels[level], outlines, 6),
                static_cast<double>(mesh.levels[level].error) + least_seen(outlines));
    }
  }
  EXPECT_GE(coarser, 4);
}

}  // namespace
}  // namespace swell::shapes
