// How far a sequence or a data set is, on a terminal.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace swell::apps {

// A line on standard error that is written over with each frame. Says nothing where that is no
// terminal, with --quiet, or for a single picture.
class Progress {
 public:
  // `what` is counted, "frames"; it must outlive this.
  Progress(int frames, bool quiet, std::string_view what);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void step();  // a frame was drawn
  void skip();  // its files were there

 private:
  using Clock = std::chrono::steady_clock;
  void show();

  bool is_shown_;
  std::string_view what_;
  int frames_, done_ = 0, drawn_ = 0;
  Clock::time_point start_ = Clock::now(), shown_{};
};

// '[#####.....] 50 of 100 frames, 12.5 frames/s, 0:04 left'. done in [0, frames]; drawn of them
// took seconds.
std::string progress_text(int done, int frames, int drawn, double seconds,
                          std::string_view what = "frames");

}  // namespace swell::apps
