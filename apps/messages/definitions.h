// The public definitions of the messages, as text that readers of recordings need.
#pragma once

#include <string>
#include <string_view>

namespace swell::apps {

// The definition of "sensor_msgs/msg/Image" with those of all that it is made of, in the form
// "ros2msg" of bags. The type is one that msg::Message holds.
std::string message_definition(std::string_view type);

}  // namespace swell::apps
