#include "mesh_import/generated_files.h"

#include <array>
#include <cstdint>

#include "mesh_import/generated_shapes.h"
#include "mesh_import/mesh_files.h"

namespace swell {
namespace {

namespace fs = std::filesystem;

std::string text_of(glm::vec3 p) { return number(p.x) + " " + number(p.y) + " " + number(p.z); }

std::string join(const std::vector<std::string>& parts, const std::string& between) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : between) + part;
  return text;
}

std::string with_returns(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '\n' ? std::string("\r\n") : std::string(1, c);
  return result;
}

std::string name_of(int n, const std::string& extension) {
  const std::string number = std::to_string(n);
  return (n % 5 == 2 ? "of number " + number : "mesh_" + number) + extension;
}

glm::vec3 face_normal(const PolygonShape& shape, const std::vector<std::size_t>& face) {
  const glm::vec3 a = shape.points[face[0]];
  return glm::normalize(glm::cross(shape.points[face[1]] - a, shape.points[face[2]] - a));
}

// A file that holds the shape's points, moved by `place` in the object's axes.
template <class Place>
GeneratedFile expected_of(const fs::path& path, const PolygonShape& shape, const Place& place) {
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

// --- glTF

std::string base64(const std::string& bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k <= bytes.size() ? kDigits[bits >> (18 - 6 * k) & 63u] : '=';
  }
  return text;
}

// What goes into a glTF file, piece by piece.
struct GltfParts {
  std::string data;
  std::vector<std::string> views, accessors, primitives;

  // Returns the accessor's number.
  std::size_t add(const std::string& bytes, int component, const std::string& type,
                  std::size_t count, const std::string& more = "") {
    data.resize((data.size() + 3) / 4 * 4, '\0');
    views.push_back(R"({"buffer":0,"byteOffset":)" + std::to_string(data.size()) +
                    R"(,"byteLength":)" + std::to_string(bytes.size()) + "}");
    accessors.push_back(R"({"bufferView":)" + std::to_string(views.size() - 1) +
                        R"(,"componentType":)" + std::to_string(component) + R"(,"type":")" + type +
                        R"(","count":)" + std::to_string(count) + more + "}");
    data += bytes;
    return accessors.size() - 1;
  }
  std::size_t add_points(const std::vector<glm::vec3>& points) {
    std::string bytes;
    glm::vec3 low(1e9f), high(-1e9f);
    for (const glm::vec3& p : points) {
      append(bytes, p);
      low = glm::min(low, p), high = glm::max(high, p);
    }
    const auto list = [](glm::vec3 v) {
      return "[" + number(v.x) + "," + number(v.y) + "," + number(v.z) + "]";
    };
    return add(bytes, 5126, "VEC3", points.size(),
               R"(,"min":)" + list(low) + R"(,"max":)" + list(high));
  }
  // Of 1, 2 or 4 bytes each.
  std::size_t add_indices(const std::vector<std::size_t>& indices, int bytes_each) {
    std::string bytes;
    for (const std::size_t i : indices) {
      const auto index = static_cast<std::uint32_t>(i);
      bytes.append(reinterpret_cast<const char*>(&index), static_cast<std::size_t>(bytes_each));
    }
    const int component = bytes_each == 1 ? 5121 : bytes_each == 2 ? 5123 : 5125;
    return add(bytes, component, "SCALAR", indices.size());
  }
};

std::string gltf_primitive(std::size_t position, const std::string& more) {
  return R"({"attributes":{"POSITION":)" + std::to_string(position) + more;
}

