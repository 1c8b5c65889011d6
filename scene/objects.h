// Things on the sea and by it: what a scene file says of them, and where they are at a time.
//
//   std::vector<scene::ObjectPose> poses(scene.objects.size());
//   scene::object_poses(scene.objects, water.at(t_s, frame, workers), poses);
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "math/enum_table.h"

namespace swell::ocean {
class DriftTrack;
class WaterSurface;
}  // namespace swell::ocean

namespace swell::scene {

enum class ObjectKind : std::uint8_t {
  kBuoy,    // a navigation buoy: hull, tower, lantern, top mark
  kSphere,  // an ellipsoid, if its sizes differ
  kBox,
  kBoat,        // an open rowing boat with thwarts
  kSailboat,    // hull, keel, rudder, mast, boom and two sails
  kPier,        // a deck on posts, along the heading
  kLighthouse,  // a tower with bands, a gallery and a lantern
  kRock,        // a boulder
  kMesh,        // of a file
  kImplicit,    // of functions (scene/implicit_surface.h), of a file
};

// What sets an object's height and tilt.
enum class Motion : std::uint8_t {
  kFloat,  // the water under it
  kFixed,  // nothing: it stands upright at a height
};

// Which axis of a mesh's file points up.
enum class UpAxis : std::uint8_t { kByFormat, kY, kZ };

// What a buoy carries on top.
enum class TopMark : std::uint8_t { kCan, kCone, kSphere };

// What a kind takes up of the water's surface.
enum class PlanShape : std::uint8_t {
  kRound,  // an ellipse
  kBox,
  kPosts,  // those of a pier
};

// The posts of a pier stand in pairs along it: how many, where the last pair stands and how far out
// a post is, from the middle, and half its sizes, all in parts of the pier's.
struct PierPosts {
  int pairs = 9;
  double aside = 1.1 / 3.0, ahead = 17.0 / 36.0;
  glm::dvec2 half{0.16 / 3.0, 0.16 / 36.0};
};
inline constexpr PierPosts kPierPosts{};

// What all objects of a kind have in common. One more kind is an enumerator, a row of kObjectKinds
// and one of object_mesh.cpp, which names what builds its triangles.
struct ObjectKindFacts {
  std::string_view name;  // in scene files
  // As it is commonly built, and where a scene says no more: FloatingObject's members.
  glm::dvec3 size_m{2.6, 2.6, 6.0};
  double draught = 0.2;
  glm::vec3 colour{0.60f, 0.03f, 0.02f};
  Motion motion = Motion::kFloat;
  PlanShape plan = PlanShape::kRound;
  bool is_compact = false;      // closed all around, and about as wide as high
  bool shades_itself = true;    // a part of it may stand between another one and the sun
  bool makes_wake = false;      // where it floats along a path
  bool is_of_file = false;      // its shape, with the size of that
  bool at_file_origin = false;  // its waterline is the file's z = 0
};

inline constexpr auto kObjectKinds = enum_table<ObjectKind, ObjectKindFacts>({
    {ObjectKind::kBuoy, {.name = "buoy", .is_compact = true}},
    {ObjectKind::kSphere, {.name = "sphere", .is_compact = true, .shades_itself = false}},
    {ObjectKind::kBox,
     {.name = "box", .plan = PlanShape::kBox, .is_compact = true, .shades_itself = false}},
    {ObjectKind::kBoat,
     {.name = "boat",
      .size_m = {1.7, 4.6, 0.8},
      .draught = 0.25,
      .colour = {0.55f, 0.57f, 0.55f},
      .makes_wake = true}},
    {ObjectKind::kSailboat,
     {.name = "sailboat",
      .size_m = {2.9, 9.2, 14.5},
      .draught = 0.12,
      .colour = {0.62f, 0.62f, 0.60f},
      .makes_wake = true}},
    {ObjectKind::kPier,
     {.name = "pier",
      .size_m = {3.0, 36.0, 7.0},
      .draught = 0.70,
      .colour = {0.21f, 0.15f, 0.10f},
      .motion = Motion::kFixed,
      .plan = PlanShape::kPosts}},
    {ObjectKind::kLighthouse,
     {.name = "lighthouse",
      .size_m = {8.0, 8.0, 26.0},
      .draught = 0.0,
      .colour = {0.55f, 0.03f, 0.02f},
      .motion = Motion::kFixed}},
    {ObjectKind::kRock,
     {.name = "rock",
      .size_m = {6.0, 5.0, 3.5},
      .draught = 0.4,
      .colour = {0.17f, 0.155f, 0.14f},
      .motion = Motion::kFixed}},
    {ObjectKind::kMesh, {.name = "mesh", .plan = PlanShape::kBox, .is_of_file = true}},
    {ObjectKind::kImplicit,
     {.name = "form",
      .plan = PlanShape::kBox,
      .makes_wake = true,
      .is_of_file = true,
      .at_file_origin = true}},
});

inline constexpr auto kObjectKindNames = [] {
  EnumTable<ObjectKind, std::string_view> names{};
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = kObjectKinds[i].name;
  return names;
}();

struct FloatingObject {
  ObjectKind kind = ObjectKind::kBuoy;
  TopMark top_mark = TopMark::kCan;
  glm::dvec2 position_m{0.0};  // east, north; moored there, unless it has a path or drifts
  glm::dvec3 size_m = ObjectKindFacts{}.size_m;  // across, along the heading, up
  double heading_rad = 0.0;                      // clockwise from north
  double draught = ObjectKindFacts{}.draught;    // part of the height below still water
  glm::vec3 colour = ObjectKindFacts{}.colour;   // linear RGB reflectance of the paint
  std::string name{};                            // no other object's, or empty
  std::string label{};                           // its class in labelled pictures; empty: "object"

