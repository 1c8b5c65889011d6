// Small mesh files of four formats, written by hand here: what the importer is asked in tests.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace swell {

// Triangles without common vertices, their corners against the clock from outside.
struct LooseTriangles {
  std::vector<glm::vec3> corners;
};

// A box from `low` to `high`, two triangles a side.
inline LooseTriangles box_triangles(glm::vec3 low, glm::vec3 high) {
  LooseTriangles box;
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {0, 1}) {
      std::array<glm::vec3, 4> corner;
      for (int i = 0; i < 4; ++i) {
        const int u = i == 1 || i == 2, v = i >= 2;
        corner[static_cast<std::size_t>(i)][axis] = side ? high[axis] : low[axis];
        corner[static_cast<std::size_t>(i)][(axis + 1) % 3] =
            u ? high[(axis + 1) % 3] : low[(axis + 1) % 3];
        corner[static_cast<std::size_t>(i)][(axis + 2) % 3] =
            v ? high[(axis + 2) % 3] : low[(axis + 2) % 3];
      }
      for (const auto& t : {std::array{0, 1, 2}, std::array{0, 2, 3}})
        for (int k = 0; k < 3; ++k)
          box.corners.push_back(
              corner[static_cast<std::size_t>(t[static_cast<std::size_t>(side ? k : 2 - k)])]);
    }
  }
  return box;
}

// `turn` takes the object's axes (right, ahead, up) to the file's.
using Turn = std::function<glm::vec3(glm::vec3)>;
inline glm::vec3 z_up(glm::vec3 p) { return p; }
inline glm::vec3 y_up(glm::vec3 p) { return {p.x, p.z, -p.y}; }  // OBJ, COLLADA
inline glm::vec3 gltf_up(glm::vec3 p) { return {-p.x, p.z, p.y}; }

inline void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

inline std::string number(float x) {
  std::string text = std::to_string(x);
  return text;
}

template <class T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// With a material of this colour beside it; without if `colour` is null.
inline void write_obj(const std::filesystem::path& path, const LooseTriangles& mesh,
                      const glm::vec3* colour) {
  std::string text;
  if (colour) {
    const std::filesystem::path library = std::filesystem::path(path).replace_extension(".mtl");
    write_text(library, "newmtl paint\nKd " + number(colour->x) + " " + number(colour->y) + " " +
                            number(colour->z) + "\nNs 0\n");
    text = "mtllib " + library.filename().string() + "\nusemtl paint\n";
  }
  for (const glm::vec3& c : mesh.corners) {
    const glm::vec3 p = y_up(c);
    text += "v " + number(p.x) + " " + number(p.y) + " " + number(p.z) + "\n";
  }
  for (std::size_t i = 1; i <= mesh.corners.size(); i += 3)
    text +=
        "f " + std::to_string(i) + " " + std::to_string(i + 1) + " " + std::to_string(i + 2) + "\n";
  write_text(path, text);
}

inline void write_stl(const std::filesystem::path& path, const LooseTriangles& mesh) {
  std::string bytes(80, ' ');
  append(bytes, static_cast<std::uint32_t>(mesh.corners.size() / 3));
  for (std::size_t i = 0; i < mesh.corners.size(); i += 3) {
    append(bytes, glm::vec3(0.0f));
    for (std::size_t k = 0; k < 3; ++k) append(bytes, mesh.corners[i + k]);
    append(bytes, std::uint16_t{0});
  }
  write_text(path, bytes);
}

