// The keys of [[object]].
#include <array>

#include "scene/file/parameter_row.h"
#include "scene/file/parameters.h"

namespace swell::scene {
namespace {

struct ObjectKindName {
  static constexpr auto words = kObjectKindNames;
  auto& operator()(auto& object) const { return object.kind; }
};

struct MotionName {
  using enum Motion;
  static constexpr auto words = enum_words<Motion>({{kFloat, "float"}, {kFixed, "fixed"}});
  auto& operator()(auto& object) const { return object.motion; }
};

struct UpAxisName {
  using enum UpAxis;
  static constexpr auto words = enum_words<UpAxis>({{kByFormat, "auto"}, {kY, "y"}, {kZ, "z"}});
  auto& operator()(auto& object) const { return object.up; }
};

struct OriginName {
  static constexpr auto words = enum_words<bool>({{false, "middle"}, {true, "file"}});
  auto& operator()(auto& object) const { return object.at_file_origin; }
};

struct TopMarkName {
  using enum TopMark;
  static constexpr auto words =
      enum_words<TopMark>({{kCan, "can"}, {kCone, "cone"}, {kSphere, "sphere"}});
  auto& operator()(auto& object) const { return object.top_mark; }
};

#define SWELL_FIELD(PATH) \
  [](auto& object) -> auto& { return object.PATH; }

}  // namespace

std::vector<Parameter<FloatingObject>> object_parameters() {
  using ObjectRow = Row<FloatingObject>;
  auto file = ObjectRow::plain<std::string>(
      "file", ParameterKind::kPath, SWELL_FIELD(file),
      "of a mesh: OBJ, glTF, GLB, STL or COLLADA; of a form: TOML; relative to the scene file");
  file.path_of = "mesh";
  file.is_set = [](const FloatingObject& object) { return !object.file.empty(); };
  // A mesh and a form have their file's.
  auto size = ObjectRow::vector("size_m", {0.05, 500, "m"}, SWELL_FIELD(size_m),
                                "across, along its heading, and from its lowest point to the top; "
                                "a mesh or form has its file's");
  size.is_set = [](const FloatingObject& object) { return !kObjectKinds[object.kind].is_of_file; };
  auto draught = ObjectRow::number("draught", {0, 1}, SWELL_FIELD(draught),
                                   "part of its height that lies below still water");
  draught.is_set = [](const FloatingObject& object) {
    return !kObjectKinds[object.kind].is_of_file || !object.at_file_origin;
  };
  return {
      ObjectRow::choice("kind", ObjectKindName{},
                        "what it is; its common size, draught, motion and colour follow"),
      ObjectRow::choice("top_mark", TopMarkName{}, "what a buoy carries on top"),
      ObjectRow::vector("position_m", {-1e6, 1e6, "m"}, SWELL_FIELD(position_m),
                        "of its middle: east, north"),
      ObjectRow::choice("motion", MotionName{},
                        "whether the water sets its height and tilt, or it stands at height_m, "
                        "upright but for roll_deg; fixed for a pier, a lighthouse and a rock"),
      ObjectRow::number("height_m", {-12000, 12000, "m"}, SWELL_FIELD(height_m),
                        "of a fixed object's waterline over the mean sea level"),
      ObjectRow::angle("roll_deg", {-180, 180, "deg"}, SWELL_FIELD(roll_rad),
                       "of a fixed object, about the line along its heading: an aircraft in a "
                       "turn; positive lowers its right side"),
      ObjectRow::points("path_m", {-1e6, 1e6, "m"}, 2, kMaxPathPoints, SWELL_FIELD(path_m),
                        "it goes along the line through these points [east, north], from the "
                        "first at t = 0, in place of position_m and heading_deg"),
      ObjectRow::number("speed_mps", {0, 1000, "m/s"}, SWELL_FIELD(speed_mps), "along path_m"),
      ObjectRow::plain<bool>("path_closed", ParameterKind::kBoolean, SWELL_FIELD(path_closed),
                             "path_m goes on from its last point to the first, round and round; "
                             "false: the object stops at the last"),
      ObjectRow::plain<bool>(
          "wake", ParameterKind::kBoolean, SWELL_FIELD(wake),
          "a boat, sailboat or form that floats along path_m makes waves and foam"),
      ObjectRow::plain<bool>("drift", ParameterKind::kBoolean, SWELL_FIELD(drift),
                             "the river at position_m takes what floats along and turns it, from "
                             "t = 0 on; it stops where a lake or the sea does"),
      size,
      ObjectRow::angle("heading_deg", {-360, 360, "deg"}, SWELL_FIELD(heading_rad),
                       "where it points, clockwise from north"),
      draught,
      ObjectRow::vector("colour", {0, 1}, SWELL_FIELD(colour),
                        "linear RGB reflectance of its paint"),
      ObjectRow::number("roughness", {0.05, 1}, SWELL_FIELD(roughness),
                        "of its paint: 0.05 is polished, 1 matt"),
      ObjectRow::number("metalness", {0, 1}, SWELL_FIELD(metalness),
                        "of its paint: 1 mirrors in its colour and scatters nothing"),
      ObjectRow::or_zero(ObjectRow::number("checker_m", {0.01, 100, "m"}, SWELL_FIELD(checker_m),
                                           "side of squares on it, every second one nearly black; "
                                           "0: none")),
      file,
      ObjectRow::choice("up", UpAxisName{},
                        "axis of the file that points up; auto: z of STL, else y"),
      ObjectRow::number("scale", {1e-4, 1e4, "m"}, SWELL_FIELD(scale), "of a unit of the file"),
      ObjectRow::choice(
          "origin", OriginName{},
          "what of a mesh or form is at position_m, at its waterline: the middle of its box, "
          "sunk by draught, or the file's origin"),
      ObjectRow::optional_text("name", SWELL_FIELD(name),
                               "by which camera.mount may call it; no two alike"),
      ObjectRow::optional_text("class", SWELL_FIELD(label),
                               "what it is in labelled pictures; \"object\" if left out"),
  };
}

#undef SWELL_FIELD

}  // namespace swell::scene
