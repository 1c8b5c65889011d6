// Handles of the C interface that are owned, and its errors as exceptions of Python.
#pragma once

#include <pybind11/pybind11.h>
#include <swell.h>

#include <memory>
#include <mutex>
#include <new>
#include <stdexcept>
#include <utility>
#include <vector>

namespace swell_python {

namespace py = pybind11;

// A scene that cannot be made; swell.SceneError in Python.
class SceneError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

inline void check(swell_status status) {
  const char* const message = swell_last_error();
  switch (status) {
    case SWELL_OK:
      return;
    case SWELL_BAD_ARGUMENT:
      throw py::value_error(message);
    case SWELL_BAD_SCENE:
      throw SceneError(message);
    case SWELL_NO_MEMORY:
      throw std::bad_alloc();
    default:
      throw std::runtime_error(message);
  }
}

// Runs without the lock of the interpreter.
template <class Call>
void call(const Call& c_function) {
  const py::gil_scoped_release others_may_run;
  check(c_function());  // on the thread that has the message
}

struct Deleter {
  void operator()(swell_world* world) const { swell_world_destroy(world); }
  void operator()(swell_session* session) const { swell_session_destroy(session); }
  void operator()(swell_picture* picture) const { swell_picture_destroy(picture); }
};
template <class Handle>
using Owned = std::unique_ptr<Handle, Deleter>;

// Sessions and pictures of a world that are not in use.
class Pool {
 public:
  Pool(Owned<swell_world> world, int threads) : world_(std::move(world)), threads_(threads) {}

  const swell_world* world() const { return world_.get(); }

  Owned<swell_session> take_session() {
    if (auto session = take(sessions_)) return session;
    swell_session* made = nullptr;
    check(swell_session_create(world_.get(), threads_, &made));
    return Owned<swell_session>(made);
  }

  Owned<swell_picture> take_picture() {
    if (auto picture = take(pictures_)) return picture;
    swell_picture* made = nullptr;
    check(swell_picture_create(&made));
    return Owned<swell_picture>(made);
  }

  void give_back(Owned<swell_session> session) { give_back(std::move(session), sessions_); }
  void give_back(Owned<swell_picture> picture) { give_back(std::move(picture), pictures_); }

 private:
  static constexpr std::size_t kMost = 4;  // that are kept of each

  template <class Handle>
  Owned<Handle> take(std::vector<Owned<Handle>>& from) {
    const std::lock_guard lock(mutex_);
    if (from.empty()) return {};
    Owned<Handle> handle = std::move(from.back());
    from.pop_back();
    return handle;
  }

  template <class Handle>
  void give_back(Owned<Handle> handle, std::vector<Owned<Handle>>& to) {
    const std::lock_guard lock(mutex_);
    if (handle && to.size() < kMost) to.push_back(std::move(handle));
  }

  Owned<swell_world> world_;
  int threads_;
  std::mutex mutex_;
  std::vector<Owned<swell_session>> sessions_;
  std::vector<Owned<swell_picture>> pictures_;
};

// A session for one call; every thread has its own.
class Session {
 public:
  explicit Session(Pool& pool) : pool_(pool), handle_(pool.take_session()) {}
  ~Session() { pool_.give_back(std::move(handle_)); }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  swell_session* get() const { return handle_.get(); }

 private:
  Pool& pool_;
  Owned<swell_session> handle_;
};

}  // namespace swell_python
