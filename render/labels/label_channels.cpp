#include "render/labels/label_channels.h"

#include <algorithm>

#include "render/labels/labels.h"

namespace swell::render {
namespace {

constexpr std::array<LabelInfo, kLabelCount> kTable = {{
    {Label::kDepth,
     "depth",
     {"Z"},
     false,
     "m",
     "Distance from the eye along the view axis; in wide pictures along the ray.",
     "+inf",
     "",
     &Labels::depth_m},
    {Label::kDistance,
     "distance",
     {"distance"},
     false,
     "m",
     "Distance from the eye.",
     "+inf",
     "",
     &distance_of},
    {Label::kPosition,
     "position",
     {"P.X", "P.Y", "P.Z"},
     false,
     "m",
     "Place in the world: east, north, up.",
     "+inf or -inf by the sign of the direction's component, 0 where that is 0",
     "",
     &position_of},
    {Label::kNormal,
     "normal",
     {"N.X", "N.Y", "N.Z"},
     false,
     "1",
     "Unit normal that shading used, in the world: with the waves and the unevenness of the ground "
     "that triangles cannot hold, as far as pixels of that size show them.",
     "0, 0, 0",
     "",
     &Labels::normal},
    {Label::kGeometricNormal,
     "geometric_normal",
     {"Ng.X", "Ng.Y", "Ng.Z"},
     false,
     "1",
     "Unit normal of the drawn triangle, in the world, on the side that is seen.",
     "0, 0, 0",
     "",
     &Labels::geometric_normal},
    {Label::kId,
     "id",
     {"id"},
     true,
     "",
     "Which thing is seen: 1 the sea, 2 the land, 16 + n object n of the scene, 4096 + n tree n.",
     "0",
     "",
     &Labels::id},
    {Label::kClass,
     "class",
     {"class"},
     true,
     "",
     "What kind of thing is seen: 1 water, 2 terrain, 3 an object that names no class, 4 water "
     "that "
     "foam hides more than half of, from 5 on classes that objects name, and that of trees.",
     "0",
     "",
     &Labels::klass},
    {Label::kMotion,
     "motion",
     {"motion.X", "motion.Y"},
     false,
     "px",
     "Where in the picture the point that is seen is one frame later, whether it is seen then or "
     "not, less where it is now; x right, y down. Water moves as its column does, up and down at "
     "one place, objects as they float, trees as they sway; what water mirrors or shows does not "
     "count.",
     "by the camera's rotation alone",
     "0, 0 where the point is behind the next camera",
     &Labels::motion_px},
    {Label::kElevation,
     "elevation",
     {"elevation"},
     false,
     "m",
     "Height of the drawn water above the mean level.",
     "0",
     "0",
     &Labels::elevation_m,
     LabelLook::kHeight},
    {Label::kFoam,
     "foam",
     {"foam"},
     false,
     "1",
     "Part of the water that foam of breaking waves hides, in [0, 1].",
     "0",
     "0",
     &Labels::foam,
     LabelLook::kShare},
    {Label::kFlags,
     "flags",
     {"flags"},
     true,
     "",
     "What the water shows besides the sky and its own colour: 1 where land or an object is more "
     "than half of what it mirrors, 2 where the ground or an object is more than half of what is "
     "seen through it, 3 both; 4 more at every pixel that an eye sees through water; 8 more where "
     "a "
     "wake tilts the water by more than 0.02 or has left foam on it.",
     "0",
     "0",
     &Labels::flags},
}};
static_assert(lists_all(kTable, &LabelInfo::label));

}  // namespace

std::span<const LabelInfo, kLabelCount> label_table() { return kTable; }

const LabelInfo* find_label(std::string_view name) {
  const auto found = std::ranges::find(kTable, name, &LabelInfo::name);
  return found == kTable.end() ? nullptr : &*found;
}

}  // namespace swell::render
