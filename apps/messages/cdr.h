// Messages as ROS 2 has them in bags and on the wire: CDR of the OMG, version 1, little endian,
// behind the four bytes that say so.
//
// Source: Object Management Group, DDS Interoperability Wire Protocol (DDSI-RTPS) 2.3, clause 10.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/messages/messages.h"

namespace swell::apps {

// The message's bytes. They depend on the message alone.
std::vector<std::uint8_t> cdr_bytes(const msg::Message& message);

}  // namespace swell::apps
