// swell-render: draws one picture or a sequence of a scene.
#include <fmt/core.h>

#include "apps/render/frame_log.h"
#include "apps/render/render_options.h"
#include "apps/shared/notices.h"
#include "apps/shared/picture_file.h"
#include "apps/shared/program.h"
#include "render/frame.h"

namespace swell::apps {
namespace {

render::FrameOptions frame_options(const RenderOptions& options) {
  render::FrameOptions frame = options.setup.frame;
  frame.keep_linear = stores_linear_light(options.out);
  return frame;
}

FrameRecord frame_record(const RenderOptions& options, const scene::Scene& scene, int k,
                         const render::Target& target) {
  return {k,
          frame_time_s(options, k),
          target.width_px,
          target.height_px,
          render::picture_hash(target),
          scene.name,
          picture_path(options, k).string()};
}

void draw_frames(const RenderOptions& options, const render::World& world, FrameLog& log) {
  const PictureSize size = options.setup.size;
  const render::FrameOptions frame = frame_options(options);
  Workers workers(options.setup.threads);
  render::Workspace workspace;
  render::Target target;
  EyeWarning warning;
  const FrameRange range = frame_range(options);
  for (int k = range.first; k <= range.last; ++k) {
    const double t_s = frame_time_s(options, k);
    const View view = scene::camera_view(world.scene().camera, t_s, size.width_px, size.height_px);
    render::render_frame(world, view, t_s, frame, workspace, target, workers);
    warning.look(k, world, view, workspace);
    if (!options.out.empty()) write_picture(target, picture_path(options, k));
    log.add(frame_record(options, world.scene(), k, target));
  }
}

void run(const RenderOptions& options) {
  select_simd(options.setup.simd);
  check_output(options);
  FrameLog log(options);
  const bool draws = draws_pictures(options);
  const std::string& path = options.setup.scene_path;
  scene::Scene scene = draws ? load_scene(path) : scene::load_scene(path);
  if (options.dump_scene) fmt::print("{}", scene::dump_scene(scene));
  if (!draws) return;
  draw_frames(options, render::World(std::move(scene)), log);
  log.finish();
}

}  // namespace
}  // namespace swell::apps

int main(int argc, char** argv) {
  return swell::apps::run_program([&] {
    const auto options = swell::apps::parse_render_options(argc, argv);
    if (options) swell::apps::run(*options);
  });
}