// All faces as one primitive, with or without indices, or a fan each.
void add_gltf_primitives(const PolygonShape& shape, int n, GltfParts& parts) {
  const std::string material = n % 2 == 0 ? R"(,"material":0})" : "}";
  std::vector<std::size_t> corners = fans_of(shape);
  std::vector<glm::vec3> points, normals;
  for (const glm::vec3& p : shape.points) points.push_back(gltf_up(p));
  if (n % 10 == 8) {
    const std::size_t position = parts.add_points(points);
    for (const auto& face : shape.faces)
      parts.primitives.push_back(gltf_primitive(
          position,
          R"(},"mode":6,"indices":)" + std::to_string(parts.add_indices(face, 2)) + material));
    return;
  }
  if (n % 4 == 0) {  // corner by corner, with normals
    std::vector<glm::vec3> loose;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::vector<std::size_t> face(
          corners.begin() + static_cast<std::ptrdiff_t>(i / 3 * 3),
          corners.begin() + static_cast<std::ptrdiff_t>(i / 3 * 3 + 3));
      loose.push_back(points[corners[i]]);
      normals.push_back(gltf_up(face_normal(shape, face)));
    }
    const std::size_t position = parts.add_points(loose);
    parts.primitives.push_back(gltf_primitive(
        position, R"(,"NORMAL":)" + std::to_string(parts.add_points(normals)) + "}" + material));
    return;
  }
  const int bytes_each = n % 4 == 3 ? 4 : n % 4 == 1 && points.size() < 150 ? 1 : 2;
  const std::size_t position = parts.add_points(points);
  const std::size_t indices = parts.add_indices(corners, bytes_each);
  parts.primitives.push_back(
      gltf_primitive(position, R"(},"indices":)" + std::to_string(indices) + material));
}

// A place of the mesh in the file's axes, and how the file says it.
struct GltfNodes {
  std::string json;
  glm::vec3 (*place)(glm::vec3);
};

GltfNodes gltf_nodes(int n) {
  switch (n % 5) {
    case 1:  // by a quarter turn about y, twice as large, moved
      return {R"([{"mesh":0,"translation":[1,2,3],"rotation":[0,0.70710678,0,0.70710678],)"
              R"("scale":[2,2,2]}])",
              [](glm::vec3 p) {
                return glm::vec3(2.0f * p.z + 1.0f, 2.0f * p.y + 2.0f, -2.0f * p.x + 3.0f);
              }};
    case 2:
      return {R"([{"mesh":0,"matrix":[1,0,0,0, 0,3,0,0, 0,0,1,0, 5,0,0,1]}])",
              [](glm::vec3 p) { return glm::vec3(p.x + 5.0f, 3.0f * p.y, p.z); }};
    case 3:
      return {R"([{"children":[1],"translation":[0,1,0]},{"children":[2],"scale":[2,1,1]},)"
              R"({"mesh":0,"translation":[1,0,0]}])",
              [](glm::vec3 p) { return glm::vec3(2.0f * (p.x + 1.0f), p.y + 1.0f, p.z); }};
    case 4:  // a mirror
      return {R"([{"mesh":0,"scale":[-1,1,1]}])",
              [](glm::vec3 p) { return glm::vec3(-p.x, p.y, p.z); }};
    default:
      return {R"([{"name":"plain","mesh":0}])", [](glm::vec3 p) { return p; }};
  }
}

std::string gltf_json(const GltfParts& parts, const GltfNodes& nodes, const std::string& uri,
                      int n) {
  const std::string buffer = uri.empty() ? "" : R"("uri":")" + uri + R"(",)";
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":)" + nodes.json +
         R"(,"meshes":[{"primitives":[)" + join(parts.primitives, ",") + "]}]," +
         (n % 2 == 0
              ? R"("materials":[{"pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,0.125,1],)"
                R"("metallicFactor":0.5}}],)"
              : "") +
         R"("accessors":[)" + join(parts.accessors, ",") + R"(],"bufferViews":[)" +
         join(parts.views, ",") + R"(],"buffers":[{)" + buffer + R"("byteLength":)" +
         std::to_string(parts.data.size()) + "}]}";
}

std::string glb_of(std::string json, std::string data) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  data.resize((data.size() + 3) / 4 * 4, '\0');
  std::string bytes = "glTF";
  append(bytes, std::uint32_t{2});
  append(bytes, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + data.size()));
  append(bytes, static_cast<std::uint32_t>(json.size()));
  bytes += "JSON" + json;
  append(bytes, static_cast<std::uint32_t>(data.size()));
  return bytes + std::string("BIN\0", 4) + data;
}

