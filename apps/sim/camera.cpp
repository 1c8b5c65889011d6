#include "apps/sim/camera.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <span>

#include "apps/jpeg/jpeg.h"
#include "apps/messages/camera_messages.h"
#include "apps/sim/lens.h"
#include "apps/sim/sim_world.h"
#include "math/elementary.h"
#include "math/projection.h"
#include "render/frame.h"
#include "scene/camera.h"
#include "sky/sky_light.h"
#include "texture/image/image_io.h"

namespace swell::apps {
namespace {

using render::Label;
using scene::PictureCoding;

class CameraSensor {
 public:
  CameraSensor(const scene::Sensor& sensor, SimWorld& world, Simulation& simulation)
      : sensor_(sensor), world_(world) {
    width_px_ = sensor.width_px, height_px_ = sensor.height_px;
    lens_ = lens_of_fov(sensor.fov_y_rad, width_px_, height_px_);
    find_projection();
    find_lookup();
    options_.noise = sensor.noise;
    find_exposure();
    if (sensor.raw)
      picture_ = simulation.topic(camera_topic(sensor.name, kPictureTopic), msg::Image::kType);
    if (sensor.compressed != PictureCoding::kNone) add_compressed(simulation);
    info_ = simulation.topic(camera_topic(sensor.name, kCameraInfoTopic), msg::CameraInfo::kType);
    if (sensor.depth) add_label(Label::kDepth, simulation);
    if (sensor.classes) add_label(Label::kClass, simulation);
    if (sensor.ids) add_label(Label::kId, simulation);
  }

  void publish(const Moment& moment, const Emit& emit) {
    draw(moment);
    const ImageHead head = {
        {moment.stamp(), optical_frame_name(sensor_)}, sensor_.width_px, sensor_.height_px};
    publish_picture(head, emit);
    emit(info_, camera_info(head, {projection_, k_, sensor_.distortion}));
    for (const LabelTopic& label : labels_) emit(label.topic, label_picture(head, label.label));
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

  // That of the f-number, if it has one.
  void find_exposure() {
    if (sensor_.f_number == 0.0) return;
    const scene::Scene& scene = world_.world().scene();
    if (scene.camera.exposure_s == 0.0)
      refuse("f_number", "got it in a scene without camera.exposure_s, allowed both");
    if (sky::is_gradient(scene.sky))
      refuse("f_number",
             "got it under a gradient, whose light has no unit, allowed it where sky.model is "
             "\"atmosphere\"");
    options_.exposure =
        scene::camera_exposure(sensor_.f_number, scene.camera.exposure_s, sensor_.noise.iso);
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

  void add_compressed(Simulation& simulation) {
    if (sensor_.compressed == PictureCoding::kJpeg && !has_jpeg())
      refuse("compressed",
             "got \"jpeg\", allowed \"none\" or \"png\": this swell-sim was built without "
             "libjpeg-turbo");
    compressed_ =
        simulation.topic(camera_topic(sensor_.name, kCompressedTopic), msg::CompressedImage::kType);
  }

  void add_label(Label label, Simulation& simulation) {
    const std::string_view name = render::label_table()[static_cast<std::size_t>(label)].name;
    labels_.push_back(
        {label, simulation.topic(camera_topic(sensor_.name, name), msg::Image::kType)});
    options_.labels.add(label);
  }

  void draw(const Moment& moment) {
    const FramePose pose = world_.sensor_at(sensor_, moment);
    const glm::dmat3 axes = {-pose.axes[1], pose.axes[0], pose.axes[2]};
    View view = make_view(pose.position_m, axes, lens_, static_cast<float>(sensor_.near_m),
                          width_px_, height_px_);
    view.projection = projection_;
    const std::vector<scene::GivenPose> given = world_.given_poses(moment);
    const std::vector<ocean::Disturbance> disturbances = world_.disturbances(moment);
    options_.poses = given;
    options_.disturbances = disturbances;
    render::render_frame(world_.world(), view, moment.t_s(), options_, workspace_, target_,
                         world_.workers());
    options_.poses = {};
    options_.disturbances = {};
  }

  void publish_picture(const ImageHead& head, const Emit& emit) const {
    if (!picture_ && !compressed_) return;
    std::vector<std::uint8_t> rgb = picture();
    if (compressed_)
      emit(*compressed_,
           compressed_rgb_image(head, scene::kPictureCodings[sensor_.compressed], encoded(rgb)));
    if (picture_) emit(*picture_, rgb_image(head, std::move(rgb)));
  }

  // R, G, B of the picture as the lens shows it.
  std::vector<std::uint8_t> picture() const {
    if (!lookup_) return rgb_bytes(target_.rgba);
    std::vector<std::uint8_t> rgb(3 * pixels());
    lookup_->blend(target_.rgba, rgb);
    return rgb;
  }

  std::vector<std::uint8_t> encoded(const std::vector<std::uint8_t>& rgb) const {
    const int width = sensor_.width_px, height = sensor_.height_px;
    if (sensor_.compressed == PictureCoding::kJpeg)
      return jpeg_bytes(rgb, width, height, {.quality = sensor_.jpeg_quality});
    return texture::encode_image(texture::Image8{width, height, 3, rgb}, ".png");
  }

  std::size_t pixels() const {
    return static_cast<std::size_t>(sensor_.width_px) * static_cast<std::size_t>(sensor_.height_px);
  }

  msg::Image label_picture(const ImageHead& head, Label label) const {
    const render::Labels& labels = target_.labels;
    switch (label) {
      case Label::kDepth:
        return float_image(head, seen(labels.depth_m));
      case Label::kClass:
        return class_image(head, seen(labels.klass));
      default:
        return id_image(head, seen(labels.id));
    }
  }

  // A label's values as the lens shows them.
  template <class Value>
  std::vector<Value> seen(const std::vector<Value>& plane) const {
    if (!lookup_) return plane;
    std::vector<Value> values(pixels());
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = plane[lookup_->nearest(i)];
    return values;
  }

  const scene::Sensor& sensor_;
  SimWorld& world_;
  Projection projection_;
  Intrinsics k_;                      // of perspective cameras and fisheyes
  Lens lens_;                         // of the pinhole picture that is drawn,
  int width_px_ = 0, height_px_ = 0;  // and its size
  std::optional<LensLookup> lookup_;  // none: it is the picture
  std::optional<std::size_t> picture_, compressed_;
  std::size_t info_ = 0;
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
