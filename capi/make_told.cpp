#include "capi/make_told.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "math/stop.h"
#include "math/with_ieee.h"

namespace swell::capi {
namespace {

using Make = std::function<std::shared_ptr<const NamedWorld>(render::WorldMaking)>;

// A world that another thread makes. One that is left before it is finished is stopped.
class Making {
 public:
  Making(const swell_scene& scene, const Make& make)
      : scene_(scene), make_(make), maker_([this] { run(); }) {}
  ~Making() {
    stop_ = true;
    maker_.join();
  }
  Making(const Making&) = delete;
  Making& operator=(const Making&) = delete;

  // Tells the caller until the world is made.
  std::shared_ptr<const NamedWorld> finish() {
    constexpr auto kTurn = std::chrono::milliseconds(10);
    while (true) {
      std::unique_lock lock(mutex_);
      const bool is_finished = changed_.wait_for(lock, kTurn, [&] { return is_finished_; });
      const std::vector<std::string> lines = std::exchange(lines_, {});
      const double done = done_;
      lock.unlock();
      tell(lines, done);
      if (!is_finished) continue;
      if (fault_) std::rethrow_exception(fault_);
      return made_;
    }
  }

 private:
  void run() {
    const ScopedStop stoppable(&stop_);
    render::WorldMaking making;
    making.stop = &stop_;
    making.tell = [this](double done) {
      const std::lock_guard lock(mutex_);
      done_ = done;
    };
    making.log = [this](const std::string& line) {
      const std::lock_guard lock(mutex_);
      lines_.push_back(line);
    };
    try {
      with_ieee([&] { made_ = make_(making); });
    } catch (...) {
      fault_ = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    is_finished_ = true;
    changed_.notify_one();
  }

  void tell(const std::vector<std::string>& lines, double done) {
    if (scene_.log)
      for (const std::string& line : lines) scene_.log(scene_.user, line.c_str());
    if (scene_.progress && scene_.progress(scene_.user, done) != 0) throw Stopped();
  }

  const swell_scene& scene_;
  const Make& make_;
  std::atomic<bool> stop_ = false;
  std::mutex mutex_;  // of what follows, and of what was made before is_finished_
  std::condition_variable changed_;
  bool is_finished_ = false;
  double done_ = 0.0;
  std::vector<std::string> lines_;
  std::shared_ptr<const NamedWorld> made_;
  std::exception_ptr fault_;
  std::thread maker_;  // begins when all else is there
};

}  // namespace

std::shared_ptr<const NamedWorld> make_told(const swell_scene& scene, const Make& make) {
  if (!scene.progress && !scene.log) return make({});
  return Making(scene, make).finish();
}

}  // namespace swell::capi
