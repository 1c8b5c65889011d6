#include "mesh_import/generated_files.h"

#include <array>
#include <cstdint>

#include "mesh_import/generated_parts.h"

namespace swell {
namespace {

namespace fs = std::filesystem;

std::string with_returns(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '\n' ? std::string("\r\n") : std::string(1, c);
  return result;
}

// --- OBJ

struct ObjWays {
  bool negative, has_normals, has_uv, is_triangulated;
};

// Corner k of a face whose vertices are numbered from 0.
std::string obj_corner(const ObjWays& ways, std::size_t vertex, std::size_t face,
                       const PolygonShape& shape) {
  const auto index = [&](std::size_t i, std::size_t count) {
    return std::to_string(static_cast<long>(i) + (ways.negative ? -static_cast<long>(count) : 1));
  };
  const std::string v = index(vertex, shape.points.size());
  const std::string t = ways.has_uv ? index(vertex, shape.points.size()) : "";
  const std::string normal = ways.has_normals ? index(face, shape.faces.size()) : "";
  if (ways.has_normals) return v + "/" + t + "/" + normal;
  return ways.has_uv ? v + "/" + t : v;
}

std::string obj_faces(const ObjWays& ways, const PolygonShape& shape, int n) {
  std::string text;
  for (std::size_t f = 0; f < shape.faces.size(); ++f) {
    const auto& face = shape.faces[f];
    std::vector<std::string> corners;
    for (const std::size_t vertex : face) corners.push_back(obj_corner(ways, vertex, f, shape));
    if (n % 6 == 4 && f == face.size() / 2) text += "usemtl other\ng part two\ns off\n";
    if (!ways.is_triangulated) {
      text += "f " + join(corners, n == 10 ? " \\\n " : " ") + "\n";
      continue;
    }
    for (std::size_t k = 2; k < corners.size(); ++k)
      text += "f " + corners[0] + "  " + corners[k - 1] + "\t" + corners[k] + "\n";
  }
  return text;
}

GeneratedFile write_obj_number(const fs::path& folder, int n) {
  const PolygonShape shape = shape_number(n);
  const fs::path path = folder / name_of(n, n == 9 ? ".OBJ" : ".obj");
  GeneratedFile file = expected_of(path, shape, z_up);
  const ObjWays ways{n % 2 == 1, n % 4 == 1, n % 3 == 1, n % 3 == 0};
  std::string text = "# made up\n";
  if (n % 2 == 0) {
    const std::string library = name_of(n, ".mtl");
    write_text(folder / library,
               "newmtl paint\nKd 0.5 0.25 0.125\nNs 40\n\nnewmtl other\nKd 1 1 1\nd 0.5\n");
    text += "mtllib " + library + "\nusemtl paint\n";
  }
  if (n % 3 == 2) text += "o thing\n\n";
  for (const glm::vec3& p : shape.points) {
    text += "v " + text_of(y_up(p)) + (n == 14 ? " 1 0.5 0" : n == 16 ? " 1.0" : "") + "\n";
    if (ways.has_uv) text += "vt " + number(0.1f * p.x) + " " + number(0.1f * p.y) + "\n";
  }
  if (ways.has_normals)
    for (const auto& face : shape.faces)
      text += "vn " + text_of(y_up(face_normal(shape, face))) + "\n";
  text += obj_faces(ways, shape, n);
  if (n % 7 == 3) text += "f 1 1 2\nl 1 2\np 3\n";
  if (n == 26) file.broken = "a vertex that is no place", text = "v nan 0 0\n" + text;
  if (n == 27) file.broken = "no faces", text = text.substr(0, text.find("\nf "));
  if (n == 28)
    file.broken = "all faces of vertices that are not there", text = "v 0 0 0\nf 4 5 6\nf 7 8 9\n";
  if (n == 29) file.broken = "bytes of anything", text = std::string("\0\1\2f\xff\n\n\n", 8);
  if (n == 26) text += "f -1 -2 1\n";
  write_text(path, n % 6 == 3 ? with_returns(text) : text);
  return file;
}

// --- STL

std::string binary_stl(const PolygonShape& shape, int n) {
  const std::vector<std::size_t> corners = fans_of(shape);
  std::string bytes = n % 6 == 3 ? "solid of bytes" : "made up";
  bytes.resize(80, n % 4 == 1 ? '\0' : ' ');
  append(bytes, static_cast<std::uint32_t>(corners.size() / 3));
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (i % 3 == 0) append(bytes, glm::vec3(0.0f, 0.0f, n % 2 ? 1.0f : 0.0f));
    append(bytes, shape.points[corners[i]]);
    if (i % 3 == 2) append(bytes, static_cast<std::uint16_t>(n % 6 == 5 ? 0x8123 : 0));
  }
  return bytes;
}

std::string ascii_stl(const PolygonShape& shape, int n) {
  const std::vector<std::size_t> corners = fans_of(shape);
  const std::string indent = n % 4 == 0 ? "\t" : "  ";
  std::string text = n % 3 == 0 ? "solid\n" : "solid thing made up\n";
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    if (n % 6 == 2 && i == corners.size() / 6 * 3) text += "endsolid\nsolid another\n";
    text +=
        indent + "facet normal 0 0 " + (n % 4 == 2 ? "1e0" : "0") + "\n" + indent + "outer loop\n";
    for (std::size_t k = 0; k < 3; ++k)
      text += indent + indent + "vertex " + text_of(shape.points[corners[i + k]]) + "\n";
    text += indent + "endloop\n" + indent + "endfacet\n";
  }
  return text + "endsolid\n";
}

GeneratedFile write_stl_number(const fs::path& folder, int n) {
  PolygonShape shape = shape_number(n);
  const fs::path path = folder / name_of(n, n == 9 ? ".STL" : ".stl");
  GeneratedFile file = expected_of(path, shape, z_up);
  if (n % 7 == 3) shape.faces.push_back({0, 0, 1});
  std::string text = n % 2 ? binary_stl(shape, n) : ascii_stl(shape, n);
  if (n == 26) file.broken = "no facets", text = "solid nothing\nendsolid nothing\n";
  if (n == 27) file.broken = "a file cut off", text.resize(text.size() / 2);
  if (n == 28)
    file.broken = "facets of a point each", text = ascii_stl({{{1, 2, 3}}, {{0, 0, 0}}}, 0);
  if (n == 29) file.broken = "more facets said than there are", text[83] = '\x7f';
  write_text(path, n % 6 == 4 ? with_returns(text) : text);
  return file;
}

}  // namespace

std::vector<GeneratedFile> generate_mesh_files(const fs::path& folder) {
  std::vector<GeneratedFile> files;
  constexpr std::array kWriters = {write_obj_number, write_gltf_number, write_stl_number,
                                   write_dae_number};
  for (const auto& write : kWriters)
    for (int n = 0; n < kGeneratedFiles; ++n) files.push_back(write(folder, n));
  return files;
}

}  // namespace swell
