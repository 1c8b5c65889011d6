#include <array>

#include "mesh_import/generated_parts.h"

namespace swell {
namespace {

namespace fs = std::filesystem;

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

}  // namespace

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

}  // namespace swell
