#include "apps/sim/camera.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <optional>
#include <span>

#include "apps/sim/lens.h"
#include "apps/sim/sim_world.h"
#include "math/elementary.h"
#include "math/projection.h"
#include "render/frame.h"

namespace swell::apps {
namespace {

using render::Label;

class CameraSensor {
 public:
  CameraSensor(const scene::Sensor& sensor, SimWorld& world, Simulation& simulation)
      : sensor_(sensor), world_(world) {
    width_px_ = sensor.width_px, height_px_ = sensor.height_px;
    lens_ = lens_of_fov(sensor.fov_y_rad, width_px_, height_px_);
    find_projection();
    find_lookup();
    options_.noise = sensor.noise;
    const std::string name = "/" + sensor.name;
    picture_ = simulation.topic(name + "/image_raw", msg::Image::kType);
    info_ = simulation.topic(name + "/camera_info", msg::CameraInfo::kType);
    if (sensor.depth) add_label(Label::kDepth, name + "/depth", simulation);
    if (sensor.classes) add_label(Label::kClass, name + "/class", simulation);
    if (sensor.ids) add_label(Label::kId, name + "/id", simulation);
  }

  void publish(const Moment& moment, const Emit& emit) {
    draw(moment);
    const msg::Header header = {moment.stamp(), optical_frame_name(sensor_)};
    emit(picture_, picture(header));
    emit(info_, info(header));
    for (const LabelTopic& label : labels_) emit(label.topic, label_picture(header, label.label));
  }

 private:
  struct LabelTopic {
    Label label;
    std::size_t topic;
  };

  [[noreturn]] void refuse(const char* key, const char* text) const {
    scene::refuse_key(world_.rig(), sensor_key(world_.rig(), sensor_) + "." + key, text);
  }

  // The projection, and K where there is one.
  void find_projection() {
    projection_.kind = sensor_.projection;
    if (sensor_.projection == ProjectionKind::kPerspective) {
      const double focal_px = 0.5 * sensor_.height_px / tan(0.5 * sensor_.fov_y_rad);
      k_ = {focal_px, focal_px, 0.5 * sensor_.width_px, 0.5 * sensor_.height_px};
    }
    if (sensor_.projection != ProjectionKind::kFisheye) return;
    const glm::dvec4& k = sensor_.fisheye_k;
    projection_ =
        fisheye_of_fov(sensor_.fisheye_fov_rad, {k[0], k[1], k[2], k[3]}, width_px_, height_px_);
    if (!is_one_to_one(projection_.bend, projection_.half_fov_rad))
      refuse("fisheye_k",
             "got a lens that folds the picture, allowed one whose radius grows with the angle up "
             "to half of fisheye_fov_deg");
    k_ = projection_.k;
  }

  // The wider pinhole picture, where there is a lens.
  void find_lookup() {
    Distortion lens{};
    std::ranges::copy(sensor_.distortion, lens.begin());
    if (lens == Distortion{}) return;
    if (projection_.is_wide())
      refuse("distortion", "got it for a wide camera, allowed for projection \"perspective\"");
    if (sensor_.noise.full_well_e > 0.0)
      refuse("full_well_e", "got noise beside distortion, which would blend it, allowed 0");
    lookup_ = LensLookup::find(k_, width_px_, height_px_, lens);
    if (!lookup_)
      refuse("distortion",
             "got one that folds the picture, does not reach its corners or takes a wide picture "
             "of over 8192 px, allowed lenses that are one to one on it");
    width_px_ = lookup_->wide_width_px(), height_px_ = lookup_->wide_height_px();
    lens_ = lens_of_intrinsics(lookup_->wide_intrinsics(), width_px_, height_px_);
  }

  void add_label(Label label, const std::string& name, Simulation& simulation) {
    labels_.push_back({label, simulation.topic(name, msg::Image::kType)});
    options_.labels.add(label);
  }

  void draw(const Moment& moment) {
    const FramePose pose = world_.sensor_at(sensor_, moment);
    const glm::dmat3 axes = {-pose.axes[1], pose.axes[0], pose.axes[2]};
    View view = make_view(pose.position_m, axes, lens_, static_cast<float>(sensor_.near_m),
                          width_px_, height_px_);
    view.projection = projection_;
    const std::vector<scene::GivenPose> given = world_.given_poses(moment);
    options_.poses = given;
    render::render_frame(world_.world(), view, moment.t_s(), options_, workspace_, target_,
                         world_.workers());
    options_.poses = {};
  }

