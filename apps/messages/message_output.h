// Where a simulation's messages go: a file, or a transport.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "apps/messages/messages.h"

namespace swell::apps {

struct Topic {
  std::string name;       // "/camera/image_raw"
  std::string_view type;  // kType of the message that it carries
  bool is_kept = false;   // those who come later get its last message too, as of /tf_static
};

// Made for the topics that it is given. What cannot be written throws texture::FileError.
class MessageOutput {
 public:
  virtual ~MessageOutput() = default;

  // A message of topic number `topic`, in the order of their stamps.
  virtual void write(std::size_t topic, std::int64_t stamp_ns, const msg::Message& message) = 0;

  // After the last one.
  virtual void finish() = 0;
};

}  // namespace swell::apps
