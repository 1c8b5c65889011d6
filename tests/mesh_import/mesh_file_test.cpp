// Meshes of files: the same box of four formats, units and axes, levels, textures, refusals.
#include "shapes/mesh_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>
#include <string>
#include <tuple>

#include "math/elementary.h"
#include "mesh_import/mesh_files.h"
#include "shapes/flat_mesh.h"
#include "texture/image/image_io.h"

namespace swell::shapes {
namespace {

namespace fs = std::filesystem;

const glm::vec3 kLow(-1.0f, -3.0f, -0.5f), kHigh(2.0f, 4.0f, 1.5f);
const glm::vec3 kColour(0.25f, 0.5f, 0.125f);

// A corner in units of the file, in the object's axes.
glm::vec3 corner(const MeshOfFile& mesh, const ObjectMesh& level, std::size_t i) {
  const glm::vec3 q = level.position[level.indices[i]];
  const glm::vec3 low(mesh.low), size(mesh.high - mesh.low);
  return low + (q + glm::vec3(0.5f, 0.5f, 0.0f)) * size;
}

// The triangles as sets of corners, whatever their order.
using Place = std::tuple<long, long, long>;
std::multiset<std::multiset<Place>> triangles_of(const MeshOfFile& mesh) {
  std::multiset<std::multiset<Place>> triangles;
  const ObjectMesh& level = mesh.levels.front();
  for (std::size_t i = 0; i < level.indices.size(); i += 3) {
    std::multiset<Place> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::vec3 p = corner(mesh, level, i + k) * 1000.0f;
      corners.emplace(std::lround(p.x), std::lround(p.y), std::lround(p.z));
    }
    triangles.insert(corners);
  }
  return triangles;
}

std::string refusal(const fs::path& file) {
  try {
    load_mesh(file.string(), scene::UpAxis::kByFormat);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return {};
}

TEST(MeshFile, ABoxOfEveryFormatHasTheSameTwelveTrianglesAndNormals) {
  const auto files = write_all_formats(mesh_folder("box"), box_triangles(kLow, kHigh), &kColour);
  const auto expected = triangles_of(load_mesh(files[1].string(), scene::UpAxis::kByFormat));
  ASSERT_EQ(expected.size(), 12u);
  for (const fs::path& file : files) {
    SCOPED_TRACE(file);
    const MeshOfFile mesh = load_mesh(file.string(), scene::UpAxis::kByFormat);
    EXPECT_LT(glm::distance(mesh.low, glm::dvec3(kLow)), 1e-6);
    EXPECT_LT(glm::distance(mesh.high, glm::dvec3(kHigh)), 1e-6);
    EXPECT_EQ(triangles_of(mesh), expected);
    const ObjectMesh& level = mesh.levels.front();
    for (std::size_t i = 0; i < level.triangles.size(); ++i) {
      const ObjectTriangle& t = level.triangles[i];
      // Away from the box's middle, along one axis.
      glm::vec3 middle(0.0f, 0.0f, -0.5f);
      for (std::size_t k = 0; k < 3; ++k) middle += level.position[level.indices[3 * i + k]] / 3.0f;
      int axis = 0;
      for (int c = 1; c < 3; ++c)
        if (std::abs(middle[c]) > std::abs(middle[axis])) axis = c;
      glm::vec3 out(0.0f);
      out[axis] = middle[axis] > 0.0f ? 1.0f : -1.0f;
      EXPECT_LT(glm::distance(t.normal_at_origin, out), 1e-5f);
      EXPECT_LT(glm::distance(t.flat_normal, out), 1e-5f);
      EXPECT_LT(glm::length(t.normal_along_x) + glm::length(t.normal_along_y) +
                    glm::length(t.normal_along_z),
                1e-4f);
      // STL has no materials: the object paints it.
      EXPECT_EQ(t.painted, file.extension() == ".stl");
      if (!t.painted) {
        EXPECT_LT(glm::distance(t.tint, kColour), 1e-5f);
        EXPECT_EQ(t.metalness, 0.0f);
        EXPECT_EQ(t.roughness, 1.0f);
      }
    }
  }
}

TEST(MeshFile, WithoutAMaterialTheObjectPaintsIt) {
  for (const fs::path& file :
       write_all_formats(mesh_folder("plain"), box_triangles(kLow, kHigh), nullptr)) {
    const MeshOfFile mesh = load_mesh(file.string(), scene::UpAxis::kByFormat);
    for (const ObjectTriangle& t : mesh.levels[0].triangles) EXPECT_TRUE(t.painted) << file;
  }
}

TEST(MeshFile, UnitsAndAxesAreThoseOfTheFileOrTheKey) {
  const fs::path folder = mesh_folder("axes");
  const LooseTriangles box = box_triangles(kLow, kHigh);
  const auto box_of = [&](const fs::path& file, scene::UpAxis up) {
    const MeshOfFile mesh = load_mesh(file.string(), up);
    return std::pair(mesh.low, mesh.high);
  };
  const auto expect_box = [&](const auto& found, glm::dvec3 low, glm::dvec3 high) {
    EXPECT_LT(glm::distance(found.first, low), 1e-5);
    EXPECT_LT(glm::distance(found.second, high), 1e-5);
  };
  write_dae(folder / "cm.dae", box, nullptr, 0.01);
  expect_box(box_of(folder / "cm.dae", scene::UpAxis::kByFormat), 0.01 * glm::dvec3(kLow),
             0.01 * glm::dvec3(kHigh));
  write_dae(folder / "z.dae", box, nullptr, 1.0, true);
  expect_box(box_of(folder / "z.dae", scene::UpAxis::kByFormat), kLow, kHigh);
  write_stl(folder / "a.stl", box);
  expect_box(box_of(folder / "a.stl", scene::UpAxis::kZ), kLow, kHigh);
  // Its z taken for what lies behind: x, -z, y.
  expect_box(box_of(folder / "a.stl", scene::UpAxis::kY), {kLow.x, -kHigh.z, kLow.y},
             {kHigh.x, -kLow.z, kHigh.y});
}

TEST(MeshFile, AnObjectTakesItsSizeFromTheFile) {
  const fs::path file = mesh_folder("fit") / "a.stl";
  write_stl(file, box_triangles(kLow, kHigh));
  const MeshOfFile mesh = load_mesh(file.string(), scene::UpAxis::kByFormat);
  scene::FloatingObject object = common_object(scene::ObjectKind::kMesh);
  object.scale = 2.0;
  object.draught = 0.3;
  fit_object(mesh, object);
  EXPECT_LT(glm::distance(object.size_m, glm::dvec3(6.0, 14.0, 4.0)), 1e-5);
  EXPECT_EQ(object.draught, 0.3);
  EXPECT_EQ(object.middle_m, glm::dvec2(0.0));
  object.at_file_origin = true;
  fit_object(mesh, object);
  EXPECT_NEAR(object.draught, 0.25, 1e-6);  // 1 m of 4 lies below the file's origin
  EXPECT_LT(glm::distance(object.middle_m, glm::dvec2(1.0, 1.0)), 1e-5);
  object.scale = 1000.0;
  EXPECT_THROW(fit_object(mesh, object), std::runtime_error);
}

// A ball's normals are its radii, where its facets meet at less than 40 degrees.
TEST(MeshFile, WhereTheFileHasNoNormalsSmoothPartsGetThem) {
  LooseTriangles ball;
  const auto point = [](int i, int j) {
    const SinCos up = sin_cos_turns(i / 64.0), around = sin_cos_turns(j / 64.0);
    return glm::vec3(up.sin * around.cos, up.sin * around.sin, up.cos);
  };
  for (int i = 0; i < 32; ++i) {
    for (int j = 0; j < 64; ++j) {
      const glm::vec3 a = point(i, j), b = point(i + 1, j), c = point(i + 1, j + 1),
                      d = point(i, j + 1);
      if (i < 31) ball.corners.insert(ball.corners.end(), {a, b, c});
      if (i > 0) ball.corners.insert(ball.corners.end(), {a, c, d});
    }
  }
  const fs::path file = mesh_folder("ball") / "a.stl";
  write_stl(file, ball);
  const MeshOfFile mesh = load_mesh(file.string(), scene::UpAxis::kByFormat);
  const ObjectMesh& level = mesh.levels.front();
  EXPECT_EQ(level.triangles.size(), ball.corners.size() / 3);
  for (std::size_t i = 0; i < level.triangles.size(); ++i) {
    const ObjectTriangle& t = level.triangles[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::vec3 q = level.position[level.indices[3 * i + k]];
      const glm::vec3 n = t.normal_at_origin + q.x * t.normal_along_x + q.y * t.normal_along_y +
                          q.z * t.normal_along_z;
      EXPECT_LT(glm::distance(n, 2.0f * (q - glm::vec3(0.0f, 0.0f, 0.5f))), 0.02f);
    }
  }
  // Coarser levels are of the same ball.
  ASSERT_GE(mesh.levels.size(), 2u);
  for (std::size_t n = 1; n < mesh.levels.size(); ++n) {
    const ObjectMesh& coarse = mesh.levels[n];
    EXPECT_LT(2 * coarse.triangles.size(), mesh.levels[n - 1].triangles.size() + 1);
    double volume = 0.0;
    for (std::size_t i = 0; i < coarse.indices.size(); i += 3) {
      const auto p = [&](std::size_t k) {
        return glm::dvec3(coarse.position[coarse.indices[i + k]]);
      };
      volume += glm::dot(p(0), glm::cross(p(1), p(2))) / 6.0;
    }
    EXPECT_NEAR(volume / (kPi / 6.0), 1.0, 0.1) << n;
  }
}

TEST(MeshFile, APictureLiesWhereItsCoordinatesSay) {
  const fs::path folder = mesh_folder("picture");
  texture::Image8 image{2, 2, 3, {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255}};
  texture::write_file(folder / "four.png", texture::encode_image(image, ".png"));
  write_text(folder / "a.mtl", "newmtl m\nKd 1 1 1\nmap_Kd four.png\n");
  write_text(folder / "a.obj",
             "mtllib a.mtl\nv 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
             "usemtl m\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n");
  const MeshOfFile mesh = load_mesh((folder / "a.obj").string(), scene::UpAxis::kByFormat);
  const ObjectMesh& level = mesh.levels.front();
  ASSERT_EQ(level.textured.size(), 2u);
  ASSERT_EQ(level.textures->size(), 1u);
  // Seen upright the picture's first texel, red, is at the top left.
  const auto colour_at = [&](glm::vec3 q, const TriangleTexture& t) {
    const glm::vec4 p(1.0f, q.x, q.y, q.z);
    return texture::sample((*level.textures)[0], glm::dot(t.u, p), glm::dot(t.v, p), 0.0f);
  };
  for (const TriangleTexture& t : level.textured) {
    EXPECT_LT(glm::distance(colour_at({-0.25f, 0.0f, 0.75f}, t), glm::vec3(1, 0, 0)), 1e-4f);
    EXPECT_LT(glm::distance(colour_at({0.25f, 0.0f, 0.75f}, t), glm::vec3(0, 1, 0)), 1e-4f);
    EXPECT_LT(glm::distance(colour_at({-0.25f, 0.0f, 0.25f}, t), glm::vec3(0, 0, 1)), 1e-4f);
    EXPECT_LT(glm::distance(colour_at({0.25f, 0.0f, 0.25f}, t), glm::vec3(1, 1, 1)), 1e-4f);
  }
}

TEST(MeshFile, WhatCannotBeReadIsRefusedInOneLine) {
  const fs::path folder = mesh_folder("bad");
  write_text(folder / "empty.obj", "");
  write_text(folder / "points.obj", "v 0 0 0\nv 1 1 1\np 1 2\n");
  write_text(folder / "line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  write_text(folder / "nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write_text(folder / "broken.gltf", "{\"asset\":{\"version\":\"2.0\"");
  write_text(folder / "broken.glb", "glTF\x02");
  write_text(folder / "broken.dae", "<COLLADA><asset>");
  write_text(folder / "short.stl", std::string(80, ' ') + std::string("\xff\xff\xff\x7f", 4));
  write_text(folder / "a.blend", "BLENDER");
  write_text(folder / "outside.mtl", "newmtl m\nmap_Kd ../../../../etc/hostname\n");
  write_text(folder / "outside.obj",
             "mtllib outside.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n");
  for (const char* const name :
       {"empty.obj", "points.obj", "line.obj", "nan.obj", "broken.gltf", "broken.glb", "broken.dae",
        "short.stl", "a.blend", "outside.obj", "missing.obj"}) {
    const std::string fault = refusal(folder / name);
    EXPECT_NE(fault, "") << name;
    EXPECT_EQ(fault.find('\n'), std::string::npos) << name;
    EXPECT_LT(fault.size(), 400u) << name;
  }
  EXPECT_NE(refusal(folder / "a.blend").find("allowed .obj, .gltf"), std::string::npos);
}

// Readers open a file more than once, and what is left over at its end costs nothing.
TEST(MeshFile, CountsOnceHoweverOftenItIsOpened) {
  const fs::path file = mesh_folder("large") / "a.glb";
  write_glb(file, box_triangles(kLow, kHigh), nullptr);
  fs::resize_file(file, kMostMeshFileBytes);
  EXPECT_EQ(refusal(file), "");
  fs::resize_file(file, kMostMeshFileBytes + 1);
  EXPECT_EQ(refusal(file), "a file of over 512 MiB, allowed 512 MiB");
  fs::remove(file);
}

#ifdef SWELL_SANITIZED
constexpr int kRows = 100, kColumns = 200;  // checked builds are slow
#else
constexpr int kRows = 500, kColumns = 1000;
#endif

// 1,000,000 triangles of a bumpy ball. Alone it takes 2.4 s on two cores.
TEST(MeshFile, AMillionTrianglesLoadInFiveSeconds) {
  LooseTriangles ball;
  std::vector<glm::vec3> point;
  for (int i = 0; i <= kRows; ++i)
    for (int j = 0; j < kColumns; ++j) {
      const SinCos up = sin_cos_turns(0.5 * i / kRows);
      const SinCos around = sin_cos_turns(static_cast<double>(j) / kColumns);
      const double r = 3.0 + 0.1 * sin(18.0 * j * kPi / kColumns) * up.sin;
      point.emplace_back(r * up.sin * around.cos, r * up.sin * around.sin, r * up.cos);
    }
  for (int i = 0; i < kRows; ++i)
    for (int j = 0; j < kColumns; ++j) {
      const int a = i * kColumns + j, b = i * kColumns + (j + 1) % kColumns;
      for (const int k : {a, a + kColumns, b + kColumns, a, b + kColumns, b})
        ball.corners.push_back(point[static_cast<std::size_t>(k)]);
    }
  const fs::path file = mesh_folder("million") / "a.stl";
  write_stl(file, ball);
  const auto start = std::chrono::steady_clock::now();
  const MeshOfFile mesh = load_mesh(file.string(), scene::UpAxis::kByFormat);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  // The poles' triangles have no area.
  EXPECT_EQ(mesh.levels.front().triangles.size(), std::size_t{2} * kColumns * (kRows - 1));
  EXPECT_GE(mesh.levels.size(), 3u);
  RecordProperty("seconds", std::to_string(taken.count()));
  // A machine with other work is slower.
  EXPECT_LT(taken.count(), 30.0);
  fs::remove(file);
}

}  // namespace
}  // namespace swell::shapes
