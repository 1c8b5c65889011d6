// Things that float on the sea: what a scene file says of them, and how the sea carries them.
//
//   std::vector<scene::ObjectPose> poses(scene.objects.size());
//   scene::object_poses(scene.objects, water.at(t_s, frame, workers), poses);
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>

namespace swell::ocean {
class WaterSurface;
}

namespace swell::scene {

enum class ObjectKind : std::uint8_t {
  kBuoy,    // a navigation buoy: hull, tower, lantern, top mark
  kSphere,  // an ellipsoid, if its sizes differ
  kBox,
};
inline constexpr std::array<std::string_view, 3> kObjectKindNames = {"buoy", "sphere", "box"};

// What a buoy carries on top.
enum class TopMark : std::uint8_t { kCan, kCone, kSphere };

struct FloatingObject {
  ObjectKind kind = ObjectKind::kBuoy;
  TopMark top_mark = TopMark::kCan;
  glm::dvec2 position_m{0.0};             // east, north; moored there
  glm::dvec3 size_m{2.6, 2.6, 6.0};       // across, along the heading, up
  double heading_rad = 0.0;               // clockwise from north
  double draught = 0.2;                   // part of the height below still water
  glm::vec3 colour{0.60f, 0.03f, 0.02f};  // linear RGB reflectance of the paint
  std::string name{};                     // no other object's, or empty
  std::string label{};                    // its class in labelled pictures; empty: "object"
};

// The name of the object's class in labelled pictures.
std::string_view object_class(const FloatingObject& object);

// Where an object is at one time. In its own axes (right, ahead, up) the origin lies on its
// vertical axis at the waterline.
struct ObjectPose {
  glm::dvec3 position_world{0.0};
  glm::dmat3 world_from_object{1.0};  // columns: unit right, ahead, up; right-handed
};

// Lays objects on the surface: the height is the mean over the hull's plan, so that waves shorter
// than the hull hardly lift it; the tilt is kTiltShare of that of the plane of least squares there.
// A pose depends on the object and the surface alone. Spans of one length. Allocates nothing;
// 0.5 us an object.
void object_poses(std::span<const FloatingObject> objects, const ocean::WaterSurface& surface,
                  std::span<ObjectPose> poses);

// A hull's weight and mooring keep it more upright than the water is.
inline constexpr double kTiltShare = 0.7;

}  // namespace swell::scene