inline void write_glb(const std::filesystem::path& path, const LooseTriangles& mesh,
                      const glm::vec3* colour) {
  std::string data;
  glm::vec3 low(1e9f), high(-1e9f);
  for (const glm::vec3& c : mesh.corners) {
    const glm::vec3 p = gltf_up(c);
    append(data, p);
    low = glm::min(low, p), high = glm::max(high, p);
  }
  const auto list = [](glm::vec3 v) {
    return "[" + number(v.x) + "," + number(v.y) + "," + number(v.z) + "]";
  };
  std::string json =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0})";
  if (colour) json += R"(,"material":0)";
  json += "}]}],";
  if (colour)
    json += R"("materials":[{"pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":1,)"
            R"("baseColorFactor":[)" +
            number(colour->x) + "," + number(colour->y) + "," + number(colour->z) + ",1]}}],";
  json += R"("accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":)" +
          std::to_string(mesh.corners.size()) + R"(,"min":)" + list(low) + R"(,"max":)" +
          list(high) + R"(}],"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":)" +
          std::to_string(data.size()) + R"(}],"buffers":[{"byteLength":)" +
          std::to_string(data.size()) + "}]}";
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string bytes = "glTF";
  append(bytes, std::uint32_t{2});
  append(bytes, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + data.size()));
  append(bytes, static_cast<std::uint32_t>(json.size()));
  bytes += "JSON" + json;
  append(bytes, static_cast<std::uint32_t>(data.size()));
  bytes += std::string("BIN\0", 4) + data;
  write_text(path, bytes);
}

// unit_m: of a unit of the file.
inline void write_dae(const std::filesystem::path& path, const LooseTriangles& mesh,
                      const glm::vec3* colour, double unit_m = 1.0, bool is_z_up = false) {
  std::string places, indices;
  for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
    const glm::vec3 p = is_z_up ? z_up(mesh.corners[i]) : y_up(mesh.corners[i]);
    places += number(p.x) + " " + number(p.y) + " " + number(p.z) + " ";
    indices += std::to_string(i) + " ";
  }
  const std::string count = std::to_string(mesh.corners.size());
  std::string text =
      R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" )"
      R"(version="1.4.1"><asset><unit meter=")" +
      std::to_string(unit_m) + R"("/><up_axis>)" + (is_z_up ? "Z_UP" : "Y_UP") +
      "</up_axis></asset>";
  if (colour)
    text += R"(<library_effects><effect id="e"><profile_COMMON><technique sid="t"><lambert>)"
            R"(<diffuse><color>)" +
            number(colour->x) + " " + number(colour->y) + " " + number(colour->z) +
            R"( 1</color></diffuse></lambert></technique></profile_COMMON></effect>)"
            R"(</library_effects><library_materials><material id="m" name="paint">)"
            R"(<instance_effect url="#e"/></material></library_materials>)";
  text +=
      R"(<library_geometries><geometry id="g"><mesh><source id="p"><float_array id="a" count=")" +
      std::to_string(3 * mesh.corners.size()) + "\">" + places +
      R"(</float_array><technique_common><accessor source="#a" stride="3" count=")" + count +
      R"("><param name="X" type="float"/><param name="Y" type="float"/>)"
      R"(<param name="Z" type="float"/></accessor></technique_common></source>)"
      R"(<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>)"
      R"(<triangles count=")" +
      std::to_string(mesh.corners.size() / 3) + "\"" + (colour ? R"( material="m")" : "") +
      R"(><input semantic="VERTEX" source="#v" offset="0"/><p>)" + indices +
      R"(</p></triangles></mesh></geometry></library_geometries><library_visual_scenes>)"
      R"(<visual_scene id="s"><node><instance_geometry url="#g">)" +
      (colour ? R"(<bind_material><technique_common><instance_material symbol="m" target="#m"/>)"
                R"(</technique_common></bind_material>)"
              : "") +
      R"(</instance_geometry></node></visual_scene></library_visual_scenes>)"
      R"(<scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
  write_text(path, text);
}

// In each format, in a folder of its own for each caller.
inline std::filesystem::path mesh_folder(const std::string& name) {
  const std::filesystem::path folder =
      std::filesystem::path(SWELL_BINARY_DIR) / "mesh_tests" / name;
  std::filesystem::create_directories(folder);
  return folder;
}

inline std::vector<std::filesystem::path> write_all_formats(const std::filesystem::path& folder,
                                                            const LooseTriangles& mesh,
                                                            const glm::vec3* colour) {
  const std::vector<std::filesystem::path> files = {folder / "a.obj", folder / "a.stl",
                                                    folder / "a.glb", folder / "a.dae"};
  write_obj(files[0], mesh, colour);
  write_stl(files[1], mesh);
  write_glb(files[2], mesh, colour);
  write_dae(files[3], mesh, colour);
  return files;
}

}  // namespace swell
