#include "mesh_import/asset_file.h"

#include <assimp/BaseImporter.h>
#include <assimp/DefaultIOSystem.h>
#include <assimp/GltfMaterial.h>
#include <assimp/importerdesc.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstring>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <set>

namespace swell::mesh_import {
namespace {

namespace fs = std::filesystem;
using scene::UpAxis;
using shapes::FlatMaterial;
using shapes::FlatVertex;

template <class... T>
[[noreturn]] void refuse(fmt::format_string<T...> text, T&&... values) {
  throw Refused(fmt::format(text, std::forward<T>(values)...));
}

// --- Files

// Opens regular files in one folder and below, of a bounded size together.
class OneFolder : public Assimp::DefaultIOSystem {
 public:
  OneFolder(const fs::path& folder, const InputCounter& count_inputs)
      : folder_(fs::weakly_canonical(folder)), count_inputs_(count_inputs) {}

  bool Exists(const char* file) const override { return !allowed_path(file).empty(); }

  Assimp::IOStream* Open(const char* file, const char* mode) override {
    const fs::path path = allowed_path(file);
    if (mode[0] != 'r' || path.empty()) return nullptr;
    std::error_code error;
    const std::uint64_t bytes = fs::file_size(path, error);
    if (error) return nullptr;
    const bool is_first = opened_.insert(path).second;  // readers open a file more than once
    if (is_first) taken_ += bytes;
    if (taken_ > shapes::kMostMeshFileBytes) return nullptr;
    if (is_first) count_inputs_(bytes);
    return DefaultIOSystem::Open(file, "rb");
  }

 private:
  fs::path allowed_path(const char* file) const {  // empty: of no file that may be opened
    std::error_code error;
    const fs::path path = fs::canonical(file, error);
    if (error || !fs::is_regular_file(path, error)) return {};
    return std::ranges::mismatch(folder_, path).in1 == folder_.end() ? path : fs::path();
  }

  fs::path folder_;
  InputCounter count_inputs_;
  std::set<fs::path> opened_;
  std::uint64_t taken_ = 0;
};

std::string extension_of(const fs::path& file) {
  std::string text = file.extension().string();
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text.empty() ? text : text.substr(1);
}

// So that no other format's reader has a look at the file.
void keep_readers_of(const std::string& extension, Assimp::Importer& importer) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    const std::string theirs =
        std::string(" ") + importer.GetImporterInfo(i)->mFileExtensions + " ";
    if (theirs.find(" " + extension + " ") == std::string::npos)
      importer.UnregisterLoader(importer.GetImporter(i));  // left behind: the process ends soon
  }
}

// --- Materials

// Whether the library has put it there for meshes without one: of glTF nameless and the last.
bool is_default(const aiScene& scene, unsigned material) {
  aiString name;
  const bool is_named =
      scene.mMaterials[material]->Get(AI_MATKEY_NAME, name) == AI_SUCCESS && name.length > 0;
  if (is_named) return name == aiString(AI_DEFAULT_MATERIAL_NAME);
  return material + 1 == scene.mNumMaterials;
}

FlatMaterial material_of(const aiMaterial& from) {
  FlatMaterial to;
  aiColor4D colour(1.0f, 1.0f, 1.0f, 1.0f);
  if (from.Get(AI_MATKEY_BASE_COLOR, colour) != AI_SUCCESS)
    from.Get(AI_MATKEY_COLOR_DIFFUSE, colour);
  const auto part = [](float x) { return x >= 0.0f ? std::min(x, 1.0f) : 0.0f; };  // nor NaN
  to.colour = {part(colour.r), part(colour.g), part(colour.b)};
  float number = 0.0f;
  if (from.Get(AI_MATKEY_METALLIC_FACTOR, number) == AI_SUCCESS) to.metalness = part(number);
  int model = aiShadingMode_Gouraud;
  from.Get(AI_MATKEY_SHADING_MODEL, model);
  const bool has_highlight = model == aiShadingMode_Phong || model == aiShadingMode_Blinn;
  if (from.Get(AI_MATKEY_ROUGHNESS_FACTOR, number) == AI_SUCCESS) {
    to.roughness = part(number);
  } else if (has_highlight && from.Get(AI_MATKEY_SHININESS, number) == AI_SUCCESS &&
             number > 0.0f) {
    // The exponent of Blinn and Phong's highlight as wide as that of the roughness r: 2 / r^4 - 2.
    to.roughness = part(std::sqrt(std::sqrt(2.0f / (number + 2.0f))));
  }
  return to;
}

// What lies on a material, once for all materials that have it.
class Textures {
 public:
  Textures(const aiScene& scene, fs::path folder) : scene_(scene), folder_(std::move(folder)) {}

