// Where swell-render's records of frames go: standard output, a file of JSON, the comparison with
// expected hashes.
#pragma once

#include <optional>
#include <string>

#include "apps/render/expected_hashes.h"
#include "apps/render/frame_record.h"
#include "apps/render/render_options.h"

namespace swell::apps {

class FrameLog {
 public:
  // Reads the file of --expect: throws texture::FileError. The options must outlive the log.
  explicit FrameLog(const RenderOptions& options);

  // Takes a frame that has been drawn. Its line is on standard output when this returns; throws
  // std::runtime_error if it cannot be.
  void add(const FrameRecord& record);

  // After the last frame: writes the file of --json (whole or not there; texture::FileError), then
  // throws std::runtime_error naming the first frame whose hash is not the expected one.
  void finish() const;

 private:
  void compare(const FrameRecord& record);

  const RenderOptions& options_;
  std::optional<ExpectedHashes> expected_;
  std::string json_;  // the lines of the file
  std::string first_fault_;
  int frames_ = 0, faults_ = 0;
};

}  // namespace swell::apps
