#include "apps/dataset/sample.h"

#include <fmt/core.h>

#include "apps/dataset/instances.h"
#include "apps/dataset/object_places.h"
#include "apps/render/label_sidecar.h"
#include "apps/shared/json.h"
#include "apps/shared/label_file.h"
#include "apps/shared/picture_file.h"
#include "render/view/render_view.h"
#include "render/world_view.h"
#include "scene/settings.h"
#include "texture/image/image_io.h"

namespace swell::apps {
namespace {

constexpr double kNextFrame_s = 1.0 / 60.0;      // for the label of motion
constexpr std::int64_t kIdsOfAPicture = 10'000;  // of annotations: more than there are objects

std::vector<std::uint8_t> bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

// swell-render's command line that draws a sample's picture and labels again.
std::vector<std::string> command_of(const scene::Recipe& recipe, const scene::SampleDraw& draw,
                                    int sample) {
  std::vector<std::string> command = {"swell-render", "--scene", recipe.scene_text};
  for (const std::string& setting : draw.settings) {
    command.push_back("--set");
    command.push_back(setting);
  }
  for (const std::string& word :
       {std::string("--time"), fmt::format("{}", draw.t_s), std::string("--size"),
        fmt::format("{}x{}", recipe.width_px, recipe.height_px), std::string("--out"),
        fmt::format("{:06}.png", sample)})
    command.push_back(word);
  if (!recipe.labels.empty()) {
    command.push_back("--labels");
    command.push_back(recipe.labels);
  }
  return command;
}

Json annotation_json(const Instance& instance, const scene::FloatingObject& object, int category,
                     int sample, int height_px, int width_px) {
  return {{"id", (sample + 1) * kIdsOfAPicture + instance.id},
          {"image_id", sample + 1},
          {"category_id", category},
          {"bbox", {instance.x_px, instance.y_px, instance.width_px, instance.height_px}},
          {"area", instance.area_px},
          {"iscrowd", 0},
          {"segmentation", {{"size", {height_px, width_px}}, {"counts", instance.runs}}},
          {"instance_id", instance.id},
          {"name", object.name}};
}

// What COCO has of the picture. The hull that carries the camera is no object of the picture's.
std::string facts_of(const scene::Recipe& recipe, const scene::Scene& scene,
                     const ClassSet& classes, const render::Target& target, int sample) {
  Json annotations = Json::array();
  for (const Instance& instance : find_instances(target.labels.id, target.width_px,
                                                 render::kFirstObjectId, render::kFirstTreeId)) {
    const scene::FloatingObject& object = scene.objects[instance.id - render::kFirstObjectId];
    const bool is_own_hull = !scene.camera.mount.empty() && object.name == scene.camera.mount;
    const std::optional<int> category = classes.category_of(object);
    if (category && !is_own_hull)
      annotations.push_back(
          annotation_json(instance, object, *category, sample, recipe.height_px, recipe.width_px));
  }
  const Json facts = {{"image",
                       {{"id", sample + 1},
                        {"file_name", sample_file("images", sample, "png")},
                        {"width", recipe.width_px},
                        {"height", recipe.height_px}}},
                      {"annotations", annotations}};
  return facts.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string sample_file(const std::string& folder, int sample, const std::string& extension) {
  return fmt::format("{}/{:06}.{}", folder, sample, extension);
}

SampleMaker::SampleMaker(const scene::Recipe& recipe, const ClassSet& classes,
                         render::LabelSet labels, int threads)
    : recipe_(recipe), classes_(classes), labels_(labels), workers_(threads) {}

void SampleMaker::make_world(const std::vector<std::string>& settings) {
  scene::Scene scene = scene::load_scene(recipe_.scene, settings);
  const int threads = workers_.thread_count();
  world_ = world_ ? render::World(std::move(scene), *world_, threads)
                  : render::World(std::move(scene), threads);
}

Sample SampleMaker::make(int sample) {
  // A scene, and in its view the objects.
  scene::SampleDraw draw = scene::draw_sample(recipe_, sample);
  make_world(draw.settings);
  const auto view_at = [&](double t_s) {
    return render::world_view(*world_, t_s, recipe_.width_px, recipe_.height_px, sea_, workers_);
  };
  const View view = view_at(draw.t_s);
  const auto placed = place_objects(recipe_, sample, *world_, view, draw.t_s);
  if (!placed.empty()) {
    draw.settings.insert(draw.settings.end(), placed.begin(), placed.end());
    make_world(draw.settings);
  }

  render::FrameOptions options;
  options.labels = labels_;
  options.labels.add(render::Label::kId);
  options.labels.add(render::Label::kClass);
  options.next_frame_s = kNextFrame_s;
  if (labels_.has(render::Label::kMotion)) options.next_view = view_at(draw.t_s + kNextFrame_s);
  const std::vector<View> exposed = render::exposed_views(
      *world_, draw.t_s, options, {recipe_.width_px, recipe_.height_px}, sea_, workers_);
  options.exposed_views = exposed;
  render::render_frame(*world_, view, draw.t_s, options, workspace_, target_, workers_);
  warning_.look(sample, *world_, view, workspace_);

  const scene::Scene& scene = world_->scene();
  const int width = target_.width_px, height = target_.height_px;
  const std::vector<std::uint32_t>& ids = target_.labels.id;
  Sample result;
  const auto add = [&](const std::string& folder, const std::string& extension,
                       std::vector<std::uint8_t> bytes) {
    result.files.push_back({sample_file(folder, sample, extension), std::move(bytes)});
    return result.files.back().name;
  };
  const std::string picture =
      add("images", "png", texture::encode_image(rgb_image(target_), ".png"));
  std::string labels;
  if (!labels_.empty())
    labels = add("labels", "exr",
                 encode_planes(width, height, label_planes(target_.labels, labels_, view), {}));
  const texture::Image8 classes{width, height, 1, classes_.class_map(target_.labels, scene)};
  add("classes", "png", texture::encode_image(classes, ".png"));
  const texture::Image16 instances{width, height, 1, {ids.begin(), ids.end()}};
  add("instances", "png", texture::encode_image(instances, ".png"));
  const SidecarFrame facts = {sample, draw.t_s, 1.0 / kNextFrame_s, render::picture_hash(target_),
                              labels, picture};
  add("camera", "json",
      bytes_of(label_sidecar(facts, view, scene, recipe_.scene_text, labels_,
                             command_of(recipe_, draw, sample))));
  result.facts = facts_of(recipe_, scene, classes_, target_, sample);
  return result;
}

}  // namespace swell::apps
