#include "apps/view/world_rebuild.h"

#include <exception>
#include <utility>

namespace swell::view {

WorldRebuilder::WorldRebuilder() : thread_([this] { run(); }) {}

WorldRebuilder::~WorldRebuilder() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void WorldRebuilder::request(scene::Scene scene) {
  {
    const std::lock_guard lock(mutex_);
    wanted_ = std::move(scene);
  }
  wake_.notify_one();
}

bool WorldRebuilder::swap_if_ready(std::unique_ptr<render::World>& world) {
  {
    const std::lock_guard lock(mutex_);
    if (!ready_ || retired_) return false;
    retired_ = std::exchange(world, std::move(ready_));
  }
  wake_.notify_one();
  return true;
}

bool WorldRebuilder::busy() const {
  const std::lock_guard lock(mutex_);
  return wanted_ || building_ || ready_;
}

std::string WorldRebuilder::error() const {
  const std::lock_guard lock(mutex_);
  return error_;
}

void WorldRebuilder::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return stop_ || wanted_ || retired_; });
    if (stop_) return;

    // Free what the frame loop has handed back.
    if (std::unique_ptr<render::World> old = std::move(retired_)) {
      lock.unlock();
      old.reset();
      lock.lock();
      continue;
    }

    // Build the newest request; a newer one may arrive meanwhile.
    scene::Scene scene = std::move(*wanted_);
    wanted_.reset();
    building_ = true;
    lock.unlock();
    std::unique_ptr<render::World> built;
    std::string error;
    try {
      built = std::make_unique<render::World>(std::move(scene));
    } catch (const std::exception& e) {
      error = e.what();
    }
    lock.lock();
    building_ = false;
    error_ = std::move(error);
    if (built) ready_ = std::move(built);
  }
}

}  // namespace swell::view
