#include "apps/bench/frame_run.h"

#include <fmt/core.h>

#include "apps/shared/cpu_name.h"
#include "apps/shared/notices.h"
#include "apps/shared/report.h"
#include "math/simd_target.h"

namespace swell::apps {

void add_frame_run(CommandLine& line, const std::string& frames_help, FrameRun& run) {
  add_required_frame_setup(line, run.setup);
  add_quality_options(line, run.setup.frame);
  add_integer(line, "--frames", run.frames, 1, 10000, frames_help);
  add_json_option(line, run.json);
}

render::World begin_run(const FrameRun& run) {
  select_simd(run.setup.simd);
  check_text_place(run.json);
  return render::World(load_scene(run.setup.scene), run.setup.threads);
}

void report_run(const FrameRun& run, const render::World& world, const std::string& how,
                const std::string& text, const Json& figures) {
  const PictureSize size = run.setup.size;
  const std::string_view simd = simd_target_name(current_simd_target());
  if (run.json != "-")
    fmt::print("{} {}x{}, {}, {} on {}\n{}", world.scene().name, size.width_px, size.height_px,
               simd, how, cpu_name(), text);
  if (run.json.empty()) return;
  Json json = {{"scene", world.scene().name}, {"size", {size.width_px, size.height_px}}};
  json["simd"] = simd;
  json["cpu"] = cpu_name();
  json.update(figures);
  write_text(run.json, json.dump(2) + "\n");
}

}  // namespace swell::apps
