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
// How the water moves below the surface (ocean/below_frame.h), which pressure moves it, and what
// that does to hulls:
//
//   ocean::VelocityFrame velocity;
//   ocean::advance_velocity(water.sea(), frame, velocity, workers);
//   ocean::BelowFrame below;  // like the frame, of one time
//   ocean::begin_below(water.sea(), frame, &velocity, below);
//   std::vector<ocean::WaterMotion> motion(places.size());  // std::vector<glm::dvec3> places
//   surface.motions(places, {}, ocean::kSeaDensity_kg_m3, below, workers, motion);
//   const ocean::HullLoads loads =
//       surface.hull_loads(hull, centre_of_mass, ocean::kSeaDensity_kg_m3, below, workers);
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
#include <memory>
#include <vector>

#include "math/parallel.h"
#include "ocean/coast/coast.h"
#include "ocean/coast/shelter.h"
#include "ocean/coast/surf_fronts.h"
#include "ocean/open_sea/sea.h"
#include "ocean/wakes/disturbance.h"
#include "ocean/wakes/made_fields.h"
#include "ocean/water_surface.h"
#include "scene/scene.h"
#include "terrain/height_grid.h"
#include "terrain/shore_map.h"

namespace swell::scene {

using WaterHit = ocean::WaterHit;
using WaterSurface = ocean::WaterSurface;

// What of a scene's water does not change with time, for programs that ask. Those that draw too
// take that of their world: render::World::water(). Copies share it.
class Water {
 public:
  // All but the sea and what disturbs it may be missing.
  struct Parts {
    std::shared_ptr<const ocean::Sea> sea;
    SeaArea area;
    std::shared_ptr<const terrain::HeightGrid> terrain;
    std::shared_ptr<const terrain::ShoreMap> shore;
    std::shared_ptr<const ocean::InlandWater> inland;
    std::shared_ptr<const ocean::CoastSea> coast;
    std::shared_ptr<const ocean::Shelter> shelter;
    std::shared_ptr<const ocean::SurfFronts> fronts;
    std::vector<ocean::Disturbance> disturbances;
  };

  // Throws SceneError (a value out of its range) or texture::FileError (a height image). Rivers and
  // lakes are made with this many threads, 1 to 256, the same with any.
  explicit Water(const Scene& scene, int threads = 1);
  // Of one scene's parts.
  explicit Water(Parts parts) : parts_(std::move(parts)) {}

  // Fills `frame` with the sea at any finite time, past or to come, and looks at it. `more`
  // disturbs the water besides what the scene has, in this frame. Where few points are asked, wakes
  // that are made when they are asked take half of the time or less; the water, or the world that
  // it is of, then has to outlive the frame's use.
  WaterSurface at(double t_s, ocean::SeaFrame& frame, Workers& workers,
                  std::span<const ocean::Disturbance> more = {},
                  ocean::MakeWakes wakes = ocean::MakeWakes::kNow) const;

  // Whether the sea or a sheet of its swash covers the ground at p_world, as pictures show it, at
  // the surface's time.
  bool wets(const WaterSurface& surface, glm::dvec2 p_world) const;

  const ocean::Sea& sea() const { return *parts_.sea; }
  const terrain::HeightGrid* terrain() const { return parts_.terrain.get(); }
  const terrain::ShoreMap* shore() const { return parts_.shore.get(); }
  const ocean::InlandWater* inland() const { return parts_.inland.get(); }
  const ocean::CoastSea* coast() const { return parts_.coast.get(); }
  const ocean::Shelter* shelter() const { return parts_.shelter.get(); }
  const ocean::SurfFronts* fronts() const { return parts_.fronts.get(); }

 private:
  Parts parts_;
};

}  // namespace swell::scene
