// swell-render: draws one picture or a sequence of a scene.
#include <fmt/core.h>

#include <chrono>
#include <vector>

#include "apps/render/film_file.h"
#include "apps/render/frame_files.h"
#include "apps/render/frame_log.h"
#include "apps/render/label_sidecar.h"
#include "apps/render/picture_stream.h"
#include "apps/render/render_options.h"
#include "apps/shared/notices.h"
#include "apps/shared/picture_file.h"
#include "apps/shared/program.h"
#include "apps/shared/progress.h"
#include "render/frame.h"
#include "render/world_view.h"
#include "scene/settings.h"

namespace swell::apps {
namespace {

render::FrameOptions frame_options(const RenderOptions& options) {
  render::FrameOptions frame = options.setup.frame;
  frame.keep_linear = stores_linear_light(options.out);
  frame.labels = drawn_labels(options);
  frame.next_frame_s = 1.0 / options.fps;
  return frame;
}

// Writes the frame's files and tells of it.
FrameRecord finish_frame(const RenderOptions& options, const DrawnFrame& frame, FilmFile& film) {
  FrameRecord record = {frame.frame,
                        frame.t_s,
                        frame.view.width_px,
                        frame.view.height_px,
                        frame.hash,
                        frame.scene.name,
                        picture_path(options, frame.frame).string()};
  if (!writes_files(options)) return record;
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  write_frame_files(options, frame);
  film.add(frame);
  record.file_ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  return record;
}

void draw_frames(const RenderOptions& options, const render::World& world, FrameLog& log) {
  const PictureSize size = options.setup.size;
  render::FrameOptions frame = frame_options(options);
  Workers workers(options.setup.threads);
  render::Workspace workspace;
  render::Target target;
  ocean::SeaFrame sea;
  const auto view_at = [&](double t_s) {
    return render::world_view(world, t_s, size.width_px, size.height_px, sea, workers);
  };
  EyeWarning warning;
  const FrameRange range = frame_range(options);
  PictureStream stream(options.stream, options.fps);
  FilmFile film(options);
  Progress progress((range.last - range.first) / options.every + 1, options.quiet, "frames");
  const std::string scene_hash = scene_hash_text(world.scene());
  for (int k = range.first; k <= range.last; k += options.every) {
    if (options.skip_existing && files_exist(options, k)) {
      progress.skip();
      continue;
    }
    const double t_s = frame_time_s(options, k);
    const View view = view_at(t_s);
    const std::vector<View> exposed =
        render::exposed_views(world, t_s, frame, {size.width_px, size.height_px}, sea, workers);
    frame.exposed_views = exposed;
    if (frame.labels.has(render::Label::kMotion))
      frame.next_view = view_at(next_time_s(options, k));
    render::render_frame(world, view, t_s, frame, workspace, target, workers);
    warning.look(k, world, view, workspace);
    stream.add(target);
    const std::uint64_t hash = render::picture_hash(target);
    log.add(finish_frame(options, {k, t_s, hash, scene_hash, world.scene(), view, target}, film));
    progress.step();
  }
  film.finish();
}

void run(const RenderOptions& options) {
  select_simd(options.setup.simd);
  check_output(options);
  FrameLog log(options);
  const bool draws = draws_pictures(options);
  const SceneChoice& choice = options.setup.scene;
  scene::Scene scene = draws ? load_scene(choice) : scene::load_scene(choice.path, choice.settings);
  if (options.dump_scene) fmt::print("{}", scene::dump_scene(scene));
  if (!draws) return;
  if (options.setup.frame.wireframe) check_perspective(scene, "--wireframe");
  const render::WorldMaking making = {.threads = options.setup.threads,
                                      .cache_folder = options.setup.cache_folder};
  draw_frames(options, render::World(std::move(scene), making), log);
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
