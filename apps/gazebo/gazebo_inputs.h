// The clock and poses of bodies from Gazebo's transport.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "apps/messages/messages.h"

namespace swell::apps {

// What takes that which comes; called from the transport's threads, one at a time.
struct GazeboTakers {
  std::function<void(std::string_view topic, std::int64_t t_ns)> clock;
  std::function<void(std::string_view topic, std::string_view frame, std::int64_t t_ns,
                     const msg::Pose& pose)>
      pose;
  std::function<void(std::string_view topic, const std::string& what)> refuse;
};

struct GazeboInputTopics {
  std::span<const std::string> frames;  // of bodies whose poses come from outside
  std::string poses = {};               // topic; empty: /model/FRAME/pose
  bool has_clock = false;               // listen to /clock
};

// Listens from its making to its end, after which nothing is taken any more.
class GazeboInputs {
 public:
  // Throws OptionError for a name that the transport does not take; without one, as check_gazebo().
  GazeboInputs(const GazeboInputTopics& topics, GazeboTakers takers);
  ~GazeboInputs();
  GazeboInputs(const GazeboInputs&) = delete;
  GazeboInputs& operator=(const GazeboInputs&) = delete;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace swell::apps
