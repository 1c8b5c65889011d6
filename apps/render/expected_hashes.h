// The hashes that the frames of a run are expected to have (--expect).
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace swell::apps {

class ExpectedHashes {
 public:
  // Reads a file of parse_frame_line's lines, one or more for each frame. Throws
  // texture::FileError: 'PATH: ...' if it cannot be read, 'PATH:LINE: ...' at the first line that
  // is of neither kind or has another hash for a frame than a line before it.
  explicit ExpectedHashes(const std::filesystem::path& path);

  // What is wrong with the hash that was found for a frame; empty if it is the expected one.
  std::string fault(int frame, std::uint64_t found) const;

 private:
  std::string file_;
  std::map<int, std::uint64_t> hashes_;
};

}  // namespace swell::apps
