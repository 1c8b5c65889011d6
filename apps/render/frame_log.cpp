#include "apps/render/frame_log.h"

#include <fmt/core.h>

#include <cstdio>
#include <stdexcept>

#include "apps/shared/report.h"

namespace swell::apps {
namespace {

void print_line(const std::string& line) {
  write_text("-", line);
  if (std::fflush(stdout) != 0) throw std::runtime_error("cannot write to standard output");
}

}  // namespace

FrameLog::FrameLog(const RenderOptions& options) : options_(options) {
  if (!options.expect.empty()) expected_.emplace(options.expect);
}

void FrameLog::add(const FrameRecord& record) {
  ++frames_;
  if (options_.json == "-")
    print_line(json_line(record));
  else if (options_.hash)
    print_line(hash_line(record));
  if (!options_.json.empty() && options_.json != "-") json_ += json_line(record);
  if (expected_) compare(record);
}

void FrameLog::compare(const FrameRecord& record) {
  const std::string fault = expected_->fault(record.frame, record.hash);
  if (fault.empty()) return;
  if (faults_++ == 0) first_fault_ = fault;
}

void FrameLog::finish() const {
  if (!json_.empty()) write_text(options_.json, json_);
  if (faults_ > 0)
    throw std::runtime_error(
        fmt::format("{}; {} of {} frames are not as expected", first_fault_, faults_, frames_));
}

}  // namespace swell::apps
