// Stage 3 and 4: implicit surfaces as they have turned, and as views see them.
#include <algorithm>
#include <cmath>
#include <span>

#include "math/elementary.h"
#include "render/view/implicits.h"
#include "render/view/objects_drawn.h"
#include "render/view/render_view.h"
#include "scene/implicit_surface.h"

namespace swell::render {
namespace {

// --- At a time

scene::Quadric about(const scene::Quadric& f, const glm::dmat3& back, glm::dvec3 from_hub) {
  const glm::dmat3 a(f.xx, f.xy, f.xz, f.xy, f.yy, f.yz, f.xz, f.yz, f.zz);
  const glm::dmat3 turned = glm::transpose(back) * a * back;
  scene::Quadric result;
  result.xx = turned[0][0], result.yy = turned[1][1], result.zz = turned[2][2];
  result.xy = turned[1][0], result.xz = turned[2][0], result.yz = turned[2][1];
  result.b = glm::transpose(back) * (f.times(from_hub) + f.b);
  result.c = f(from_hub);
  return result;
}

// How a part has turned: p_now = hub + turned (p - hub), p = back p_now + offset.
struct Turn {
  glm::dmat3 turned{1.0}, back{1.0};
  glm::dvec3 offset{0.0};
};

Turn turn_of(const scene::ImplicitPart& part, double t_s) {
  if (part.turns_per_s == 0.0) return {};
  Turn turn;
  turn.turned = scene::turn_about(part.axis, part.turns_per_s * t_s);
  turn.back = glm::transpose(turn.turned);
  turn.offset = part.hub - turn.back * part.hub;
  return turn;
}

RayQuadric about_middle(const scene::Quadric& f, glm::dvec3 middle) {
  const auto narrow = [](double v) { return static_cast<float>(v); };
  return {narrow(f.xx),
          narrow(f.yy),
          narrow(f.zz),
          narrow(f.xy),
          narrow(f.xz),
          narrow(f.yz),
          glm::vec3(f.times(middle) + f.b),
          narrow(f(middle))};
}

RayTable table_at(const scene::HeightTable& table, double t_s, const Turn& turn,
                  glm::dvec3 middle) {
  const scene::FramesAt frames = scene::frames_at(table, t_s);
  return {frames.now,
          frames.next,
          static_cast<float>(frames.share),
          static_cast<float>(
              std::max(table.threshold_m, static_cast<double>(RayTable::kNoThreshold_m))),
          glm::mat3(table.linear * turn.back),
          glm::vec3(table(turn.back * middle + turn.offset))};
}

void add_part(const scene::ImplicitPart& part, double t_s, PosedImplicit& posed) {
  const Turn turn = turn_of(part, t_s);
  glm::dvec3 middle = 0.5 * (part.low + part.high), half = 0.5 * (part.high - part.low);
  if (part.turns_per_s != 0.0) {
    middle = part.hub + turn.turned * (middle - part.hub);
    half = glm::abs(turn.turned[0]) * half.x + glm::abs(turn.turned[1]) * half.y +
           glm::abs(turn.turned[2]) * half.z;
  }
  const glm::vec3 about_m(middle);
  const auto add = [&](const scene::Quadric& f) {
    return about_middle(part.turns_per_s == 0.0 ? f : about(f, turn.back, turn.offset),
                        glm::dvec3(about_m));
  };
  posed.parts.push_back({about_m, glm::vec3(half) * 1.00001f + 1e-5f,
                         static_cast<std::uint32_t>(posed.terms.size()),
                         static_cast<std::uint32_t>(part.terms.size()), RayPart::kNoTable,
                         glm::vec3(part.hub), glm::vec3(part.axis * part.turns_per_s)});
  if (part.table) {
    posed.parts.back().table = static_cast<std::int32_t>(posed.tables.size());
    posed.tables.push_back(table_at(*part.table, t_s, turn, glm::dvec3(about_m)));
  }
  for (const scene::ImplicitTerm& term : part.terms) {
    posed.terms.push_back({add(term.quadric),
                           static_cast<std::uint32_t>(posed.perturbations.size()),
                           static_cast<std::uint32_t>(term.perturbations.size())});
    for (const scene::Perturbation& r : term.perturbations)
      posed.perturbations.push_back({add(r.quadric), static_cast<float>(r.factor)});
  }
}

// --- In a view

// How an object's implicit surface lies: p_implicit = base + implicit_from_world (p_rel -
// bottom_rel).
struct ImplicitPlace {
  glm::dmat3 implicit_from_world, world_from_implicit;
  glm::dvec3 base, bottom_rel;
  double level_rel_m;
};

ImplicitPlace place_of(const ObjectInstance& instance) {
  const glm::dvec3 size(instance.implicit_size);
  ImplicitPlace place;
  place.implicit_from_world = glm::transpose(glm::dmat3(glm::dvec3(instance.right) * size.x,
                                                        glm::dvec3(instance.ahead) * size.y,
                                                        glm::dvec3(instance.up) * size.z));
  place.world_from_implicit = glm::inverse(place.implicit_from_world);
  place.base = glm::dvec3(instance.implicit_base);
  place.bottom_rel = glm::dvec3(instance.bottom_rel);
  place.level_rel_m = static_cast<double>(instance.waterline_rel_m);
  return place;
}

// The plane dot(n, p_rel) + w of the world, in the form's axes.
glm::vec4 plane_in_implicit(const ImplicitPlace& place, glm::dvec3 n, double w) {
  const glm::dvec3 normal = glm::transpose(place.world_from_implicit) * n;
  return glm::vec4(
      glm::dvec4(normal, w + glm::dot(n, place.bottom_rel) - glm::dot(normal, place.base)));
}

void set_planes(const RenderView& view, const ImplicitPlace& place, ImplicitInView& implicit) {
  const auto add = [&](glm::dvec3 n, double w) {
    implicit.planes[static_cast<std::size_t>(implicit.plane_count++)] =
        plane_in_implicit(place, n, w);
  };
  if (view.kind != ViewKind::kWindow) {
    const glm::dvec4 image(
        image_clip_plane(view.kind, view.eye, SurfaceKind::kObjects, view.clip_margin_m));
    add(glm::dvec3(image), image.w - image.z * place.level_rel_m);
  }
  if (view.clip_plane) {
    const glm::dvec3 n(*view.clip_plane);
    add(n, view.clip_plane->w + glm::dot(n, view.camera.eye_world));
  }
}

// On a round earth points rise by this plus slope . (x, y) from where they are shown to the flat
// world: the parabola of the earth, as straight as it is over an object.
struct Rise {
  glm::dvec2 slope;
  double at_eye_m;
};

Rise rise_at(const RenderView& view, const ImplicitPlace& place) {
  const double drop = static_cast<double>(view.drop_per_m2);
  const glm::dvec2 at(place.bottom_rel);
  return {2.0 * drop * at, -drop * glm::dot(at, at)};
}

void set_rays(const RenderView& view, const ImplicitPlace& place, ImplicitInView& implicit) {
  const Rise rise = rise_at(view, place);
  const double mirrored = view.kind == ViewKind::kReflection ? -1.0 : 1.0;
  // Columns.
  const glm::dmat3 world_from_shown(1.0, 0.0, mirrored * rise.slope.x, 0.0, 1.0,
                                    mirrored * rise.slope.y, 0.0, 0.0, mirrored);
  const double lift = mirrored < 0.0 ? 2.0 * place.level_rel_m - rise.at_eye_m : rise.at_eye_m;
  implicit.implicit_from_ray = place.implicit_from_world * world_from_shown;
  implicit.implicit_from_eye =
      place.base + place.implicit_from_world * (glm::dvec3(0.0, 0.0, lift) - place.bottom_rel);
}

void bend_rays(const ImplicitsInView& implicits, const RenderView& view, const ImplicitPlace& place,
               ImplicitInView& implicit) {
  const Rise rise = rise_at(view, place);
  const auto raised = [&](glm::dvec3 ray) {
    ray.z += glm::dot(rise.slope, glm::dvec2(ray));
    return glm::vec3(ray);
  };
  BentRays& bent = implicit.bent.emplace();
  bent.ray = raised(implicits.ray), bent.ray_dx = raised(implicits.ray_dx),
  bent.ray_dy = raised(implicits.ray_dy);
  bent.rise_m = static_cast<float>(rise.at_eye_m);
  bent.level_rel_m = static_cast<float>(place.level_rel_m);
  const float n2 = view.refraction_index * view.refraction_index;
  bent.index2 = view.eye.submerged ? 1.0f / n2 : n2;
  bent.towards = view.eye.submerged ? 1.0f : -1.0f;
  bent.implicit_from_world = glm::mat3(place.implicit_from_world);
  bent.origin_rel = glm::vec3(place.bottom_rel - place.world_from_implicit * place.base);
}

constexpr float kAnywhere_px = 1e6f;

// Where a view shows a box of the implicit surface's axes, by its corners; all of the window if it
// reaches behind the eye.
PartPlace place_in_window(const ImplicitsInView& in, const ImplicitInView& implicit, glm::dvec3 low,
                          glm::dvec3 high) {
  const glm::dmat3 ray_from_implicit = glm::inverse(implicit.implicit_from_ray);
  // Rays of depth 1 in their own coordinates: (x, y) in pixels.
  const glm::dmat3 pixel_from_ray = glm::inverse(glm::dmat3(in.ray_dx, in.ray_dy, in.ray));
  PartPlace place{kAnywhere_px, kAnywhere_px, -kAnywhere_px, -kAnywhere_px, 1e30f, -1e30f};
  bool all_before = true;
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 corner((i & 1) ? high.x : low.x, (i & 2) ? high.y : low.y,
                            (i & 4) ? high.z : low.z);
    const glm::dvec3 p =
        pixel_from_ray *
        (ray_from_implicit * (corner - implicit.implicit_from_eye));  // (x, y, 1) depth
    const auto depth = static_cast<float>(p.z);
    place.nearest_m = std::min(place.nearest_m, depth);
    place.farthest_m = std::max(place.farthest_m, depth);
    if (depth < in.near_m) {
      all_before = false;
      continue;
    }
    const glm::vec2 at(glm::dvec2(p) / p.z);
    place.x0 = std::min(place.x0, at.x), place.x1 = std::max(place.x1, at.x);
    place.y0 = std::min(place.y0, at.y), place.y1 = std::max(place.y1, at.y);
  }
  if (place.farthest_m < in.near_m) return place;  // nowhere
  if (!all_before) place.x0 = place.y0 = -kAnywhere_px, place.x1 = place.y1 = kAnywhere_px;
  // Rounding.
  constexpr float kRounding_px = 0.02f, kRounding = 1e-5f;
  place.x0 -= kRounding_px, place.y0 -= kRounding_px;
  place.x1 += kRounding_px, place.y1 += kRounding_px;
  place.nearest_m = std::max(place.nearest_m * (1.0f - kRounding), in.near_m * 0.5f);
  place.farthest_m *= 1.0f + kRounding;
  return place;
}

void set_extent(const PartPlace& place, raster::Viewport viewport, ImplicitInView& implicit) {
  const auto pixel = [](float at, int size) {
    return static_cast<int>(std::floor(std::clamp(at, -1.0f, static_cast<float>(size))));
  };
  if (place.x0 > place.x1) return;
  implicit.x0 = std::max(pixel(place.x0, viewport.width_px), 0);
  implicit.y0 = std::max(pixel(place.y0, viewport.height_px), 0);
  implicit.x1 = std::min(pixel(place.x1, viewport.width_px), viewport.width_px - 1);
  implicit.y1 = std::min(pixel(place.y1, viewport.height_px), viewport.height_px - 1);
}

void include(const PartPlace& more, PartPlace& place) {
  place.x0 = std::min(place.x0, more.x0), place.x1 = std::max(place.x1, more.x1);
  place.y0 = std::min(place.y0, more.y0), place.y1 = std::max(place.y1, more.y1);
}

// A bent view shows a box somewhat off its corners.
PartPlace bent_place(std::span<const glm::vec4> corners, raster::Viewport viewport) {
  PartPlace place{kAnywhere_px, kAnywhere_px, -kAnywhere_px, -kAnywhere_px, 0.0f, 1e30f};
  for (const glm::vec4& p : corners) {
    if (!(p.w > p.z)) return {-kAnywhere_px, -kAnywhere_px, kAnywhere_px, kAnywhere_px, 0, 1e30f};
    const float x = (0.5f + 0.5f * p.x / p.w) * static_cast<float>(viewport.width_px);
    const float y = (0.5f - 0.5f * p.y / p.w) * static_cast<float>(viewport.height_px);
    include({x, y, x, y, 0.0f, 0.0f}, place);
  }
  constexpr float kMore = 0.1f, kMore_px = 8.0f;
  const float more = kMore_px + kMore * std::max(place.x1 - place.x0, place.y1 - place.y0);
  place.x0 -= more, place.y0 -= more, place.x1 += more, place.y1 += more;
  return place;
}

void set_window_rays(const View& camera, ImplicitsInView& implicits) {
  const glm::dvec3 right(camera.right), up(camera.up), forward(camera.forward);
  const double half_x = camera.tan_half_x, half_y = camera.tan_half_y;
  implicits.ray =
      forward + right * (camera.tan_middle_x - half_x) + up * (camera.tan_middle_y + half_y);
  implicits.ray_dx = right * (2.0 * half_x / camera.width_px);
  implicits.ray_dy = up * (-2.0 * half_y / camera.height_px);
  implicits.near_m = camera.near_m;
}

// Near parts first hide what is behind them; bent views take them as they come.
void add_order(const ImplicitInView& implicit, ImplicitsInView& implicits) {
  const auto parts = implicit.implicit->parts.size();
  for (std::size_t i = 0; i < parts; ++i) implicits.order.push_back(static_cast<std::uint16_t>(i));
  if (implicit.bent) return;
  const auto nearest_m = [&](std::uint16_t part) {
    return implicits.places[implicit.first_place + part].nearest_m;
  };
  std::ranges::sort(std::span(implicits.order).last(parts), [&](std::uint16_t a, std::uint16_t b) {
    return nearest_m(a) != nearest_m(b) ? nearest_m(a) < nearest_m(b) : a < b;
  });
}

}  // namespace

