#include "capi/asked_sea.h"

#include "ocean/open_sea/sea.h"
#include "render/sea/sea_maps.h"
#include "render/world/world_state.h"

namespace swell::capi {

const render::WorldState& state_of(const swell_session& session) {
  return session.named->world.state();
}

const ocean::SeaFrame& sea_at(double t_s, swell_session& session,
                              std::span<const ocean::Disturbance> more) {
  return frame_at(t_s, session.sea, [&](ocean::SeaFrame& frame) {
    advance_waves(state_of(session), t_s, more, {}, frame, session.workers);
  });
}

const ocean::VelocityFrame& velocity_at(double t_s, swell_session& session) {
  return frame_at(t_s, session.velocity, [&](ocean::VelocityFrame& frame) {
    ocean::advance_velocity(*state_of(session).sea, session.sea.frame, frame, session.workers);
  });
}

void Forgetting::forget() {
  session_.sea.t_s.reset();
  session_.velocity.t_s.reset();
  session_.below.t_s.reset();
}

}  // namespace swell::capi
