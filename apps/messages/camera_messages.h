// What cameras publish: pictures, labels as pictures, and what the camera is. Encodings of labels
// are OpenCV's names of types, numbers little endian.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/messages/messages.h"
#include "math/view.h"

namespace swell::apps {

// "/camera/image_raw" of "camera" and "image_raw". A label's picture has the label's name.
std::string camera_topic(const std::string& camera, std::string_view what);
inline constexpr std::string_view kPictureTopic = "image_raw", kCameraInfoTopic = "camera_info",
                                  kCompressedTopic = "image_raw/compressed";

// An image but for its pixels. Cameras are in frames with x right, y down, z ahead
// (scene::optical_frame_name).
struct ImageHead {
  msg::Header header;
  int width_px = 0, height_px = 0;
};

// R, G, B of pixels with R in the low byte.
std::vector<std::uint8_t> rgb_bytes(std::span<const std::uint32_t> rgba);

// "rgb8", of three bytes a pixel.
msg::Image rgb_image(const ImageHead& head, std::vector<std::uint8_t> rgb);

// The same as bytes of "jpeg" or "png", in the words of image_transport's plugins.
msg::CompressedImage compressed_rgb_image(const ImageHead& head, std::string_view coding,
                                          std::vector<std::uint8_t> bytes);

// "32FC1" to "32FC3": one to three numbers a pixel, as many as there are.
msg::Image float_image(const ImageHead& head, std::span<const float> values);

// Numbers of classes (at most 65535) as "16UC1", of things as "32SC1", flags (at most 255) as
// "8UC1".
msg::Image class_image(const ImageHead& head, std::span<const std::uint32_t> classes);
msg::Image id_image(const ImageHead& head, std::span<const std::uint32_t> ids);
msg::Image flags_image(const ImageHead& head, std::span<const std::uint32_t> flags);

struct CameraModel {
  Projection projection{};
  Intrinsics k{};  // of perspective cameras and fisheyes: the first pixel's middle is (0.5, 0.5)
  std::vector<double> distortion = std::vector<double>(5);  // k1, k2, p1, p2, k3 of perspective
};

// Of perspective cameras "plumb_bob", of fisheyes "equidistant"; of equirectangular ones
// "equirectangular" with K and P of zeros, as no matrix says what they see.
msg::CameraInfo camera_info(const ImageHead& head, const CameraModel& model);

}  // namespace swell::apps
