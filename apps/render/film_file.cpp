#include "apps/render/film_file.h"

#include <cmath>

#include "apps/messages/camera_messages.h"
#include "apps/shared/label_file.h"
#include "scene/file/rig.h"

namespace swell::apps {
namespace {

constexpr const char* kCamera = "camera";
enum Topics : std::size_t { kTransform, kPicture, kCameraInfo, kFirstLabel };

std::string optical_frame() {
  scene::Sensor camera;
  camera.name = kCamera;
  return scene::optical_frame_name(camera);
}

msg::TFMessage transform_of(msg::Time stamp, const OpticalPose& pose) {
  const glm::dvec3& eye = pose.eye_world;
  const glm::dquat& q = pose.world_from_optical;
  return {{{{stamp, "map"}, optical_frame(), {{eye.x, eye.y, eye.z}, {q.x, q.y, q.z, q.w}}}}};
}

msg::Image label_image(const ImageHead& head, render::Label label, const render::Labels& labels,
                       const View& view) {
  render::LabelSet set;
  set.add(label);
  const std::vector<LabelPlane> planes = label_planes(labels, set, view);
  if (const auto* numbers = std::get_if<std::vector<std::uint32_t>>(&planes[0].samples))
    switch (label) {
      case render::Label::kClass:
        return class_image(head, *numbers);
      case render::Label::kFlags:
        return flags_image(head, *numbers);
      default:
        return id_image(head, *numbers);
    }
  // Vectors pixel by pixel.
  const std::size_t pixels = std::get<std::vector<float>>(planes[0].samples).size();
  std::vector<float> values(pixels * planes.size());
  for (std::size_t c = 0; c < planes.size(); ++c) {
    const auto& plane = std::get<std::vector<float>>(planes[c].samples);
    for (std::size_t i = 0; i < pixels; ++i) values[i * planes.size() + c] = plane[i];
  }
  return float_image(head, values);
}

}  // namespace

FilmFile::FilmFile(const RenderOptions& options) {
  if (!is_film(options.out)) return;
  std::vector<Topic> topics = {{"/tf", msg::TFMessage::kType},
                               {camera_topic(kCamera, kPictureTopic), msg::Image::kType},
                               {camera_topic(kCamera, kCameraInfoTopic), msg::CameraInfo::kType}};
  if (film_holds_labels(options))
    for (const render::LabelInfo& info : render::label_table()) {
      if (!options.labels.has(info.label)) continue;
      labels_.push_back(info.label);
      topics.push_back({camera_topic(kCamera, info.name), msg::Image::kType});
    }
  output_ = std::make_unique<McapOutput>(options.out, topics);
}

void FilmFile::add(const DrawnFrame& frame) {
  if (!output_) return;
  const std::int64_t t_ns = std::llround(frame.t_s * 1e9);
  const auto write = [&](std::size_t topic, const msg::Message& message) {
    output_->write(topic, t_ns, message);
  };
  const ImageHead head = {
      {msg::Time::of_ns(t_ns), optical_frame()}, frame.view.width_px, frame.view.height_px};
  const Projection& projection = frame.view.projection;
  const OpticalPose pose = camera_pose(frame.view);
  write(kTransform, transform_of(head.header.stamp, pose));
  write(kPicture, rgb_image(head, rgb_bytes(frame.target.rgba)));
  CameraModel model;
  model.projection = projection;
  model.k = projection.is_wide() ? projection.k : pose.k;
  write(kCameraInfo, camera_info(head, model));
  for (std::size_t n = 0; n < labels_.size(); ++n)
    write(kFirstLabel + n, label_image(head, labels_[n], frame.target.labels, frame.view));
}

void FilmFile::finish() {
  if (output_) output_->finish();
}

}  // namespace swell::apps
