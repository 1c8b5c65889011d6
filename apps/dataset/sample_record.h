// What a data set keeps of a sample beside its files.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "apps/shared/json.h"

namespace swell::apps {

// A record's text: `content` and the hash over it, in a line.
std::string record_text(const Json& content);

struct SampleRecord {
  std::string recipe;  // the hash of what it was drawn from
  int sample = 0;
  Json files, facts;      // objects: hashes by names; COCO's image and annotations
  bool has_hash = false;  // false: of a version that wrote none
  bool is_whole = false;  // every byte is as it was written
};

// Nothing if the bytes are no record at all: other text, or JSON of another shape.
std::optional<SampleRecord> parse_record(std::span<const std::uint8_t> bytes);

}  // namespace swell::apps
