// Fog that is not found for each pixel, as graphics hardware once had it: at the vertices of
// triangles and interpolated between them, or in a table by the first bits of the depth buffer.
// Both are coarser than a pixel's own, and are here to be compared with it.
//
// Source: Vyatkin, Dolgovesov, A combined method of visualising functionally defined surfaces and
// three-dimensional textures, 2019 (the two methods; theirs is that of vertices).
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "math/enum_table.h"
#include "render/view/surfaces.h"

namespace swell::render {

struct DrawRecord;
struct Fog;
struct Meshes;
struct RenderView;
struct StageRun;
struct ViewRays;

// A place, and what fog before it leaves of its light and adds.
struct FogAtPlace {
  glm::vec3 p_seen{0.0f};  // relative to the eye, on a round earth as far sunk as it is seen [m]
  float height_m = 0.0f;   // over the sea
  glm::vec3 passes{1.0f}, added{0.0f};
};

// A table's rows, one for all depths z of the depth buffer whose first 16 bits are the same: sign,
// exponent, and 7 bits of the mantissa. Row 0 is that of the near plane, z = 1.
struct FogTable {
  static constexpr int kDroppedBits = 16, kRowsAnOctave = 1 << (23 - kDroppedBits), kOctaves = 24;
  static constexpr int kRows = kRowsAnOctave * kOctaves + 1;
  static constexpr std::int32_t kFirst = std::bit_cast<std::int32_t>(1.0f) >> kDroppedBits;

  // The depth in the middle of a row.
  static float middle(int row) {
    return std::bit_cast<float>((kFirst - row) << kDroppedBits | 1 << (kDroppedBits - 1));
  }
};

struct StoredFog {
  bool is_table = false;  // or of vertices
  // Of the window's vertices by surface, and its triangles.
  EnumTable<SurfaceKind, std::vector<FogAtPlace>> vertices;
  const EnumTable<SurfaceKind, DrawRecord>* draws = nullptr;
  PrimitiveRanges primitives;
  // By row.
  std::vector<FogAtPlace> table;
};

// The corners of a triangle by its primitive's number; of what rays found, and of no triangle,
// three times the same place.
using FogAtCorners = std::array<const FogAtPlace*, 3>;
FogAtCorners find_corners(const StoredFog& stored, std::uint32_t primitive);

// Sets passes and added of the places, seen from the eye of `fog`.
void see_fog_at(const Fog& fog, std::span<FogAtPlace> places);

// Fills stored.vertices of the window, whose pass is prepared.
void find_fog_at_vertices(const Fog& fog, const Meshes& meshes, const RenderView& window,
                          StoredFog& stored, const StageRun& run);

// Fills stored.table: each row has the fog of one way, in the middle column of the view to the sea
// at the row's depth, or as near to that as the picture shows. size_px: the picture's.
void find_fog_by_depth(const Fog& fog, const ViewRays& rays, glm::ivec2 size_px, StoredFog& stored);

}  // namespace swell::render
