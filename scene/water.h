// The water of a scene, as something to ask at any place and time.
//
//   const scene::Scene scene = scene::load_scene("harbour.toml");
//   const scene::Water water(scene);
//   swell::Workers workers(2);
//   ocean::SeaFrame frame;  // one for each time that is kept
//   const scene::WaterSurface surface = water.at(t_s, frame, workers);
//   std::vector<float> height_m(buoys.size());
//   surface.heights(buoys, height_m);  // std::vector<glm::dvec2> buoys: x east, y north
//   const bool wet = surface.in_water({12.0, 40.0, -0.5});
//
// Foam, which knows the waves of some seconds before, is made beside it:
//
//   const ocean::Whitecaps whitecaps =
//       ocean::make_whitecaps(water.sea(), water.coast(), workers);  // ocean/coast/train_square.h
//   ocean::WhitecapFrame foam;
//   ocean::advance_whitecaps(whitecaps, t_s, foam, workers);
//   std::vector<float> white(buoys.size());
//   surface.foam(buoys, foam, white);
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "math/parallel.h"
#include "ocean/coast/coast.h"
#include "ocean/coast/shelter.h"
#include "ocean/coast/surf_fronts.h"
#include "ocean/open_sea/sea.h"
#include "ocean/wakes/disturbance.h"
#include "ocean/water_surface.h"
#include "scene/scene.h"
#include "terrain/height_grid.h"
#include "terrain/shore_map.h"

namespace swell::scene {

using WaterHit = ocean::WaterHit;
using WaterSurface = ocean::WaterSurface;

// What of a scene's water does not change with time, for programs that ask and do not draw.
class Water {
 public:
  // Throws SceneError (a value out of its range) or texture::FileError (a height image). Rivers and
  // lakes are made with this many threads, 1 to 256, the same with any.
  explicit Water(const Scene& scene, int threads = 1);

  // Fills `frame` with the sea at any finite time, past or to come, and looks at it. `more`
  // disturbs the water besides what the scene has, in this frame.
  WaterSurface at(double t_s, ocean::SeaFrame& frame, Workers& workers,
                  std::span<const ocean::Disturbance> more = {}) const;

  // Whether the sea or a sheet of its swash covers the ground at p_world, as pictures show it, at
  // the surface's time.
  bool wets(const WaterSurface& surface, glm::dvec2 p_world) const;

  const ocean::Sea& sea() const { return sea_; }
  const terrain::HeightGrid* terrain() const { return terrain_ ? &*terrain_ : nullptr; }
  const terrain::ShoreMap* shore() const { return shore_ ? &*shore_ : nullptr; }
  const ocean::InlandWater* inland() const { return inland_ ? &*inland_ : nullptr; }
  const ocean::CoastSea* coast() const { return coast_ ? &*coast_ : nullptr; }
  const ocean::Shelter* shelter() const { return shelter_ ? &*shelter_ : nullptr; }
  const ocean::SurfFronts* fronts() const { return fronts_ ? &*fronts_ : nullptr; }

 private:
  ocean::Sea sea_;
  SeaArea area_;
  std::optional<terrain::HeightGrid> terrain_;
  std::optional<terrain::ShoreMap> shore_;
  std::optional<ocean::InlandWater> inland_;
  std::optional<ocean::CoastSea> coast_;
  std::optional<ocean::Shelter> shelter_;
  std::optional<ocean::SurfFronts> fronts_;
  std::vector<ocean::Disturbance> disturbances_;
};

}  // namespace swell::scene
