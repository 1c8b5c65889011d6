// Makes new worlds beside the frame loop, so that a change of the waves never stalls a frame.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "render/frame.h"

namespace swell::view {

// One thread of low priority that builds one world at a time, with what it can take over from an
// older one. Requests that come while it is busy replace one another: only the newest is built.
class WorldRebuilder {
 public:
  WorldRebuilder();
  ~WorldRebuilder();  // waits for the world being built
  WorldRebuilder(const WorldRebuilder&) = delete;
  WorldRebuilder& operator=(const WorldRebuilder&) = delete;

  // `like`: a world whose sky and terrain are taken over where the scene has the same.
  void request(scene::Scene scene, std::shared_ptr<const render::World> like);

  // Puts the newest finished world in place of `world` and has the old one freed by the thread.
  // False if there is none. Never waits for a build.
  bool swap_if_ready(std::shared_ptr<const render::World>& world);

  // True while a request is waiting or being built, or its world has not been taken.
  bool busy() const;

  // Why the last build failed; empty if it did not. The world is kept in that case.
  std::string error() const;

 private:
  struct Request {
    scene::Scene scene;
    std::shared_ptr<const render::World> like;
  };

  void run();

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  bool stop_ = false, building_ = false;
  std::optional<Request> wanted_;
  std::shared_ptr<const render::World> ready_, retired_;
  std::string error_;
  std::thread thread_;  // last: starts when everything above is there
};

}  // namespace swell::view