  std::size_t pixels() const {
    return static_cast<std::size_t>(sensor_.width_px) * static_cast<std::size_t>(sensor_.height_px);
  }

  msg::Image image(const msg::Header& header, const char* encoding, std::size_t pixel_bytes) const {
    msg::Image image;
    image.header = header;
    image.height = static_cast<std::uint32_t>(sensor_.height_px);
    image.width = static_cast<std::uint32_t>(sensor_.width_px);
    image.encoding = encoding;
    image.step = static_cast<std::uint32_t>(pixel_bytes) * image.width;
    image.data.resize(pixels() * pixel_bytes);
    return image;
  }

  msg::Image picture(const msg::Header& header) const {
    msg::Image image = this->image(header, "rgb8", 3);
    if (lookup_) {
      lookup_->blend(target_.rgba, image.data);
      return image;
    }
    for (std::size_t i = 0; i < target_.rgba.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c)
        image.data[3 * i + c] = static_cast<std::uint8_t>(target_.rgba[i] >> (8 * c));
    return image;
  }

  msg::Image label_picture(const msg::Header& header, Label label) const {
    const render::Labels& labels = target_.labels;
    switch (label) {
      case Label::kDepth:
        return values<float>(header, "32FC1", labels.depth_m);
      case Label::kClass:
        return values<std::uint16_t>(header, "16UC1", labels.klass);
      default:
        return values<std::uint32_t>(header, "32SC1", labels.id);
    }
  }

  template <class Written, class Value>
  msg::Image values(const msg::Header& header, const char* encoding,
                    const std::vector<Value>& plane) const {
    msg::Image image = this->image(header, encoding, sizeof(Written));
    for (std::size_t i = 0; i < pixels(); ++i) {
      const auto value = static_cast<Written>(plane[lookup_ ? lookup_->nearest(i) : i]);
      std::memcpy(image.data.data() + i * sizeof value, &value, sizeof value);
    }
    return image;
  }

  msg::CameraInfo info(const msg::Header& header) const {
    msg::CameraInfo info;
    info.header = header;
    info.height = static_cast<std::uint32_t>(sensor_.height_px);
    info.width = static_cast<std::uint32_t>(sensor_.width_px);
    info.r = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    switch (projection_.kind) {
      case ProjectionKind::kPerspective:
        info.distortion_model = "plumb_bob";
        info.d = sensor_.distortion;
        break;
      case ProjectionKind::kFisheye:
        info.distortion_model = "equidistant";
        info.d.assign(projection_.bend.begin(), projection_.bend.end());
        break;
      case ProjectionKind::kEquirectangular:  // no matrix says what it sees
        info.distortion_model = "equirectangular";
        return info;
    }
    const double cx = k_.cx - 0.5, cy = k_.cy - 0.5;
    info.k = {k_.fx, 0.0, cx, 0.0, k_.fy, cy, 0.0, 0.0, 1.0};
    info.p = {k_.fx, 0.0, cx, 0.0, 0.0, k_.fy, cy, 0.0, 0.0, 0.0, 1.0, 0.0};
    return info;
  }

  const scene::Sensor& sensor_;
  SimWorld& world_;
  Projection projection_;
  Intrinsics k_;                      // of perspective cameras and fisheyes
  Lens lens_;                         // of the pinhole picture that is drawn,
  int width_px_ = 0, height_px_ = 0;  // and its size
  std::optional<LensLookup> lookup_;  // none: it is the picture
  std::size_t picture_ = 0, info_ = 0;
  std::vector<LabelTopic> labels_;
  render::FrameOptions options_;
  render::Workspace workspace_;
  render::Target target_;
};

}  // namespace

Publish camera(const scene::Sensor& sensor, SimWorld& world, Simulation& simulation) {
  const auto made = std::make_shared<CameraSensor>(sensor, world, simulation);
  return [made](const Moment& moment, const Emit& emit) { made->publish(moment, emit); };
}

}  // namespace swell::apps