GeneratedFile write_gltf_number(const fs::path& folder, int n) {
  const PolygonShape shape = shape_number(n);
  const bool is_binary = n % 3 == 0, is_external = n % 3 == 1;
  const fs::path path = folder / name_of(n, is_binary ? ".glb" : ".gltf");
  const GltfNodes nodes = gltf_nodes(n);
  GeneratedFile file = expected_of(path, shape, [&](glm::vec3 p) {
    const glm::vec3 q = nodes.place(gltf_up(p));
    return glm::vec3(-q.x, q.z, q.y);
  });
  GltfParts parts;
  add_gltf_primitives(shape, n, parts);
  if (n == 26) file.broken = "a buffer that ends early", parts.data.resize(20);
  if (n == 29) file.broken = "places that are not there";
  std::string uri;
  if (is_external) {
    uri = "data_" + std::to_string(n) + ".bin";
    if (n != 28) write_text(folder / uri, parts.data);
    if (n == 28) file.broken = "a buffer that is not there";
  } else if (!is_binary) {
    uri = "data:application/octet-stream;base64," + base64(parts.data);
  }
  std::string text = gltf_json(parts, nodes, uri, n);
  const std::string position = "\"POSITION\":";
  if (n == 29) text.insert(text.find(position) + position.size(), "9");
  if (is_binary) text = glb_of(text, parts.data);
  if (n == 27) file.broken = "a file cut off", text.resize(text.size() / 2);
  write_text(path, text);
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

// --- COLLADA

std::string dae_source(const std::string& id, const std::vector<glm::vec3>& values) {
  std::string text = "<source id=\"" + id + "\"><float_array id=\"" + id + "_a\" count=\"" +
                     std::to_string(3 * values.size()) + "\">";
  for (const glm::vec3& v : values) text += text_of(v) + "\n";
  return text + "</float_array><technique_common><accessor source=\"#" + id + "_a\" count=\"" +
         std::to_string(values.size()) +
         "\" stride=\"3\"><param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/>"
         "<param name=\"Z\" type=\"float\"/></accessor></technique_common></source>";
}

// As triangles, as a list of polygons with their sizes, or as polygons one by one.
std::string dae_faces(const PolygonShape& shape, int n) {
  const bool has_normals = n % 2 == 1;
  const std::string inputs =
      std::string("<input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/>") +
      (has_normals ? "<input semantic=\"NORMAL\" source=\"#n\" offset=\"1\"/>" : "");
  const auto corner = [&](std::size_t vertex, std::size_t face) {
    return std::to_string(vertex) + (has_normals ? " " + std::to_string(face) : "") + " ";
  };
  std::string fans, all, sizes, single;
  std::size_t triangles = 0;
  for (std::size_t f = 0; f < shape.faces.size(); ++f) {
    const auto& face = shape.faces[f];
    single += "<p>";
    for (const std::size_t vertex : face) all += corner(vertex, f), single += corner(vertex, f);
    single += "</p>";
    sizes += std::to_string(face.size()) + " ";
    for (std::size_t k = 2; k < face.size(); ++k, ++triangles)
      fans += corner(face[0], f) + corner(face[k - 1], f) + corner(face[k], f);
  }
  const std::string material = n % 4 < 2 ? " material=\"m\"" : "";
  const auto element = [&](const std::string& name, std::size_t count, const std::string& more) {
    return "<" + name + material + " count=\"" + std::to_string(count) + "\">" + inputs + more +
           "</" + name + ">";
  };
  if (n % 3 == 0) return element("triangles", triangles, "<p>" + fans + "</p>");
  if (n % 3 == 1)
    return element("polylist", shape.faces.size(),
                   "<vcount>" + sizes + "</vcount><p>" + all + "</p>");
  return element("polygons", shape.faces.size(), single);
}

// How the file places its geometry, and what that does to a point.
struct DaeNodes {
  std::string before, after, library;
  glm::vec3 (*place)(glm::vec3);
};

DaeNodes dae_nodes(int n) {
  switch (n % 4) {
    case 1:
      return {"<node><translate>1 2 3</translate><rotate>0 0 1 90</rotate><scale>2 2 2</scale>",
              "</node>", "", [](glm::vec3 p) {
                return glm::vec3(1.0f - 2.0f * p.y, 2.0f + 2.0f * p.x, 3.0f + 2.0f * p.z);
              }};
    case 2:
      return {"<node><node><matrix>1 0 0 5 0 3 0 0 0 0 1 0 0 0 0 1</matrix>", "</node></node>", "",
              [](glm::vec3 p) { return glm::vec3(p.x + 5.0f, 3.0f * p.y, p.z); }};
    case 3:
      return {"<node><translate>0 0 -4</translate>", "</node>", "library",
              [](glm::vec3 p) { return p + glm::vec3(0.0f, 0.0f, -4.0f); }};
    default:
      return {"<node>", "</node>", "", [](glm::vec3 p) { return p; }};
  }
}

glm::vec3 x_up(glm::vec3 p) { return {p.z, -p.x, -p.y}; }

std::string dae_text(const PolygonShape& shape, const DaeNodes& nodes, const std::string& header,
                     int n) {
  std::vector<glm::vec3> normals;
  for (const auto& face : shape.faces) normals.push_back(face_normal(shape, face));
  const std::string bind = n % 4 < 2
                               ? "<bind_material><technique_common><instance_material symbol=\"m\" "
                                 "target=\"#paint\"/></technique_common></bind_material>"
                               : "";
  const std::string instance = "<instance_geometry url=\"#g\">" + bind + "</instance_geometry>";
  const bool is_shared = !nodes.library.empty();
  return "<?xml version=\"1.0\"?><COLLADA "
         "xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">" +
         header +
         "<library_effects><effect id=\"e\"><profile_COMMON><technique sid=\"t\"><phong><diffuse>"
         "<color>0.5 0.25 0.125 1</color></diffuse></phong></technique></profile_COMMON></effect>"
         "</library_effects><library_materials><material id=\"paint\" name=\"paint\">"
         "<instance_effect url=\"#e\"/></material></library_materials>"
         "<library_geometries><geometry id=\"g\"><mesh>" +
         dae_source("p", shape.points) + (n % 2 ? dae_source("n", normals) : "") +
         "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices>" +
         dae_faces(shape, n) + "</mesh></geometry></library_geometries>" +
         (is_shared ? "<library_nodes><node id=\"part\">" + instance + "</node></library_nodes>"
                    : "") +
         "<library_visual_scenes><visual_scene id=\"s\">" + nodes.before +
         (is_shared ? "<instance_node url=\"#part\"/>" : instance) + nodes.after +
         "</visual_scene></library_visual_scenes><scene><instance_visual_scene url=\"#s\"/></scene>"
         "</COLLADA>";
}

GeneratedFile write_dae_number(const fs::path& folder, int n) {
  PolygonShape shape = shape_number(n);
  const fs::path path = folder / name_of(n, ".dae");
  constexpr std::array<float, 4> kUnits_m = {1.0f, 0.01f, 0.0254f, 10.0f};
  constexpr std::array<const char*, 3> kUps = {"Y_UP", "Z_UP", "X_UP"};
  const float unit_m = kUnits_m[static_cast<std::size_t>(n / 3 % 4)];
  const auto up = static_cast<std::size_t>(n / 2 % 3);
  const DaeNodes nodes = dae_nodes(n);
  // The places are taken as they are in the file's axes, and turned back as its header says.
  const auto turned = [&](glm::vec3 p) { return up == 0 ? y_up(p) : up == 1 ? z_up(p) : x_up(p); };
  const auto back = [&](glm::vec3 q) {
    return up == 0 ? glm::vec3(q.x, -q.z, q.y) : up == 1 ? q : glm::vec3(-q.y, -q.z, q.x);
  };
  GeneratedFile file =
      expected_of(path, shape, [&](glm::vec3 p) { return unit_m * back(nodes.place(turned(p))); });
  for (glm::vec3& p : shape.points) p = turned(p);
  const std::string header = "<asset><unit name=\"unit\" meter=\"" + number(unit_m) +
                             "\"/><up_axis>" + kUps[up] + "</up_axis></asset>";
  std::string text = dae_text(shape, nodes, header, n);
  const auto replace = [&](const std::string& what, const std::string& with) {
    text.replace(text.find(what), what.size(), with);
  };
  if (n == 26) file.broken = "a file cut off", text.resize(text.size() / 2);
  if (n == 27) file.broken = "places that are not there", replace("source=\"#p\"", "source=\"#q\"");
  if (n == 28) file.broken = "an index beyond its places", replace("<p>0", "<p>99999");
  if (n == 29)
    file.broken = "no scene", replace("<scene>", "<extra>"), replace("</scene>", "</extra>");
  write_text(path, text);
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
