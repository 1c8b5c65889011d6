// Reads the messages that come from outside from their bytes: as cdr.h writes them, in either byte
// order.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "apps/messages/messages.h"

namespace swell::apps {

// Nothing where the bytes are those of no such message: too few, lengths that are not true, text
// without its end, over three bytes left. Numbers are as they come; nanoseconds may be any.
std::optional<msg::Clock> read_clock(std::span<const std::uint8_t> bytes);
std::optional<msg::PoseStamped> read_pose_stamped(std::span<const std::uint8_t> bytes);

}  // namespace swell::apps
