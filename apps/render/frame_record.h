// What swell-render tells of a frame: one line of text (--hash) or of JSON (--json), and what
// --expect reads back from either.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace swell::apps {

struct FrameRecord {
  int frame = 0;
  double t_s = 0.0;
  int width_px = 0, height_px = 0;
  std::uint64_t hash = 0;  // render::picture_hash
  std::string scene;       // its name
  std::string out;         // the picture's file, or empty
  double file_ms = -1.0;   // what encoding and writing all of its files took; below 0: none
};

// 'frame N xxh3 <16 hex digits>' and a line break.
std::string hash_line(const FrameRecord& record);

// {"frame", "t_s", "size": [w, h], "xxh3": 16 hex digits, "scene", "out": path or null, "file_ms":
// number or null} and a line break. Bytes of names that are not UTF-8 become U+FFFD.
std::string json_line(const FrameRecord& record);

struct FrameHash {
  int frame = 0;  // >= 0
  std::uint64_t hash = 0;
};

// Reads a line of either kind, without its line break; nothing if it is neither. Of JSON it looks
// at "frame" and "xxh3" alone.
std::optional<FrameHash> parse_frame_line(std::string_view line);

}  // namespace swell::apps
