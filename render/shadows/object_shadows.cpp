#include "render/shadows/object_shadows.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "math/check.h"
#include "math/earth.h"
#include "math/elementary.h"
#include "math/smoothstep.h"
#include "ocean/inland/inland_water.h"
#include "ocean/open_sea/sea.h"
#include "ocean/water_surface.h"
#include "render/frame/profile.h"
#include "render/shadows/shadow_reach.h"
#include "render/view/object_levels.h"
#include "render/view/objects_drawn.h"
#include "render/world/land_shadow.h"
#include "render/world/world_state.h"

namespace swell::render {
namespace {

constexpr float kRounding_m = 0.5f;          // of the places of pixels far away
constexpr std::size_t kMostCasters = 65535;  // lists of tiles hold 16 bits; 2000 piers have fewer
constexpr double kMostLift_m = 3.0;
// A smaller one casts no shadow and leaves no trace on the water: the picture would not show them.
constexpr float kSmallestCaster_px = 0.5f;
// How far the mesh of an outline may lie off the finest one: what is soft, or less than a row, does
// not show.
constexpr float kMostOutlineError_px = 1.0f, kMostOutlineError = 0.01f;  // or of the largest side
constexpr auto kSunRadius = static_cast<float>(kSunRadius_rad);

// In metres along right, up and towards the sun, from the object's place.
using SunPoint = glm::vec3;

// From the mesh's coordinates.
struct SunFrame {
  glm::mat3 axes;
  glm::vec3 origin;

  SunPoint operator()(glm::vec3 q) const { return axes * q + origin; }
};

// A mesh's vertices as the sun sees them: those of a small one are worked out once, of which each
// has six triangles.
struct SunVertices {
  const shapes::ObjectMesh& mesh;
  SunFrame frame;
  std::array<SunPoint, 512> found;
  bool is_small;