  std::int32_t add(const aiMaterial& material) {
    aiString name;
    if (material.GetTexture(aiTextureType_BASE_COLOR, 0, &name) != AI_SUCCESS &&
        material.GetTexture(aiTextureType_DIFFUSE, 0, &name) != AI_SUCCESS)
      return -1;
    const auto [found, is_new] =
        numbers_.try_emplace(name.C_Str(), static_cast<std::int32_t>(sources_.size()));
    if (is_new) sources_.push_back(source_of(name.C_Str()));
    if (sources_.size() > shapes::kMostMeshTextures)
      refuse("over {0} textures, allowed {0}", shapes::kMostMeshTextures);
    return found->second;
  }
  std::vector<TextureSource> take() { return std::move(sources_); }

 private:
  TextureSource source_of(const char* name) const {
    TextureSource source;
    const aiTexture* const held = scene_.GetEmbeddedTexture(name);
    if (!held) {
      std::string path = name;
      std::ranges::replace(path, '\\', '/');
      source.path = folder_ / path;
    } else if (held->mHeight == 0) {
      const char* const bytes = reinterpret_cast<const char*>(held->pcData);
      source.bytes.assign(bytes, bytes + held->mWidth);
    } else {
      source.width = held->mWidth, source.height = held->mHeight;
      const std::size_t texels = std::size_t{source.width} * source.height;
      if (texels > shapes::kMostMeshTexels) refuse("a texture of {} texels", texels);
      for (std::size_t i = 0; i < texels; ++i) {
        const aiTexel& t = held->pcData[i];
        source.texels.push_back(t.r | t.g << 8 | t.b << 16 | 0xff000000u);
      }
    }
    return source;
  }

  const aiScene& scene_;
  fs::path folder_;
  std::map<std::string, std::int32_t> numbers_;
  std::vector<TextureSource> sources_;
};

void add_materials(const aiScene& scene, const fs::path& folder, bool plain, LooseMesh& mesh) {
  Textures textures(scene, folder);
  if (scene.mNumMaterials > shapes::kMostMeshMaterials)
    refuse("{} materials, allowed {}", scene.mNumMaterials, shapes::kMostMeshMaterials);
  for (unsigned i = 0; i < scene.mNumMaterials; ++i) {
    FlatMaterial material = material_of(*scene.mMaterials[i]);
    if (plain || is_default(scene, i)) material.painted = 1;
    if (!material.painted) material.texture = textures.add(*scene.mMaterials[i]);
    mesh.materials.push_back(material);
  }
  if (mesh.materials.empty()) mesh.materials.push_back({.painted = 1});
  mesh.textures = textures.take();
}

// --- Triangles

// Its columns are what the file's axes are in the object's.
glm::mat3 object_from_file(const std::string& extension, UpAxis up) {
  const glm::vec3 right(1, 0, 0), ahead(0, 1, 0), above(0, 0, 1);
  if (up == UpAxis::kZ || (up == UpAxis::kByFormat && extension == "stl"))
    return {right, ahead, above};
  // A glTF model looks along its z; other files with y up are mostly turned as if seen on paper.
  if (extension == "gltf" || extension == "glb") return {-right, above, ahead};
  return {right, above, -ahead};
}

struct Placed {
  const aiNode* node;
  aiMatrix4x4 transform;
};

bool is_finite(const aiMatrix4x4& m) {
  return std::all_of(&m.a1, &m.a1 + 16, [](float x) { return std::isfinite(x); });
}

class Collector {
 public:
  Collector(const aiScene& scene, const glm::mat3& axes, bool keep_normals,
            const InputCounter& count_inputs, LooseMesh& to)
      : scene_(scene),
        axes_(axes),
        keep_normals_(keep_normals),
        count_inputs_(count_inputs),
        to_(to),
        is_placed_(scene.mNumMeshes) {}

  // Whatever hangs on the node, however deep.
  void add_all() {
    constexpr std::size_t kMostNodes = 1'000'000;
    std::vector<Placed> open = {{scene_.mRootNode, aiMatrix4x4()}};
    std::size_t nodes = 0;
    while (!open.empty()) {
      const Placed placed = open.back();
      open.pop_back();
      if (++nodes > kMostNodes) refuse("over {} nodes", kMostNodes);
      const aiMatrix4x4 transform = placed.transform * placed.node->mTransformation;
      if (!is_finite(transform)) refuse("a node at no place");
      for (unsigned i = 0; i < placed.node->mNumMeshes; ++i)
        place(placed.node->mMeshes[i], transform);
      for (unsigned i = placed.node->mNumChildren; i-- > 0;)
        open.push_back({placed.node->mChildren[i], transform});
    }
  }

