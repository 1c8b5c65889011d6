// Frames with smooth edges, for their tests: small pictures, the parts of their pixels, and the
// same pictures moved by parts of a pixel, to judge them by.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "math/simd_target.h"
#include "render/drawn_shots.h"
#include "render/workspace.h"

namespace swell::render {

// A shipped scene, made once: drawing does not change it.
inline const World& shipped_world(const std::string& name) {
  static std::map<std::string, World> worlds;
  const auto found = worlds.find(name);
  return found != worlds.end() ? found->second
                               : worlds.emplace(name, World(load_shipped(name))).first->second;
}

inline View view_of(const World& world, double t_s, int width_px, int height_px) {
  return scene::camera_view(world.scene().camera, t_s, width_px, height_px);
}

// A flat, smooth sea under a sky of one colour, nearly without haze: what is left is edges.
inline scene::Scene plain_scene() {
  scene::Scene scene;
  scene.sea.wind_speed_mps = 0.0;
  scene.sea.resolution = 64;
  scene.water.bump_strength = 0.0;
  scene.detail.triangulation = scene::Triangulation::kPlane;
  scene.sky.zenith = scene.sky.horizon = glm::vec3(0.04f, 0.08f, 0.16f);
  scene.sky.sun_radiance = glm::vec3(2.0f);
  scene.sky.cloud_cover = 0.0;
  scene.sky.haze_distance_m = 1e6;
  scene.sky.sun_azimuth_rad = kPi;  // behind a camera that looks north
  scene.sky.sun_direction = {0.0f, -0.8660254f, 0.5f};
  return scene;
}

inline scene::FloatingObject white_box(glm::dvec2 position_m, glm::dvec3 size_m) {
  scene::FloatingObject box;
  box.kind = scene::ObjectKind::kBox;
  box.position_m = position_m;
  box.size_m = size_m;
  box.colour = glm::vec3(0.9f);
  return box;
}

// A camera that looks north along the sea, level but for its roll.
inline View north_view(double eye_z_m, double roll_rad, double fov_y_rad, int width_px,
                       int height_px) {
  return make_view({0.0, 0.0, eye_z_m}, camera_axes(0.0, 0.0, roll_rad),
                   lens_of_fov(fov_y_rad, width_px, height_px), 0.25f, width_px, height_px);
}

// The view whose pixels' middles lie where this one's lie, moved by (right, down) pixels.
inline View moved(const View& view, glm::dvec2 by_px) {
  const Lens lens = {.tan_half_x = view.tan_half_x,
                     .tan_half_y = view.tan_half_y,
                     .tan_middle_x = view.tan_middle_x + 2.0 * by_px.x / view.width_px *
                                                             static_cast<double>(view.tan_half_x),
                     .tan_middle_y = view.tan_middle_y - 2.0 * by_px.y / view.height_px *
                                                             static_cast<double>(view.tan_half_y)};
  const glm::dmat3 axes(view.right, view.forward, view.up);
  return make_view(view.eye_world, axes, lens, view.near_m, view.width_px, view.height_px);
}

// 64 places of a pixel from its middle, one in each of 64 columns and of 64 rows, evenly spread
// (Hammersley's points).
inline std::array<glm::dvec2, 64> rook_places() {
  std::array<glm::dvec2, 64> places;
  for (int i = 0; i < 64; ++i) {
    int mirrored = 0;
    for (int bit = 0; bit < 6; ++bit) mirrored |= (i >> bit & 1) << (5 - bit);
    places[static_cast<std::size_t>(i)] = {(i + 0.5) / 64.0 - 0.5, (mirrored + 0.5) / 64.0 - 0.5};
  }
  return places;
}

// The place of a sample from the pixel's middle.
inline glm::dvec2 place_of_sample(const raster::SamplePosition& p) {
  return glm::dvec2(p.x_fx8, p.y_fx8) / 256.0 - 0.5;
}

// sRGB bytes as light of the display, in [0, 1] (IEC 61966-2-1).
inline double display_light(std::uint32_t rgba, int channel) {
  const double code = (rgba >> (8 * channel) & 255u) / 255.0;
  return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}

// What a pixel's centre shows.
struct Centre {
  float z = 0.0f;
  std::uint32_t primitive = raster::kNoPrimitive;
};

// Draws one frame after another of a world.
class EdgeRenderer {
 public:
  explicit EdgeRenderer(const World& world, double t_s = 0.0, int threads = 2)
      : world_(world), t_s_(t_s), workers_(threads) {
    options.water_triangles = options.terrain_triangles = 4000;
    options.edge_samples = 0;
  }