  SunVertices(const shapes::ObjectMesh& of, const SunFrame& sun)
      : mesh(of), frame(sun), is_small(of.position.size() <= found.size()) {
    if (is_small) std::ranges::transform(of.position, found.begin(), sun);
  }
  SunPoint operator[](std::uint32_t i) const {
    return is_small ? found[i] : frame(mesh.position[i]);
  }
};

SunFrame sun_frame(const scene::FloatingObject& object, const scene::ObjectPose& pose,
                   const ObjectShadows& shadows) {
  const glm::mat3 sun_from_world =
      glm::transpose(glm::mat3(shadows.right, shadows.up, shadows.sun));
  glm::mat3 world_from_mesh(pose.world_from_object);
  for (int i = 0; i < 3; ++i) world_from_mesh[i] *= static_cast<float>(object.size_m[i]);
  const glm::mat3 axes = sun_from_world * world_from_mesh;
  const glm::vec2 middle = glm::vec2(object.middle_m / glm::dvec2(object.size_m));
  return {axes, axes * glm::vec3(middle, -static_cast<float>(object.draught))};
}

// Widens those of every `step` rows that an edge crosses.
void add_edge(const SunPoint& a, const SunPoint& b, int step, Outline& outline) {
  const float row_a = (a.y - outline.lowest_m) * outline.rows_per_m;
  const float row_b = (b.y - outline.lowest_m) * outline.rows_per_m;
  const float low = std::min(row_a, row_b), high = std::max(row_a, row_b);
  const int last = std::min(static_cast<int>(std::floor(high)), Outline::kRows - 1);
  const float inverse = row_a == row_b ? 0.0f : 1.0f / (row_b - row_a);
  const int first = std::max(static_cast<int>(std::ceil(low)), 0);
  for (int i = (first + step - 1) / step * step; i <= last; i += step) {
    const float s = (static_cast<float>(i) - row_a) * inverse;
    const float x = a.x + s * (b.x - a.x), z = a.z + s * (b.z - a.z);
    if (x < outline.left_m[i]) outline.left_m[i] = x, outline.left_depth_m[i] = z;
    if (x > outline.right_m[i]) outline.right_m[i] = x, outline.right_depth_m[i] = z;
  }
}

// Returns how many rows apart an outline is taken. Some rows stand for all of a small object: every
// seventh, about a pixel apart, or every third.
int row_step(float size_px) { return size_px < 8.0f ? 7 : size_px < 20.0f ? 3 : 1; }

// The rows between those of every `step`.
void fill_rows(int step, Outline& outline) {
  for (int i = 0; i < Outline::kRows; ++i) {
    const int below = i / step * step, above = std::min(below + step, Outline::kRows - 1);
    const float t = static_cast<float>(i - below) / static_cast<float>(step);
    for (auto* const ends :
         {&outline.left_m, &outline.right_m, &outline.left_depth_m, &outline.right_depth_m})
      (*ends)[i] = (*ends)[below] + t * ((*ends)[above] - (*ends)[below]);
  }
}

// The axes across a sun's direction.
void set_axes(glm::vec3 sun, ObjectShadows& shadows) {
  const glm::vec2 level(sun);
  const float length = glm::length(level);
  const glm::vec2 towards = length > 1e-6f ? level / length : glm::vec2(0.0f, 1.0f);
  shadows.sun = sun;
  shadows.right = {towards.y, -towards.x, 0.0f};
  shadows.up = glm::cross(shadows.right, sun);
}

// The plan of a part of a hull at still water.
Waterline waterline_of(const scene::FloatingObject& object, const shapes::MeshPart& part,
                       const scene::ObjectPose& pose, const View& view) {
  const glm::vec2 size(object.size_m);
  const glm::vec2 half = part.half * size;
  const auto plan = [](glm::dvec3 axis) { return glm::normalize(glm::vec2(axis)); };
  Waterline w;
  w.is_round = part.is_round;
  w.right = plan(pose.world_from_object[0]) / half.x;
  w.ahead = plan(pose.world_from_object[1]) / half.y;
  w.radius_m = 0.5f * (half.x + half.y);
  const glm::dvec2 middle_m = object.middle_m + glm::dvec2(part.middle * size);
  glm::dvec3 middle = pose.position_world;
  if (middle_m != glm::dvec2(0.0)) middle += pose.world_from_object * glm::dvec3(middle_m, 0.0);
  w.middle_rel = glm::vec3(middle - view.eye_world);
  // The hull proper: what stands on it hides little of the sky.
  w.freeboard_m = std::max(part.top - static_cast<float>(object.draught), 0.0f) *
                  static_cast<float>(object.size_m.z);
  return w;
}

// How the sea moves its water about, as if all waves were one long swell down the wind.
struct WaterMotion {
  double omega_rad_s = 0.0;  // of the mean wave
  double speed_mps = 0.0;    // root mean square, along the wind
  glm::dvec2 downwind{0.0, 1.0};
};

WaterMotion motion_of(const WorldState& world) {
  const double length_m = world.water_bounds().mean_wavelength_m;
  const double travel = world.scene.sea.wind_from_rad + kPi;
  WaterMotion motion;
  motion.downwind = {sin(travel), cos(travel)};
  if (length_m <= 0.0) return motion;
  motion.omega_rad_s = std::sqrt(2.0 * kPi * world.scene.sea.gravity_mps2 / length_m);
  motion.speed_mps = 0.25 * world.sea->significant_height_m() * motion.omega_rad_s;
  return motion;
}

// Water in a crest runs with the waves, in a trough against them.
void add_foam(const WaterMotion& motion, double height_m, Waterline& line) {
  const double speed = motion.speed_mps;
  line.foam = static_cast<float>(0.8 * (1.0 - exp(-speed / 0.3)));
  line.foam_m = static_cast<float>(0.1 + 0.6 * std::min(speed, 1.0));
  if (speed > 0.0)
    line.flow = glm::vec2(motion.downwind *
                          std::clamp(0.5 * motion.omega_rad_s * height_m / speed, -1.0, 1.0));
}

// The current that runs past a part of an object in a river, none past one that makes a wake;
// nothing beside rivers.
std::optional<glm::vec2> river_past(const WorldState& world, const scene::FloatingObject& object,
                                    glm::dvec2 part_world) {
  if (!world.inland) return std::nullopt;
  const auto at = world.inland->at(part_world);
  if (!at || at->sea_share >= 1.0f) return std::nullopt;
  const bool stands = object.path_m.empty() && !object.drift_track;
  return stands ? world.inland->undisturbed_current(part_world) : glm::vec2(0.0f);
}

// White water at what a current runs against, more of it in its lee.
void add_river_foam(glm::vec2 current_mps, Waterline& line) {
  const float speed = glm::length(current_mps);
  line.foam = 0.9f * smoothstep(0.3f, 1.6f, speed);
  line.foam_m = 0.2f + 0.7f * std::min(speed, 2.0f);
  line.flow = speed > 0.0f ? current_mps / speed : glm::vec2(0.0f);
}

// Where the sun's disc is four times as broad as the object, which hides a tenth of it.
float reach_of(const scene::FloatingObject& object) {
  const glm::dvec3 size = object.size_m;
  return 2.0f * static_cast<float>(std::max({size.x, size.y, 0.3 * size.z})) / kSunRadius;
}

// Whatever way the sun stands, no outline is larger.
Outline largest_outline(const scene::FloatingObject& object) {
  const double above = std::max(object.draught, 1.0 - object.draught);
  const auto radius = static_cast<float>(glm::length(object.size_m * glm::dvec3(0.5, 0.5, above)) +
                                         glm::length(object.middle_m));
  Outline outline;
  outline.left_most_m = outline.least_depth_m = outline.lowest_m = -radius;
  outline.right_most_m = outline.most_depth_m = radius;
  outline.rows_per_m = (Outline::kRows - 1) / (2.0f * radius);
  return outline;
}

// All but its outline.
ShadowCaster caster_of(const scene::FloatingObject& object, const shapes::MeshPart& part,
                       const scene::ObjectPose& pose, const ShadowOptions& options,
                       const View& view) {
  ShadowCaster caster;
  caster.place_rel = glm::vec3(pose.position_world - view.eye_world);
  if (!options.without.has(Part::kHulls) && part.half.x > 0.0f && part.half.y > 0.0f) {
    const glm::vec2 size = 2.0f * part.half * glm::vec2(object.size_m);
    caster.waterline = waterline_of(object, part, pose, view);
    // What stands far over the water or under it does not tell on it.
    const double over_m = pose.position_world.z - pose.water_m;
    if (std::abs(over_m) < kMostLift_m)
      caster.near_m = 0.5f * glm::length(size) + ShadowCaster::kContact_m;
  }
  if (options.sun_direction.z > 0.0f && !options.without.has(Part::kShadows))
    caster.reach_m = reach_of(object);
  caster.outline = largest_outline(object);
  return caster;
}

// Whether any point between the corners may be seen, itself or mirrored in the sea, sunken by up to
// drop_m.
bool in_view(const Corners& corners, float level, float drop_m,
             const std::array<glm::vec4, 5>& planes) {
  return std::ranges::all_of(planes, [&](const glm::vec4& plane) {
    return std::any_of(corners.p.begin(), corners.p.begin() + corners.count, [&](glm::vec3 p) {
      const float mirrored = 2.0f * plane.z * (level - p.z);
      return glm::dot(glm::vec3(plane), p) + plane.w + std::max(mirrored, 0.0f) +
                 std::max(-plane.z * drop_m, 0.0f) >=
             0.0f;
    });
  });
}

// What throws a caster's shadow.
const shapes::ObjectMesh& mesh_of(const WorldState& world, const ObjectGeometry& objects,
                                  const ShadowCaster& caster, const View& view) {
  const glm::vec3 size_m(world.scene.objects[caster.object].size_m);
  const float largest_m = std::max({size_m.x, size_m.y, size_m.z});
  const float radius_m = caster.outline.right_most_m;
  const float error_m = kMostOutlineError_px / most_px_per_m(caster.place_rel, radius_m, view);
  return outline_mesh(world, objects, caster.object,
                      std::max(error_m, kMostOutlineError * largest_m));
}

SunBox sun_box(const ShadowCaster& caster, const ObjectShadows& shadows) {
  const Outline& outline = caster.outline;
  SunBox box;
  const glm::vec3 place = caster.place_rel;
  box.place = {glm::dot(place, shadows.right), glm::dot(place, shadows.up),
               glm::dot(place, shadows.sun)};
  box.reach_m = caster.reach_m;
  box.middle_m = 0.5f * (outline.left_most_m + outline.right_most_m);
  box.half_width_m = 0.5f * (outline.right_most_m - outline.left_most_m);
  box.half_height_m = 0.5f * (Outline::kRows - 1) / outline.rows_per_m;
  box.middle_up_m = outline.lowest_m + box.half_height_m;
  box.most_depth_m = outline.most_depth_m;
  box.object = static_cast<float>(caster.object);
  return box;
}

}  // namespace

Outline outline_of(const shapes::ObjectMesh& mesh, const shapes::MeshPart& part,
                   const scene::FloatingObject& object, const scene::ObjectPose& pose,
                   const ObjectShadows& shadows, int step) {
  SWELL_DCHECK((Outline::kRows - 1) % step == 0, "step={}", step);
  const SunVertices vertices(mesh, sun_frame(object, pose, shadows));
  const auto indices =
      std::span(mesh.indices).subspan(3u * part.first_triangle, 3u * part.triangles);
  glm::vec3 low(kInfinity<float>), high(-kInfinity<float>);
  for (const std::uint32_t index : indices) {
    const SunPoint p = vertices[index];
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  Outline outline;
  outline.left_most_m = low.x, outline.right_most_m = high.x;
  outline.least_depth_m = low.z, outline.most_depth_m = high.z;
  // The first and the last row lie a little inside, where edges cross them.
  const float inside = 1e-3f * (high.y - low.y);
  outline.lowest_m = low.y + inside;
  outline.rows_per_m = (Outline::kRows - 1) / std::max(high.y - low.y - 2.0f * inside, 1e-6f);
  // The triangles of files look anywhere, and sails have one for two sides.
  const bool is_closed = scene::kObjectKinds[object.kind].is_compact;
  outline.left_m.fill(kInfinity<float>);
  outline.right_m.fill(-kInfinity<float>);
  for (std::size_t i = 0; i < indices.size(); i += 3) {
    const std::array<SunPoint, 3> p = {vertices[indices[i]], vertices[indices[i + 1]],
                                       vertices[indices[i + 2]]};
    // What is turned to the sun has the outline of the whole.
    const glm::vec2 along = p[1] - p[0], aside = p[2] - p[0];
    if (is_closed && along.x * aside.y - along.y * aside.x >= 0.0f) continue;
    for (int k = 0; k < 3; ++k) add_edge(p[k], p[(k + 1) % 3], step, outline);
  }
  for (int i = 0; i < Outline::kRows; ++i)
    if (outline.left_m[i] > outline.right_m[i]) outline.left_m[i] = outline.right_m[i] = 0.0f;
  if (step > 1) fill_rows(step, outline);
  return outline;
}

void find_shadow_casters(const WorldState& world, const ShadowOptions& options, const View& view,
                         ObjectGeometry& objects, const StageRun& run) {
  const std::vector<scene::FloatingObject>& all = world.scene.objects;
  ObjectShadows& shadows = objects.shadows;
  shadows.casters.clear();
  if (all.empty()) return;
  set_axes(options.sun_direction, shadows);
  const auto level = -static_cast<float>(view.eye_world.z);
  const float wave_m = world.water_bounds(options.disturbances).height_m + kRounding_m;
  shadows.lowest_rel_m = level - wave_m;
  shadows.sea_below_rel_m = level + wave_m;
  const WaterMotion motion = motion_of(world);
  const std::array<glm::vec4, 5> planes = frustum_planes(view);
  const float sinks_per_m2 = drop_per_m2(world.earth_radius_m(options.without));
  for (std::size_t i = 0; i < all.size(); ++i) {
    const glm::vec3 place_rel(objects.poses[i].position_world - view.eye_world);
    if (drawn_size_px(all[i], place_rel, view) < kSmallestCaster_px) continue;
    if (world.objects.of_object[i]->implicit && !objects.draws_implicits) continue;
    const std::vector<shapes::MeshPart>& parts = world.objects.parts[i];
    for (std::size_t k = 0; k < parts.size(); ++k) {
      ShadowCaster caster = caster_of(all[i], parts[k], objects.poses[i], options, view);
      caster.object = static_cast<std::uint32_t>(i);
      caster.part = static_cast<std::uint32_t>(k);
      const glm::dvec3 part_world = view.eye_world + glm::dvec3(caster.waterline.middle_rel);
      if (const auto current_mps = river_past(world, all[i], glm::dvec2(part_world)))
        add_river_foam(*current_mps, caster.waterline);
      else
        add_foam(motion, objects.poses[i].water_m, caster.waterline);
      const bool tells = caster.near_m > 0.0f || caster.reach_m > 0.0f;
      if (!tells) continue;
      const Corners corners = corners_of(caster, shadows);
      if (in_view(corners, level, most_drop_m(corners, sinks_per_m2), planes) &&
          shadows.casters.size() < kMostCasters)
        shadows.casters.push_back(caster);
    }
  }
  run.for_each(shadows.casters.size(), [&](std::size_t i, int) {
    ShadowCaster& caster = shadows.casters[i];
    if (caster.reach_m <= 0.0f) return;
    const scene::FloatingObject& object = all[caster.object];
    const shapes::ObjectMesh& mesh = mesh_of(world, objects, caster, view);
    shapes::MeshPart part{.triangles = static_cast<std::uint32_t>(mesh.triangles.size())};
    if (!mesh.parts.empty()) part = mesh.parts[caster.part];
    const int step = row_step(drawn_size_px(object, caster.place_rel, view));
    caster.outline = outline_of(mesh, part, object, objects.poses[caster.object], shadows, step);
  });
  shadows.boxes.clear();
  for (const ShadowCaster& caster : shadows.casters)
    shadows.boxes.push_back(sun_box(caster, shadows));
}

}  // namespace swell::render
