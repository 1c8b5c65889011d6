// What the writers of made-up mesh files share.
#pragma once

#include "mesh_import/generated_files.h"
#include "mesh_import/generated_shapes.h"
#include "mesh_import/mesh_files.h"

namespace swell {

inline std::string text_of(glm::vec3 p) {
  return number(p.x) + " " + number(p.y) + " " + number(p.z);
}

inline std::string join(const std::vector<std::string>& parts, const std::string& between) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : between) + part;
  return text;
}

inline std::string name_of(int n, const std::string& extension) {
  const std::string number = std::to_string(n);
  return (n % 5 == 2 ? "of number " + number : "mesh_" + number) + extension;
}

inline glm::vec3 face_normal(const PolygonShape& shape, const std::vector<std::size_t>& face) {
  const glm::vec3 a = shape.points[face[0]];
  return glm::normalize(glm::cross(shape.points[face[1]] - a, shape.points[face[2]] - a));
}

// A file that holds the shape's points, moved by `place` in the object's axes.
template <class Place>
GeneratedFile expected_of(const std::filesystem::path& path, const PolygonShape& shape,
                          const Place& place) {
  GeneratedFile file;
  file.path = path;
  file.triangles = fans_of(shape).size() / 3;
  file.low = glm::vec3(1e9f), file.high = glm::vec3(-1e9f);
  for (const glm::vec3& p : shape.points) {
    file.low = glm::min(file.low, place(p));
    file.high = glm::max(file.high, place(p));
  }
  return file;
}

// File n of a format.
GeneratedFile write_gltf_number(const std::filesystem::path& folder, int n);
GeneratedFile write_dae_number(const std::filesystem::path& folder, int n);

}  // namespace swell