  FrameStatistics draw(const View& view, int edge_samples) {
    options.edge_samples = edge_samples;
    return render_frame(world_, view, t_s_, options, workspace_, target, workers_);
  }

  const Workspace::State& state() const { return workspace_.state(); }

  // By pixel of the picture.
  std::vector<Centre> centres() const {
    const VisibilityBuffer& buffer = state().visibility;
    std::vector<Centre> centres(pixel_count());
    for_each_pixel([&](int tile, std::size_t in_tile, std::size_t pixel) {
      if (buffer.covered[static_cast<std::size_t>(tile)] >= 0)
        centres[pixel] = {buffer.depth_of(tile)[in_tile], buffer.primitive_of(tile)[in_tile]};
    });
    return centres;
  }

  // The same, in the order in which the tiles hold them.
  std::vector<std::vector<EdgeFragment>> fragments() const {
    std::vector<std::vector<EdgeFragment>> of_pixel(pixel_count());
    const raster::TileGrid& grid = state().visibility.grid;
    for (int tile = 0; tile < grid.count(); ++tile) {
      const raster::PixelBox box = raster::tile_box(state().window.viewport(), grid, tile);
      for (const EdgeFragment& f : state().edges.of_tile[static_cast<std::size_t>(tile)]) {
        const int x_px = box.x0_px + f.pixel % grid.tile_size_px;
        const int y_px = box.y0_px + f.pixel / grid.tile_size_px;
        of_pixel.at(static_cast<std::size_t>(y_px * target.width_px + x_px)).push_back(f);
      }
    }
    return of_pixel;
  }

  // 0 the sky, 1 the water, 2 the land, 3 an object.
  int kind_of(std::uint32_t primitive) const {
    for (const SurfaceKind kind : kAllSurfaces)
      if (state().window.primitives.holds(kind, primitive)) return 1 + static_cast<int>(kind);
    return 0;
  }

  // The same, but for every object its own.
  std::ptrdiff_t surface_of(std::uint32_t primitive) const {
    const ObjectGeometry& objects = state().meshes.objects;
    if (kind_of(primitive) < 3) return kind_of(primitive);
    const std::uint32_t n = primitive - state().window.primitives.begin(SurfaceKind::kObjects);
    return 3 + (objects.primitives[n].object - objects.instances.data());
  }

  Target target;
  FrameOptions options;

 private:
  std::size_t pixel_count() const { return target.rgba.size(); }

  template <class Visit>
  void for_each_pixel(const Visit& visit) const {
    const raster::TileGrid& grid = state().visibility.grid;
    for (int tile = 0; tile < grid.count(); ++tile) {
      const raster::PixelBox box = raster::tile_box(state().window.viewport(), grid, tile);
      for (int y = 0; y < box.height_px; ++y)
        for (int x = 0; x < box.width_px; ++x)
          visit(tile, static_cast<std::size_t>(y * grid.tile_size_px + x),
                static_cast<std::size_t>((box.y0_px + y) * target.width_px + box.x0_px + x));
    }
  }

  const World& world_;
  double t_s_;
  Workers workers_;
  Workspace workspace_;
};

}  // namespace swell::render
