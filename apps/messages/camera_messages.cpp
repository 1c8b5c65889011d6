#include "apps/messages/camera_messages.h"

#include <bit>
#include <cstring>
#include <utility>

namespace swell::apps {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they are held");

std::size_t pixels(const ImageHead& head) {
  return static_cast<std::size_t>(head.width_px) * static_cast<std::size_t>(head.height_px);
}

msg::Image image(const ImageHead& head, std::string encoding, std::vector<std::uint8_t> data) {
  msg::Image image;
  image.header = head.header;
  image.height = static_cast<std::uint32_t>(head.height_px);
  image.width = static_cast<std::uint32_t>(head.width_px);
  image.encoding = std::move(encoding);
  image.step = static_cast<std::uint32_t>(data.size() / image.height);
  image.data = std::move(data);
  return image;
}

// One number a pixel.
template <class Written>
msg::Image numbers(const ImageHead& head, const char* encoding,
                   std::span<const std::uint32_t> values) {
  std::vector<std::uint8_t> data(values.size() * sizeof(Written));
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto value = static_cast<Written>(values[i]);
    std::memcpy(data.data() + i * sizeof value, &value, sizeof value);
  }
  return image(head, encoding, std::move(data));
}

}  // namespace

std::string camera_topic(const std::string& camera, std::string_view what) {
  return "/" + camera + "/" + std::string(what);
}

std::vector<std::uint8_t> rgb_bytes(std::span<const std::uint32_t> rgba) {
  std::vector<std::uint8_t> rgb(3 * rgba.size());
  for (std::size_t i = 0; i < rgba.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      rgb[3 * i + c] = static_cast<std::uint8_t>(rgba[i] >> (8 * c));
  return rgb;
}

msg::Image rgb_image(const ImageHead& head, std::vector<std::uint8_t> rgb) {
  return image(head, "rgb8", std::move(rgb));
}

// The channels' order is the one that OpenCV decodes to.
msg::CompressedImage compressed_rgb_image(const ImageHead& head, std::string_view coding,
                                          std::vector<std::uint8_t> bytes) {
  return {head.header, "rgb8; " + std::string(coding) + " compressed bgr8", std::move(bytes)};
}

msg::Image float_image(const ImageHead& head, std::span<const float> values) {
  std::vector<std::uint8_t> data(values.size_bytes());
  std::memcpy(data.data(), values.data(), data.size());
  return image(head, "32FC" + std::to_string(values.size() / pixels(head)), std::move(data));
}

msg::Image class_image(const ImageHead& head, std::span<const std::uint32_t> classes) {
  return numbers<std::uint16_t>(head, "16UC1", classes);
}

msg::Image id_image(const ImageHead& head, std::span<const std::uint32_t> ids) {
  return numbers<std::uint32_t>(head, "32SC1", ids);
}

msg::Image flags_image(const ImageHead& head, std::span<const std::uint32_t> flags) {
  return numbers<std::uint8_t>(head, "8UC1", flags);
}

msg::CameraInfo camera_info(const ImageHead& head, const CameraModel& model) {
  msg::CameraInfo info;
  info.header = head.header;
  info.height = static_cast<std::uint32_t>(head.height_px);
  info.width = static_cast<std::uint32_t>(head.width_px);
  info.r = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  switch (model.projection.kind) {
    case ProjectionKind::kPerspective:
      info.distortion_model = "plumb_bob";
      info.d = model.distortion;
      break;
    case ProjectionKind::kFisheye:
      info.distortion_model = "equidistant";
      info.d.assign(model.projection.bend.begin(), model.projection.bend.end());
      break;
    case ProjectionKind::kEquirectangular:
      info.distortion_model = "equirectangular";
      return info;
  }
  const Intrinsics& k = model.k;
  const double cx = k.cx - 0.5, cy = k.cy - 0.5;
  info.k = {k.fx, 0.0, cx, 0.0, k.fy, cy, 0.0, 0.0, 1.0};
  info.p = {k.fx, 0.0, cx, 0.0, 0.0, k.fy, cy, 0.0, 0.0, 0.0, 1.0, 0.0};
  return info;
}

}  // namespace swell::apps
