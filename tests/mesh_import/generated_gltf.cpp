#include <cstdint>

#include "mesh_import/generated_parts.h"

namespace swell {
namespace {

namespace fs = std::filesystem;

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
  // Adds indices of 1, 2 or 4 bytes each.
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

}  // namespace

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

}  // namespace swell
