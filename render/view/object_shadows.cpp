#include "render/view/object_shadows.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/earth.h"
#include "math/elementary.h"
#include "render/world/land_shadow.h"

namespace swell::render {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kRounding_m = 0.5f;          // of the places of pixels far away
constexpr std::size_t kMostCasters = 65535;  // lists of tiles hold 16 bits; 2000 piers have fewer
constexpr double kMostLift_m = 3.0;
// A smaller one casts no shadow and leaves no trace on the water: the picture would not show them.
constexpr float kSmallestCaster_px = 0.5f;
constexpr auto kSunRadius = static_cast<float>(kSunRadius_rad);

// In metres along right, up and towards the sun, from the object's place.
using SunPoint = glm::vec3;

// From the mesh's coordinates.
struct SunFrame {
  glm::mat3 axes;
  glm::vec3 origin;

  SunPoint operator()(glm::vec3 q) const { return axes * q + origin; }
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

// Widens the rows that an edge crosses.
void add_edge(const SunPoint& a, const SunPoint& b, Outline& outline) {
  const float row_a = (a.y - outline.lowest_m) * outline.rows_per_m;
  const float row_b = (b.y - outline.lowest_m) * outline.rows_per_m;
  const float low = std::min(row_a, row_b), high = std::max(row_a, row_b);
  const int last = std::min(static_cast<int>(std::floor(high)), Outline::kRows - 1);
  for (int i = std::max(static_cast<int>(std::ceil(low)), 0); i <= last; ++i) {
    const float s = row_a == row_b ? 0.0f : (static_cast<float>(i) - row_a) / (row_b - row_a);
    const SunPoint p = a + s * (b - a);
    if (p.x < outline.left_m[i]) outline.left_m[i] = p.x, outline.left_depth_m[i] = p.z;
    if (p.x > outline.right_m[i]) outline.right_m[i] = p.x, outline.right_depth_m[i] = p.z;
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
Waterline waterline_of(const scene::FloatingObject& object, const scene::MeshPart& part,
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

WaterMotion motion_of(const World::State& world) {
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
ShadowCaster caster_of(const scene::FloatingObject& object, const scene::MeshPart& part,
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

// Places relative to the eye between which lies all that a caster may tell on: its hull's
// surroundings, and its outline's way down the sun's direction.
struct Corners {
  std::array<glm::vec3, 24> p;
  int count = 0;
  void add(glm::vec3 corner) { p[count++] = corner; }
};

Corners corners_of(const ShadowCaster& caster, const ObjectShadows& shadows) {
  Corners corners;
  const float near_m = caster.near_m;
  for (int i = 0; near_m > 0.0f && i < 8; ++i)
    corners.add(caster.waterline.middle_rel +
                near_m * glm::vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  if (caster.reach_m <= 0.0f) return corners;
  const Outline& o = caster.outline;
  const float highest_m = o.lowest_m + (Outline::kRows - 1) / o.rows_per_m;
  // Down to the lowest that is shaded, from the place's height and from the outline's highest one.
  const float height_m = caster.place_rel.z + highest_m * shadows.up.z +
                         std::max(o.most_depth_m, 0.0f) * shadows.sun.z - shadows.lowest_rel_m;
  // A little further for what is soft there.
  const float sine = std::max(shadows.sun.z, 1e-4f);
  const float way_m =
      std::min(caster.reach_m, std::max(height_m, 0.0f) / sine * (1.0f + 2.0f * kSunRadius / sine));
  for (int i = 0; i < 16; ++i) {
    const float way = i & 8 ? way_m : 0.0f, soft = way * kSunRadius;
    const float x = i & 1 ? o.right_most_m + soft : o.left_most_m - soft;
    const float y = i & 2 ? highest_m + soft : o.lowest_m - soft;
    const float z = (i & 4 ? o.most_depth_m : o.least_depth_m) - way;
    corners.add(caster.place_rel + x * shadows.right + y * shadows.up + z * shadows.sun);
  }
  return corners;
}

// How far a round earth sinks what lies between the corners at most, and what light reaches from
// there under water.
float most_drop_m(const Corners& corners, float drop_per_m2) {
  float farthest_m = 0.0f;
  for (int i = 0; i < corners.count; ++i)
    farthest_m = std::max(farthest_m, glm::length(glm::vec2(corners.p[i])));
  farthest_m += 2.0f * kDeepestShadow_m;
  return farthest_m * farthest_m * drop_per_m2;
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

// A part of the window, in pixels.
struct WindowBox {
  glm::vec2 low{kInfinity}, high{-kInfinity};
  bool all = false;  // of the window
};

void add_flat_point(const View& camera, glm::vec3 p_rel, WindowBox& box) {
  const glm::vec4 clip = camera.clip_from_rel * glm::vec4(p_rel, 1.0f);
  if (clip.w <= camera.near_m) {
    box.all = true;
    return;
  }
  const glm::vec2 ndc(clip.x / clip.w, -clip.y / clip.w);
  const glm::vec2 size(camera.width_px, camera.height_px);
  const glm::vec2 at = (0.5f * ndc + 0.5f) * size;
  box.low = glm::min(box.low, at);
  box.high = glm::max(box.high, at);
}

// Wherever between p_rel and drop_m below it a point is drawn.
void add_point(const View& camera, glm::vec3 p_rel, float drop_m, WindowBox& box) {
  add_flat_point(camera, p_rel, box);
  add_flat_point(camera, p_rel - glm::vec3(0.0f, 0.0f, drop_m), box);
}

// Where a view shows what lies between the corners. In a mirror or under water things appear
// between heights that bound map_point()'s, whose level is that of the sea or of any hull.
WindowBox window_box(const Corners& corners, const RenderView& view, float lowest_rel_m) {
  WindowBox box;
  box.all = view.eye.submerged;
  const float drop_m = most_drop_m(corners, view.drop_per_m2);
  const float level = -static_cast<float>(view.camera.eye_world.z), wave_m = level - lowest_rel_m;
  for (int i = 0; i < corners.count; ++i) {
    const glm::vec3 p = corners.p[i];
    switch (view.kind) {
      case ViewKind::kWindow:
        add_point(view.camera, p, drop_m, box);
        break;
      case ViewKind::kReflection:
        for (const float by : {-2.0f * wave_m, 2.0f * wave_m})
          add_point(view.camera, {p.x, p.y, 2.0f * level - p.z + by}, drop_m, box);
        break;
      case ViewKind::kRefraction:
        // Light goes on below the water at up to 49 degrees from the vertical.
        for (const float aside : {-1.15f, 1.15f})
          for (const float ahead : {-1.15f, 1.15f})
            for (const float deep : {-wave_m, kDeepestShadow_m})
              add_point(view.camera,
                        {p.x + aside * std::max(deep, 0.0f), p.y + ahead * std::max(deep, 0.0f),
                         std::min(p.z, level - deep)},
                        drop_m, box);
        add_point(view.camera, p, drop_m, box);
        break;
    }
  }
  return box;
}

struct TileBox {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;  // half open
};

// A pixel or two wider: shadows are as soft as a pixel at least.
TileBox tiles_of(const WindowBox& box, const raster::TileGrid& grid) {
  if (box.all) return {0, 0, grid.tiles_x, grid.tiles_y};
  const auto tile = [&](float px, int tiles) {
    const float at = px / static_cast<float>(grid.tile_size_px);
    return static_cast<int>(std::clamp(std::floor(at), -1.0f, static_cast<float>(tiles)));
  };
  const glm::vec2 low = box.low - 2.0f, high = box.high + 2.0f;
  return {std::max(tile(low.x, grid.tiles_x), 0), std::max(tile(low.y, grid.tiles_y), 0),
          std::min(tile(high.x, grid.tiles_x) + 1, grid.tiles_x),
          std::min(tile(high.y, grid.tiles_y) + 1, grid.tiles_y)};
}

}  // namespace

Outline outline_of(const scene::ObjectMesh& mesh, const scene::MeshPart& part,
                   const scene::FloatingObject& object, const scene::ObjectPose& pose,
                   const ObjectShadows& shadows) {
  const SunFrame frame = sun_frame(object, pose, shadows);
  const auto indices =
      std::span(mesh.indices).subspan(3u * part.first_triangle, 3u * part.triangles);
  glm::vec3 low(kInfinity), high(-kInfinity);
  for (const std::uint32_t index : indices) {
    const SunPoint p = frame(mesh.position[index]);
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
  const bool is_closed = object.kind < scene::ObjectKind::kBoat;
  outline.left_m.fill(kInfinity);
  outline.right_m.fill(-kInfinity);
  for (std::size_t i = 0; i < indices.size(); i += 3) {
    const std::array<SunPoint, 3> p = {frame(mesh.position[indices[i]]),
                                       frame(mesh.position[indices[i + 1]]),
                                       frame(mesh.position[indices[i + 2]])};
    // What is turned to the sun has the outline of the whole.
    const glm::vec2 along = p[1] - p[0], aside = p[2] - p[0];
    if (is_closed && along.x * aside.y - along.y * aside.x >= 0.0f) continue;
    for (int k = 0; k < 3; ++k) add_edge(p[k], p[(k + 1) % 3], outline);
  }
  for (int i = 0; i < Outline::kRows; ++i)
    if (outline.left_m[i] > outline.right_m[i]) outline.left_m[i] = outline.right_m[i] = 0.0f;
  return outline;
}

void find_shadow_casters(const World::State& world, const ShadowOptions& options, const View& view,
                         ObjectGeometry& objects, const StageRun& run) {
  const std::vector<scene::FloatingObject>& all = world.scene.objects;
  ObjectShadows& shadows = objects.shadows;
  shadows.casters.clear();
  if (all.empty()) return;
  set_axes(options.sun_direction, shadows);
  const auto level = -static_cast<float>(view.eye_world.z);
  shadows.lowest_rel_m = level - world.water_bounds(options.disturbances).height_m - kRounding_m;
  const WaterMotion motion = motion_of(world);
  const std::array<glm::vec4, 5> planes = frustum_planes(view);
  const float sinks_per_m2 = drop_per_m2(world.earth_radius_m(options.without));
  for (std::size_t i = 0; i < all.size(); ++i) {
    const glm::vec3 place_rel(objects.poses[i].position_world - view.eye_world);
    if (drawn_size_px(all[i], place_rel, view) < kSmallestCaster_px) continue;
    const std::vector<scene::MeshPart>& parts = world.objects.parts[i];
    for (std::size_t k = 0; k < parts.size(); ++k) {
      ShadowCaster caster = caster_of(all[i], parts[k], objects.poses[i], options, view);
      caster.object = static_cast<std::uint32_t>(i);
      caster.part = static_cast<std::uint32_t>(k);
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
    const scene::ObjectMesh& mesh = shadow_mesh(world, caster.object, caster.place_rel, view);
    scene::MeshPart part{.triangles = static_cast<std::uint32_t>(mesh.triangles.size())};
    if (!mesh.parts.empty()) part = mesh.parts[caster.part];
    caster.outline = outline_of(mesh, part, object, objects.poses[caster.object], shadows);
  });
}

void list_casters(const ObjectShadows& shadows, const RenderView& view,
                  const raster::TileGrid& grid, TileCasters& of_tile) {
  of_tile.first.clear();
  of_tile.caster.clear();
  if (shadows.casters.empty()) return;
  of_tile.first.assign(static_cast<std::size_t>(grid.count()) + 1, 0);
  const auto for_tiles = [&](const ShadowCaster& caster, auto&& visit) {
    const TileBox box =
        tiles_of(window_box(corners_of(caster, shadows), view, shadows.lowest_rel_m), grid);
    for (int y = box.y0; y < box.y1; ++y)
      for (int x = box.x0; x < box.x1; ++x) visit(static_cast<std::size_t>(y) * grid.tiles_x + x);
  };
  // Counts, then places: in order of the casters' numbers.
  for (const ShadowCaster& caster : shadows.casters)
    for_tiles(caster, [&](std::size_t tile) { ++of_tile.first[tile + 1]; });
  for (std::size_t i = 1; i < of_tile.first.size(); ++i) of_tile.first[i] += of_tile.first[i - 1];
  of_tile.caster.resize(of_tile.first.back());
  for (std::size_t i = 0; i < shadows.casters.size(); ++i)
    for_tiles(shadows.casters[i], [&](std::size_t tile) {
      of_tile.caster[of_tile.first[tile]++] = static_cast<std::uint16_t>(i);
    });
  for (std::size_t i = of_tile.first.size() - 1; i > 0; --i)
    of_tile.first[i] = of_tile.first[i - 1];
  of_tile.first[0] = 0;
}

}  // namespace swell::render
