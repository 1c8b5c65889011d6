#include "apps/view/world_rebuild.h"

#include <sys/resource.h>

#include <exception>
#include <utility>

namespace swell::view {
namespace {

// A third of a frame thread's share of a CPU, so that frames become a sixth longer, not a half,
// when all CPUs draw, and the waves are there within a second all the same. One thread, for the
// same reason.
constexpr int kNice = 5, kThreads = 1;

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
  setpriority(PRIO_PROCESS, 0, kNice);  // Linux: of this thread; a refusal only costs time
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
