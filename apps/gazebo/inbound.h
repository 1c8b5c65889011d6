// What is read of messages that come in on Gazebo's transport.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "apps/gazebo/gazebo_inputs.h"
#include "apps/gazebo/names.h"

namespace swell::apps {

// All of these may be called with any message.

// The simulation's time of a clock.
void take_clock(std::string_view topic, const gz_msgs::Clock& clock, const GazeboTakers& takers);

// The pose of a body, one of `frames`, by its name; what has another name is left out without a
// word, as worlds have more models. A pose without a name is that of `topic_frame`, if that is not
// empty. Without a stamp of its own it has its vector's.
void take_pose(std::string_view topic, const gz_msgs::Pose& pose,
               std::span<const std::string> frames, std::string_view topic_frame,
               const GazeboTakers& takers);
void take_poses(std::string_view topic, const gz_msgs::Pose_V& poses,
                std::span<const std::string> frames, std::string_view topic_frame,
                const GazeboTakers& takers);

}  // namespace swell::apps
