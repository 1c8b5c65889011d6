// Transports between processes: what a simulation's messages go to and its inputs come from.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "apps/messages/message_output.h"
#include "apps/sim/inputs.h"

namespace swell::scene {
class Water;
}

namespace swell::apps {

// It has to outlive what it gives.
class Transport {
 public:
  virtual ~Transport() = default;

  // Publishes the topics, and answers for the water where the transport has services.
  virtual std::unique_ptr<MessageOutput> output(std::span<const Topic> topics,
                                                const scene::Water& water) = 0;

  // Takes poses of the bodies of `inputs`, and the clock.
  virtual std::unique_ptr<InputSource> source(bool takes_clock, Inputs& inputs) = 0;

  // Who can hear it, in one line; once it has an output.
  virtual std::string audience() const = 0;
};

// ROS 2 over DDS (apps/dds), as its environment variables say. In lock-step it waits for
// subscribers that take less than is published, who else miss the oldest, and what one publisher
// sends comes in its order. Throws OptionError, also where it is not built.
std::unique_ptr<Transport> open_dds(bool is_lock_step);

// Gazebo's (apps/gazebo), as its environment variables say. `poses` is the topic of bodies' poses;
// empty: /model/FRAME/pose. Throws OptionError where it is not built.
std::unique_ptr<Transport> open_gazebo(const std::string& poses);

}  // namespace swell::apps
