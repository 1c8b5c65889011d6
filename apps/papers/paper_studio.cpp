#include <algorithm>
#include <cmath>

#include "apps/bench/frame_run.h"
#include "apps/papers/paper.h"
#include "apps/shared/output_file.h"
#include "apps/shared/picture_file.h"
#include "apps/shared/report.h"
#include "render/world_view.h"
#include "scene/settings.h"
#include "texture/image/image_io.h"

namespace swell::apps {

bool PaperNumber::holds() const {
  switch (agreement) {
    case Agreement::kSame:
      return std::abs(ours - paper) <= tolerance;
    case Agreement::kAtMost:
      return ours <= paper;
    case Agreement::kAtLeast:
      return ours >= paper;
  }
  return false;
}

PaperStudio::PaperStudio(std::filesystem::path scenes, std::filesystem::path out, PictureSize size,
                         int threads)
    : scenes_(std::move(scenes)),
      out_(std::move(out)),
      size_(size),
      threads_(threads),
      workers_(threads) {}

scene::Scene PaperStudio::load(const std::string& scene, std::span<const std::string> sets) const {
  return scene::load_scene(scene_path(scene), sets);
}

const render::World& PaperStudio::world_of(const std::string& scene,
                                           std::span<const std::string> sets) {
  constexpr std::size_t kKept = 6;
  std::string key = scene;
  for (const std::string& set : sets) key += '\n' + set;
  std::vector<const render::World*> like;
  for (const KeptWorld& kept : kept_) {
    if (kept.key == key) return kept.world;
    like.push_back(&kept.world);
  }
  render::World world(load(scene, sets), like, threads_);
  if (kept_.size() == kKept) kept_.pop_front();
  kept_.push_back({std::move(key), std::move(world)});
  return kept_.back().world;
}

std::string PaperStudio::draw(std::string_view name, const std::string& scene,
                              std::span<const std::string> sets, render::FrameOptions options,
                              double t_s) {
  const render::World& world = world_of(scene, sets);
  ocean::SeaFrame camera_sea;
  const View view =
      render::world_view(world, t_s, size_.width_px, size_.height_px, camera_sea, workers_);
  statistics_ = render::render_frame(world, view, t_s, options, workspace_, picture_, workers_);
  const std::string file = std::string(name) + ".png";
  write_picture(picture_, out_ / file);
  return file;
}

double PaperStudio::least_frame_ms(const std::string& scene, int frames) {
  const render::World& world = world_of(scene);
  ocean::SeaFrame camera_sea;
  render::Target target;
  double least_ms = 1e9;
  for (int k = -kWarmUp; k < frames; ++k) {
    const double t_s = k / kFramesPerSecond;
    const View view =
        render::world_view(world, t_s, size_.width_px, size_.height_px, camera_sea, workers_);
    const double ms =
        render::render_frame(world, view, t_s, {}, workspace_, target, workers_).frame_ms;
    if (k >= 0) least_ms = std::min(least_ms, ms);
  }
  return least_ms;
}

std::string PaperStudio::write(std::string_view name, const texture::Image8& image) const {
  const std::string file = std::string(name) + ".png";
  write_output(out_ / file, texture::encode_image(image, ".png"));
  return file;
}

std::string PaperStudio::write(std::string_view name, const std::string& svg) const {
  const std::string file = std::string(name) + ".svg";
  write_text((out_ / file).string(), svg);
  return file;
}

}  // namespace swell::apps
