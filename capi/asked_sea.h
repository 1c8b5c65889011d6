// The sea that a session is asked for: what it keeps of a time.
#pragma once

#include <span>

#include "capi/handles.h"

namespace swell::ocean {
struct Disturbance;
}
namespace swell::render {
struct WorldState;
}

namespace swell::capi {

// x and y of points are below this.
inline constexpr double kFarthest_m = 1e9;

// The frame of a time: advanced, unless it is of that time already.
template <class Frame, class Advance>
const Frame& frame_at(double t_s, AtTime<Frame>& kept, const Advance& advance) {
  if (kept.t_s != t_s) {
    kept.t_s.reset();
    advance(kept.frame);
    kept.t_s = t_s;
  }
  return kept.frame;
}

const render::WorldState& state_of(const swell_session& session);

// With `more` disturbances, inside a Forgetting.
const ocean::SeaFrame& sea_at(double t_s, swell_session& session,
                              std::span<const ocean::Disturbance> more = {});
// At the time of sea_at(), which is called before.
const ocean::VelocityFrame& velocity_at(double t_s, swell_session& session);

// Around a call with disturbances of its own: what a session keeps of a time is without them.
class Forgetting {
 public:
  explicit Forgetting(swell_session& session) : session_(session) { forget(); }
  ~Forgetting() { forget(); }
  Forgetting(const Forgetting&) = delete;
  Forgetting& operator=(const Forgetting&) = delete;

 private:
  void forget();
  swell_session& session_;
};

}  // namespace swell::capi
