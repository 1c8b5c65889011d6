// Subscribes to the boat's sensors and saves what it sees, as seen.h says, until swell-sim is gone.
//   watch FOLDER
#include <chrono>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>
#include <thread>
#include <vector>

#include "hull.h"
#include "seen.h"
#include "topics.h"

namespace {

float number_at(const std::uint8_t* bytes) {
  float value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

class Watch {
 public:
  explicit Watch(const char* folder)
      : seen_(folder),
        pictures_(node_, "/camera/image_raw", sensor_msgs_msg_dds__Image__desc),
        depths_(node_, "/camera/depth", sensor_msgs_msg_dds__Image__desc),
        clouds_(node_, "/lidar/points", sensor_msgs_msg_dds__PointCloud2__desc),
        poses_(node_, "/base_link/pose", geometry_msgs_msg_dds__PoseStamped__desc) {
    for (std::size_t n = 0; n < kColumnCount; ++n)
      waves_.emplace_back(node_, "/hull_" + std::to_string(n),
                          geometry_msgs_msg_dds__PointStamped__desc);
  }

  void run() {
    while (!pictures_.has_writer()) rest();
    // What was written before the writer left is still there to take.
    for (bool is_over = false; !is_over;) {
      is_over = !pictures_.has_writer();
      while (take()) {
      }
      rest();
    }
  }

 private:
  static void rest() { std::this_thread::sleep_for(std::chrono::milliseconds(1)); }

  bool take() {
    bool has_come = pictures_.take([&](const Image& image) {
      if (image.data._length != 3 * image.width * image.height) return;
      seen_.add_picture(ns_of(image.header.stamp), image.width, image.height, image.data._buffer);
    });
    has_come |= depths_.take([&](const Image& image) {
      const std::size_t middle = std::size_t{image.height / 2} * image.width + image.width / 2;
      if (image.data._length < 4 * (middle + 1)) return;
      seen_.add("depth", ns_of(image.header.stamp), number_at(image.data._buffer + 4 * middle));
    });
    has_come |= clouds_.take([&](const PointCloud2& cloud) {
      const std::size_t middle = std::size_t{cloud.height / 2} * cloud.width + cloud.width / 2;
      if (cloud.data._length < cloud.point_step * (middle + 1)) return;
      // x, which points along the middle beam, comes first.
      seen_.add("lidar", ns_of(cloud.header.stamp),
                number_at(cloud.data._buffer + cloud.point_step * middle));
    });
    has_come |= poses_.take([&](const PoseStamped& pose) {
      const auto& [p, q] = pose.pose;
      seen_.add("pose", ns_of(pose.header.stamp), p.x, p.y, p.z, q.x, q.y, q.z, q.w);
    });
    for (const auto& wave : waves_)
      has_come |= wave.take([&](const PointStamped& at) {
        seen_.add("wave", ns_of(at.header.stamp), at.point.x, at.point.y, at.point.z);
      });
    return has_come;
  }

  Seen seen_;
  Participant node_;
  Reader<Image> pictures_, depths_;
  Reader<PointCloud2> clouds_;
  Reader<PoseStamped> poses_;
  std::vector<Reader<PointStamped>> waves_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "watch FOLDER\n"), 2;
  try {
    Watch(argv[1]).run();
    return 0;
  } catch (const std::exception& fault) {
    return std::fprintf(stderr, "watch: %s\n", fault.what()), 1;
  }
}
