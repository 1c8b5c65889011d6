// A scene made ready to draw; world_state.h says what is in one.
#pragma once

#include <memory>
#include <span>

#include "math/parallel.h"
#include "render/world/world_making.h"
#include "scene/scene.h"

namespace swell::scene {
class Water;
}

namespace swell::render {

struct WorldState;

// A scene made ready to draw: sea state, terrain, static maps. Read-only while frames are drawn;
// several threads may draw the same World with a Workspace each. One that was moved from may only
// be assigned to or destroyed; whatever else is done with it aborts with a message.
class World {
 public:
  // Builds the same bits with any number of threads, in [1, 256]. Throws scene::SceneError (a value
  // out of its range, as for files), texture::FileError (a height image), or std::runtime_error if
  // there are not so many threads to be had.
  explicit World(scene::Scene scene, int threads = available_cpus());

  // Builds the same bits sooner: what one of `like` has made of the same (sky, sea, terrain with
  // its maps, coast) is shared with it, and its files are not read again. On `threads` threads;
  // with another wind alone 20 ms, 200 ms more for the trains of a coast.
  World(scene::Scene scene, std::span<const World* const> like, int threads);
  World(scene::Scene scene, const World& like, int threads);
  // As it says (render/world/world_making.h). Throws OverMemoryBound and Stopped too.
  World(scene::Scene scene, const WorldMaking& making);
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;
  const scene::Scene& scene() const;

  // Its water, to be asked without drawing (scene/water.h): the same, not made anew.
  scene::Water water() const;

  const WorldState& state() const;

 private:
  std::unique_ptr<WorldState> state_;
};

}  // namespace swell::render
