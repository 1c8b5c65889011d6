// What a subscriber saw, in a folder: pictures as PPM files, and seen.txt with a line for each
// thing, 'KIND STAMP_NS VALUE ...', which check.py reads:
//   picture STAMP FILE
//   depth STAMP M              along the view axis at the picture's principal point
//   lidar STAMP M              range of the middle beam
//   pose STAMP X Y Z QX QY QZ QW   of the boat, as its program said
//   wave STAMP X Y Z           of a wave probe
#pragma once

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iomanip>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <string>

// Any number of threads may use it.
class Seen {
 public:
  explicit Seen(const std::string& folder) : folder_(folder), file_(folder + "/seen.txt") {
    if (!file_) throw std::runtime_error("cannot write " + folder + "/seen.txt");
    file_ << std::setprecision(std::numeric_limits<double>::max_digits10);
  }

  template <class... Values>
  void add(const char* kind, std::int64_t stamp_ns, Values... values) {
    const std::lock_guard lock(mutex_);
    file_ << kind << ' ' << stamp_ns;
    (..., (file_ << ' ' << values));
    file_ << std::endl;
  }

  // `rgb`: rows from the top, 3 bytes a pixel. Named by the stamp in milliseconds.
  void add_picture(std::int64_t stamp_ns, unsigned width, unsigned height, const void* rgb) {
    char name[40];
    std::snprintf(name, sizeof name, "picture_%06lld.ppm",
                  static_cast<long long>(stamp_ns / 1'000'000));
    std::ofstream picture(folder_ + "/" + name, std::ios::binary);
    picture << "P6\n" << width << ' ' << height << "\n255\n";
    picture.write(static_cast<const char*>(rgb), std::streamsize{3} * width * height);
    if (!picture) throw std::runtime_error("cannot write " + folder_ + "/" + name);
    add("picture", stamp_ns, name);
  }

 private:
  std::string folder_;
  std::mutex mutex_;
  std::ofstream file_;
};
