// The outputs beside colour, exact per pixel: each is that of the surface at the pixel's centre (of
// wide views, at that of the nearest pixel drawn), never mixed with a neighbour's. This one table
// names them for code, files and documents.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "math/enum_table.h"
#include "math/view.h"

namespace swell::render {

enum class Label : std::uint8_t {
  kDepth,            // along the view axis; of wide views the distance
  kDistance,         // from the eye
  kPosition,         // in the world
  kNormal,           // as shaded
  kGeometricNormal,  // of the drawn triangle
  kId,               // which thing
  kClass,            // what kind of thing
  kMotion,           // in the picture, to the next frame
  kElevation,        // of the water
  kFoam,
  kFlags,
};
inline constexpr std::size_t kLabelCount = kEnumerators<Label>;

// Which labels are wanted.
class LabelSet {
 public:
  constexpr LabelSet() = default;
  static constexpr LabelSet all() {
    LabelSet set;
    set.bits_ = (1u << kLabelCount) - 1;
    return set;
  }
  constexpr bool has(Label label) const { return (bits_ >> static_cast<unsigned>(label) & 1) != 0; }
  constexpr void add(Label label) { bits_ |= 1u << static_cast<unsigned>(label); }
  constexpr bool empty() const { return bits_ == 0; }
  bool operator==(const LabelSet&) const = default;

 private:
  static_assert(kLabelCount < 32);
  std::uint32_t bits_ = 0;
};

// One value a pixel each, row by row; empty where it was not asked for. Distance and position are
// not stored: they follow from the depth, which is there for them.
struct Labels {
  LabelSet set;
  std::vector<float> depth_m;
  std::vector<glm::vec3> normal, geometric_normal;
  std::vector<std::uint32_t> id, klass;
  std::vector<glm::vec2> motion_px;
  std::vector<float> elevation_m, foam;
  std::vector<std::uint8_t> flags;
};

// Where a label's values are: in a member of Labels, or as a function of the view, the pixel and
// its depth.
using LabelValues =
    std::variant<std::vector<float> Labels::*, std::vector<std::uint8_t> Labels::*,
                 std::vector<std::uint32_t> Labels::*, std::vector<glm::vec2> Labels::*,
                 std::vector<glm::vec3> Labels::*, double (*)(const View&, int, int, float),
                 glm::dvec3 (*)(const View&, int, int, float)>;

// What a label's floats are, for pictures of them.
enum class LabelLook : std::uint8_t { kDistance, kHeight, kShare };

struct LabelInfo {
  Label label;
  std::string_view name;                   // in options and documents
  std::array<std::string_view, 3> planes;  // channel names in files; empty: no further one
  bool is_integer;                         // UINT, else FLOAT
  std::string_view unit;                   // "m", "px", "1" or "" for numbers that name something
  std::string_view meaning;                // one sentence
  std::string_view of_sky;                 // its value where the sky is seen
  std::string_view elsewhere;              // its value where it does not apply, or ""
  LabelValues values;
  LabelLook look = LabelLook::kDistance;
  std::size_t plane_count() const { return planes[1].empty() ? 1 : planes[2].empty() ? 2 : 3; }
};

// In the order of Label.
std::span<const LabelInfo, kLabelCount> label_table();

// The label of a name of the table; nullptr for others.
const LabelInfo* find_label(std::string_view name);

// Values of kId: the sky's, the water's, the land's; object n of the scene has kFirstObjectId + n,
// tree n of the world kFirstTreeId + n.
inline constexpr std::uint32_t kSkyId = 0, kWaterId = 1, kLandId = 2, kFirstObjectId = 16,
                               kFirstTreeId = 4096;

// Values of kClass. Classes that objects name are numbered on from kFirstOwnClass, in the order in
// which the scene first names them; objects that name none are of kObjectClass.
inline constexpr std::uint32_t kSkyClass = 0, kWaterClass = 1, kTerrainClass = 2, kObjectClass = 3,
                               kFoamClass = 4, kFirstOwnClass = 5;

// Bits of kFlags: what the picture shows besides the water itself, at water pixels; that the eye
// looks through water, at all.
inline constexpr std::uint32_t kShowsMirrored = 1, kShowsRefracted = 2, kSeenInWater = 4,
                               kShowsWake = 8;

}  // namespace swell::render