  Motion motion = Motion::kFloat;
  double height_m = 0.0;  // fixed: of its waterline over the mean sea level
  double roll_rad = 0.0;  // fixed: about where it points; positive lowers its right side
  // East, north: it goes along this line, turned as its ends on the line are, in place of the
  // position and the heading. It begins at the first point at t = 0.
  std::vector<glm::dvec2> path_m{};
  double speed_mps = 3.0;
  bool path_closed = true;  // from the last point on to the first; false: it stops at the last
  bool wake = true;         // what floats along a path and is a boat makes one
  bool drift = false;       // the river at its position takes it along from t = 0 on
  // Its way, in a scene that a render::World holds.
  std::shared_ptr<const ocean::DriftTrack> drift_track{};

  // These hold for what is painted.
  double roughness = 0.42;  // 0: mirrors, 1: matt
  double metalness = 0.0;
  double checker_m = 0.0;  // side of its squares, every second one nearly black; 0: none

  // These are for a mesh or an implicit surface.
  std::string file{};
  std::string
      file_place{};  // where a scene file names it, for messages: "harbour.toml:12: column 8"
  UpAxis up = UpAxis::kByFormat;
  double scale = 1.0;           // metres for a unit of the file
  bool at_file_origin = false;  // the position is that of the file's origin, at the waterline
  // middle_m tells how far right and ahead of the position the middle of the box lies: 0 unless
  // at_file_origin. render::World sets it and size_m by the file; if at_file_origin, also draught.
  glm::dvec2 middle_m{0.0};
};

// Returns an object of the kind as it is commonly built: size, draught, colour, and whether it
// floats.
FloatingObject common_object(ObjectKind kind);

// The name of the object's class in labelled pictures.
std::string_view object_class(const FloatingObject& object);

// Where an object is at one time. In its own axes (right, ahead, up) the origin lies on its
// vertical axis at the waterline.
struct ObjectPose {
  glm::dvec3 position_world{0.0};
  glm::dmat3 world_from_object{1.0};  // columns: unit right, ahead, up; right-handed
  double water_m = 0.0;               // height of the water that mirrors it
};

// Where all objects are: those that float lie on the surface. Their height is the mean over the
// hull's plan, so that waves shorter than the hull hardly lift it; the tilt is kTiltShare of that
// of the plane of least squares there. A pose depends on the object and the surface (with its time)
// alone. Spans of one length. Allocates nothing; 0.5 us an object.
void object_poses(std::span<const FloatingObject> objects, const ocean::WaterSurface& surface,
                  std::span<ObjectPose> poses);

// A pose that a caller gives to one of the objects, for one frame. Its water_m is not read.
struct GivenPose {
  std::size_t object = 0;  // its index in the scene
  ObjectPose pose;
};

// Puts the given poses, each with the water under it, in place of those of their objects. Of
// several for one object the last counts. `given` passes check_given_poses().
void take_given_poses(std::span<const FloatingObject> objects, std::span<const GivenPose> given,
                      const ocean::WaterSurface& surface, std::span<ObjectPose> poses);

// Aborts with a message unless each is of an object, at most 1e7 m away along each axis, with unit
// axes at right angles, right-handed, to within 1e-6.
void check_given_poses(std::span<const GivenPose> given, std::size_t objects);

// The poses on a sea that is drawn flat: what floats lies at its mean level.
void lay_flat(std::span<const FloatingObject> objects, std::span<ObjectPose> poses);

// Where an object is seen from above at t_s, wherever the sea takes it: its place and its heading.
struct PlanPose {
  glm::dvec2 position_m;
  double heading_rad;
};
PlanPose plan_pose(const FloatingObject& object, double t_s);

// A hull's weight and mooring keep it more upright than the water is.
inline constexpr double kTiltShare = 0.7;

}  // namespace swell::scene
