// Topics of DDS whose samples are bytes in CDR: a sample that is written or taken is a
// std::vector<std::uint8_t>, its four bytes of encapsulation first. One type does for all messages;
// to other nodes it is of the name that it is given, without a description of its own (XTypes), as
// the types of ROS 2's nodes are.
#pragma once

#include <dds/dds.h>

#include <string>

struct ddsi_sertype;

namespace swell::apps {

// A topic of the participant, which owns it, or a negative return code of DDS; and its type as
// Cyclone has it, which lives as long.
struct CdrTopic {
  dds_entity_t entity = 0;
  const ddsi_sertype* type = nullptr;
};
CdrTopic create_cdr_topic(dds_entity_t participant, const std::string& topic,
                          const std::string& type);

}  // namespace swell::apps
