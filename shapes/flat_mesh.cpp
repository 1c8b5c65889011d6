#include "shapes/flat_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <type_traits>

namespace swell::shapes {
namespace {

template <class... T>
void check(bool good, fmt::format_string<T...> text, T&&... values) {
  if (!good) throw std::runtime_error(fmt::format(text, std::forward<T>(values)...));
}

class Bytes {
 public:
  explicit Bytes(std::span<const char> bytes) : left_(bytes) {}

  template <class Value>
  void take(std::span<Value> values) {
    static_assert(std::is_trivially_copyable_v<Value>);
    check(left_.size() >= values.size_bytes(), "a stream that ends early");
    if (!values.empty()) std::memcpy(values.data(), left_.data(), values.size_bytes());
    left_ = left_.subspan(values.size_bytes());
  }
  template <class Value>
  Value take() {
    Value value{};
    take(std::span(&value, 1));
    return value;
  }
  // The size is checked before there is room made for it.
  template <class Value>
  std::vector<Value> take_all(std::size_t count) {
    check(left_.size() / sizeof(Value) >= count, "a stream that ends early");
    std::vector<Value> values(count);
    take(std::span(values));
    return values;
  }
  bool empty() const { return left_.empty(); }

 private:
  std::span<const char> left_;
};

template <std::size_t kSize>
bool all_within(const std::array<float, kSize>& values, float low, float high) {
  return std::ranges::all_of(values, [&](float x) { return x >= low && x <= high; });
}

void check_header(const FlatHeader& header) {
  check(header.magic == kFlatMagic, "no mesh");
  check(header.levels >= 1 && header.levels <= kMostMeshLevels, "{} levels", header.levels);
  check(header.vertices <= 3 * kMostMeshTriangles, "{} vertices", header.vertices);
  check(header.materials >= 1 && header.materials <= kMostMeshMaterials, "{} materials",
        header.materials);
  check(header.textures <= kMostMeshTextures, "{} textures", header.textures);
  for (std::uint32_t i = 0; i < header.levels; ++i)
    check(header.triangles[i] >= 1 && header.triangles[i] <= kMostMeshTriangles, "{} triangles",
          header.triangles[i]);
  check(all_within(header.error, 0.0f, 1e3f), "levels that lie nowhere");
}

void check_content(const FlatMesh& mesh) {
  for (const FlatVertex& v : mesh.vertices) {
    check(all_within(v.position, -1e9f, 1e9f), "a place that is no place");
    check(all_within(v.normal, -1.01f, 1.01f), "a normal that is none");
    check(all_within(v.uv, -1e6f, 1e6f), "texture coordinates that are none");
  }
  for (const FlatLevel& level : mesh.levels) {
    check(std::ranges::all_of(level.indices, [&](auto i) { return i < mesh.vertices.size(); }),
          "an index without a vertex");
    check(std::ranges::all_of(level.material, [&](auto i) { return i < mesh.materials.size(); }),
          "a triangle without a material");
  }
  for (const FlatMaterial& m : mesh.materials) {
    check(all_within(m.colour, 0.0f, 1.0f), "a colour that is none");
    check(all_within(std::array{m.roughness, m.metalness}, 0.0f, 1.0f), "a material that is none");
    check(m.texture >= -1 && m.texture < static_cast<std::int32_t>(mesh.textures.size()),
          "a material without its texture");
  }
}

}  // namespace

FlatMesh read_flat_mesh(std::span<const char> bytes) {
  Bytes from(bytes);
  const auto header = from.take<FlatHeader>();
  check_header(header);
  FlatMesh mesh;
  mesh.vertices = from.take_all<FlatVertex>(header.vertices);
  for (std::uint32_t i = 0; i < header.levels; ++i) {
    const std::size_t triangles = header.triangles[i];
    mesh.levels.emplace_back();
    mesh.levels.back().indices = from.take_all<std::uint32_t>(3 * triangles);
    mesh.levels.back().material = from.take_all<std::uint32_t>(triangles);
    mesh.levels.back().error = header.error[i];
  }
  mesh.materials = from.take_all<FlatMaterial>(header.materials);
  std::uint64_t texels = 0;
  for (std::uint32_t i = 0; i < header.textures; ++i) {
    FlatTexture texture;
    texture.width = from.take<std::uint32_t>();
    texture.height = from.take<std::uint32_t>();
    const auto is_side = [](std::uint32_t side) {
      return side >= 1 && side <= kMostTextureSide_px;
    };
    check(is_side(texture.width) && is_side(texture.height), "a texture of {} x {}", texture.width,
          texture.height);
    texels += std::uint64_t{texture.width} * texture.height;
    check(texels <= kMostMeshTexels, "{} texels", texels);
    texture.texels =
        from.take_all<std::uint32_t>(static_cast<std::size_t>(texture.width) * texture.height);
    mesh.textures.push_back(std::move(texture));
  }
  check(from.empty(), "a stream that does not end");
  check_content(mesh);
  return mesh;
}

}  // namespace swell::shapes
