#include "apps/view/world_rebuild.h"

#include <sys/resource.h>

#include <exception>
#include <utility>

namespace swell::view {
namespace {

// A change of the wind at a beach is 180 ms of work. Where two threads draw 1280x720 in 30 ms on
// two CPUs, it shows after 0.5 s and frames take 39 ms meanwhile; with a nice value of 3 after
// 0.4 s and 44 ms, of 10 after 0.9 s and 36 ms. One thread, so that no more than one of the
// frame's threads gives way.
constexpr int kNice = 7, kThreads = 1;

}  // namespace

WorldRebuilder::WorldRebuilder() : thread_([this] { run(); }) {}

WorldRebuilder::~WorldRebuilder() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void WorldRebuilder::request(scene::Scene scene, std::shared_ptr<const render::World> like) {
  {
    const std::lock_guard lock(mutex_);
    wanted_ = Request{std::move(scene), std::move(like)};
  }
  wake_.notify_one();
}

bool WorldRebuilder::swap_if_ready(std::shared_ptr<const render::World>& world) {
  {
    const std::lock_guard lock(mutex_);
    if (!ready_ || retired_) return false;
    retired_ = std::exchange(world, std::exchange(ready_, nullptr));
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
  // On Linux of this thread alone. A refusal only costs time.
  setpriority(PRIO_PROCESS, 0, getpriority(PRIO_PROCESS, 0) + kNice);
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return stop_ || wanted_ || retired_; });
    if (stop_) return;

    // Free what the frame loop has handed back.
    if (std::shared_ptr<const render::World> old = std::exchange(retired_, nullptr)) {
      lock.unlock();
      old.reset();
      lock.lock();
      continue;
    }

    // Build the newest request; a newer one may arrive meanwhile.
    Request request = std::move(*wanted_);
    wanted_.reset();
    building_ = true;
    lock.unlock();
    std::shared_ptr<const render::World> built;
    std::string error;
    try {
      built = std::make_shared<render::World>(std::move(request.scene), *request.like, kThreads);
    } catch (const std::exception& e) {
      error = e.what();
    }
    request.like.reset();  // here, where nobody waits
    lock.lock();
    building_ = false;
    error_ = std::move(error);
    if (built) ready_ = std::move(built);
  }
}

}  // namespace swell::view