 private:
  void place(unsigned number, const aiMatrix4x4& transform) {
    const aiMesh& mesh = *scene_.mMeshes[number];
    if (!mesh.HasFaces() || !mesh.HasPositions()) return;
    if (to_.material.size() + mesh.mNumFaces > shapes::kMostMeshTriangles)
      refuse("over {0} triangles, allowed {0}", shapes::kMostMeshTriangles);
    if (is_placed_[number]) count_inputs_(kInputsPerCopiedTriangle * mesh.mNumFaces);
    is_placed_[number] = true;
    add(mesh, transform);
  }

  void add(const aiMesh& mesh, const aiMatrix4x4& transform) {
    glm::mat3 linear;
    for (unsigned row = 0; row < 3; ++row)
      for (unsigned column = 0; column < 3; ++column)
        linear[static_cast<int>(column)][static_cast<int>(row)] = transform[row][column];
    const glm::vec3 shift(transform.a4, transform.b4, transform.c4);
    const float determinant = glm::determinant(linear);
    // Normals by the cofactors, which need no inverse.
    const glm::mat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                              glm::cross(linear[0], linear[1]));
    const float side = determinant < 0.0f ? -1.0f : 1.0f;
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
      const aiFace& face = mesh.mFaces[i];
      if (face.mNumIndices != 3) continue;
      bool has_normals = keep_normals_ && mesh.HasNormals();
      std::array<FlatVertex, 3> corners;
      for (unsigned k = 0; k < 3; ++k) {
        const unsigned v = face.mIndices[k];
        if (v >= mesh.mNumVertices) refuse("an index without a vertex");
        const auto vec3 = [](const aiVector3D& a) { return glm::vec3(a.x, a.y, a.z); };
        const glm::vec3 p = axes_ * (linear * vec3(mesh.mVertices[v]) + shift);
        if (!(glm::dot(p, p) < 1e16f)) refuse("a vertex that is no place, allowed up to 1e8 units");
        FlatVertex& corner = corners[k];
        corner.position = {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f};  // no -0
        if (has_normals) {
          const glm::vec3 n = side * (axes_ * (cofactors * vec3(mesh.mNormals[v])));
          const float length = std::sqrt(glm::dot(n, n));
          has_normals = length > 0.0f && std::isfinite(length);
          if (has_normals) corner.normal = {n.x / length, n.y / length, n.z / length};
        }
        if (mesh.HasTextureCoords(0)) {
          const aiVector3D uv = mesh.mTextureCoords[0][v];
          const auto bounded = [](float x) { return std::abs(x) <= 1e5f ? x : 0.0f; };
          corner.uv = {bounded(uv.x), 1.0f - bounded(uv.y)};  // v up in the library's scenes
        }
      }
      if (determinant < 0.0f) std::swap(corners[1], corners[2]);
      to_.corners.insert(to_.corners.end(), corners.begin(), corners.end());
      to_.has_normals.push_back(has_normals);
      to_.material.push_back(
          std::min(mesh.mMaterialIndex, static_cast<unsigned>(to_.materials.size() - 1)));
    }
  }

  const aiScene& scene_;
  glm::mat3 axes_;
  bool keep_normals_;
  const InputCounter& count_inputs_;
  LooseMesh& to_;
  std::vector<bool> is_placed_;  // of each mesh
};

}  // namespace

LooseMesh read_asset(const fs::path& file, UpAxis up, const InputCounter& count_inputs) {
  const std::string extension = extension_of(file);
  constexpr std::array<std::string_view, 5> kReadable = {"obj", "gltf", "glb", "stl", "dae"};
  if (std::ranges::find(kReadable, extension) == kReadable.end())
    refuse("a file '.{}', allowed .obj, .gltf, .glb, .stl and .dae", extension);
  const fs::path folder = fs::absolute(file).parent_path();
  Assimp::Importer importer;
  importer.SetIOHandler(new OneFolder(folder, count_inputs));  // owns it
  keep_readers_of(extension, importer);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* const scene =
      importer.ReadFile(file.string(), aiProcess_Triangulate | aiProcess_SortByPType);
  if (std::string_view(importer.GetErrorString()) == "std::bad_alloc") throw std::bad_alloc();
  if (!scene || !scene->mRootNode)
    refuse("a file that cannot be read ({})", importer.GetErrorString());
  LooseMesh mesh;
  const bool is_stl = extension == "stl";
  add_materials(*scene, folder, is_stl, mesh);
  // STL's normals say no more than its triangles do.
  Collector(*scene, object_from_file(extension, up), !is_stl, count_inputs, mesh).add_all();
  if (mesh.material.empty()) refuse("a file without triangles");
  return mesh;
}

}  // namespace swell::mesh_import