void pose_implicit(const scene::ImplicitSurface& implicit, double t_s, PosedImplicit& posed) {
  posed.parts.clear(), posed.terms.clear(), posed.perturbations.clear();
  posed.tables.clear();
  for (const scene::ImplicitPart& part : implicit.parts) add_part(part, t_s, posed);
}

void find_implicits(const ObjectDraws& objects, RenderView& view) {
  ImplicitsInView& implicits = view.implicits;
  implicits.implicits.clear(), implicits.places.clear(), implicits.order.clear();
  set_window_rays(view.camera, implicits);
  for (std::size_t i = 0; i < objects.instances.size(); ++i) {
    const ObjectInstance& instance = objects.instances[i];
    if (!instance.implicit) continue;
    const ImplicitPlace place = place_of(instance);
    ImplicitInView implicit;
    implicit.implicit = instance.implicit;
    implicit.first_primitive =
        view.primitives.begin(SurfaceKind::kObjects) + objects.parts[i].first_triangle;
    implicit.first_place = static_cast<std::uint32_t>(implicits.places.size());
    implicit.first_in_order = static_cast<std::uint32_t>(implicits.order.size());
    set_planes(view, place, implicit);
    set_rays(view, place, implicit);
    const glm::dvec3 middle = place.base + glm::dvec3(0.0, 0.0, 0.5 * instance.implicit_size.z);
    const glm::dvec3 shown =
        glm::inverse(implicit.implicit_from_ray) * (middle - implicit.implicit_from_eye);
    implicit.middle_depth_m = std::max(glm::dot(shown, glm::dvec3(view.camera.forward)),
                                       static_cast<double>(implicits.near_m));
    if (view.kind == ViewKind::kRefraction) {
      bend_rays(implicits, view, place, implicit);
      const std::span<const glm::vec4> p_clip = view.vertices_of(SurfaceKind::kObjects).p_clip;
      set_extent(
          bent_place(p_clip.subspan(objects.parts[i].first_vertex, objects.parts[i].vertices),
                     view.viewport()),
          view.viewport(), implicit);
    } else {
      PartPlace whole{kAnywhere_px, kAnywhere_px, -kAnywhere_px, -kAnywhere_px, 0, 0};
      for (const RayPart& part : instance.implicit->parts) {
        implicits.places.push_back(place_in_window(implicits, implicit,
                                                   glm::dvec3(part.middle - part.half),
                                                   glm::dvec3(part.middle + part.half)));
        include(implicits.places.back(), whole);
      }
      set_extent(whole, view.viewport(), implicit);
    }
    add_order(implicit, implicits);
    implicits.implicits.push_back(implicit);
  }
}

std::optional<glm::dmat4x3> part_move(const ObjectInstance& object, std::uint32_t part,
                                      double step_s) {
  const RayPart& turning = object.implicit->parts[part];
  const glm::dvec3 spin(turning.spin);
  const double turns_per_s = glm::length(spin);
  if (turns_per_s == 0.0) return std::nullopt;
  const ImplicitPlace place = place_of(object);
  const glm::dmat3 turn =
      scene::turn_about(spin / turns_per_s, turns_per_s * step_s) - glm::dmat3(1.0);
  const glm::dmat3 moved = place.world_from_implicit * turn;
  const glm::dmat3 linear = moved * place.implicit_from_world;
  const glm::dvec3 arm_of_eye =
      place.base - place.implicit_from_world * place.bottom_rel - glm::dvec3(turning.hub);
  return glm::dmat4x3(linear[0], linear[1], linear[2], moved * arm_of_eye);
}

}  // namespace swell::render
