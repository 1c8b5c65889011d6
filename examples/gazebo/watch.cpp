// Subscribes to the boat's sensors and saves what it sees, as seen.h says, until SIGTERM or SIGINT.
//   watch FOLDER
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>

#include "seen.h"
#include "transport.h"

namespace {

float number_at(const std::string& bytes, std::size_t place) {
  float value;
  std::memcpy(&value, bytes.data() + place, sizeof value);
  return value;
}

class Watch {
 public:
  explicit Watch(const char* folder) : seen_(folder) {
    node_.Subscribe("/camera/image", &Watch::see_picture, this);
    node_.Subscribe("/camera/depth_image", &Watch::see_depth, this);
    node_.Subscribe("/lidar/points", &Watch::see_points, this);
    node_.Subscribe("/model/base_link/pose", &Watch::see_pose, this);
    node_.Subscribe("/bow_wave", &Watch::see_wave, this);
  }

 private:
  void see_picture(const msgs::Image& image) {
    if (image.data().size() != std::size_t{3} * image.width() * image.height()) return;
    seen_.add_picture(ns_of(image.header().stamp()), image.width(), image.height(),
                      image.data().data());
  }
  void see_depth(const msgs::Image& image) {
    const std::size_t middle = std::size_t{image.height() / 2} * image.width() + image.width() / 2;
    if (image.data().size() < 4 * (middle + 1)) return;
    seen_.add("depth", ns_of(image.header().stamp()), number_at(image.data(), 4 * middle));
  }
  void see_points(const msgs::PointCloudPacked& cloud) {
    const std::size_t middle = std::size_t{cloud.height() / 2} * cloud.width() + cloud.width() / 2;
    if (cloud.data().size() < cloud.point_step() * (middle + 1)) return;
    // x, which points along the middle beam, comes first.
    seen_.add("lidar", ns_of(cloud.header().stamp()),
              number_at(cloud.data(), cloud.point_step() * middle));
  }
  void see_pose(const msgs::Pose& pose) {
    const auto& p = pose.position();
    const auto& q = pose.orientation();
    seen_.add("pose", ns_of(pose.header().stamp()), p.x(), p.y(), p.z(), q.x(), q.y(), q.z(),
              q.w());
  }
  void see_wave(const msgs::Vector3d& at) {
    seen_.add("wave", ns_of(at.header().stamp()), at.x(), at.y(), at.z());
  }

  Seen seen_;
  transport::Node node_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "watch FOLDER\n"), 2;
  try {
    const Watch watch(argv[1]);
    transport::waitForShutdown();
    return 0;
  } catch (const std::exception& fault) {
    return std::fprintf(stderr, "watch: %s\n", fault.what()), 1;
  }
}
