#include "apps/shared/progress.h"

#include <fmt/core.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>

namespace swell::apps {
namespace {

std::string duration_text(double seconds) {
  const auto s = static_cast<long>(std::ceil(seconds));
  if (s < 3600) return fmt::format("{}:{:02}", s / 60, s % 60);
  return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

}  // namespace

std::string progress_text(int done, int frames, int drawn, double seconds, std::string_view what) {
  constexpr int kWidth = 30;
  const auto filled = static_cast<std::size_t>(std::int64_t{kWidth} * done / frames);
  std::string text = fmt::format("[{}{}] {} of {} {}", std::string(filled, '#'),
                                 std::string(kWidth - filled, '.'), done, frames, what);
  if (drawn > 0 && seconds > 0.0)
    text += fmt::format(", {:.1f} {}/s, {} left", drawn / seconds, what,
                        duration_text(seconds / drawn * (frames - done)));
  return text;
}

Progress::Progress(int frames, bool quiet, std::string_view what)
    : is_shown_(frames > 1 && !quiet && isatty(STDERR_FILENO) != 0), what_(what), frames_(frames) {}

Progress::~Progress() {
  if (is_shown_ && done_ > 0) fmt::print(stderr, "\n");
}

void Progress::step() {
  ++drawn_;
  ++done_;
  show();
}

void Progress::skip() {
  ++done_;
  show();
}

void Progress::show() {
  constexpr std::chrono::milliseconds kPause(100);
  const Clock::time_point now = Clock::now();
  if (!is_shown_ || (now - shown_ < kPause && done_ < frames_)) return;
  shown_ = now;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  fmt::print(stderr, "\r{}\x1b[K", progress_text(done_, frames_, drawn_, seconds, what_));
  std::fflush(stderr);
}

}  // namespace swell::apps
