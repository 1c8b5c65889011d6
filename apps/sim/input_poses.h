// Poses of bodies that come from outside, kept by their stamps: where a body is between two of
// them, and how it moves.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/sim/frames.h"
#include "apps/sim/simulation.h"

namespace swell::apps {

struct StampedPose {
  std::int64_t stamp_ns = 0;
  glm::dvec3 position_m{0.0};                  // in "map"
  glm::dquat orientation{1.0, 0.0, 0.0, 0.0};  // w, x, y, z; of length 1

  bool operator==(const StampedPose&) const = default;
};

// Answers depend on what was added and on the horizon alone, not on the order of adding. Used by
// one thread at a time.
class InputPoses {
 public:
  // Keeps a pose; one of the same stamp gives way. Of a body at most 20,000 are kept. False if it
  // was there already.
  bool add(std::string_view frame, const StampedPose& pose);

  void forget_all() { tracks_.clear(); }

  // Whether a pose of this time or later is kept, whatever the horizon.
  bool reaches(std::string_view frame, const Moment& moment) const;

  // Poses after this moment are not looked at, those 10 s before it no longer kept, but for the
  // last one.
  void set_horizon(const Moment& moment);

  // The pose at a moment: between the two around it (positions along a line, orientations along the
  // shorter turn), after the last one that one: nothing is extrapolated. None before the first one.
  std::optional<FramePose> at(std::string_view frame, const Moment& moment) const;

  // When a body's poses are to be differenced: at `end` and one and two steps before it. The step
  // is 40 ms, or the time between poses if that is longer; `end` is the moment, or the last pose if
  // none has come since and that was 1 s ago or less. None while the first pose is less than two
  // steps old, unless the body stands still since.
  struct Window {
    Moment end;
    std::int64_t step_ns = 0;
  };
  std::optional<Window> motion_window(std::string_view frame, const Moment& moment) const;

 private:
  using Track = std::vector<StampedPose>;  // by stamps, no two alike

  const Track* find(std::string_view frame) const;
  // One behind the last pose of the track at or before the moment and the horizon.
  std::size_t count_until(const Track& track, std::int64_t t_ns) const;

  std::map<std::string, Track, std::less<>> tracks_;
  std::int64_t horizon_ns_ = 0;
};

}  // namespace swell::apps
